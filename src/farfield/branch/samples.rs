//! The samples of one column, and the amplitudes that are summed there.

use super::wave_kernels::LANES;
use crate::optics::AmplitudeMatrix;
use num_complex::Complex64;

/// Scattering angles of a column (radians, ascending), with room behind them for a last block.
#[derive(Clone, Debug)]
pub struct Samples {
    pub(super) padded: Vec<f64>,
    count: usize,
}

impl Samples {
    /// Samples at these scattering angles (radians, ascending).
    pub fn new(theta: &[f64]) -> Self {
        let last = theta.last().copied().unwrap_or(0.0);
        let mut padded = theta.to_vec();
        padded.resize(theta.len() + LANES, last);
        Self { padded, count: theta.len() }
    }

    /// The angles themselves.
    pub(super) fn theta(&self) -> &[f64] {
        &self.padded[..self.count]
    }
}

/// Amplitudes of one column: a row over its samples for each real and imaginary part of S1 … S4,
/// in the order S1, S2, S3, S4, real part first. Each row has room for a last block.
#[derive(Clone, Debug)]
pub struct Sums {
    pub(super) rows: [Vec<f64>; 8],
    count: usize,
}

impl Sums {
    /// Empty sums for these samples.
    pub fn new(samples: &Samples) -> Self {
        let rows = std::array::from_fn(|_| vec![0.0; samples.padded.len()]);
        Self { rows, count: samples.count }
    }

    /// As amplitude matrices.
    pub fn amplitudes(&self) -> Vec<AmplitudeMatrix> {
        let at = |e: usize, i: usize| Complex64::new(self.rows[2 * e][i], self.rows[2 * e + 1][i]);
        let matrix = |i| AmplitudeMatrix { s1: at(0, i), s2: at(1, i), s3: at(2, i), s4: at(3, i) };
        (0..self.count).map(matrix).collect()
    }
}

/// Which half of a plane a column is: the side of its azimuth, or the far side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// That of the plane's own azimuth.
    Near,
    /// That of the azimuth opposite.
    Far,
}
