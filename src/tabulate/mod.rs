//! From amplitudes to the slabs of a table.

pub mod forward_peak;
pub mod slab;
