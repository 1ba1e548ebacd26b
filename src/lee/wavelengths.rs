//! Where the wavelengths of a column stand.
//!
//! Beats between rays that go different ways through a large drop run through thousands of cycles
//! over the visible; no affordable number of wavelengths resolves them, they have to average out.
//! On an even grid those whose path difference is a multiple of the reciprocal step do not: they
//! count in full. On an uneven one no beat stays in step, and what is left of each falls as one
//! over the root of the number. It falls fastest where every wavelength has the same effect on what
//! is seen, so they stand in proportion to that.

use crate::color::{Illuminant, Observer};
use std::f64::consts::TAU;

/// Visible range of the integral, metres: beyond it lies less than 1e-3 of any stimulus.
pub const BAND: (f64, f64) = (380e-9, 735e-9);
/// Share of the wavelengths that stand evenly in the wavenumber all the same: where the eye sees
/// little, slow beats are to be resolved too. Of 0.05, 0.12, 0.25, 0.5 the best.
const EVEN: f64 = 0.25;
/// Cells of the search for equal shares.
const CELLS: usize = 4000;

/// Wavelengths, metres, descending, and the intervals they stand for, up to a common factor.
pub fn nodes(count: usize) -> (Vec<f64>, Vec<f64>) {
    let (slow, fast) = (TAU / BAND.1, TAU / BAND.0);
    let step = (fast - slow) / CELLS as f64;
    let places: Vec<f64> = (0..CELLS).map(|k| slow + (k as f64 + 0.5) * step).collect();
    let density = density(&places);
    let total: f64 = density.iter().sum();
    let (mut below, mut cell) = (0.0, 0);
    (0..count)
        .map(|i| {
            let share = (i as f64 + 0.5) / count as f64 * total;
            while cell + 1 < CELLS && below + density[cell] < share {
                below += density[cell];
                cell += 1;
            }
            let inside = (share - below) / density[cell];
            let wavelength = TAU / (slow + (cell as f64 + inside) * step);
            // dλ = λ² dν
            (wavelength, wavelength * wavelength / density[cell])
        })
        .unzip()
}

/// How densely wavelengths stand by wavenumber (radians per metre): 1 in the mean.
fn density(wavenumbers: &[f64]) -> Vec<f64> {
    let stimulus = |wavenumber: &f64| {
        let wavelength = TAU / wavenumber;
        let width = wavelength * wavelength * Illuminant::D65.power(wavelength);
        Observer::Cie1931.matching(wavelength).map(|value| value * width)
    };
    let stimuli: Vec<[f64; 3]> = wavenumbers.iter().map(stimulus).collect();
    let sums: [f64; 3] = std::array::from_fn(|c| stimuli.iter().map(|s| s[c]).sum());
    // L*, a*, b* of a nearly white colour move as 116 Y, 500 (X - Y) and 200 (Y - Z).
    let effect = |stimulus: &[f64; 3]| {
        let [x, y, z] = std::array::from_fn(|c| stimulus[c] / sums[c]);
        (116.0 * y).hypot(500.0 * (x - y)).hypot(200.0 * (y - z))
    };
    let effects: Vec<f64> = stimuli.iter().map(effect).collect();
    let mean = effects.iter().sum::<f64>() / effects.len() as f64;
    effects.into_iter().map(|effect| EVEN + (1.0 - EVEN) * effect / mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The intervals make up the whole band, and weigh a smooth spectrum as an integral does.
    #[test]
    fn intervals_integrate() {
        let (wavelengths, widths) = nodes(600);
        assert!(wavelengths.windows(2).all(|pair| pair[0] > pair[1]));
        // Up to a common factor: the mean of 1/λ² over the band is 1/(λ₀ λ₁).
        let sum: f64 = widths.iter().sum();
        let mean: f64 = wavelengths.iter().zip(&widths).map(|(w, width)| width / (w * w)).sum();
        let expected = 1.0 / (BAND.0 * BAND.1);
        assert!((mean / sum / expected - 1.0).abs() < 1e-4, "{}", mean / sum / expected);
    }
}
