//! Mathematics without physics: special functions, kernels, interpolation, quadrature.
//!
//! ```
//! use gonio::math::gauss_legendre;
//!
//! let integral: f64 = gauss_legendre::nodes(20).iter().map(|(x, weight)| weight * x.exp()).sum();
//! assert!((integral - (1f64.exp() - (-1f64).exp())).abs() < 1e-14);
//! ```

pub mod bytes;
mod curves;
pub mod digits;
pub mod fused;
pub mod gauss_legendre;
pub mod half_turn;
pub mod jet;
pub mod phase;
pub mod scalar;
mod special;
pub mod vec3;

pub use curves::{chebyshev, cosine_series, interpolate, lane_fourier, monotone, spline};
pub use special::{airy, principal_value, riccati_bessel, spherical_harmonics};

/// The golden ratio's fraction: steps of it spread any number of places evenly over 0 to 1.
pub const GOLDEN: f64 = 0.618_033_988_749_894_9;
