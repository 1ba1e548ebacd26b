//! Mathematics without physics: special functions, kernels, interpolation, quadrature.

pub mod scalar;
pub mod vec3;
