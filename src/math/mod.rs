//! Mathematics without physics: special functions, kernels, interpolation, quadrature.

pub mod monotone;
pub mod principal_value;
pub mod riccati_bessel;
pub mod scalar;
pub mod spline;
pub mod vec3;
