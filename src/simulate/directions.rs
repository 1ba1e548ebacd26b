//! Amplitudes in chosen directions, in place of a table.

use super::cross_sections::CrossSections;
use super::error::SimulateError;
use super::prepared::far_field;
use super::{Treatment, worth};
use crate::farfield::{ErrorEstimate, FarField};
use crate::optics::AmplitudeMatrix;
use crate::phase_table::InvalidTable;
use crate::plan::Plan;
use num_complex::Complex64;

/// Amplitude matrices in chosen directions, absolute phase relative to a wave through the centre; as
/// computed: [`finite`] checks them.
pub fn scatter(
    plan: &Plan,
    index: Complex64,
    size_parameter: f64,
    directions: &[(f64, f64)],
) -> Vec<AmplitudeMatrix> {
    scatter_far_field(plan, index, size_parameter, directions).0
}

/// What rays make of chosen directions.
#[derive(Clone, Debug)]
pub struct Seen {
    /// In the order of the directions.
    pub amplitudes: Vec<AmplitudeMatrix>,
    /// Of the whole particle.
    pub sections: CrossSections,
    /// How far intensities may be from the truth.
    pub worth: ErrorEstimate,
}

/// The same with cross sections, for the share of light on the shadow that rays lose inside, and with what
/// the intensities are worth.
///
/// With a `filter` (radians) amplitudes of patches have the intensities that it leaves near bows.
///
/// # Errors
/// Amplitudes that are no numbers, cross-sections that are none or out of balance; what the series that
/// judge rays refuse.
pub fn scatter_with_sections(
    plan: &Plan,
    index: Complex64,
    size_parameter: f64,
    directions: &[(f64, f64)],
    absorbed: f64,
    filter: Option<f64>,
) -> Result<Seen, SimulateError> {
    let (mut amplitudes, far_field) = scatter_far_field(plan, index, size_parameter, directions);
    if let Some(sigma) = filter {
        amplitudes = far_field.scatter_filtered(directions, plan.forward_diffraction, sigma);
    }
    let sections = CrossSections::new(plan, &far_field, index, absorbed);
    sections.validate()?;
    let treatment = Treatment { interference: true, filter, peak_apart: false };
    let azimuths: Vec<f64> = directions.iter().map(|d| d.1).collect();
    let worth = worth(&far_field, plan, index, size_parameter, treatment, &[], &azimuths)?;
    Ok(Seen { amplitudes: finite(amplitudes, directions)?, sections, worth })
}

/// Amplitudes as they are, where all of them are numbers.
///
/// # Errors
/// The first direction whose amplitude is none.
pub fn finite(
    amplitudes: Vec<AmplitudeMatrix>,
    directions: &[(f64, f64)],
) -> Result<Vec<AmplitudeMatrix>, SimulateError> {
    let Some(bad) = amplitudes.iter().position(|amplitude| !amplitude.s11().is_finite()) else {
        return Ok(amplitudes);
    };
    let (theta, phi) = directions.get(bad).copied().unwrap_or((f64::NAN, f64::NAN));
    Err(SimulateError::Amplitudes(InvalidTable {
        field: "amplitude".into(),
        value: format!("{:?}", amplitudes[bad]),
        accepted: format!(
            "finite at theta {:.4}°, azimuth {:.4}°",
            theta.to_degrees(),
            phi.to_degrees()
        ),
    }))
}

fn scatter_far_field<'a>(
    plan: &'a Plan,
    index: Complex64,
    size_parameter: f64,
    directions: &[(f64, f64)],
) -> (Vec<AmplitudeMatrix>, FarField<'a>) {
    let far_field = far_field(plan, index, size_parameter, plan.forward_diffraction, None);
    (far_field.scatter(directions, plan.forward_diffraction), far_field)
}
