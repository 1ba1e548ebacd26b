//! The forward peak in a table: often narrower than a sample.
//!
//! Half of all light that a large particle scatters lies in the diffraction peak, whose lobes are
//! `π/x` wide. Where a table's cell is coarser than a lobe the sample holds the mean of the
//! diffracted intensity over its cell. What the energy budget says must be scattered and the rest
//! of the table does not hold is given to the peak as one factor (near 1: edge effects of order
//! `x^(-2/3)` and the wave between diffraction and rays), so that the table sums to 1.

use crate::farfield::direction::Direction;
use crate::farfield::forward::penumbra_layout::near_axis;
use crate::farfield::forward::wave::ForwardWave;
use crate::math::half_turn::shares;
use crate::optics::AmplitudeMatrix;
use std::f64::consts::PI;

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
        let reach = near_axis(size_parameter);
        let last = theta.len() - 1;
        let cell = |i: usize| {
            let low = if i == 0 { theta[0] } else { 0.5 * (theta[i - 1] + theta[i]) };
            let high = if i == last { theta[last] } else { 0.5 * (theta[i] + theta[i + 1]) };
            (low, high)
        };
        let count = theta.partition_point(|&t| t < reach);
        let cells = (0..count).map(cell).collect();
        Self { cells, size_parameter }
    }

    /// No cells: the peak is left out or does not exist.
    pub fn none() -> Self {
        Self { cells: Vec::new(), size_parameter: 0.0 }
    }

    /// The diffracted wave in all cells at an azimuth.
    fn samples(&self, peak: &ForwardWave, theta: &[f64], phi: f64, mean: bool) -> Vec<PeakSample> {
        let sample = |i: usize| PeakSample {
            amplitude: peak.peak(&Direction::new(theta[i], phi)),
            mean: if mean && self.is_coarse(i) { self.mean_intensity(peak, i, phi) } else { 0.0 },
        };
        (0..self.cells.len()).map(sample).collect()
    }

    /// Mean of `|S_diffraction|²` over cell `i` at an azimuth.
    fn mean_intensity(&self, peak: &ForwardWave, i: usize, azimuth: f64) -> f64 {
        let (low, high) = self.cells[i];
        let lobes = (high - low) * self.size_parameter / PI;
        let count = (lobes * SAMPLES_PER_LOBE).ceil().clamp(4.0, 4096.0) as usize;
        let (mut sum, mut weights) = (0.0, 0.0);
        for k in 0..count {
            let theta = low + (high - low) * (k as f64 + 0.5) / count as f64;
            let weight = theta.sin();
            sum += weight * peak.peak(&Direction::new(theta, azimuth)).s11();
            weights += weight;
        }
        if weights > 0.0 { sum / weights } else { 0.0 }
    }

    /// Whether cell `i` is too coarse to be represented by its centre.
    pub fn is_coarse(&self, i: usize) -> bool {
        let (low, high) = self.cells[i];
        (high - low) * self.size_parameter > 0.25 * PI
    }
}

/// The diffracted wave in the cells of the peak, by azimuth: computed at a few azimuths of a
/// half-turn (the vertical plane is a mirror) and interpolated, since it varies slowly.
pub struct PeakRows {
    /// By azimuth `jπ/last`, by cell: amplitude at the sample, mean intensity over the cell.
    rows: Vec<Vec<PeakSample>>,
}

/// The diffracted wave in one cell: amplitude at its sample, mean intensity over the cell (0 where
/// the cell is fine enough for the sample to stand for it).
#[derive(Clone, Copy, Debug, Default)]
pub struct PeakSample {
    /// Its amplitudes at the direction.
    pub amplitude: AmplitudeMatrix,
    /// Mean of its intensity over the cell.
    pub mean: f64,
}

/// Neighbours in the interpolation over azimuth.
const STENCIL: usize = 6;

impl PeakRows {
    /// Compute the rows for samples `theta`; the outline's deformation sets how many azimuths.
    pub fn new(peak: &ForwardWave, cells: &ForwardCells, theta: &[f64], mean: bool) -> Self {
        let reach =
            near_axis(peak.size_parameter) * peak.size_parameter * peak.shadow.deformation();
        let last = if reach < 1e-9 { 0 } else { 32 + (1.5 * reach).ceil() as usize };
        let azimuths = (0..=last).map(|j| PI * j as f64 / last.max(1) as f64);
        let rows = azimuths.map(|phi| cells.samples(peak, theta, phi, mean)).collect();
        Self { rows }
    }

    /// Samples of all cells at an azimuth in [0, π].
    pub fn at(&self, azimuth: f64) -> Vec<PeakSample> {
        if self.rows.len() == 1 {
            return self.rows[0].clone();
        }
        let mut found = vec![PeakSample::default(); self.rows[0].len()];
        for share in shares::<STENCIL>(azimuth, self.rows.len()) {
            let (weight, row) = (share.weight, &self.rows[share.index]);
            // S3 and S4 change sign in the mirror
            let cross = if share.mirrored { -weight } else { weight };
            for (sum, sample) in found.iter_mut().zip(row) {
                let AmplitudeMatrix { s1, s2, s3, s4 } = sample.amplitude;
                let (s1, s2, s3, s4) = (s1 * weight, s2 * weight, s3 * cross, s4 * cross);
                sum.amplitude += AmplitudeMatrix { s1, s2, s3, s4 };
                sum.mean += sample.mean * weight;
            }
        }
        found
    }
}
