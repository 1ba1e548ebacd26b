//! From amplitudes to the slabs of a table.

pub mod forward_peak;
pub mod scattered_power;
pub mod slab;
