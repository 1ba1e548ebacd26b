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

#[cfg(test)]
mod tests {
    use super::*;
    use num_complex::Complex64;

    fn ray<T: Scalar>() -> Ray<T> {
        let v = |x: f64, y: f64, z: f64| Vec3::new(T::real(x), T::real(y), T::real(z));
        let e = |x: f64, y: f64| Vec3 {
            x: Complex64::new(0.0, x),
            y: y.into(),
            z: Complex64::default(),
        };
        Ray {
            position: v(0.1, 0.2, -0.3),
            direction: v(0.0, 0.0, 1.0),
            dx: [v(1.0, 0.0, 0.0), v(0.0, 1.0, 0.0)],
            ds: [v(-0.5, 0.0, 0.0), v(0.0, 0.25, 0.0)],
            path: T::real(0.4),
            field: [e(0.6, 0.0), e(0.0, 0.8)],
            focal_lines: 0,
        }
    }

    #[test]
    fn power_is_the_mean_of_both_polarisations() {
        assert!((ray::<f64>().power() - 0.5).abs() < 1e-15);
    }

    /// One focus two lengths ahead, the other behind; complex rays are asked for their real parts.
    #[test]
    fn focal_lines_ahead_are_counted() {
        assert_eq!(ray::<f64>().focal_lines_within(1.9), 0);
        assert_eq!(ray::<f64>().focal_lines_within(2.1), 1);
        assert_eq!(ray::<Complex64>().focal_lines_within(f64::INFINITY), 1);
    }
}
