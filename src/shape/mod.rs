//! Shapes of particles: surface, normal, curvature, silhouette. One file per kind.

/// Model of the equilibrium shape of a falling raindrop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RaindropModel {
    BeardChuang1987,
    ChuangBeard1990,
}
