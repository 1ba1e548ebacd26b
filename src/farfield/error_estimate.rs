//! How far a far field may be from the truth, as the method itself can tell.
//!
//! Four things are known: what interpolation costs, by tracing planes half-way between those of the
//! set and with twice the knots; the power that is still inside after the last order; how far beams and
//! patches are from exact series; and the next terms of the uniform formulas, of the order of `x^{-2/3}`
//! (a wave zone). Waves that are left out or wrong by `Δ` change the intensity `|S|²` by `√2 |S||Δ|` on
//! average over their phase.

use super::far_field::{FarField, Source};
use crate::farfield::azimuth::plane_set::PlaneSet;
use crate::trace::Tracer;
use std::f64::consts::PI;

/// Scattering angles at which it is looked for, and the bands over which each is averaged: many
/// fringes, of which the mean square counts.
const SAMPLES: usize = 400;
const BANDS: usize = 40;
/// The angles looked at, radians: without the forward peak and its mirror image.
const FROM: f64 = PI / 18.0;
const TO: f64 = PI - FROM;

/// Relative errors of the intensity from 10° to 170°.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorEstimate {
    /// Root of the sum of squared errors over that of squared intensities.
    pub weighted: f64,
    /// Root mean square over bands of 4°, each relative to its own intensity.
    pub by_band: f64,
}

impl FarField<'_> {
    /// The method's own estimate of its error. `inside` is the power still inside after the last
    /// order, per power on the silhouette. `None` for patches alone, whose error is not known.
    pub fn error_estimate(&self, tracer: &Tracer, inside: f64) -> Option<ErrorEstimate> {
        let Source::Planes(planes, fallback) = &self.source else { return None };
        let x = self.size_parameter;
        // steps of an irrational ratio, so that no sample keeps to the knots
        let place = |k: usize| FROM + (TO - FROM) * (k as f64 * 0.618_033_988_749_895).fract();
        let mut theta: Vec<f64> = (0..SAMPLES).map(place).collect();
        theta.sort_by(f64::total_cmp);
        let azimuth = planes.checked_azimuth;
        let missed = planes.missed(tracer, &theta, azimuth);
        let (waves, doubted) = fallback.doubted(&theta, azimuth);
        let rays = planes.columns(&theta, &[azimuth]).swap_remove(0);
        let left_out = inside * self.silhouette().area() * x * x / (4.0 * PI);
        let next_terms = x.powf(-4.0 / 3.0);
        let (mut squares, mut intensities, mut relative) = (0.0, 0.0, 0.0);
        for band in 0..BANDS {
            let samples = band * SAMPLES / BANDS..(band + 1) * SAMPLES / BANDS;
            let (mut wrong, mut all) = (0.0, 0.0);
            for i in samples {
                wrong += missed[i] + left_out + doubted[i];
                all += (rays[i] + waves[i]).s11();
            }
            let square = (2.0 * wrong / all).min(1.0) + next_terms;
            relative += square;
            squares += square * all * all;
            intensities += all * all;
        }
        let (weighted, by_band) = (squares / intensities, relative / BANDS as f64);
        Some(ErrorEstimate { weighted: weighted.sqrt(), by_band: by_band.sqrt() })
    }
}

impl PlaneSet {
    /// `S11` of what interpolation adds or misses, at some scattering angles of an azimuth.
    fn missed(&self, tracer: &Tracer, theta: &[f64], azimuth: f64) -> Vec<f64> {
        let mut missed = vec![0.0; theta.len()];
        for [interpolated, traced] in self.checks(tracer, theta, azimuth) {
            for (sum, (a, b)) in missed.iter_mut().zip(interpolated.into_iter().zip(traced)) {
                *sum += (a - b).s11();
            }
        }
        missed
    }
}
