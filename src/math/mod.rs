//! Mathematics without physics: special functions, kernels, interpolation, quadrature.

pub mod scalar;
pub mod vec3;
pub mod riccati_bessel;
