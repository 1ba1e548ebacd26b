//! Where T-matrices are the method: what is aimed at, what is allowed, what `auto` expects.
//!
//! All thresholds of this room stand here.

/// Smallest size parameter: below, products of the radial functions leave the range of f64.
pub(super) const LEAST_SIZE: f64 = 1e-6;
/// Asymmetry aimed at: below it rounding rules, and convergence is so fast that it costs a few
/// degrees more than a rough answer.
pub(super) const AIM: f64 = 1e-10;
/// Degrees beyond which one T takes a minute and half a gigabyte.
pub(super) const MOST_DEGREES: usize = 280;
/// Degrees of a fit on the surface: beyond, its factors lose more than further waves gain.
pub(super) const MOST_FITTED: usize = 140;
/// Steps without progress after which more degrees are no help.
pub(super) const STALLED: usize = 3;
/// Share of the tolerance that the asymmetry of the first order tried may take.
pub(super) const MARGIN: f64 = 0.1;
/// Relative error that rounding leaves.
pub(super) const ROUNDING: f64 = 1e-13;

/// Seconds of one core that `auto` spends on the T of one wavelength.
const BUDGET: f64 = 10.0;
/// Degrees by which a deformed body exceeds those of the sphere about it, per unit of spread.
const MORE_BY_SPREAD: f64 = 1.0;
/// `x (far - near)(far/near - 1)` up to which tolerances of 1e-3 are met. Measured: 8 for axis ratio 0.8
/// at x = 150 (asymmetry 1e-5) and 7 for drops of 2 mm at x = 100 (1e-4) and spheroids of 0.7 at 50
/// (1e-7) are met, 14 for 0.7 at 100 (6e-2) and 19 for 0.5 at 30 are not.
const MOST_STRAIN: f64 = 8.1;

/// What a T-matrix would cost, and whether it is expected to converge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expectation {
    /// Highest degree of spherical waves.
    pub degrees: usize,
    /// Seconds of one core for T.
    pub cpu_seconds: f64,
    /// Whether it is expected to meet tolerances of 1e-3 and more.
    pub converges: bool,
}

impl Expectation {
    /// Whether `auto` takes it.
    pub fn is_accepted(&self) -> bool {
        self.converges && self.cpu_seconds <= BUDGET && self.degrees <= MOST_DEGREES
    }
}

/// What to expect of a body whose distances from the best origin go from `near` to `far` (radii of
/// the sphere of equal volume).
pub(super) fn of_spread(size_parameter: f64, (near, far): (f64, f64), mirror: bool) -> Expectation {
    let reach = size_parameter * far;
    let round = reach + 4.05 * reach.cbrt() + 2.0;
    let strain = size_parameter * (far - near) * (far / near - 1.0);
    let degrees = (round * (1.0 + MORE_BY_SPREAD * (far / near - 1.0))).ceil();
    // n⁴ with the constant of 150 degrees in 4 s; mirror symmetry saves a factor of three
    let share = if mirror { 1.0 / 3.0 } else { 1.0 };
    let cpu_seconds = 4.0 * share * (degrees / 150.0).powi(4);
    Expectation { degrees: degrees as usize, cpu_seconds, converges: strain < MOST_STRAIN }
}
