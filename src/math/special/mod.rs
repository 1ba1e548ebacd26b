//! Special functions and singular integrals.

pub mod airy;
pub mod principal_value;
pub mod riccati_bessel;
pub mod spherical_harmonics;
pub mod wigner;
