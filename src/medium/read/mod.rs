//! Readers of files that hold a refractive index.

pub(super) mod agf;
mod csv_cells;
pub(super) mod csv_table;
pub(super) mod ending;
mod extinction;
pub(super) mod refractive_index_info;
pub(super) mod text;
