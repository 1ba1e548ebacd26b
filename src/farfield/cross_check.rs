//! Scattering planes against Gaussian beams, two independent ways to the same wave.
//!
//! On strongly flattened particles rays may gather where no plane tells (a fold across its plane, a
//! branch that its scan does not reach). Beams see every ray, but are a few percent coarser. So for
//! such particles both are computed at some directions. What comes of it is a value, the largest share of
//! the amplitude by which they differ; [`super::assignment`] says for which orders, and what follows.

use crate::farfield::assignment::{Difference, Thresholds};
use crate::farfield::azimuth::plane_set::PlaneSet;
use crate::farfield::gaussian_beams::GaussianBeams;
use crate::farfield::wave_field::waves;
use crate::optics::AmplitudeMatrix;
use crate::trace::Tracer;
use std::f64::consts::PI;

/// Azimuths, scattering angles in each and in each band.
const AZIMUTHS: usize = 9;
const SAMPLES: usize = 640;
const BAND: usize = 16;

/// How far the waves of some orders are from those of beams; no more is looked at once they are gross.
pub(crate) fn differences(
    planes: &PlaneSet,
    tracer: &Tracer,
    orders: &[u32],
    size_parameter: f64,
    by: &Thresholds,
) -> Vec<Difference> {
    let theta: Vec<f64> =
        (0..SAMPLES).map(|k| PI * (0.08 + 0.84 * (k as f64 + 0.5) / SAMPLES as f64)).collect();
    let difference = |&order: &u32| {
        let azimuths = planes.some_azimuths(order, AZIMUTHS);
        let beams = GaussianBeams::new(tracer, &[order], &azimuths, size_parameter);
        let mut share = 0.0f64;
        for phi in azimuths {
            let found = planes.columns_of(order, &theta, phi);
            share = share.max(largest_share(&found, &waves(&beams, &theta, phi), by.faint_band));
            if share > by.gross_difference {
                break;
            }
        }
        Difference { order, share }
    };
    orders.iter().map(difference).collect()
}

/// Largest share of the amplitude by which two columns differ in a band that is not faint.
fn largest_share(found: &[AmplitudeMatrix], beams: &[AmplitudeMatrix], faint: f64) -> f64 {
    let power = |column: &[AmplitudeMatrix]| column.iter().map(AmplitudeMatrix::s11).sum::<f64>();
    let faint = faint * power(beams) * BAND as f64 / beams.len() as f64;
    let share = |(found, beams): (&[AmplitudeMatrix], &[AmplitudeMatrix])| {
        let off: f64 = found.iter().zip(beams).map(|(f, b)| (*f - *b).s11()).sum();
        let most = power(beams).max(power(found));
        if most > faint { (off / most).sqrt() } else { 0.0 }
    };
    found.chunks(BAND).zip(beams.chunks(BAND)).map(share).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(size: impl Fn(usize) -> f64) -> Vec<AmplitudeMatrix> {
        (0..SAMPLES)
            .map(|k| AmplitudeMatrix {
                s1: size(k).into(),
                s2: size(k).into(),
                ..Default::default()
            })
            .collect()
    }

    #[test]
    fn the_worst_band_counts_unless_it_is_faint() {
        let beams = column(|_| 1.0);
        let off = |by: f64| column(|k| if k < BAND { 1.0 - by } else { 1.0 });
        assert_eq!(largest_share(&beams, &beams, 0.05), 0.0);
        assert!((largest_share(&off(0.4), &beams, 0.05) - 0.4).abs() < 1e-12);
        let faint = column(|k| if k < BAND { 0.1 } else { 1.0 });
        let without = column(|k| if k < BAND { 0.0 } else { 1.0 });
        assert_eq!(largest_share(&without, &faint, 0.05), 0.0);
        assert_eq!(largest_share(&without, &faint, 0.005), 1.0);
    }
}
