//! The data that are compiled in: the tables of `data/media`, and the catalogue of formulas.

pub(super) mod catalogue;
pub(super) mod tables;
