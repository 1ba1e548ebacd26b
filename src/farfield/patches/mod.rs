//! The published method (Sadeghi et al. 2012): sheets of rays as triangles on the sphere of directions.

pub mod collecting_sphere;
pub mod field;
pub mod gaussian_filter;
pub mod interference;
pub mod sheets;
