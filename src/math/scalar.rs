//! The scalar that a ray is made of: real for the rays one sees, complex for those behind a caustic.
//!
//! On the dark side of a caustic the ray equations have complex solutions. All shapes here are
//! analytic, so the same tracing code follows them when its scalar is complex.
//!
//! ```
//! use gonio::math::scalar::Scalar;
//! use num_complex::Complex64;
//!
//! fn hypotenuse<T: Scalar>(a: T, b: T) -> T {
//!     (a * a + b * b).root()
//! }
//! assert_eq!(hypotenuse(3.0, 4.0), 5.0);
//! assert_eq!(hypotenuse(Complex64::from(3.0), Complex64::from(4.0)).re, 5.0);
//! ```

use num_complex::Complex64;
use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// A field with square roots: `f64` or `Complex64`.
pub trait Scalar:
    Copy
    + Debug
    + Default
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// Whether this is the real field.
    const REAL: bool;
    /// A real number as this scalar.
    fn real(value: f64) -> Self;
    /// A complex number as this scalar: its real part where this is the real field.
    fn of_complex(value: Complex64) -> Self;
    /// Principal square root.
    fn root(self) -> Self;
    /// Principal value of a real power; whole powers of real numbers are those of arithmetic.
    fn power(self, exponent: f64) -> Self;
    /// Real part.
    fn re(self) -> f64;
    /// Size, for tolerances.
    fn size(self) -> f64;
    /// As a complex number.
    fn complex(self) -> Complex64;
    /// `z · w` for a complex `z`, without complex arithmetic where `self` is real.
    fn scale(self, z: Complex64) -> Complex64;
}

impl Scalar for f64 {
    const REAL: bool = true;
    fn real(value: f64) -> Self {
        value
    }
    fn of_complex(value: Complex64) -> Self {
        value.re
    }
    fn root(self) -> Self {
        self.sqrt()
    }
    fn power(self, exponent: f64) -> Self {
        self.powf(exponent)
    }
    fn re(self) -> f64 {
        self
    }
    fn size(self) -> f64 {
        self.abs()
    }
    fn complex(self) -> Complex64 {
        Complex64::new(self, 0.0)
    }
    fn scale(self, z: Complex64) -> Complex64 {
        z * self
    }
}

impl Scalar for Complex64 {
    const REAL: bool = false;
    fn real(value: f64) -> Self {
        Complex64::new(value, 0.0)
    }
    fn of_complex(value: Complex64) -> Self {
        value
    }
    /// Without angles, which take most of the time of [`Complex64::sqrt`].
    fn root(self) -> Self {
        let (a, b) = (self.re.abs(), self.im);
        let larger = (0.5 * (a + (a * a + b * b).sqrt())).sqrt();
        if larger == 0.0 {
            return Complex64::new(0.0, b);
        }
        let smaller = 0.5 * b / larger;
        if self.re >= 0.0 {
            Complex64::new(larger, smaller)
        } else {
            Complex64::new(smaller.abs(), larger.copysign(b))
        }
    }
    fn power(self, exponent: f64) -> Self {
        match exponent as i32 {
            whole if f64::from(whole) == exponent => self.powi(whole),
            _ => self.powf(exponent),
        }
    }
    fn re(self) -> f64 {
        self.re
    }
    fn size(self) -> f64 {
        self.norm_sqr().sqrt()
    }
    fn complex(self) -> Complex64 {
        self
    }
    fn scale(self, z: Complex64) -> Complex64 {
        z * self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a formula over scalars gives, and its size and parts.
    fn found<T: Scalar>(x: f64) -> [f64; 3] {
        let value = (T::real(x) * 3.0 - 1.0).root() / (T::real(x) + 2.0);
        let scaled = T::real(x).scale(Complex64::new(1.0, 2.0));
        [value.re(), value.size(), scaled.im]
    }

    #[test]
    fn both_fields_agree_on_real_numbers() {
        let (real, complex) = (found::<f64>(0.7), found::<Complex64>(0.7));
        for (r, c) in real.iter().zip(complex) {
            assert!((r - c).abs() < 1e-15, "{real:?} {complex:?}");
        }
        assert_eq!(real[2], 1.4);
    }

    #[test]
    fn the_root_is_the_principal_one() {
        for (re, im) in [(0.3, -2.0), (-1.7, 1e-9), (-0.2, -0.4), (5.0, 0.0), (1e-200, 1e-3)] {
            let z = Complex64::new(re, im);
            let (found, known) = (z.root(), z.sqrt());
            assert!((found - known).norm() < 4e-16 * known.norm(), "{z}: {found} {known}");
        }
        assert_eq!(Complex64::default().root(), Complex64::default());
        assert_eq!(Complex64::real(-4.0).root(), Complex64::new(0.0, 2.0));
        assert!(Complex64::new(-1.0, -1e-12).root().im < 0.0);
    }
}
