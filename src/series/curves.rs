//! What spheres scatter into some angles, with the cross-sections, whichever series it is from.

use super::debye_error::BandErrors;
use super::elements;
use super::layered::Layered;
use super::mean::Mean;
use std::f64::consts::{PI, TAU};

/// Relative error of the series itself.
pub(super) const SERIES_ERROR: f64 = 1e-9;
/// Curves at some angles, with the cross-sections.
pub(super) struct Curves {
    /// S11, S12, S33, S34 as areas per solid angle.
    pub elements: Vec<[f64; 4]>,
    pub scattering: f64,
    pub extinction: f64,
    pub absorption: f64,
    /// Extinction by the optical theorem on the amplitudes straight ahead.
    pub forward: Option<f64>,
    pub asymmetry: f64,
    /// Share of the scattering that the terms of a list leave out; negative where those left out take
    /// light away by interference.
    pub left_out: f64,
    pub errors: BandErrors,
}

impl Curves {
    /// A sphere of a radius that varies along it (metres), at a wavelength outside.
    pub fn of_layered(sphere: &Layered, theta: &[f64], radius: f64, wavelength: f64) -> Self {
        let area = (wavelength / TAU).powi(2);
        let (q, shadow) = (sphere.efficiencies(), PI * radius * radius);
        let amplitudes = sphere.amplitudes_parallel(theta);
        Curves {
            elements: amplitudes.into_iter().map(|pair| elements(pair, area)).collect(),
            scattering: q.q_sca * shadow,
            extinction: q.q_ext * shadow,
            absorption: q.q_abs * shadow,
            forward: Some(2.0 * TAU * area * sphere.straight_ahead().re),
            asymmetry: q.asymmetry,
            left_out: 0.0,
            errors: BandErrors::even(sphere.error().max(SERIES_ERROR)),
        }
    }

    /// A mean.
    pub fn of_mean(mean: Mean) -> Self {
        Curves {
            elements: mean.elements,
            scattering: mean.scattering,
            extinction: mean.scattering + mean.absorption,
            absorption: mean.absorption,
            forward: Some(mean.forward_extinction),
            asymmetry: mean.asymmetry,
            left_out: 0.0,
            errors: BandErrors::even(mean.error),
        }
    }
}
