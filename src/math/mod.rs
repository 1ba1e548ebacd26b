//! Mathematics without physics: special functions, kernels, interpolation, quadrature.

pub mod airy;
pub mod chebyshev;
pub mod cosine_series;
pub mod digits;
pub mod fused;
pub mod gauss_legendre;
pub mod half_turn;
pub mod interpolate;
pub mod jet;
pub mod lane_fourier;
pub mod monotone;
pub mod phase;
pub mod principal_value;
pub mod riccati_bessel;
pub mod scalar;
pub mod spherical_harmonics;
pub mod spline;
pub mod vec3;
