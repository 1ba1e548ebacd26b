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

mod airy;
mod assigned;
mod judge;
mod method;
pub(crate) mod near_grazing_taper;
mod rim;
mod thresholds;

pub use airy::AiryRange;
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
mod tests;
