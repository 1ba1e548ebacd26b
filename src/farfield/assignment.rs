//! Which method stands for which order, why, and how far its wave may be off: decided by the scene alone,
//! never by the directions asked for.
//!
//! Scattering planes serve as long as their rays match from azimuth to azimuth. How far rays of an order
//! stray from those of a sphere grows with the order and with the deformation of the outline (see
//! [`caustic_disorder`]); beyond some of it the order is a sum on a complex wavefront
//! ([`super::complex_wavefront`]), which asks nothing of its rays. Between two values of it both are
//! computed and mixed, so that nothing jumps where one takes over from the other. Where few wavelengths fit
//! into a particle, all caustics of an order lie in one wave zone, and it is a sum over partial waves
//! ([`super::partial_waves`]). What cannot be followed on trial is handed on by [`Assignment::after`].
//!
//! ```
//! use gonio::farfield::assignment::{Assignment, Method, Thresholds};
//! use gonio::{shape::Shape, trace::Tracer};
//! let shape = Shape::spheroid(0.95, 0.0)?;
//! let tracer = Tracer::new(&shape, 1.333.into(), 200.0, 2);
//! let found = Assignment::new(&tracer, &[0, 1, 2], 200.0, &Thresholds::MEASURED);
//! assert_eq!(found.orders_of(Method::Planes), [0]);
//! assert_eq!(found.orders_of(Method::PartialWaves), [1, 2]);
//! # Ok::<(), gonio::shape::ShapeError>(())
//! ```

use crate::trace::Tracer;
use serde::Serialize;
use std::f64::consts::PI;

/// Every number on which the choice of a method and its expected error rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thresholds {
    /// Size parameter below which transmitted orders of deformed particles are sums over partial waves:
    /// from here on planes are quicker, and as good (errors of both meet at 600).
    pub partial_waves_below: f64,
    /// Caustic disorder over which the sum on a complex wavefront takes over, for orders that cross the
    /// axis once; planes and sum agree between the two values.
    pub sum_low_orders: [f64; 2],
    /// The same for orders whose bows are made near the rim.
    pub sum_high_orders: [f64; 2],
    /// The first of the latter.
    pub first_high_order: u32,
    /// Bodies that look the same from below keep their rays in order further: planes of a spheroid of axis
    /// ratio 0.9 are reciprocal within 1e-4 up to order 3.
    pub of_mirror_symmetry: f64,
    /// Share of its amplitude by which a wave may be off, measured against Debye terms: of partial waves
    /// times the size parameter.
    pub error_of_partial_waves: f64,
    /// The same of sums on a complex wavefront, by order.
    pub error_of_sums: f64,
    /// The same of patches.
    pub error_of_patches: f64,
}

impl Thresholds {
    /// As measured.
    pub const MEASURED: Self = Self {
        partial_waves_below: 600.0,
        sum_low_orders: [0.14, 0.165],
        sum_high_orders: [0.09, 0.1],
        first_high_order: 4,
        of_mirror_symmetry: 2.0,
        error_of_partial_waves: 2.0,
        error_of_sums: 0.02,
        error_of_patches: 0.07,
    };
}

impl Default for Thresholds {
    fn default() -> Self {
        Self::MEASURED
    }
}

/// What computes the wave of an order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    Planes,
    PartialWaves,
    ComplexWavefront,
    Patches,
}

impl Method {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Method::Planes => "scattering planes with uniform formulas at caustics",
            Method::PartialWaves => "sum over partial waves from rays",
            Method::ComplexWavefront => "sum over rays of a complex wavefront",
            Method::Patches => "patches of rays on the sphere of directions",
        }
    }
}

/// One method's part in one order.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Assigned {
    pub order: u32,
    pub method: Method,
    /// Share of the order's amplitude that this method stands for.
    pub share: f64,
    pub reason: String,
    /// Share of the amplitude by which it may be off.
    pub expected_error: f64,
}

/// What could not be followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trial<'o> {
    /// Orders whose radial lines of launch points lose their rays.
    RadialLines(&'o [u32]),
    /// Orders whose scattering planes do not match.
    Planes(&'o [u32]),
}

/// Who computes what, by ascending order.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Assignment {
    entries: Vec<Assigned>,
    #[serde(skip)]
    judge: Judge,
}

/// The numbers of one particle and wavelength.
#[derive(Clone, Debug, PartialEq)]
struct Judge {
    thresholds: Thresholds,
    size_parameter: f64,
    rotational: bool,
    deformed: bool,
    /// Caustic disorder per order, lessened by the body's symmetry.
    deformation: f64,
}

impl Assignment {
    /// Decide for some orders, ascending.
    pub fn new(tracer: &Tracer, orders: &[u32], size_parameter: f64, by: &Thresholds) -> Self {
        let deformed = !tracer.shape().rotational_symmetry();
        Self::as_if(deformed, tracer, orders, size_parameter, by)
    }

    /// The same; `deformed` says whether the particle counts as one that small sizes serve by partial
    /// waves: a sphere may stand for a deformed one.
    pub(crate) fn as_if(
        deformed: bool,
        tracer: &Tracer,
        orders: &[u32],
        size_parameter: f64,
        by: &Thresholds,
    ) -> Self {
        let shape = tracer.shape();
        let lessened = if shape.mirror_symmetry() { by.of_mirror_symmetry } else { 1.0 };
        let judge = Judge {
            thresholds: *by,
            size_parameter,
            rotational: shape.rotational_symmetry(),
            deformed,
            deformation: caustic_disorder(tracer, 1) / lessened,
        };
        let entries = orders.iter().flat_map(|&order| judge.first(order)).collect();
        Self { entries, judge }
    }

    /// The same after a trial: orders that it lost go to others.
    #[must_use]
    pub fn after(self, trial: Trial) -> Self {
        let Self { entries, judge } = self;
        let lost = |entry: &Assigned| match trial {
            Trial::RadialLines(lost) => {
                entry.method == Method::PartialWaves && lost.contains(&entry.order)
            }
            Trial::Planes(lost) => lost.contains(&entry.order),
        };
        let mut settled: Vec<Assigned> = Vec::new();
        for entry in entries {
            if !lost(&entry) {
                settled.push(entry);
            } else if settled.last().is_none_or(|last| last.order != entry.order) {
                settled.extend(match trial {
                    Trial::RadialLines(_) => judge.by_disorder(entry.order),
                    Trial::Planes(_) => vec![judge.without_planes(entry.order)],
                });
            }
        }
        Self { entries: settled, judge }
    }

    /// All parts, by ascending order.
    pub fn entries(&self) -> &[Assigned] {
        &self.entries
    }

    /// The orders in which a method has a part.
    pub fn orders_of(&self, method: Method) -> Vec<u32> {
        self.shares_of(method).into_iter().map(|(order, _)| order).collect()
    }

    /// The same with its shares.
    pub fn shares_of(&self, method: Method) -> Vec<(u32, f64)> {
        let of_it = self.entries.iter().filter(|entry| entry.method == method);
        of_it.map(|entry| (entry.order, entry.share)).collect()
    }

    /// The expected error of a method in the lowest order of its own.
    pub fn error_of(&self, method: Method) -> f64 {
        let first = self.entries.iter().find(|entry| entry.method == method);
        first.map_or(0.0, |entry| entry.expected_error)
    }
}

impl Judge {
    fn first(&self, order: u32) -> Vec<Assigned> {
        let limit = self.thresholds.partial_waves_below;
        if order == 0 || !self.deformed || self.size_parameter >= limit {
            return self.by_disorder(order);
        }
        let reason = format!(
            "few wavelengths in the particle: size parameter {:.0} below {limit}",
            self.size_parameter
        );
        let expected_error = self.thresholds.error_of_partial_waves / self.size_parameter;
        vec![Assigned { order, method: Method::PartialWaves, share: 1.0, reason, expected_error }]
    }

    /// Planes, the sum, or both.
    fn by_disorder(&self, order: u32) -> Vec<Assigned> {
        let (share, disorder) = (self.share_of_sum(order), f64::from(order) * self.deformation);
        let [from, to] = self.limits(order);
        let planes = Assigned {
            order,
            method: Method::Planes,
            share: 1.0 - share,
            reason: match order {
                0 => "reflection: its wave is one with the penumbra".into(),
                _ if self.rotational => {
                    "one plane stands for all: nothing depends on azimuth".into()
                }
                _ => {
                    format!("rays match from azimuth to azimuth: disorder {disorder:.3} below {to}")
                }
            },
            // the next terms of the uniform formulas
            expected_error: self.size_parameter.powf(-2.0 / 3.0),
        };
        let reason = format!("caustics in disorder: {disorder:.3} above {from}");
        let sum = Assigned { share, ..self.sum(order, reason) };
        [planes, sum].into_iter().filter(|part| part.share > 0.0).collect()
    }

    fn without_planes(&self, order: u32) -> Assigned {
        let reason = "scattering planes do not match from azimuth to azimuth".into();
        if order == 0 {
            // at the rim a sum would show its end as an edge that shines
            let expected_error = self.thresholds.error_of_patches;
            return Assigned { order, method: Method::Patches, share: 1.0, reason, expected_error };
        }
        self.sum(order, reason)
    }

    fn sum(&self, order: u32, reason: String) -> Assigned {
        let expected_error = self.thresholds.error_of_sums * f64::from(order);
        Assigned { order, method: Method::ComplexWavefront, share: 1.0, reason, expected_error }
    }

    fn limits(&self, order: u32) -> [f64; 2] {
        let by = &self.thresholds;
        if order < by.first_high_order { by.sum_low_orders } else { by.sum_high_orders }
    }

    /// Share of the sum in the wave of an order; the rest is that of scattering planes. Reflection has its
    /// own wave at the rim, and what is rotationally symmetric one plane.
    fn share_of_sum(&self, order: u32) -> f64 {
        if order == 0 || self.rotational {
            return 0.0;
        }
        let [from, to] = self.limits(order);
        let t = ((f64::from(order) * self.deformation - from) / (to - from)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    }
}

/// How far rays of an order stray from those of a sphere: order times deformation of the outline.
pub(crate) fn caustic_disorder(tracer: &Tracer, order: u32) -> f64 {
    let silhouette = tracer.shape().silhouette();
    let radii: Vec<f64> = (0..16).map(|k| silhouette.radius(k as f64 * PI / 8.0)).collect();
    let (low, high) = radii.iter().fold((f64::MAX, 0.0f64), |(l, h), r| (l.min(*r), h.max(*r)));
    f64::from(order) * (high - low)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{RaindropModel, Shape};
    use num_complex::Complex64;

    fn shares(radius_mm: f64, elevation: f64) -> Vec<f64> {
        let sun = elevation.to_radians();
        let model = RaindropModel::BeardChuang1987;
        let shape = Shape::raindrop(1e-3 * radius_mm, model, sun).unwrap();
        let tracer = Tracer::new(&shape, Complex64::new(1.33, 0.0), 5000.0, 5);
        let orders: Vec<u32> = (0..=5).collect();
        let found = Assignment::new(&tracer, &orders, 5000.0, &Thresholds::MEASURED);
        let of_sum = found.shares_of(Method::ComplexWavefront);
        let share =
            |order| of_sum.iter().find(|(p, _)| *p == order).map_or(0.0, |(_, share)| *share);
        orders.into_iter().map(share).collect()
    }

    #[test]
    fn shares_rise_with_order_and_deformation() {
        assert_eq!(shares(0.5, 20.0), [0.0; 6]);
        assert_eq!(shares(2.0, 20.0), [0.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
        let all: Vec<f64> = (40..200).map(|r| shares(0.01 * f64::from(r), 20.0)[2]).collect();
        assert!(all.windows(2).all(|w| w[1] >= w[0] && w[1] - w[0] < 0.6), "{all:?}");
    }

    /// Seen along its axis a drop is round, however flat.
    #[test]
    fn drops_lit_from_above_have_one_plane() {
        assert_eq!(shares(2.0, 90.0), [0.0; 6]);
    }

    fn spheroid(size_parameter: f64, by: &Thresholds) -> Assignment {
        let shape = Shape::spheroid(0.9, 0.0).unwrap();
        let tracer = Tracer::new(&shape, Complex64::new(1.333, 0.0), size_parameter, 5);
        Assignment::new(&tracer, &[0, 1, 2, 5], size_parameter, by)
    }

    /// The shares of each order add up to one, whatever happens to it.
    #[test]
    fn shares_add_up() {
        for x in [100.0, 599.0, 600.0, 5000.0] {
            let first = spheroid(x, &Thresholds::MEASURED);
            let second = first.clone().after(Trial::RadialLines(&[2]));
            let third = second.clone().after(Trial::Planes(&[0, 5]));
            for found in [first, second, third] {
                for order in [0, 1, 2, 5] {
                    let parts = found.entries().iter().filter(|entry| entry.order == order);
                    let sum: f64 = parts.map(|entry| entry.share).sum();
                    assert!((sum - 1.0).abs() < 1e-15, "x = {x}, order {order}: {sum}");
                }
            }
        }
    }

    #[test]
    fn a_trial_hands_on_what_it_lost() {
        let found = spheroid(200.0, &Thresholds::MEASURED).after(Trial::RadialLines(&[1]));
        assert_eq!(found.orders_of(Method::Planes), [0, 1]);
        let found = found.after(Trial::Planes(&[0, 1]));
        assert_eq!(found.orders_of(Method::Patches), [0]);
        assert_eq!(found.orders_of(Method::ComplexWavefront), [1]);
        assert_eq!(found.orders_of(Method::PartialWaves), [2, 5]);
        assert_eq!(found.error_of(Method::PartialWaves), 2.0 / 200.0);
    }

    /// Another threshold, another method and another reason.
    #[test]
    fn thresholds_decide() {
        let by = Thresholds { partial_waves_below: 150.0, ..Thresholds::MEASURED };
        assert!(spheroid(200.0, &by).orders_of(Method::PartialWaves).is_empty());
        let [measured, moved] = [&Thresholds::MEASURED, &by].map(|by| spheroid(200.0, by));
        assert_ne!(measured.entries()[1].reason, moved.entries()[1].reason);
    }
}
