//! Mathematics without physics. For shapes of one's own: vectors, real and complex scalars, jets that carry
//! derivatives along; inside the house also special functions, kernels, interpolation, quadrature.
//!
//! ```
//! use gonio::math::jet::Jet;
//!
//! let (q, depth) = (Jet::first(0.9), Jet::second(0.4));
//! let outline = (q - depth * depth) / 4.0 + depth * depth / 9.0 - 1.0;
//! assert!((outline.x - 0.25).abs() < 1e-15); // its slope along q
//! ```

pub(crate) mod bytes;
mod curves;
pub mod digits;
pub(crate) mod fused;
pub(crate) mod gauss_legendre;
pub(crate) mod half_turn;
pub mod jet;
pub(crate) mod parallel;
pub(crate) mod phase;
pub mod scalar;
mod special;
pub mod vec3;

pub(crate) use curves::{
    chebyshev, cosine_series, interpolate, lane_fourier, monotone, uneven_fourier,
};
pub(crate) use special::{airy, principal_value, riccati_bessel, spherical_harmonics, wigner};

/// The golden ratio's fraction: steps of it spread any number of places evenly over 0 to 1.
pub(crate) const GOLDEN: f64 = 0.618_033_988_749_894_9;
