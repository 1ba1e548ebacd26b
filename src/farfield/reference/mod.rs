//! Independent and slow: what the other methods are measured against.

pub mod huygens_fresnel;
