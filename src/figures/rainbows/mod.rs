//! Sadeghi et al. 2012, "Physically-based simulation of rainbows": its figures and tables; and Airy's theory, which the
//! paper and Lee 1998 compare with Lorenz–Mie.

mod airy;
mod focal_line;
mod patches;
mod profiles;
mod rays;
mod sizes;
mod skies;
mod spheres;
mod stages;
mod strips;
mod widths;

use super::figure::Figure;

/// All of them.
pub(super) const FIGURES: &[Figure] = &[
    skies::FIG_1,
    rays::FIG_3,
    focal_line::FIG_4,
    spheres::FIG_5,
    spheres::FIG_6,
    profiles::FIG_7,
    stages::FIG_9,
    patches::FIG_10,
    sizes::FIG_11,
    skies::FIG_12,
    skies::FIG_13,
    skies::FIG_14,
    skies::FIG_15,
    skies::FIG_16,
    skies::FIG_17,
    profiles::TABLE_I,
    widths::TABLE_II,
    airy::STRIPS,
];
