//! Whether a T-matrix takes the place of rays: where one converges, at a cost that is allowed.

use super::acceptance::PlanError;
use crate::farfield::assignment::Thresholds;
use crate::farfield::forward::diffraction::ForwardDiffraction;
use crate::medium::{Light, MediumError};
use crate::phase_table::ForwardPeak;
use crate::scene::{Diffraction, Interference, Orders, Scene};
use crate::series::tmatrix::{self, Solver, TMatrixError};
use crate::shape::Shape;
use std::f64::consts::TAU;

/// Share of the tolerance of a table that amplitudes may take: an intensity is twice as wrong.
const OF_AMPLITUDES: f64 = 0.5;

/// Relative error of amplitudes that a table's tolerance asks for.
pub fn amplitude_tolerance(tolerance: f64) -> f64 {
    OF_AMPLITUDES * tolerance
}

/// The largest size parameter of a scene, and its light.
fn largest(scene: &Scene, radius: f64) -> Result<(f64, Light), MediumError> {
    let shortest = scene.wavelengths.iter().copied().fold(f64::INFINITY, f64::min);
    let light = scene.medium.light(shortest)?;
    Ok((TAU * radius / light.wavelength, light))
}

/// Refuse a particle that no T-matrix is made for at one of the wavelengths, before any is tried.
pub(super) fn check(scene: &Scene, shape: &Shape, radius: f64) -> Result<(), PlanError> {
    Ok(tmatrix::check(shape, largest(scene, radius)?.0)?)
}

/// Whether `auto` takes the T-matrix for a body that is no sphere; a sentence says why or why not. It is tried
/// at the shortest wavelength, and taken at all of them or at none.
pub(super) fn takes(
    scene: &Scene,
    shape: &Shape,
    radius: f64,
    by: &Thresholds,
    reasons: &mut Vec<String>,
) -> Result<bool, PlanError> {
    // what only rays know of
    let whole = scene.orders == Orders::Auto
        && scene.interference == Interference::Waves
        && scene.diffraction == Diffraction::Airy
        && scene.forward_peak != ForwardPeak::Separate
        && scene.rays_across.is_none();
    if !whole {
        return Ok(false);
    }
    let (size_parameter, Light { index, .. }) = largest(scene, radius)?;
    let mut skip = |why: String| {
        reasons.push(format!("the T-matrix is skipped: {why}"));
        Ok(false)
    };
    // before the surface is looked at, which takes longer than all else of a plan
    if let Err(error @ (TMatrixError::TooLarge { .. } | TMatrixError::LeftOut)) =
        tmatrix::check(shape, size_parameter)
    {
        return skip(error.to_string());
    }
    let expected = match tmatrix::expectation(shape, size_parameter) {
        Ok(expected) => expected,
        Err(error) => return skip(error.to_string()),
    };
    let budget = by.most_t_matrix_seconds;
    if expected.strain > by.most_t_matrix_strain {
        return skip(format!(
            "size parameter {size_parameter:.1} and deformation are too large for it to converge"
        ));
    }
    if expected.cpu_seconds > budget {
        return skip(format!(
            "it would take about {:.0} s of one core per wavelength, more than {budget}",
            expected.cpu_seconds
        ));
    }
    let tolerance = amplitude_tolerance(scene.tolerance);
    match tmatrix::outlook(shape, size_parameter, index, tolerance, budget) {
        Ok(outlook) => {
            let solver = match outlook.solver {
                Solver::NullField => "null field",
                Solver::LeastSquares => "least squares on the surface",
            };
            let deformation = ForwardDiffraction::new(shape).deformation();
            reasons.push(format!(
                "rays are skipped: the T-matrix converges ({solver}, waves up to degree {}, about {:.1e} of the \
                 amplitude off) in about {:.2} s of one core per wavelength; amplitudes of rays would be about \
                 {:.0} % off",
                outlook.degrees,
                outlook.error,
                outlook.cpu_seconds,
                100.0 * by.doubt_of_deformation(size_parameter, deformation)
            ));
            Ok(true)
        }
        Err(error) => skip(error.to_string()),
    }
}
