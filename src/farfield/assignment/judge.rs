//! The decision for one order, by the numbers of the particle and the thresholds.

use super::assigned::{Assigned, PlanesOutcome};
use super::method::{Method, Reason};
use super::near_grazing_taper::taper;
use super::rim::Rim;
use super::thresholds::Thresholds;
use crate::shape::Shape;
use std::f64::consts::PI;

/// The numbers of one particle and wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Judge {
    pub by: Thresholds,
    pub size_parameter: f64,
    pub tolerance: f64,
    pub index: f64,
    pub rim: Rim,
    /// Whether the body looks the same from below.
    pub mirror: bool,
    /// Whether small sizes are sums over partial waves.
    pub deformed: bool,
    /// Caustic disorder per order.
    pub disorder: f64,
}

impl Judge {
    pub(super) fn first(&self, order: u32) -> Assigned {
        let limit = self.by.partial_waves_below;
        if order == 0 || !self.deformed || self.size_parameter >= limit {
            let share = self.share_of_sum(order);
            if share >= 1.0 {
                let [_, limit] = self.by.wavefront_disorder(order, self.mirror);
                let reason = Reason::Disordered(self.decisive_disorder(order), limit);
                return self.complex_wavefront(order, vec![reason]);
            }
            let mixed = (share > 0.0).then_some(Reason::Mixed(share));
            let mut entry = self.planes(order, mixed.into_iter().collect());
            entry.share_of_sum = share;
            entry.expected_error += share * (self.error_of_wavefront(order) - entry.expected_error);
            return entry;
        }
        let expected_error = self.by.error_of_partial_waves / self.size_parameter;
        let reasons = vec![Reason::Small(limit)];
        assigned(order, Method::PartialWaves, reasons, expected_error)
    }

    pub(super) fn planes(&self, order: u32, mut reasons: Vec<Reason>) -> Assigned {
        reasons.push(match order {
            0 => Reason::Reflection,
            _ if self.rotational() => Reason::OnePlane,
            _ => Reason::Ordered(self.disorder_of(order)),
        });
        let expected_error = (self.next_terms(order) * self.size_parameter.powf(-2.0 / 3.0))
            .hypot(self.by.error_of_knots * self.tolerance);
        assigned(order, Method::Planes, reasons, expected_error)
    }

    fn rotational(&self) -> bool {
        self.rim != Rim::Uneven
    }

    /// What scattering planes lack of an order, in units of `x^{-2/3}`. Bows of spheres are as good as rays without
    /// one where the integral near the rim holds them, and as bad as pairs of rays near the rim where it does not.
    fn next_terms(&self, order: u32) -> f64 {
        let by_order = self.by.error_of_planes;
        if self.rim != Rim::Sphere || order < 2 {
            return by_order[(order as usize).min(by_order.len() - 1)];
        }
        let marks = taper(
            &self.by,
            self.index,
            order,
            self.size_parameter,
            0.0,
            self.by.narrowest_axis_gap,
            Rim::Sphere,
        );
        let serves = self.by.near_grazing_share(self.index, order, self.rim, 0.0) > 0.0;
        let holds =
            serves && marks.is_some() && self.size_parameter <= self.by.largest_checked_sphere;
        if holds { by_order[1] } else { by_order[2] }
    }

    pub(super) fn after_planes(&self, mut entry: Assigned, outcome: &PlanesOutcome) -> Assigned {
        if let Some((spacing, formulas)) = &outcome.found {
            entry.reasons.push(Reason::Traced(*spacing));
            entry.formulas.clone_from(formulas);
            return entry;
        }
        self.without_planes(&entry)
    }

    /// A sum on a complex wavefront, or patches for particles so small that it is too coarse. Reflection
    /// stays with patches: its rays are strongest where launch points end, at the rim, which a sum over them
    /// would show as an edge that shines.
    fn without_planes(&self, entry: &Assigned) -> Assigned {
        let order = entry.order;
        let lost = entry.reasons.iter().filter(|reason| **reason == Reason::RadialLinesLost);
        let mut reasons: Vec<Reason> = lost.copied().chain([Reason::Unmatched]).collect();
        if order == 0 {
            reasons.push(Reason::Reflection);
            return self.patches(order, reasons);
        }
        if self.size_parameter < self.by.wavefront_from {
            reasons.push(Reason::Small(self.by.wavefront_from));
            return self.patches(order, reasons);
        }
        self.complex_wavefront(order, reasons)
    }

    fn complex_wavefront(&self, order: u32, reasons: Vec<Reason>) -> Assigned {
        let expected_error = self.error_of_wavefront(order);
        let entry = assigned(order, Method::ComplexWavefront, reasons, expected_error);
        Assigned { share_of_sum: 1.0, ..entry }
    }

    /// What the wave next to the last ray misses falls like the width of the rim's edge, `x^(-1/3)`.
    fn error_of_wavefront(&self, order: u32) -> f64 {
        let by_order = self.by.error_of_wavefront;
        let measured = by_order[(order as usize).min(by_order.len() - 1)];
        (measured * (self.by.wavefront_measured_at / self.size_parameter).cbrt()).min(1.0)
    }

    /// Share of a sum on a complex wavefront in the wave of an order; the rest is that of scattering planes.
    fn share_of_sum(&self, order: u32) -> f64 {
        if order == 0 || self.rotational() || self.size_parameter < self.by.wavefront_from {
            return 0.0;
        }
        self.by.wavefront_share(order, self.mirror, self.decisive_disorder(order))
    }

    pub(super) fn patches(&self, order: u32, reasons: Vec<Reason>) -> Assigned {
        let reflected = self.by.error_of_reflection_by_patches;
        let expected_error = if order == 0 { reflected } else { self.by.error_of_patches };
        assigned(order, Method::Patches, reasons, expected_error)
    }

    /// Whether planes of an order are compared with a sum.
    pub(super) fn is_cross_checked(&self, order: u32) -> bool {
        let [first, last] = self.by.cross_checked_orders;
        let serves = !self.rotational() && self.size_parameter >= self.by.wavefront_from;
        serves
            && (first..=last).contains(&order)
            && self.disorder_of(order) > self.by.cross_checked_disorder
    }

    /// The disorder by which a sum takes over: of high orders, whose bows are all made at the same rim, that
    /// of the first.
    fn decisive_disorder(&self, order: u32) -> f64 {
        self.disorder_of(order.min(self.by.first_high_order))
    }

    pub(super) fn disorder_of(&self, order: u32) -> f64 {
        f64::from(order) * self.disorder
    }
}

fn assigned(order: u32, method: Method, reasons: Vec<Reason>, expected_error: f64) -> Assigned {
    Assigned { order, method, reasons, expected_error, share_of_sum: 0.0, formulas: Vec::new() }
}

/// How far rays of an order stray from those of a sphere: order times deformation of the outline.
pub(crate) fn caustic_disorder(shape: &Shape, order: u32) -> f64 {
    let silhouette = shape.silhouette();
    let radii: Vec<f64> = (0..16).map(|k| silhouette.radius(k as f64 * PI / 8.0)).collect();
    let (low, high) = radii.iter().fold((f64::MAX, 0.0f64), |(l, h), r| (l.min(*r), h.max(*r)));
    f64::from(order) * (high - low)
}
