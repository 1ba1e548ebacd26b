//! Curves through values: splines, series, transforms.

pub mod chebyshev;
pub mod cosine_series;
pub mod interpolate;
pub mod lane_fourier;
pub mod monotone;
pub mod spline;
pub mod uneven_fourier;
