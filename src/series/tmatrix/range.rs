//! Where T-matrices are the method: accuracy aimed at, cost allowed, and what `auto` expects of them.

/// Asymmetry aimed at: below it rounding rules, and convergence is so fast that it costs a few
/// degrees more than a rough answer.
pub(super) const AIM: f64 = 1e-10;
/// Degrees beyond which one T takes more than a minute, and half a gigabyte.
pub(super) const MOST_DEGREES: usize = 280;
/// Steps without progress after which more degrees are no help.
pub(super) const STALLED: usize = 3;
/// Share of the tolerance that asymmetry may take: single directions err more than the mean.
pub(super) const MARGIN: f64 = 0.1;
/// Relative error that rounding leaves.
pub(super) const ROUNDING: f64 = 1e-13;
