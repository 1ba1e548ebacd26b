//! Data of media: rows in units, made curves, made materials.

pub(super) mod column;
pub(super) mod extinction;
pub(super) mod material;
pub(super) mod samples;
pub(super) mod table;
pub(super) mod unit;
