//! The state of one ray: where it is, where it goes, how its neighbours diverge, what field it has.

use super::focal_lines;
use crate::math::scalar::Scalar;
use crate::math::vec3::{Field, Vec3};

/// A ray with its differentials. Lengths in units of the radius of equal volume.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray<T> {
    pub position: Vec3<T>,
    pub direction: Vec3<T>,
    /// ∂position/∂(u, v)
    pub dx: [Vec3<T>; 2],
    /// ∂direction/∂(u, v)
    pub ds: [Vec3<T>; 2],
    /// Optical path from the plane through the centre normal to the light.
    pub path: T,
    /// Electric fields for incident light along x and along y, normalised to power.
    pub field: [Field; 2],
    pub focal_lines: u32,
}

impl<T: Scalar> Ray<T> {
    /// Focal lines on the next stretch of the way.
    pub(super) fn focal_lines_within(&self, length: f64) -> u32 {
        let real = |v: Vec3<T>| Vec3 { x: v.x.re(), y: v.y.re(), z: v.z.re() };
        focal_lines::count(real(self.direction), &self.dx.map(real), &self.ds.map(real), length)
    }

    /// Power for unpolarised light, as a fraction of what the ray began with.
    pub(super) fn power(&self) -> f64 {
        power(&self.field)
    }
}

/// Power of unpolarised light whose fields for light incident along x and along y are these.
pub(super) fn power(field: &[Field; 2]) -> f64 {
    let square = |e: &Field| e.x.norm_sqr() + e.y.norm_sqr() + e.z.norm_sqr();
    0.5 * (square(&field[0]) + square(&field[1]))
}
