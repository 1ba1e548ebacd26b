//! Elhoni's thesis on spatially varying dielectrics: rays in spheres whose index varies along the radius, and how such
//! spheres scatter.

mod drawing;
mod inverse;
mod lenses;
mod scattering;

use super::figure::Figure;

/// All of them.
pub(super) const FIGURES: &[Figure] = &[
    lenses::LUNEBURG,
    inverse::SPIRALS,
    inverse::TURNS,
    lenses::GAUSSIAN,
    scattering::PHASE_FUNCTIONS,
];
