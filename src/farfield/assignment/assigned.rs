//! What is assigned to an order, and what can turn out on trial: values.

use super::method::{FormulaRange, Method, Reason, Spacing};

/// The method of one order.
#[derive(Clone, Debug, PartialEq)]
pub struct Assigned {
    /// Number of chords.
    pub order: u32,
    /// What computes it.
    pub method: Method,
    /// Why, in the order in which it came about.
    pub reasons: Vec<Reason>,
    /// Share of the amplitude by which the wave may be off.
    pub expected_error: f64,
    /// Share of the amplitude that is a sum on a complex wavefront: 1 where that is the method.
    pub share_of_sum: f64,
    /// What stands for single rays where; known once planes are traced.
    pub formulas: Vec<FormulaRange>,
}

/// What became of an order's planes.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanesOutcome {
    /// Number of chords.
    pub order: u32,
    /// `None` where they do not match.
    pub found: Option<(Spacing, Vec<FormulaRange>)>,
}

/// What turned out on trial.
#[derive(Clone, Copy, Debug)]
pub enum Outcome<'o> {
    /// Orders whose radial lines of launch points lose their rays.
    RadialLines(&'o [u32]),
    /// Planes of orders, found or not.
    Planes(&'o [PlanesOutcome]),
}
