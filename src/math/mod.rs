//! Mathematics without physics: special functions, kernels, interpolation, quadrature.

pub mod airy;
pub mod chebyshev;
pub mod cosine_series;
pub mod digits;
pub mod fused;
pub mod gauss_legendre;
pub mod half_turn;
pub mod interpolate;
pub mod lane_fourier;
pub mod monotone;
pub mod phase;
pub mod principal_value;
pub mod riccati_bessel;
pub mod scalar;
pub mod spherical_harmonics;
pub mod spline;
pub mod vec3;

/// The golden ratio's fraction: steps of it spread any number of places evenly over 0 to 1.
pub const GOLDEN: f64 = 0.618_033_988_749_894_9;
