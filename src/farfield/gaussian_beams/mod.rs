//! Sums of Gaussian beams, for orders whose caustics no scattering plane can follow.

mod beam;
mod launch;
mod sum;

pub use sum::GaussianBeams;
