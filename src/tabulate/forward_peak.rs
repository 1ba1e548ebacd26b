//! The forward peak in a table: often narrower than a sample.
//!
//! Half of all light that a large particle scatters lies in the diffraction peak, whose lobes are
//! `π/x` wide. Where a table's cell is coarser than a lobe the sample holds the mean over its cell of all the
//! light there, interference of the peak with the rest included. What the energy budget says must be scattered
//! and the rest of the table does not hold is given to the peak as one factor (near 1: edge effects of order
//! `x^(-2/3)` and the wave between diffraction and rays), so that the table sums to 1.

use crate::farfield::direction::Direction;
use crate::farfield::forward::penumbra_layout::near_axis;
use crate::farfield::forward::wave::ForwardWave;
use crate::math::half_turn::shares;
use crate::math::parallel::*;
use crate::optics::AmplitudeMatrix;
use crate::series::table::{coarse_cells, samples};
use std::f64::consts::PI;

/// θ cells of a table about the forward direction, and the angles that stand for them.
#[derive(Clone, Debug, Default)]
pub struct ForwardCells {
    /// Angles by cell, ascending: the sample of a fine cell, several of a coarse one. Radians.
    pub theta: Vec<f64>,
    /// By cell: the shares of its solid angle that its angles stand for.
    pub shares: Vec<Vec<f64>>,
}

impl ForwardCells {
    /// The cells of the θ axis (ascending) that lie within the peak; with or without means over coarse ones.
    pub fn new(theta: &[f64], size_parameter: f64, mean: bool) -> Self {
        let reach = near_axis(size_parameter);
        let coarse = if mean { coarse_cells(theta, size_parameter) } else { Vec::new() };
        // a cell that the peak reaches into is its own as a whole
        let count = theta.partition_point(|&t| t < reach).max(coarse.len());
        let mut cells = Self::default();
        for (i, &t) in theta[..count].iter().enumerate() {
            let (angles, shares) = match coarse.get(i) {
                Some(&(low, high)) => samples(low, high, size_parameter),
                None => (vec![t], vec![1.0]),
            };
            cells.theta.extend(angles);
            cells.shares.push(shares);
        }
        cells
    }

    /// How many cells there are.
    pub fn len(&self) -> usize {
        self.shares.len()
    }

    /// Of each cell the place of an angle at its middle.
    pub fn samples(&self) -> impl Iterator<Item = usize> {
        self.shares.iter().scan(0, |end, shares| {
            let first = *end;
            *end += shares.len();
            Some(first + shares.len() / 2)
        })
    }
}

/// The diffracted wave at the angles of the peak's cells, by azimuth: computed at a few azimuths of a
/// half-turn (the vertical plane is a mirror) and interpolated, since it varies slowly.
pub struct PeakRows {
    /// By azimuth `jπ/last`, by angle.
    rows: Vec<Vec<AmplitudeMatrix>>,
}

/// Neighbours in the interpolation over azimuth.
const STENCIL: usize = 6;

impl PeakRows {
    /// Compute the rows; the outline's deformation sets how many azimuths.
    pub fn new(peak: &ForwardWave, cells: &ForwardCells) -> Self {
        let reach =
            near_axis(peak.size_parameter) * peak.size_parameter * peak.shadow.deformation();
        let last = if reach < 1e-9 { 0 } else { 32 + (1.5 * reach).ceil() as usize };
        let azimuth = |j: usize| PI * j as f64 / last.max(1) as f64;
        let inside = near_axis(peak.size_parameter);
        // the last cell may reach to where the wave is in those of planes
        let wave = |theta: f64, phi: f64| match Direction::new(theta, phi) {
            direction if theta < inside => peak.peak(&direction),
            direction => peak.beside_planes(&direction),
        };
        let row = |j| cells.theta.iter().map(|&theta| wave(theta, azimuth(j))).collect();
        Self { rows: (0..=last).into_par_iter().map(row).collect() }
    }

    /// All angles at an azimuth in [0, π].
    pub fn at(&self, azimuth: f64) -> Vec<AmplitudeMatrix> {
        if self.rows.len() == 1 {
            return self.rows[0].clone();
        }
        let mut found = vec![AmplitudeMatrix::default(); self.rows[0].len()];
        for share in shares::<STENCIL>(azimuth, self.rows.len()) {
            let (weight, row) = (share.weight, &self.rows[share.index]);
            // S3 and S4 change sign in the mirror
            let cross = if share.mirrored { -weight } else { weight };
            for (sum, &AmplitudeMatrix { s1, s2, s3, s4 }) in found.iter_mut().zip(row) {
                let (s1, s2, s3, s4) = (s1 * weight, s2 * weight, s3 * cross, s4 * cross);
                *sum += AmplitudeMatrix { s1, s2, s3, s4 };
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Angles lie within their cells and stand for all of their solid angle; fine cells have their sample.
    #[test]
    fn coarse_cells_have_many_angles() {
        let theta: Vec<f64> = (0..=360).map(|i| PI * i as f64 / 360.0).collect();
        for (x, coarse) in [(20.0, false), (100.0, true), (5000.0, true)] {
            let cells = ForwardCells::new(&theta, x, true);
            let inside = theta.partition_point(|&t| t < 20.0 * PI / x);
            assert!(cells.len() == inside || cells.len() == inside + 1);
            assert_eq!(cells.theta.len() > cells.len(), coarse, "{x}");
            assert!(cells.theta.is_sorted());
            for (i, shares) in cells.shares.iter().enumerate() {
                assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{x} {i}");
            }
            assert!(cells.theta.last().unwrap() < &theta[cells.len()]);
            assert_eq!(ForwardCells::new(&theta, x, false).theta, theta[..inside]);
        }
    }
}
