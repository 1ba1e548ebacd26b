//! HDF5 files and their variables, as the rest of this room sees them: created and opened, written
//! and read with checks.

mod attribute;
pub mod created;
mod failure;
pub mod opened;
