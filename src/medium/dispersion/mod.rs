//! Formulas for the index by wavelength, and conversions between them.

pub(super) mod abbe;
pub(super) mod formula;
