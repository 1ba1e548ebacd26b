//! A solved sphere: partial waves, efficiencies, amplitudes.

use super::layers::{self, Layer};
use super::matching::Coefficients;
use super::profile;
use super::radial_index::RadialIndex;
use crate::series::angular::{self, AngleSet};
use crate::series::lorenz_mie::efficiencies;
use crate::series::{Efficiencies, SeriesError};
use num_complex::Complex64;

/// A sphere whose index varies along the radius, with its solved partial waves.
#[derive(Clone, Debug)]
pub struct Layered {
    size_parameter: f64,
    a: Vec<Complex64>,
    b: Vec<Complex64>,
    efficiencies: Efficiencies,
    error: f64,
}

impl Layered {
    /// Concentric layers, from inside out, of a sphere of size parameter `x = 2πr/λ` outside.
    ///
    /// # Errors
    /// Radii that do not ascend to 1, an index without meaning, more terms than there is room for.
    pub fn layers(size_parameter: f64, layers: &[Layer]) -> Result<Self, SeriesError> {
        let solved = layers::coefficients(size_parameter, layers)?;
        Ok(Self::new(size_parameter, solved, layers::ERROR))
    }

    /// A radial profile, to a relative error of the amplitudes (root mean square over the partial
    /// waves); [`Self::error`] states what was reached.
    ///
    /// # Errors
    /// A profile that is not positive and finite, a size parameter without meaning, or more steps
    /// than are accepted.
    pub fn profile(
        size_parameter: f64,
        index: &impl RadialIndex,
        tolerance: f64,
    ) -> Result<Self, SeriesError> {
        let (solved, error) = profile::coefficients(size_parameter, index, tolerance)?;
        Ok(Self::new(size_parameter, solved, error))
    }

    fn new(x: f64, solved: Coefficients, error: f64) -> Self {
        let Coefficients { a, b, absorbed } = solved;
        let efficiencies = efficiencies(x, &a, &b, absorbed);
        Self { size_parameter: x, a, b, efficiencies, error }
    }

    /// `x = 2πr/λ` of the outer radius.
    pub fn size_parameter(&self) -> f64 {
        self.size_parameter
    }

    /// Electric partial waves a_n; index 0 is n = 1.
    pub fn a(&self) -> &[Complex64] {
        &self.a
    }

    /// Magnetic partial waves b_n; index 0 is n = 1.
    pub fn b(&self) -> &[Complex64] {
        &self.b
    }

    /// Efficiencies (cross-section over the outer πa²) and asymmetry.
    pub fn efficiencies(&self) -> Efficiencies {
        self.efficiencies
    }

    /// Relative error of the partial waves, root mean square with their weights 2n + 1.
    pub fn error(&self) -> f64 {
        self.error
    }

    /// S1 = S2 straight ahead, `½ Σ (2n+1)(a_n + b_n)`.
    pub fn straight_ahead(&self) -> Complex64 {
        let pairs = self.a.iter().zip(&self.b).enumerate();
        0.5 * pairs.map(|(k, (a, b))| (2 * k + 3) as f64 * (a + b)).sum::<Complex64>()
    }

    /// (S1, S2) at prepared angles, on this thread.
    pub fn amplitudes_at(&self, set: &AngleSet) -> Vec<(Complex64, Complex64)> {
        angular::amplitudes(&self.a, &self.b, set)
    }

    /// (S1, S2) at scattering angles in radians, blocks of angles shared among all threads.
    pub fn amplitudes_parallel(&self, theta: &[f64]) -> Vec<(Complex64, Complex64)> {
        angular::amplitudes_parallel(&self.a, &self.b, &AngleSet::new(theta))
    }
}
