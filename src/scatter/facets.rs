//! Crystals and prisms by beams of flat facets.

use super::{Request, Scattering};
use crate::facets::beams::{Incidence, Settings, split};
use crate::facets::mean::{Azimuths, Request as MeanRequest};
use crate::facets::orientation::Stand;
use crate::facets::{Body, FarField};
use crate::farfield::ErrorEstimate;
use crate::phase_table::ERROR_BANDS;
use crate::series::Efficiencies;
use std::f64::consts::PI;

/// A convex body of flat facets that stands still. Extinction is that of the optical theorem; the error stated
/// is `error` (relative, of intensities) in all directions.
///
/// ```
/// use gonio::facets::{Body, beams::Settings, orientation::Stand};
/// use gonio::scatter::{Request, facets};
///
/// let request = Request {
///     size_parameter: 60.0,
///     index: 1.31.into(),
///     theta: vec![0.0, 0.4],
///     azimuth: 0.3,
///     tolerance: 0.01,
/// };
/// let stand = Stand::Fixed { zenith: 0.7, azimuth: 0.2, spin: 0.1 };
/// let body = Body::hexagonal_column(1.5).unwrap();
/// let seen = facets(&request, &body, stand, 0.3, Settings::default(), 0.1);
/// assert!(seen.amplitudes[0].s11() > seen.amplitudes[1].s11());
/// ```
pub fn facets(
    request: &Request,
    body: &Body,
    stand: Stand,
    sun_elevation: f64,
    settings: Settings,
    error: f64,
) -> Scattering {
    let Request { size_parameter, index, azimuth, .. } = *request;
    let light = Incidence { index, size_parameter };
    let turned = body.turned(&stand.rotation([0.5; 3], sun_elevation));
    let far = FarField::new(&split(&turned, &light, &settings), &light);
    let asked = request.theta.iter().map(|&theta| (theta, azimuth));
    let directions: Vec<(f64, f64)> = asked.chain([(PI, azimuth)]).collect();
    let mut amplitudes = far.amplitudes(&directions);
    let back = amplitudes.pop().unwrap_or_default();
    let power = MeanRequest {
        body,
        stand,
        sun_elevation,
        light,
        settings,
        theta: &[],
        cells: &[],
        azimuths: Azimuths::At(&[]),
        whole: false,
        count: 1,
        replicas: 1,
    };
    let sums = &power.replicas()[0];
    let q_ext = sums.extinction.max(sums.absorption) / PI;
    let q_abs = sums.absorption / PI;
    let worth = ErrorEstimate {
        weighted: error,
        by_band: error,
        by_direction: [error; ERROR_BANDS],
        straight_back: error,
    };
    Scattering {
        amplitudes,
        efficiencies: Efficiencies {
            q_ext,
            q_sca: q_ext - q_abs,
            q_abs,
            q_back: 4.0 * back.s11() / size_parameter.powi(2),
            asymmetry: sums.forward / sums.scattering,
        },
        diffraction_included: true,
        remainder: None,
        worth: Some(worth),
        bows: Vec::new(),
    }
}
