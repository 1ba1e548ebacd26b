//! Meridians against the sum on a complex wavefront, two independent ways to the same wave.
//!
//! On strongly flattened particles rays may gather where no meridian tells (a fold across its plane, a
//! branch that its scan does not reach). The sum sees every ray. So for such particles both are computed
//! at some directions, and an order that differs is left to the sum.

use super::complex_wavefront::ComplexWavefront;
use super::fan::{Fan, FanSettings};
use crate::optics::AmplitudeMatrix;
use crate::trace::Tracer;
use std::f64::consts::PI;

/// Orders worth a check: higher ones are weak. Order 0 has its own wave at the edge.
const ORDERS: std::ops::RangeInclusive<u32> = 1..=3;
/// Order times deformation, and size parameter, from which on it is made: the one for a reason, the
/// other so that the sum is exact enough to tell.
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

/// Regular orders whose waves differ from those of the sum by more than it may err.
pub(super) fn doubtful_orders(fan: &Fan, tracer: &Tracer, settings: &FanSettings) -> Vec<u32> {
    let x = settings.size_parameter;
    if !settings.checked || x < LEAST_SIZE {
        return Vec::new();
    }
    let theta: Vec<f64> =
        (0..SAMPLES).map(|k| PI * (0.08 + 0.84 * (k as f64 + 0.5) / SAMPLES as f64)).collect();
    let doubtful = |order: &u32| {
        let azimuths = fan.some_azimuths(*order, AZIMUTHS);
        let sum = ComplexWavefront::new(tracer, &[(*order, 1.0)], x);
        let waves = sum.columns(&theta, &azimuths);
        let pairs = azimuths.into_iter().zip(waves);
        pairs.into_iter().any(|(phi, waves)| differs(&fan.columns_of(*order, &theta, phi), &waves))
    };
    fan.regular_orders(DEFORMED, tracer)
        .into_iter()
        .filter(|order| ORDERS.contains(order))
        .filter(doubtful)
        .collect()
}

/// Whether two columns differ grossly in a band that is not faint.
fn differs(found: &[AmplitudeMatrix], sums: &[AmplitudeMatrix]) -> bool {
    let power = |column: &[AmplitudeMatrix]| column.iter().map(AmplitudeMatrix::s11).sum::<f64>();
    let faint = FAINT * power(sums) * BAND as f64 / sums.len() as f64;
    found.chunks(BAND).zip(sums.chunks(BAND)).any(|(found, sums)| {
        let off: f64 = found.iter().zip(sums).map(|(f, b)| (*f - *b).s11()).sum();
        off > GROSS * GROSS * power(sums).max(power(found))
            && power(sums).max(power(found)) > faint
    })
}
