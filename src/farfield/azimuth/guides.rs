//! Guides to the planes of a particle's orders, for all wavelengths of a table.
//!
//! Scans take half of the tracing, and only the index moves from wavelength to wavelength: they are made once at a few
//! indices ([`crate::farfield::deflection::guide`]).

use super::places::{Azimuths, axis_gaps, scanned_rays, steps};
use crate::farfield::assignment::{Thresholds, caustic_disorder};
use crate::farfield::deflection::guide::{GuideIndices, OrderGuide};
use crate::math::parallel::*;
use crate::shape::Shape;

/// Guides by order.
#[derive(Clone, Debug)]
pub struct Guides(Vec<(u32, OrderGuide)>);

impl Guides {
    /// For some orders of a particle, at all indices (real parts) between two.
    pub fn new(
        shape: &Shape,
        orders: &[u32],
        tolerance: f64,
        [from, to]: [f64; 2],
        by: &Thresholds,
    ) -> Self {
        let indices = GuideIndices::between(from, to);
        let guide = |&order: &u32| {
            let azimuths = Azimuths::of(shape).places(tolerance, steps(by, order));
            let gap = axis_gaps(by.narrowest_axis_gap, caustic_disorder(shape, order))[0];
            let rays = scanned_rays(order);
            (order, OrderGuide::new(shape, order, &azimuths, rays, gap, &indices))
        };
        Self(orders.par_iter().map(guide).collect())
    }

    /// That of an order.
    pub(crate) fn of(&self, order: u32) -> Option<&OrderGuide> {
        self.0.iter().find(|guide| guide.0 == order).map(|guide| &guide.1)
    }
}
