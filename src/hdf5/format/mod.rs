//! What stands in a file beyond the schema: chunks of its faces, and how what it has once is read.

pub mod circumstances;
pub mod faces;
pub mod methods;

/// Root attribute `format` of a merged sweep.
pub const SWEEP_FORMAT: &str = "gonio phase table sweep";
