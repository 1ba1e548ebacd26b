//! Mathematics without physics: special functions, kernels, interpolation, quadrature.

pub mod riccati_bessel;
