//! The forward peak in a table: often narrower than a sample.
//!
//! Half of all light that a large particle scatters lies in the diffraction peak, whose lobes are
//! `π/x` wide. Where a table's cell is coarser than a lobe the sample holds the mean of the
//! diffracted intensity over its cell. What the energy budget says must be scattered and the rest
//! of the table does not hold is given to the peak as one factor (near 1: edge effects of order
//! `x^(-2/3)` and the wave between diffraction and rays), so that the table sums to 1.

use super::direction::Direction;
use super::forward_diffraction::ForwardDiffraction;
use crate::optics::AmplitudeMatrix;

/// Lobes about the axis within which the peak is treated; beyond, point values serve.
const LOBES: f64 = 20.0;
/// Samples per lobe when averaging over a cell.
const SAMPLES_PER_LOBE: f64 = 8.0;

/// θ cells of a table about the forward direction.
#[derive(Clone, Debug)]
pub struct ForwardCells {
    /// (lower, upper) edge of each θ cell that the peak reaches.
    pub cells: Vec<(f64, f64)>,
    size_parameter: f64,
}

impl ForwardCells {
    /// The cells of the θ axis (ascending) that lie within the peak.
    pub fn new(theta: &[f64], size_parameter: f64) -> Self {
        let reach = LOBES * std::f64::consts::PI / size_parameter;
        let last = theta.len() - 1;
        let cell = |i: usize| {
            let low = if i == 0 { theta[0] } else { 0.5 * (theta[i - 1] + theta[i]) };
            let high = if i == last { theta[last] } else { 0.5 * (theta[i] + theta[i + 1]) };
            (low, high)
        };
        let cells = (0..theta.len()).map(cell).take_while(|c| c.0 < reach).collect();
        Self { cells, size_parameter }
    }

    /// No cells: the peak is left out or does not exist.
    pub fn none() -> Self {
        Self { cells: Vec::new(), size_parameter: 0.0 }
    }

    /// Mean of `|S_diffraction|²` over cell `i` at an azimuth.
    pub fn mean_intensity(&self, peak: &ForwardDiffraction, i: usize, azimuth: f64) -> f64 {
        let (low, high) = self.cells[i];
        let lobes = (high - low) * self.size_parameter / std::f64::consts::PI;
        let count = (lobes * SAMPLES_PER_LOBE).ceil().clamp(4.0, 4096.0) as usize;
        let (mut sum, mut weights) = (0.0, 0.0);
        for k in 0..count {
            let theta = low + (high - low) * (k as f64 + 0.5) / count as f64;
            let weight = theta.sin();
            let amplitude = peak.amplitude(self.size_parameter, &Direction::new(theta, azimuth));
            sum += weight * amplitude.norm_sqr();
            weights += weight;
        }
        if weights > 0.0 { sum / weights } else { 0.0 }
    }

    /// Whether cell `i` is too coarse to be represented by its centre.
    pub fn is_coarse(&self, i: usize) -> bool {
        let (low, high) = self.cells[i];
        (high - low) * self.size_parameter > 0.25 * std::f64::consts::PI
    }
}

/// Add the diffraction amplitude, the same for both polarisations.
pub fn add(amplitude: &mut AmplitudeMatrix, diffraction: num_complex::Complex64) {
    amplitude.s1 += diffraction;
    amplitude.s2 += diffraction;
}
