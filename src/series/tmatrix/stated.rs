//! The error of intensities that a T-matrix states, by scattering angle.

use super::far_field::Scattered;
use super::kernel::range;
use super::matrix::TMatrix;
use super::random::RandomOrientation;
use crate::math::parallel::*;
use crate::optics::AmplitudeMatrix;
use crate::phase_table::{ERROR_BANDS, error_theta};
use std::f64::consts::{FRAC_PI_2, PI};

/// Relative errors of the intensity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StatedError {
    /// Root of the sum of squared errors over that of squared intensities, 10° to 170°.
    pub weighted: f64,
    /// Root mean square over bands of 4° from 10° to 170°, each relative to its own intensity.
    pub by_band: f64,
    /// Of each band, about the angles of [`error_theta`].
    pub by_direction: [f64; ERROR_BANDS],
}

/// Bands that count in the means: without the forward peak and its mirror image.
const COUNTED: std::ops::Range<usize> = 3..43;
/// Angles within a band, in its width, and azimuths at which intensities are taken.
const WITHIN: [f64; 4] = [-0.375, -0.125, 0.125, 0.375];
const AZIMUTHS: [f64; 3] = [0.3, FRAC_PI_2, 2.8];

impl StatedError {
    /// Of a fixed body.
    pub fn of_fixed(t: &TMatrix, scattered: &Scattered) -> Self {
        let azimuths = AZIMUTHS.map(|phi| scattered.azimuth(phi));
        let at = |theta: f64| -> f64 {
            let amplitudes = scattered.amplitudes(theta, &azimuths);
            amplitudes.iter().map(AmplitudeMatrix::s11).sum::<f64>() / AZIMUTHS.len() as f64
        };
        Self::new(t, scattered.mean_intensity(), at)
    }

    /// Of a body in random orientation.
    pub fn of_random(t: &TMatrix, mean: &RandomOrientation) -> Self {
        Self::new(t, 1.0, |theta| mean.at(theta.cos())[0])
    }

    /// What is wrong of amplitudes is spread over all directions, whatever their intensity: a wave wrong by
    /// `Δ` changes `|S|²` by `√2|S||Δ|` on average over its phase.
    fn new(t: &TMatrix, mean_intensity: f64, intensity: impl Fn(f64) -> f64 + Sync) -> Self {
        let width = error_theta(1);
        let intensities: Vec<f64> = (0..ERROR_BANDS)
            .into_par_iter()
            .map(|band| {
                let at =
                    |offset: f64| intensity((error_theta(band) + offset * width).clamp(0.0, PI));
                WITHIN.into_iter().map(at).sum::<f64>() / WITHIN.len() as f64
            })
            .collect();
        let wrong = t.error().powi(2) * mean_intensity;
        let floor = range::STORED.powi(2);
        let squares = |band: usize| 2.0 * (wrong / intensities[band]).min(1.0) + floor;
        let (mut weighted, mut total, mut relative) = (0.0, 0.0, 0.0);
        for band in COUNTED {
            let weight = intensities[band].powi(2);
            weighted += squares(band) * weight;
            total += weight;
            relative += squares(band);
        }
        Self {
            weighted: (weighted / total).sqrt(),
            by_band: (relative / COUNTED.len() as f64).sqrt(),
            by_direction: std::array::from_fn(|band| squares(band).sqrt()),
        }
    }

    /// With means that are no less than this.
    pub fn at_least(self, least: f64) -> Self {
        Self { weighted: self.weighted.max(least), by_band: self.by_band.max(least), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;
    use num_complex::Complex64;

    /// What is off is the same in every direction: dim ones state more, and no band more than all of its light.
    #[test]
    fn dim_directions_state_more() {
        let shape = Shape::spheroid(0.8, 0.0).unwrap();
        let mut t = TMatrix::new(&shape, 20.0, Complex64::from(1.333), 1e-3).unwrap();
        t.drift = 1e-3;
        let scattered = Scattered::new(&t, 0.3);
        let fixed = StatedError::of_fixed(&t, &scattered);
        let ahead = fixed.by_direction[0];
        let largest = fixed.by_direction.iter().copied().fold(0.0, f64::max);
        assert!(ahead < 1e-3 && largest > 1e-3 && largest < 2.0, "{ahead} {largest}");
        assert!(fixed.weighted < fixed.by_band);
        let random = StatedError::of_random(&t, &RandomOrientation::new(&t, 1e-4).unwrap());
        assert!(random.by_direction[0] < random.by_band);
        assert_eq!(fixed.at_least(0.5).by_band, 0.5);
        t.drift = 2e-3;
        let doubled = StatedError::of_fixed(&t, &scattered);
        assert!((doubled.weighted / fixed.weighted - 2.0).abs() < 1e-2);
    }
}
