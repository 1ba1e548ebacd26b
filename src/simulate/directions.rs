//! Amplitudes in chosen directions, in place of a table.

use super::cross_sections::CrossSections;
use super::error::SimulateError;
use super::prepared::far_field;
use super::{Treatment, worth};
use crate::farfield::{ErrorEstimate, FarField};
use crate::optics::AmplitudeMatrix;
use crate::phase_table::InvalidTable;
use crate::plan::{Engine, Plan};
use num_complex::Complex64;
use std::f64::consts::TAU;

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
    let amplitudes = finite(amplitudes, directions)?;
    if plan.engine == Engine::Meridians {
        let area = far_field.silhouette().area();
        possible(&amplitudes, directions, strongest(size_parameter, area))?;
    }
    Ok(Seen { amplitudes, sections, worth })
}

/// Beyond what light on a shadow (squared radii) can do in any direction: all of it in phase over the whole shadow
/// makes `|S| = x² A/2π`; what is scattered and what is diffracted may add, in both polarisations, and a body's shadow
/// from where the light goes may be larger than that to where it comes from.
fn strongest(size_parameter: f64, area: f64) -> f64 {
    const SPARE: f64 = 2.0;
    let focused = size_parameter * size_parameter * area / TAU;
    (SPARE * 2.0 * focused).powi(2)
}

/// Whether no direction has more light than there is.
///
/// # Errors
/// The first that has.
fn possible(
    amplitudes: &[AmplitudeMatrix],
    directions: &[(f64, f64)],
    strongest: f64,
) -> Result<(), SimulateError> {
    match amplitudes.iter().position(|amplitude| amplitude.s11() > strongest) {
        Some(bad) => {
            let accepted = format!("with S11 up to {strongest:.2e}, all light in phase,");
            Err(wrong(amplitudes, directions, bad, &accepted))
        }
        None => Ok(()),
    }
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
    Err(wrong(&amplitudes, directions, bad, "finite"))
}

/// An amplitude that cannot be, and what could.
fn wrong(
    amplitudes: &[AmplitudeMatrix],
    directions: &[(f64, f64)],
    bad: usize,
    accepted: &str,
) -> SimulateError {
    let (theta, phi) = directions.get(bad).copied().unwrap_or((f64::NAN, f64::NAN));
    let (theta, phi) = (theta.to_degrees(), phi.to_degrees());
    SimulateError::Amplitudes(InvalidTable {
        field: "amplitude".into(),
        value: format!("{:?}", amplitudes[bad]),
        accepted: format!("{accepted} at theta {theta:.4}°, azimuth {phi:.4}°"),
    })
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A sphere's forward peak, `S = x²/2` of both polarisations, is possible; hundreds of times as much light is not,
    /// and its direction is named.
    #[test]
    fn no_direction_has_more_light_than_there_is() {
        let (x, area) = (5000.0f64, std::f64::consts::PI);
        let of = |s: f64| AmplitudeMatrix { s1: s.into(), s2: s.into(), ..Default::default() };
        let directions = [(0.0, 0.0), (0.1, 2.0)];
        let most = strongest(x, area);
        let peak = x * x / 2.0;
        assert!(possible(&[of(peak), of(2.0 * peak)], &directions, most).is_ok());
        let error = possible(&[of(peak), of(20.0 * peak)], &directions, most).unwrap_err();
        assert!(error.to_string().contains("theta 5.7296"), "{error}");
    }
}
