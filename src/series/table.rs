//! A slab of a phase table from the exact series: a sphere needs one azimuth only.
//!
//! Where cells of the θ axis are coarser than the lobes of the forward peak, a sample holds the mean
//! over its cell; what the samples of the rest of the sphere miss of the exact scattering
//! cross-section (their ripple is finer than the cells) is closed there too, by one factor.

use super::SeriesError;
use super::debye::{DebyeSeries, Term};
use super::lorenz_mie::Sphere;
use crate::optics::AmplitudeMatrix;
use crate::phase_table::{Axes, ForwardPeak, Quantity, Slab};
use ndarray::Array3;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// What is summed.
#[derive(Clone, Debug)]
pub enum Source {
    LorenzMie,
    /// Debye terms; their sum is normalised with the exact scattering cross-section.
    Debye(Vec<Term>),
}

/// Lobes of the forward peak that are averaged over cells, and samples per lobe.
const LOBES: f64 = 20.0;
const SAMPLES_PER_LOBE: f64 = 8.0;
/// Step of θ, in lobes, from which on cells hold means. The sum over point samples is off by about
/// 0.01 (step x)², so that with finer steps it misses 1 by less than 1e-3.
const COARSE: f64 = 0.08;

/// One wavelength of a sphere's table.
///
/// `theta` ascending, radians; `radius` and `wavelength` in metres. The values have one azimuth.
///
/// # Errors
/// An index or size parameter that the series does not accept.
pub fn sphere_slab(
    source: &Source,
    radius: f64,
    wavelength: f64,
    index: Complex64,
    theta: &[f64],
    quantity: Quantity,
    forward_peak: ForwardPeak,
) -> Result<Slab, SeriesError> {
    let size_parameter = TAU * radius / wavelength;
    let sphere = Sphere::new(size_parameter, index)?;
    let amplitudes = |angles: &[f64]| -> Result<Vec<(Complex64, Complex64)>, SeriesError> {
        Ok(match source {
            Source::LorenzMie => sphere.amplitudes_parallel(angles),
            Source::Debye(terms) => {
                DebyeSeries::new(size_parameter, index)?.sum_parallel(terms, angles)
            }
        })
    };
    let q = sphere.efficiencies();
    let scale = 1.0 / (size_parameter * size_parameter * PI * q.q_sca);
    let mut mueller: Vec<[[f64; 4]; 4]> =
        amplitudes(theta)?.into_iter().map(|pair| matrix(pair).mueller()).collect();
    let axes = Axes { wavelength: vec![wavelength], theta: theta.to_vec(), phi: vec![0.0] };
    let weights = axes.solid_angle();
    let sum = |m: &[[[f64; 4]; 4]]| -> f64 {
        m.iter().zip(&weights).map(|(m, w)| m[0][0] * scale * w).sum()
    };
    let sum_before_peak = sum(&mueller);
    if forward_peak == ForwardPeak::CellAverage {
        let cells = coarse_cells(theta, size_parameter);
        for (i, &(low, high)) in cells.iter().enumerate() {
            let (angles, shares) = samples(low, high, size_parameter);
            mueller[i] = mean(&amplitudes(&angles)?, &shares);
        }
        let total: f64 = weights.sum();
        if (total / (4.0 * PI) - 1.0).abs() < 1e-6 && !cells.is_empty() {
            let peak = sum(&mueller[..cells.len()]);
            let factor = ((1.0 - sum(&mueller) + peak) / peak).clamp(0.5, 2.0);
            mueller[..cells.len()].iter_mut().flatten().flatten().for_each(|m| *m *= factor);
        }
    }
    let elements = quantity.elements();
    let values = Array3::from_shape_fn((elements, theta.len(), 1), |(e, i, _)| {
        (mueller[i][e / 4][e % 4] * scale) as f32
    });
    let shadow = PI * radius * radius;
    Ok(Slab {
        wavelength,
        index,
        values,
        caustic_order: None,
        scattering_cross_section: q.q_sca * shadow,
        extinction_cross_section: q.q_ext * shadow,
        asymmetry: q.asymmetry,
        energy: None,
        sum_before_peak,
        peak_share: 0.0,
        error_estimate: match source {
            Source::LorenzMie => 1e-9,
            Source::Debye(_) => f64::NAN,
        },
    })
}

fn matrix((s1, s2): (Complex64, Complex64)) -> AmplitudeMatrix {
    AmplitudeMatrix { s1, s2, ..Default::default() }
}

/// Cells about the forward direction that are coarser than [`COARSE`]. The cell at 0 is half as wide
/// as its neighbour: it is the step that counts, else no cell would ever follow a fine first one.
fn coarse_cells(theta: &[f64], size_parameter: f64) -> Vec<(f64, f64)> {
    let last = theta.len() - 1;
    let cell = |i: usize| {
        let low = if i == 0 { theta[0] } else { 0.5 * (theta[i - 1] + theta[i]) };
        let high = if i == last { theta[last] } else { 0.5 * (theta[i] + theta[i + 1]) };
        (low, high)
    };
    let reach = LOBES * PI / size_parameter;
    let step = |i: usize| if i < last { theta[i + 1] - theta[i] } else { theta[i] - theta[i - 1] };
    let coarse = |&i: &usize| cell(i).0 < reach && step(i) * size_parameter > COARSE * PI;
    (0..theta.len()).take_while(coarse).map(cell).collect()
}

/// Angles within a cell and their shares of its solid angle.
fn samples(low: f64, high: f64, size_parameter: f64) -> (Vec<f64>, Vec<f64>) {
    let lobes = (high - low) * size_parameter / PI;
    let count = (lobes * SAMPLES_PER_LOBE).ceil().clamp(4.0, 65536.0) as usize;
    let angles: Vec<f64> =
        (0..count).map(|k| low + (high - low) * (k as f64 + 0.5) / count as f64).collect();
    let total: f64 = angles.iter().map(|t| t.sin()).sum();
    let shares = angles.iter().map(|t| t.sin() / total).collect();
    (angles, shares)
}

fn mean(amplitudes: &[(Complex64, Complex64)], shares: &[f64]) -> [[f64; 4]; 4] {
    let mut sum = [[0.0; 4]; 4];
    for (&pair, share) in amplitudes.iter().zip(shares) {
        let mueller = matrix(pair).mueller();
        for (to, from) in sum.iter_mut().flatten().zip(mueller.iter().flatten()) {
            *to += share * from;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever the step is to the lobes: P times solid angle sums to 1.
    #[test]
    fn values_sum_to_one_on_any_grid() {
        for radius in [1e-6, 2e-6, 5e-6, 2e-5, 8e-5] {
            for count in [46, 91, 181, 361, 721, 1801, 3601] {
                let theta: Vec<f64> =
                    (0..count).map(|i| PI * i as f64 / (count - 1) as f64).collect();
                let slab = sphere_slab(
                    &Source::LorenzMie,
                    radius,
                    5e-7,
                    Complex64::new(1.333, 0.0),
                    &theta,
                    Quantity::PhaseFunction,
                    ForwardPeak::CellAverage,
                )
                .unwrap();
                let axes = Axes { wavelength: vec![5e-7], theta, phi: vec![0.0] };
                let sum = slab.sum(&axes);
                assert!((sum - 1.0).abs() < 1e-3, "{radius} m, {count} angles: {sum}");
            }
        }
    }
}
