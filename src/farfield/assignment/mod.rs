//! Which method stands for which order, why, and how far its wave may be off: the one place that decides.
//!
//! Decided first by the scene alone: where few wavelengths fit into a deformed particle, all caustics of
//! an order lie in one wave zone, and it is a sum over partial waves ([`crate::farfield::PartialWaves`]);
//! else scattering planes serve ([`crate::farfield::PlaneSet`]). What turns out on trial is an [`Outcome`], a
//! value, and [`Assignment::after`] makes the next assignment of it: orders whose planes do not match are
//! sums on a complex wavefront ([`crate::farfield::ComplexWavefront`]), reflection and the smallest particles
//! go to patches. How far rays of an order stray from a sphere's grows with the order and with the deformation
//! of the outline; from some of it on the order is such a sum at once, which asks nothing of its rays, and over
//! a range before that it is mixed of both, so that nothing jumps where one takes over from the other.
//! [`crate::farfield::FarField`] obeys. All numbers by which this goes are in the [`Thresholds`]; none of it
//! depends on the directions asked for.
//!
//! ```
//! use gonio::farfield::assignment::{Assignment, Method, Outcome, Thresholds};
//! use gonio::{shape::Shape, trace::Tracer};
//! let shape = Shape::spheroid(0.95, 0.0)?;
//! let tracer = Tracer::new(&shape, 1.333.into(), 200.0, 2);
//! let first = Assignment::new(&tracer, &[0, 1, 2], 200.0, 0.01, &Thresholds::MEASURED);
//! assert_eq!(first.orders_of(Method::Planes), [0]);
//! assert_eq!(first.orders_of(Method::PartialWaves), [1, 2]);
//! let second = first.after(Outcome::RadialLines(&[2]));
//! assert_eq!(second.orders_of(Method::Planes), [0, 2]);
//! # Ok::<(), gonio::shape::ShapeError>(())
//! ```

mod assigned;
mod judge;
mod method;
pub(crate) mod near_grazing_taper;
mod rim;
mod thresholds;

pub use assigned::{Assigned, Outcome, PlanesOutcome};
pub(crate) use judge::caustic_disorder;
pub use method::{Formula, FormulaRange, Method, Reason, Spacing};
pub use rim::Rim;
pub use thresholds::{TaperRoom, Thresholds};

use crate::phase_table::{FormulaPart, MethodPart};
use crate::trace::Tracer;
use judge::Judge;

/// Who computes what, in the order in which orders are asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Assignment {
    entries: Vec<Assigned>,
    judge: Judge,
}

impl Assignment {
    /// Decide for some orders.
    pub fn new(
        tracer: &Tracer,
        orders: &[u32],
        size_parameter: f64,
        tolerance: f64,
        by: &Thresholds,
    ) -> Self {
        let deformed = !tracer.shape().rotational_symmetry();
        Self::as_if(deformed, tracer, orders, [size_parameter, tolerance], by)
    }

    /// The same; `deformed` says whether the particle counts as one: a sphere may stand for it.
    pub(crate) fn as_if(
        deformed: bool,
        tracer: &Tracer,
        orders: &[u32],
        [size_parameter, tolerance]: [f64; 2],
        by: &Thresholds,
    ) -> Self {
        let judge = Judge {
            by: *by,
            size_parameter,
            tolerance,
            index: tracer.index().re,
            rim: Rim::of(tracer),
            mirror: tracer.shape().mirror_symmetry(),
            deformed,
            disorder: caustic_disorder(tracer.shape(), 1),
        };
        let entries = orders.iter().map(|&order| judge.first(order)).collect();
        Self { entries, judge }
    }

    /// All orders by patches, as the scene asks.
    pub fn of_patches(
        tracer: &Tracer,
        orders: &[u32],
        size_parameter: f64,
        by: &Thresholds,
    ) -> Self {
        let mut all = Self::new(tracer, orders, size_parameter, f64::INFINITY, by);
        for entry in &mut all.entries {
            *entry = all.judge.patches(entry.order, vec![Reason::Asked]);
        }
        all
    }

    /// What follows from an outcome.
    #[must_use]
    pub fn after(self, outcome: Outcome) -> Self {
        let Self { entries, judge } = self;
        let next = |entry: Assigned| match outcome {
            Outcome::RadialLines(lost) => {
                if entry.method == Method::PartialWaves && lost.contains(&entry.order) {
                    judge.planes(entry.order, vec![Reason::RadialLinesLost])
                } else {
                    entry
                }
            }
            Outcome::Planes(outcomes) => {
                let of_it = outcomes.iter().find(|o| o.order == entry.order);
                match of_it.filter(|_| entry.method == Method::Planes) {
                    Some(outcome) => judge.after_planes(entry, outcome),
                    None => entry,
                }
            }
        };
        Self { entries: entries.into_iter().map(next).collect(), judge }
    }

    /// The method of each order.
    pub fn entries(&self) -> &[Assigned] {
        &self.entries
    }

    /// By which numbers this was decided.
    pub fn thresholds(&self) -> &Thresholds {
        &self.judge.by
    }

    /// The orders of a method.
    pub fn orders_of(&self, method: Method) -> Vec<u32> {
        let of_it = self.entries.iter().filter(|entry| entry.method == method);
        of_it.map(|entry| entry.order).collect()
    }

    /// The expected error of an order; 0 where it is not asked for.
    pub fn error_of(&self, order: u32) -> f64 {
        let entry = self.entries.iter().find(|entry| entry.order == order);
        entry.map_or(0.0, |entry| entry.expected_error)
    }

    /// Orders that are sums on a complex wavefront, all or in part, with that share of their amplitude.
    pub fn shares_of_sum(&self) -> Vec<(u32, f64)> {
        let shares = self.entries.iter().map(|entry| (entry.order, entry.share_of_sum));
        shares.filter(|(_, share)| *share > 0.0).collect()
    }

    /// Orders by planes that are to be compared with such sums, with the share of their amplitude that planes
    /// have.
    pub fn cross_checked(&self) -> Vec<(u32, f64)> {
        let planes = self.entries.iter().filter(|entry| entry.method == Method::Planes);
        let doubted = planes.filter(|entry| self.judge.is_cross_checked(entry.order));
        doubted.map(|entry| (entry.order, 1.0 - entry.share_of_sum)).collect()
    }

    /// What is left out, and why.
    pub fn skipped(&self) -> Vec<String> {
        let judge = &self.judge;
        let of = |method| !self.orders_of(method).is_empty();
        let mut skipped = Vec::new();
        if judge.deformed && !of(Method::PartialWaves) && of(Method::Planes) {
            let limit = judge.by.partial_waves_below;
            skipped.push(format!("partial waves: the size parameter is not below {limit}"));
        }
        skipped
    }

    /// In the words of a table; `light` is the share of the light by order.
    pub fn parts(&self, light: &[f64]) -> Vec<MethodPart> {
        let words = |reasons: &[Reason]| {
            let words: Vec<String> = reasons.iter().map(ToString::to_string).collect();
            words.join("; ")
        };
        let formula = |range: &FormulaRange| FormulaPart {
            formula: range.formula.words().into(),
            theta_deg: range.theta.map(|theta| (1e3 * theta.to_degrees()).round() / 1e3),
        };
        let part = |entry: &Assigned| MethodPart {
            order: Some(entry.order),
            method: entry.method.words().into(),
            reason: words(&entry.reasons),
            expected_error: Some(entry.expected_error),
            share_of_light: Some(light.get(entry.order as usize).copied().unwrap_or(0.0)),
            share_scattered: None,
            formulas: entry.formulas.iter().map(formula).collect(),
        };
        self.entries.iter().map(part).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;
    use num_complex::Complex64;

    const ORDERS: [u32; 4] = [0, 1, 2, 5];

    fn spheroid(ratio: f64, size_parameter: f64, tolerance: f64, by: &Thresholds) -> Assignment {
        let shape = Shape::spheroid(ratio, 0.0).unwrap();
        let tracer = Tracer::new(&shape, Complex64::new(1.333, 0.0), size_parameter, 5);
        Assignment::new(&tracer, &ORDERS, size_parameter, tolerance, by)
    }

    fn lost(orders: &[u32]) -> Vec<PlanesOutcome> {
        orders.iter().map(|&order| PlanesOutcome { order, found: None }).collect()
    }

    /// Whatever happens, each order has one method.
    #[test]
    fn no_order_is_lost() {
        for x in [100.0, 599.0, 600.0, 5000.0] {
            let first = spheroid(0.9, x, 0.01, &Thresholds::MEASURED);
            let second = first.clone().after(Outcome::RadialLines(&[2]));
            let third = second.clone().after(Outcome::Planes(&lost(&[0, 2, 5])));
            for found in [first, second, third] {
                let orders: Vec<u32> = found.entries().iter().map(|entry| entry.order).collect();
                assert_eq!(orders, ORDERS, "x = {x}");
            }
        }
    }

    #[test]
    fn outcomes_hand_on_what_was_lost() {
        let by = &Thresholds::MEASURED;
        let found = spheroid(0.9, 200.0, 0.01, by).after(Outcome::RadialLines(&[1]));
        assert_eq!(found.orders_of(Method::Planes), [0, 1]);
        let found = found.after(Outcome::Planes(&lost(&[0, 1])));
        assert_eq!(found.orders_of(Method::Patches), [0, 1]);
        assert_eq!([0, 1, 2].map(|order| found.error_of(order)), [0.07, 0.3, 2.0 / 200.0]);
        // reflection and, for so few wavelengths, every order stay with patches
        let large = spheroid(0.95, 2000.0, 0.01, by).after(Outcome::Planes(&lost(&[0, 2])));
        assert_eq!(large.orders_of(Method::Patches), [0]);
        assert_eq!(large.orders_of(Method::ComplexWavefront), [2, 5]);
        assert!(large.entries()[2].reasons.contains(&Reason::Unmatched));
        assert!(matches!(large.entries()[3].reasons[..], [Reason::Disordered(..)]));
    }

    fn shares(radius_mm: f64, elevation: f64) -> Vec<f64> {
        let model = crate::shape::RaindropModel::BeardChuang1987;
        let shape = Shape::raindrop(1e-3 * radius_mm, model, elevation.to_radians()).unwrap();
        let tracer = Tracer::new(&shape, Complex64::new(1.33, 0.0), 5000.0, 5);
        let orders = [0, 1, 2, 3, 4, 5];
        let found = Assignment::new(&tracer, &orders, 5000.0, 0.01, &Thresholds::MEASURED);
        found.entries().iter().map(|entry| entry.share_of_sum).collect()
    }

    /// The sum takes over little by little, with order and deformation.
    #[test]
    fn shares_of_the_sum_rise_with_order_and_deformation() {
        assert_eq!(shares(0.45, 20.0), [0.0; 6]);
        assert_eq!(shares(2.5, 20.0), [0.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
        // seen along its axis a drop is round, however flat
        assert_eq!(shares(2.0, 90.0), [0.0; 6]);
        for order in 1..6 {
            let all: Vec<f64> =
                (40..260).map(|r| shares(0.01 * f64::from(r), 20.0)[order]).collect();
            assert!(all.windows(2).all(|w| w[1] >= w[0]), "{order}: {all:?}");
            assert!(all.iter().any(|share| (0.02..0.98).contains(share)), "{order}: {all:?}");
        }
    }

    /// Another threshold, another method and another reason.
    #[test]
    fn thresholds_decide() {
        let by = Thresholds { partial_waves_below: 150.0, ..Thresholds::MEASURED };
        assert!(spheroid(0.9, 200.0, 0.01, &by).orders_of(Method::PartialWaves).is_empty());
        let both = [&Thresholds::MEASURED, &by].map(|by| spheroid(0.9, 200.0, 0.01, by).parts(&[]));
        assert_ne!(both[0][1].reason, both[1][1].reason);
        assert_eq!(both[0][0], both[1][0], "reflection is no matter of size");
    }
}
