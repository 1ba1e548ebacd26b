//! Three-vectors over a [`Scalar`]. The dot product is bilinear (no conjugation), which is what
//! analytic continuation of ray equations needs. Real geometry elsewhere uses `glam`.
//!
//! ```
//! use gonio::math::vec3::Vec3;
//!
//! let (x, y) = (Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0));
//! assert_eq!(x.cross(y).z, 1.0);
//! assert_eq!((x + y * 2.0).dot(y), 2.0);
//! ```

use super::scalar::Scalar;
use num_complex::Complex64;
use std::ops::{Add, Mul, Neg, Sub};

/// A vector `(x, y, z)`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec3<T> {
    /// First component.
    pub x: T,
    /// Second component.
    pub y: T,
    /// Third component.
    pub z: T,
}

/// The electric field of a ray: always complex.
pub type Field = Vec3<Complex64>;

impl<T: Scalar> Vec3<T> {
    /// A vector by its components.
    pub fn new(x: T, y: T, z: T) -> Self {
        Self { x, y, z }
    }

    /// A real vector over this scalar.
    pub fn real(v: Vec3<f64>) -> Self {
        Self { x: T::real(v.x), y: T::real(v.y), z: T::real(v.z) }
    }

    /// Scalar product, without conjugation.
    pub fn dot(self, o: Self) -> T {
        self.x * o.x + self.y * o.y + self.z * o.z
    }

    /// Vector product.
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
