//! Reading tables and sweeps, slab by slab.

mod header;
mod records;
pub mod sweep;
pub mod table;
