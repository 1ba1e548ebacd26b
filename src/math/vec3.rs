//! Three-vectors over a [`Scalar`]. The dot product is bilinear (no conjugation), which is what
//! analytic continuation of ray equations needs. Real geometry elsewhere uses `glam`.

use super::scalar::Scalar;
use num_complex::Complex64;
use std::ops::{Add, Mul, Neg, Sub};

/// A vector `(x, y, z)`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec3<T> {
    pub x: T,
    pub y: T,
    pub z: T,
}

/// The electric field of a ray: always complex.
pub type Field = Vec3<Complex64>;

impl<T: Scalar> Vec3<T> {
    pub fn new(x: T, y: T, z: T) -> Self {
        Self { x, y, z }
    }

    /// A real vector over this scalar.
    pub fn real(v: Vec3<f64>) -> Self {
        Self { x: T::real(v.x), y: T::real(v.y), z: T::real(v.z) }
    }

    pub fn dot(self, o: Self) -> T {
        self.x * o.x + self.y * o.y + self.z * o.z
    }

    pub fn cross(self, o: Self) -> Self {
        Self {
            x: self.y * o.z - self.z * o.y,
            y: self.z * o.x - self.x * o.z,
            z: self.x * o.y - self.y * o.x,
        }
    }

    /// The vector over the square root of its bilinear square.
    pub fn normalized(self) -> Self {
        self * (T::real(1.0) / self.dot(self).root())
    }

    /// Complex amplitude of a field along this vector.
    pub fn project(self, field: Field) -> Complex64 {
        self.x.scale(field.x) + self.y.scale(field.y) + self.z.scale(field.z)
    }

    /// A field of complex amplitude `a` along this vector.
    pub fn carry(self, a: Complex64) -> Field {
        Vec3 { x: self.x.scale(a), y: self.y.scale(a), z: self.z.scale(a) }
    }
}

impl From<glam::DVec3> for Vec3<f64> {
    fn from(v: glam::DVec3) -> Self {
        Self { x: v.x, y: v.y, z: v.z }
    }
}

impl From<Vec3<f64>> for glam::DVec3 {
    fn from(v: Vec3<f64>) -> Self {
        glam::DVec3::new(v.x, v.y, v.z)
    }
}

impl<T: Scalar> Add for Vec3<T> {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self { x: self.x + o.x, y: self.y + o.y, z: self.z + o.z }
    }
}

impl<T: Scalar> Sub for Vec3<T> {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self { x: self.x - o.x, y: self.y - o.y, z: self.z - o.z }
    }
}

impl<T: Scalar> Neg for Vec3<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }
}

impl<T: Scalar> Mul<T> for Vec3<T> {
    type Output = Self;
    fn mul(self, f: T) -> Self {
        Self { x: self.x * f, y: self.y * f, z: self.z * f }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_obey_their_identities() {
        let (a, b, c) =
            (Vec3::new(1.0, -2.0, 0.5), Vec3::new(0.3, 0.7, -1.1), Vec3::new(-0.4, 2.0, 1.5));
        assert_eq!(
            Vec3::new(1.0, 0.0, 0.0).cross(Vec3::new(0.0, 1.0, 0.0)),
            Vec3::new(0.0, 0.0, 1.0)
        );
        let (left, right) = (a.cross(b.cross(c)), b * a.dot(c) - c * a.dot(b));
        assert!((left - right).dot(left - right) < 1e-28);
        assert!((a.dot(b.cross(c)) - c.dot(a.cross(b))).abs() < 1e-14);
    }

    /// The product is bilinear: null vectors are their own normals, and a unit vector has square 1.
    #[test]
    fn complex_products_do_not_conjugate() {
        let (one, i) = (Complex64::from(1.0), Complex64::i());
        let null = Vec3::new(one, i, Complex64::default());
        assert_eq!(null.dot(null), Complex64::default());
        let unit = Vec3::new(one * 2.0, i, Complex64::new(0.3, -0.2)).normalized();
        assert!((unit.dot(unit) - 1.0).norm() < 1e-15);
    }

    #[test]
    fn a_field_is_read_as_it_was_written() {
        let axis = Vec3::new(0.6, 0.0, -0.8);
        let amplitude = Complex64::new(0.3, -1.2);
        let field = axis.carry(amplitude);
        assert!((axis.project(field) - amplitude).norm() < 1e-15);
        assert!(Vec3::new(0.8, 0.0, 0.6).project(field).norm() < 1e-15);
    }
}
