//! Branches of a deflection curve as knots, the smooth windows by which they share rays with integrals,
//! and the sum of their waves over samples.

pub mod accumulate;
pub mod knots;
pub mod samples;
mod wave_kernels;
pub mod window;
