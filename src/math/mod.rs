//! Mathematics without physics: special functions, kernels, interpolation, quadrature.

pub mod bytes;
mod curves;
pub mod digits;
pub mod fused;
pub mod gauss_legendre;
pub mod half_turn;
pub mod phase;
pub mod scalar;
mod special;
pub mod vec3;

pub use curves::{chebyshev, cosine_series, interpolate, lane_fourier, monotone, spline};
pub use special::{airy, principal_value, riccati_bessel, spherical_harmonics};

/// The golden ratio's fraction: steps of it spread any number of places evenly over 0 to 1.
pub const GOLDEN: f64 = 0.618_033_988_749_894_9;
