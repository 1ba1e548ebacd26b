//! Scattering planes against Gaussian beams, two independent ways to the same wave.
//!
//! On strongly flattened particles rays may gather where no plane tells (a fold across its plane, a
//! branch that its scan does not reach). Beams see every ray, but are a few percent coarser. So for
//! such particles both are computed at some directions, and an order that differs grossly is left to
//! the beams.

use crate::farfield::azimuth::plane_set::PlaneSet;
use crate::farfield::fallback::with_beams;
use crate::farfield::gaussian_beams::GaussianBeams;
use crate::farfield::settings::FarFieldSettings;
use crate::optics::AmplitudeMatrix;
use crate::trace::Tracer;
use std::f64::consts::PI;

/// Orders worth a check: higher ones are weak. Order 0 has its own wave at the edge.
const ORDERS: std::ops::RangeInclusive<u32> = 1..=3;
/// Order times deformation, and size parameter, from which on it is made: the one for a reason, the
/// other so that beams are fine enough to tell.
const DEFORMED: f64 = 0.06;
const LEAST_SIZE: f64 = 6000.0;
/// Azimuths, scattering angles in each and in each band.
const AZIMUTHS: usize = 9;
const SAMPLES: usize = 640;
const BAND: usize = 16;
/// Share of the amplitude in a band that may differ, and the least share of the order's mean power that
/// a band must hold to count.
const GROSS: f64 = 0.6;
const FAINT: f64 = 0.05;

/// Regular orders whose waves differ from those of beams by more than beams may err.
pub(crate) fn doubtful_orders(
    planes: &PlaneSet,
    tracer: &Tracer,
    settings: &FarFieldSettings,
) -> Vec<u32> {
    let x = settings.size_parameter;
    if !settings.checked || x < LEAST_SIZE || !with_beams(settings) {
        return Vec::new();
    }
    let theta: Vec<f64> =
        (0..SAMPLES).map(|k| PI * (0.08 + 0.84 * (k as f64 + 0.5) / SAMPLES as f64)).collect();
    let doubtful = |order: &u32| {
        let azimuths = planes.some_azimuths(*order, AZIMUTHS);
        let beams = GaussianBeams::new(tracer, &[*order], &azimuths, x);
        azimuths.into_iter().any(|phi| {
            let mut waves = vec![AmplitudeMatrix::default(); SAMPLES];
            beams.add(&theta, phi, &mut waves);
            differs(&planes.columns_of(*order, &theta, phi), &waves)
        })
    };
    planes
        .regular_orders(DEFORMED, tracer)
        .into_iter()
        .filter(|order| ORDERS.contains(order))
        .filter(doubtful)
        .collect()
}

/// Whether two columns differ grossly in a band that is not faint.
fn differs(found: &[AmplitudeMatrix], beams: &[AmplitudeMatrix]) -> bool {
    let power = |column: &[AmplitudeMatrix]| column.iter().map(AmplitudeMatrix::s11).sum::<f64>();
    let faint = FAINT * power(beams) * BAND as f64 / beams.len() as f64;
    found.chunks(BAND).zip(beams.chunks(BAND)).any(|(found, beams)| {
        let off: f64 = found.iter().zip(beams).map(|(f, b)| (*f - *b).s11()).sum();
        off > GROSS * GROSS * power(beams).max(power(found))
            && power(beams).max(power(found)) > faint
    })
}
