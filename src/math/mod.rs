//! Mathematics without physics: special functions, kernels, interpolation, quadrature.
