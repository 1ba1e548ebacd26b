//! Writing tables and sweeps, slab by slab: memory does not grow with their number.

mod body;
pub mod sweep;
pub mod table;
