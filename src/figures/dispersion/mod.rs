//! Weidlich & Wilkie 2009, "Anomalous dispersion in predictive rendering": indices that rise towards long waves within
//! bands of absorption, and what prisms and drops make of them.

mod drop;
mod dyes;
mod ice;
mod prism;
mod transform;

use super::figure::Figure;

/// All of them.
pub(super) const FIGURES: &[Figure] =
    &[prism::FIG_1, ice::FIG_2, dyes::FIG_4, prism::FIG_5, transform::TRUNCATION, drop::DYED_DROP];
