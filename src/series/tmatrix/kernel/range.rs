//! Where T-matrices are the method: what is aimed at, what is allowed, what it costs.
//!
//! All thresholds of this room stand here.

use num_complex::Complex64;

/// How T was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    /// Waterman's.
    NullField,
    /// A fit on the surface.
    LeastSquares,
}

/// Smallest size parameter: below, products of the radial functions leave the range of f64.
pub(in crate::series::tmatrix) const LEAST_SIZE: f64 = 1e-6;
/// Asymmetry aimed at: below it rounding rules, and convergence is so fast that it costs a few
/// degrees more than a rough answer.
pub(in crate::series::tmatrix) const AIM: f64 = 1e-10;
/// Degrees beyond which one T takes a minute and half a gigabyte.
pub(in crate::series::tmatrix) const MOST_DEGREES: usize = 280;
/// Degrees of a fit on the surface: beyond, its factors lose more than further waves gain.
pub(in crate::series::tmatrix) const MOST_FITTED: usize = 140;
/// Steps without progress after which more degrees are no help.
pub(in crate::series::tmatrix) const STALLED: usize = 3;
/// Share of the tolerance that the error of the order tried may take.
pub(in crate::series::tmatrix) const MARGIN: f64 = 0.1;
/// Degrees that a T is tried with once more where its asymmetry does not tell its error.
pub(in crate::series::tmatrix) const DRIFT_STEP: usize = 2;
/// Below, the last degrees of a T are a large part of it.
const FEW_DEGREES: usize = 12;
/// Degrees from which on, and k below which, light runs round inside often enough to resonate: a resonance at the
/// wrong place leaves T symmetric. Clear bodies of x = 60 had 10 to 120 times the error that their asymmetry tells.
const RESONANT_DEGREES: usize = 30;
const RESONANT_K: f64 = 3e-3;
/// What two degrees more change where resonances have left their places altogether: then the finer T is as wrong.
pub(in crate::series::tmatrix) const RESONANCES_LOST: f64 = 1e-3;

/// Whether asymmetry does not tell the error of a T of so many degrees.
pub(in crate::series::tmatrix) fn asymmetry_is_silent(degrees: usize, index: Complex64) -> bool {
    degrees < FEW_DEGREES || (degrees > RESONANT_DEGREES && index.im < RESONANT_K)
}

/// Relative error of the finer of two T that differ by `change`, with their asymmetries: what is wrong falls as
/// they do.
pub(in crate::series::tmatrix) fn error_of_change(change: f64, coarse: f64, finer: f64) -> f64 {
    if change > RESONANCES_LOST { change } else { change * (finer / coarse).min(1.0) }
}

/// Relative error that rounding leaves.
const ROUNDING: f64 = 1e-13;
/// Error of amplitudes per asymmetry of T, whose even part is kept. Measured over spheroids of 0.5 to 2 and raindrops
/// of x = 0.5 to 15, indices 1.05 to 3 + 2i: 0.1 to 3.2; and over absorbing ones of x = 25 and 60: 0.06 to 0.4.
const PER_ASYMMETRY: f64 = 1.0;
const PER_ASYMMETRY_OF_MANY: f64 = 0.25;
/// Relative error of values stored as `f32`.
pub(in crate::series::tmatrix) const STORED: f64 = 3e-8;

/// Relative error of amplitudes, root mean square over directions, of a T with this asymmetry.
pub(in crate::series::tmatrix) fn error_of(asymmetry: f64, degrees: usize) -> f64 {
    let share = if degrees > RESONANT_DEGREES { PER_ASYMMETRY_OF_MANY } else { PER_ASYMMETRY };
    (share * asymmetry).max(ROUNDING)
}

/// The asymmetry to aim at for a relative error asked of amplitudes.
pub(in crate::series::tmatrix) fn aim(tolerance: f64) -> f64 {
    (MARGIN * tolerance / PER_ASYMMETRY).max(AIM)
}

/// Degrees by which a deformed body exceeds those of the sphere about it, per unit of spread.
const MORE_BY_SPREAD: f64 = 1.0;
/// Seconds of one core for all orders of 100 degrees: null field of a body without a horizontal plane of
/// symmetry, for a real index; and least squares of any.
const NULL_FIELD_SECONDS: f64 = 0.25;
const LEAST_SQUARES_SECONDS: f64 = 6.0;
/// Share of it that such a plane leaves, and what a complex index takes.
const MIRRORED: f64 = 0.3;
const ABSORBING: f64 = 1.6;

/// What two T take over the first alone.
const CHECKED: f64 = 2.2;

/// Degrees of spherical waves that a sphere of this size parameter needs (Wiscombe 1980).
pub(in crate::series::tmatrix) fn degrees(size_parameter: f64) -> usize {
    (size_parameter + 4.05 * size_parameter.cbrt() + 2.0).ceil() as usize
}

/// What a T-matrix would cost, before anything is tried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expectation {
    /// Highest degree of spherical waves.
    pub degrees: usize,
    /// Seconds of one core for T.
    pub cpu_seconds: f64,
    /// `x (far - near)(far/near - 1)` with the smallest and largest distance of the surface from the waves'
    /// origin: the further waves reach beyond where they are proper, the more digits are lost. Measured: 8 for
    /// axis ratio 0.8 at x = 150 (asymmetry 1e-5), 7 for drops of 2 mm at x = 100 (1e-4) and spheroids of 0.7
    /// at 50 (1e-7); 14 for 0.7 at 100 (6e-2) and 19 for 0.5 at 30 do not converge.
    pub strain: f64,
}

/// What to expect of a body whose distances from the best origin go from `near` to `far` (radii of
/// the sphere of equal volume).
pub(in crate::series::tmatrix) fn of_spread(
    size_parameter: f64,
    (near, far): (f64, f64),
    mirror: bool,
) -> Expectation {
    let round = degrees(size_parameter * far) as f64;
    let strain = size_parameter * (far - near) * (far / near - 1.0);
    let degrees = (round * (1.0 + MORE_BY_SPREAD * (far / near - 1.0))).ceil() as usize;
    let cpu_seconds = seconds(Solver::NullField, degrees, mirror, Complex64::ONE);
    Expectation { degrees, cpu_seconds, strain }
}

/// Seconds of one core that all orders take.
pub(in crate::series::tmatrix) fn seconds(
    solver: Solver,
    degrees: usize,
    mirror: bool,
    index: Complex64,
) -> f64 {
    let share = if mirror { MIRRORED } else { 1.0 };
    let of_hundred = match solver {
        Solver::NullField if index.im > 0.0 => NULL_FIELD_SECONDS * ABSORBING,
        Solver::NullField => NULL_FIELD_SECONDS,
        Solver::LeastSquares => LEAST_SQUARES_SECONDS,
    };
    let once = share * of_hundred * (degrees as f64 / 100.0).powi(4);
    if asymmetry_is_silent(degrees, index) { CHECKED * once } else { once }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sphere_is_no_strain_and_larger_bodies_cost_more() {
        let water = Complex64::from(1.33);
        let round = of_spread(50.0, (1.0, 1.0), true);
        assert_eq!((round.strain, round.degrees), (0.0, degrees(50.0)));
        let flat = of_spread(50.0, (0.8, 1.1), true);
        assert!(flat.strain > 0.0 && flat.degrees > round.degrees);
        for solver in [Solver::NullField, Solver::LeastSquares] {
            let cost = |degrees| seconds(solver, degrees, false, water);
            assert!((13..200).all(|degrees| cost(degrees) < cost(degrees + 1)));
            assert!(seconds(solver, 80, true, water) < cost(80));
        }
    }

    /// Never less than rounding leaves, never more than the tolerance where the aim is met.
    #[test]
    fn errors_follow_what_is_measured() {
        for degrees in [5, 20, 60] {
            assert_eq!(error_of(0.0, degrees), ROUNDING);
            assert!(error_of(aim(1e-3), degrees) <= 1e-3);
        }
        assert_eq!(aim(1e-30), AIM);
        assert!((error_of_change(1e-5, 1e-6, 1e-7) / 1e-6 - 1.0).abs() < 1e-12);
        assert_eq!(error_of_change(1e-5, 1e-7, 1e-6), 1e-5);
        assert_eq!(error_of_change(1e-2, 1e-6, 1e-9), 1e-2);
        let (clear, dark) = (Complex64::from(1.5), Complex64::new(1.5, 0.1));
        assert!(asymmetry_is_silent(60, clear) && !asymmetry_is_silent(60, dark));
        assert!(asymmetry_is_silent(5, dark) && !asymmetry_is_silent(20, clear));
    }
}
