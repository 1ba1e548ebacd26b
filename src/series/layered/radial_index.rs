//! What a radial profile has to answer.

use num_complex::Complex64;

/// A radial profile at one wavelength, relative to the outside.
pub trait RadialIndex: Sync {
    /// `(n + ik)²` at a radius in (0, 1).
    fn squared(&self, radius: f64) -> Complex64;
    /// Radii of jumps and kinks.
    fn breaks(&self) -> Vec<f64>;
}
