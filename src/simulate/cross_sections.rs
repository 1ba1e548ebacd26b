//! Cross-sections of a ray-made far field: extinction straight ahead, absorption along the rays.

use super::error::SimulateError;
use crate::farfield::{Direction, FarField};
use crate::phase_table::InvalidTable;
use crate::plan::Plan;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Cross sections in units of the squared radius.
#[derive(Clone, Copy, Debug)]
pub struct CrossSections {
    /// What the light loses.
    pub extinction: f64,
    /// What turns into heat.
    pub absorption: f64,
}

impl CrossSections {
    /// From the share of light on the shadow that rays lose inside. Extinction is what the wave
    /// straight ahead lacks (optical theorem) where diffraction is part of it, twice the shadow for
    /// patches, which have no sound wave there; without diffraction the shadow alone.
    pub(super) fn new(plan: &Plan, far_field: &FarField, index: Complex64, absorbed: f64) -> Self {
        let area = far_field.silhouette().area();
        let wave = far_field.forward_wave();
        let beyond = wave.edge.filter(|_| index.im > 0.0).map_or(0.0, |e| e.absorption(index));
        let ahead = far_field.straight_forward().filter(|_| plan.forward_diffraction);
        let extinction = match ahead {
            Some(s) => TAU * (s.s1 + s.s2).re / wave.size_parameter.powi(2),
            None if plan.forward_diffraction => 2.0 * area,
            None => area,
        };
        Self { extinction, absorption: area * absorbed + beyond }
    }

    /// Extinction less absorption.
    pub fn scattering(&self) -> f64 {
        self.extinction - self.absorption
    }

    /// Numbers, with something scattered and no more absorbed than is taken from the light.
    pub(super) fn validate(&self) -> Result<(), SimulateError> {
        let slack = 1e-6 * self.extinction.abs();
        let absorbed = (-slack..=self.extinction).contains(&self.absorption);
        if self.extinction.is_finite() && self.scattering() > 0.0 && absorbed {
            return Ok(());
        }
        let accepted = "0 or more of it absorbed, and more than 0 scattered".to_string();
        let value = format!("{:e}, absorption {:e}", self.extinction, self.absorption);
        let field = "extinction in units of the squared radius".into();
        Err(SimulateError::Amplitudes(InvalidTable { field, value, accepted }))
    }
}

/// Extinction by the optical theorem, in units of the squared radius, from what the columns of a table
/// have at θ = 0 of one azimuth. `S1 + S2` there is a trace, the same in the plane of every azimuth.
pub(super) fn straight_ahead(far_field: &FarField, azimuth: f64) -> f64 {
    let rays = far_field.columns(&[0.0], &[azimuth], false).swap_remove(0).amplitude[0];
    let wave = far_field.forward_wave();
    let whole = rays + wave.peak(&Direction::new(0.0, azimuth));
    TAU * (whole.s1 + whole.s2).re / wave.size_parameter.powi(2)
}
