//! Relative errors of a mean by bands of scattering angle, from the difference of two means.

use crate::phase_table::{ERROR_BANDS, error_theta};
use ndarray::Array3;

/// Bands from 10° to 170° count, as in the errors of single drops.
const COUNTED: std::ops::Range<usize> = 3..43;

/// Errors of the intensity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Errors {
    /// Root of the sum of squared differences over that of squared intensities, 10° to 170°.
    pub weighted: f64,
    /// Root mean square over bands, each relative to its own intensity.
    pub by_band: f64,
    /// Of each band.
    pub by_direction: [f64; ERROR_BANDS],
}

/// Errors of `mean` (elements, θ, azimuth), if it is off by `difference`.
pub(super) fn band_errors(theta: &[f64], difference: &Array3<f64>, mean: &Array3<f64>) -> Errors {
    let mut squares = [0.0; ERROR_BANDS];
    let mut intensities = [0.0; ERROR_BANDS];
    let width = error_theta(1);
    for (i, angle) in theta.iter().enumerate() {
        let band = ((angle / width).round() as usize).min(ERROR_BANDS - 1);
        for j in 0..mean.dim().2 {
            squares[band] += difference[(0, i, j)].powi(2);
            intensities[band] += mean[(0, i, j)].powi(2);
        }
    }
    let by_direction = std::array::from_fn(|band| match intensities[band] {
        0.0 => 0.0,
        light => (squares[band] / light).sqrt(),
    });
    let covered = || COUNTED.filter(|&band| intensities[band] > 0.0);
    // a table may lie in the forward peak alone
    let all = covered().count();
    let bands = || COUNTED.filter(|&band| all == 0 || intensities[band] > 0.0);
    let sum = |of: &[f64; ERROR_BANDS]| -> f64 {
        if all == 0 { of.iter().sum() } else { bands().map(|band| of[band]).sum() }
    };
    let relative: f64 = bands().map(|band| f64::min(by_direction[band], 1.0).powi(2)).sum();
    let (off, light) = (sum(&squares), sum(&intensities));
    Errors {
        weighted: if light > 0.0 { (off / light).sqrt() } else { 0.0 },
        by_band: (relative / all.max(1) as f64).sqrt(),
        by_direction,
    }
}

impl Errors {
    /// With what the method itself errs by, at each scattering angle (radians).
    pub fn and(self, method: impl Fn(f64) -> f64) -> Self {
        let of_method = std::array::from_fn(|band| method(error_theta(band)));
        // most of the light is where the method is best
        let least = of_method.iter().copied().fold(f64::INFINITY, f64::min);
        self.beside(least, &of_method)
    }

    /// With independent errors: weighted by intensity, and of each band.
    pub fn beside(self, weighted: f64, by_direction: &[f64; ERROR_BANDS]) -> Self {
        let squares: f64 = COUNTED.map(|band| by_direction[band].powi(2)).sum();
        Self {
            weighted: self.weighted.hypot(weighted),
            by_band: self.by_band.hypot((squares / COUNTED.len() as f64).sqrt()),
            by_direction: std::array::from_fn(|b| self.by_direction[b].hypot(by_direction[b])),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_relative_to_their_band() {
        let theta: Vec<f64> = (0..181).map(|i| f64::from(i).to_radians()).collect();
        let mean = Array3::from_shape_fn((1, 181, 2), |(_, i, _)| if i < 90 { 10.0 } else { 1.0 });
        let off = Array3::from_elem((1, 181, 2), 0.1);
        let errors = band_errors(&theta, &off, &mean);
        assert!((errors.by_direction[5] - 0.01).abs() < 1e-12);
        assert!((errors.by_direction[40] - 0.1).abs() < 1e-12);
        assert!(errors.weighted < 0.02 && errors.by_band > 0.06 && errors.by_band < 0.08);
        let none = band_errors(&theta, &(&off * 0.0), &mean);
        assert_eq!((none.weighted, none.by_band), (0.0, 0.0));
        // what rays miss beside an order's edge is stated however many sizes there are
        let by = crate::farfield::assignment::Thresholds::MEASURED;
        let stated = none.and(|theta| by.doubt_of_powers(1000.0, theta));
        assert_eq!((stated.by_direction[20], stated.by_direction[10]), by.error_of_powers.into());
        assert!(stated.by_band > 0.025 && stated.weighted == 0.015);
    }
}
