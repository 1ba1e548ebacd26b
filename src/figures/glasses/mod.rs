//! LuxCore's page on the dispersion of glass, and pbrt's spectral extension: Abbe numbers, Cauchy and Sellmeier, relative
//! partial dispersion, the fire of diamond.

mod abbe;
mod curves;
mod diamond;

use super::figure::Figure;

/// All of them.
pub(super) const FIGURES: &[Figure] = &[curves::CURVES, abbe::DIAGRAM, diamond::FIRE];
