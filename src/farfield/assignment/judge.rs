//! The decision for one order, by the numbers of the particle and the thresholds.

use super::assigned::{Assigned, PlanesOutcome};
use super::method::{Method, Reason};
use super::thresholds::Thresholds;
use crate::trace::Tracer;
use std::f64::consts::PI;

/// The numbers of one particle and wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Judge {
    pub by: Thresholds,
    pub size_parameter: f64,
    pub tolerance: f64,
    pub rotational: bool,
    /// Whether small sizes are sums over partial waves.
    pub deformed: bool,
    /// Caustic disorder per order.
    pub disorder: f64,
}

impl Judge {
    pub(super) fn first(&self, order: u32) -> Assigned {
        let limit = self.by.partial_waves_below;
        if order == 0 || !self.deformed || self.size_parameter >= limit {
            return self.planes(order, Vec::new());
        }
        let expected_error = self.by.error_of_partial_waves / self.size_parameter;
        let reasons = vec![Reason::Small(limit)];
        assigned(order, Method::PartialWaves, reasons, expected_error)
    }

    pub(super) fn planes(&self, order: u32, mut reasons: Vec<Reason>) -> Assigned {
        reasons.push(match order {
            0 => Reason::Reflection,
            _ if self.rotational => Reason::OnePlane,
            _ => Reason::Ordered(self.disorder_of(order)),
        });
        let by_order = self.by.error_of_planes;
        let next_terms = by_order[(order as usize).min(by_order.len() - 1)];
        let expected_error = (next_terms * self.size_parameter.powf(-2.0 / 3.0))
            .hypot(self.by.error_of_knots * self.tolerance);
        assigned(order, Method::Planes, reasons, expected_error)
    }

    pub(super) fn after_planes(&self, mut entry: Assigned, outcome: &PlanesOutcome) -> Assigned {
        if let Some((spacing, formulas)) = &outcome.found {
            entry.reasons.push(Reason::Traced(*spacing));
            entry.formulas.clone_from(formulas);
            return entry;
        }
        let (order, limit) = (entry.order, self.by.hopeless_disorder);
        let disorder = self.disorder_of(order);
        let hopeless = self.by.is_hopeless(order, disorder);
        let reason = if hopeless { Reason::Disordered(disorder, limit) } else { Reason::Unmatched };
        self.without_planes(&entry, reason)
    }

    pub(super) fn after_check(&self, mut entry: Assigned, difference: f64) -> Assigned {
        let limit = self.by.gross_difference;
        if difference > limit {
            return self.without_planes(&entry, Reason::Differs(difference, limit));
        }
        entry.reasons.push(Reason::Agrees(difference));
        entry
    }

    /// Beams, or patches for particles so small, or tolerances so coarse, that those do better. Order 0
    /// stays with patches: its rays are strongest where launch points end, at the rim, which beams would
    /// show as an edge that shines.
    pub(super) fn without_planes(&self, entry: &Assigned, why: Reason) -> Assigned {
        let order = entry.order;
        let lost = entry.reasons.iter().filter(|reason| **reason == Reason::RadialLinesLost);
        let mut reasons: Vec<Reason> = lost.copied().chain([why]).collect();
        let (size, tolerance) = (self.by.beams_from, self.by.beams_tolerance);
        if order == 0 {
            reasons.push(Reason::Reflection);
            return self.patches(order, reasons);
        }
        if !self.has_beams() {
            reasons.push(Reason::CoarseEnough(size, tolerance));
            return self.patches(order, reasons);
        }
        reasons.push(Reason::Fine(size, tolerance));
        assigned(order, Method::Beams, reasons, self.by.error_of_beams * f64::from(order))
    }

    pub(super) fn patches(&self, order: u32, reasons: Vec<Reason>) -> Assigned {
        let reflected = self.by.error_of_reflection_by_patches;
        let expected_error = if order == 0 { reflected } else { self.by.error_of_patches };
        assigned(order, Method::Patches, reasons, expected_error)
    }

    pub(super) fn has_beams(&self) -> bool {
        self.size_parameter >= self.by.beams_from && self.tolerance <= self.by.beams_tolerance
    }

    /// Why no order is compared with beams, if none is.
    pub(super) fn skips_check(&self) -> Option<String> {
        let [_, last] = self.by.cross_checked_orders;
        let (size, disorder) = (self.by.cross_checked_size, self.by.cross_checked_disorder);
        let why = if self.rotational || self.disorder_of(last) <= disorder {
            format!("rays up to order {last} stray no farther than {disorder} from a sphere's")
        } else if self.size_parameter < size {
            format!("the size parameter is below {size}")
        } else if !self.has_beams() {
            format!("the tolerance is above {}", self.by.beams_tolerance)
        } else {
            return None;
        };
        Some(format!("a cross-check by Gaussian beams: {why}"))
    }

    pub(super) fn disorder_of(&self, order: u32) -> f64 {
        f64::from(order) * self.disorder
    }
}

fn assigned(order: u32, method: Method, reasons: Vec<Reason>, expected_error: f64) -> Assigned {
    Assigned { order, method, reasons, expected_error, formulas: Vec::new() }
}

/// How far rays of an order stray from those of a sphere: order times deformation of the outline.
pub(crate) fn caustic_disorder(tracer: &Tracer, order: u32) -> f64 {
    let silhouette = tracer.shape().silhouette();
    let radii: Vec<f64> = (0..16).map(|k| silhouette.radius(k as f64 * PI / 8.0)).collect();
    let (low, high) = radii.iter().fold((f64::MAX, 0.0f64), |(l, h), r| (l.min(*r), h.max(*r)));
    f64::from(order) * (high - low)
}
