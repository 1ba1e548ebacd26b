//! Mathematics without physics: special functions, kernels, interpolation, quadrature.
//!
//! ```
//! use gonio::math::gauss_legendre;
//!
//! let integral: f64 = gauss_legendre::nodes(20).iter().map(|(x, weight)| weight * x.exp()).sum();
//! assert!((integral - (1f64.exp() - (-1f64).exp())).abs() < 1e-14);
//! ```

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
