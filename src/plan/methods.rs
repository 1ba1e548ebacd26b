//! Who computes what in a scene, in words: per range of wavelengths and order the method, why, how far it may
//! be off, and the share of the light.

use super::{Engine, Plan};
use crate::farfield::assignment::Assigned;
use crate::medium::MediumError;
use crate::scene::Scene;
use crate::trace::{Wavefront, energy_by_fate};
use serde::Serialize;
use std::f64::consts::TAU;

/// Rays per side of the grid by which the light is shared out.
const GRID: usize = 60;

/// One order's part in a range of wavelengths.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OrderPlan {
    #[serde(flatten)]
    pub assigned: Assigned,
    /// Share of the light on the shadow that leaves in this order.
    pub share_of_light: f64,
}

/// Wavelengths over which the same methods stand for the same orders.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MethodRange {
    /// Shortest and longest, nanometres.
    pub from_nm: f64,
    pub to_nm: f64,
    /// Numbers are those of the first wavelength.
    pub orders: Vec<OrderPlan>,
}

impl Plan {
    /// The methods of all wavelengths of a scene; empty where an exact series or patches alone serve.
    ///
    /// # Errors
    /// A wavelength outside the medium's data.
    pub fn methods(&self, scene: &Scene) -> Result<Vec<MethodRange>, MediumError> {
        let mut ranges: Vec<MethodRange> = Vec::new();
        if self.engine != Engine::Meridians {
            return Ok(ranges);
        }
        for &wavelength in &scene.wavelengths {
            let (index, x) = (scene.medium.index(wavelength)?, TAU * self.radius / wavelength);
            let tracer = self.tracer(index, x);
            let entries = self.assignment(&tracer, x).entries().to_vec();
            let nm = 1e9 * wavelength;
            let same = |range: &&mut MethodRange| {
                let parts = range.orders.iter().map(|o| (o.assigned.order, o.assigned.method));
                parts.eq(entries.iter().map(|entry| (entry.order, entry.method)))
            };
            if let Some(range) = ranges.last_mut().filter(same) {
                (range.from_nm, range.to_nm) = (range.from_nm.min(nm), range.to_nm.max(nm));
                continue;
            }
            let fates = energy_by_fate(&tracer, &Wavefront::midpoints(&self.shape, GRID, GRID));
            let order = |assigned: Assigned| {
                let left = fates.left_by_order.get(assigned.order as usize).copied();
                OrderPlan { share_of_light: left.unwrap_or(0.0), assigned }
            };
            let orders = entries.into_iter().map(order).collect();
            ranges.push(MethodRange { from_nm: nm, to_nm: nm, orders });
        }
        Ok(ranges)
    }
}
