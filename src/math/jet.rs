//! A function of two variables with its first and second derivatives, carried along by the arithmetic
//! (automatic differentiation forwards, to the second order).
//!
//! A shape of one's own is one formula this way: [`crate::shape::Outline`] writes it in jets, and normals
//! and curvatures follow without a derivative worked out by hand, for real and for complex rays.
//!
//! ```
//! use gonio::math::jet::Jet;
//!
//! let (x, y) = (Jet::first(3.0), Jet::second(2.0));
//! let f = x * x * y + 1.0; // at (3, 2)
//! assert_eq!((f.value, f.x, f.y), (19.0, 12.0, 9.0));
//! assert_eq!((f.xx, f.xy, f.yy), (4.0, 6.0, 0.0));
//! ```

use super::scalar::Scalar;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A value with its derivatives with respect to the first variable (`x`) and the second (`y`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet<T> {
    /// The value.
    pub value: T,
    /// ∂/∂x
    pub x: T,
    /// ∂/∂y
    pub y: T,
    /// ∂²/∂x²
    pub xx: T,
    /// ∂²/∂x∂y
    pub xy: T,
    /// ∂²/∂y²
    pub yy: T,
}

/// Bases of broken powers count as this where they are nearer to zero or, being real, below it: what
/// rounding leaves of a square must not make a derivative infinite.
const SMALLEST_BASE: f64 = 1e-24;

impl<T: Scalar> Jet<T> {
    /// A number that depends on neither variable.
    pub fn constant(value: T) -> Self {
        let zero = T::default();
        Self { value, x: zero, y: zero, xx: zero, xy: zero, yy: zero }
    }

    /// The first variable itself, at a value.
    pub fn first(value: T) -> Self {
        Self { x: T::real(1.0), ..Self::constant(value) }
    }

    /// The second variable itself, at a value.
    pub fn second(value: T) -> Self {
        Self { y: T::real(1.0), ..Self::constant(value) }
    }

    /// `g(self)`, from the value of `g` and its two derivatives there: for functions that are not here.
    #[must_use]
    pub fn through(self, g: T, slope: T, bend: T) -> Self {
        Self {
            value: g,
            x: slope * self.x,
            y: slope * self.y,
            xx: slope * self.xx + bend * self.x * self.x,
            xy: slope * self.xy + bend * self.x * self.y,
            yy: slope * self.yy + bend * self.y * self.y,
        }
    }

    /// The power with any real exponent, on the principal branch. Whole exponents take any base; for
    /// broken ones a base that is zero, or real and negative, counts as 1e-24.
    ///
    /// ```
    /// use gonio::math::jet::Jet;
    /// let root = Jet::first(4.0).power(0.5);
    /// assert_eq!((root.value, root.x, root.xx), (2.0, 0.25, -1.0 / 32.0));
    /// ```
    #[must_use]
    pub fn power(self, exponent: f64) -> Self {
        let whole = exponent.fract() == 0.0;
        let tiny = if T::REAL { self.value.re() } else { self.value.size() } < SMALLEST_BASE;
        let base = if tiny && !whole { T::real(SMALLEST_BASE) } else { self.value };
        // a factor of zero before a power of zero that is infinite
        let term = |factor: f64, n: f64| {
            if factor == 0.0 { T::default() } else { base.power(n) * factor }
        };
        self.through(
            base.power(exponent),
            term(exponent, exponent - 1.0),
            term(exponent * (exponent - 1.0), exponent - 2.0),
        )
    }

    /// The square root, on the principal branch.
    #[must_use]
    pub fn root(self) -> Self {
        self.power(0.5)
    }
}

impl<T: Scalar> Add for Jet<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            x: self.x + other.x,
            y: self.y + other.y,
            xx: self.xx + other.xx,
            xy: self.xy + other.xy,
            yy: self.yy + other.yy,
        }
    }
}

impl<T: Scalar> Neg for Jet<T> {
    type Output = Self;
    fn neg(self) -> Self {
        self * -1.0
    }
}

impl<T: Scalar> Sub for Jet<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<T: Scalar> Mul for Jet<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self, other);
        Self {
            value: a.value * b.value,
            x: a.x * b.value + a.value * b.x,
            y: a.y * b.value + a.value * b.y,
            xx: a.xx * b.value + a.x * b.x * 2.0 + a.value * b.xx,
            xy: a.xy * b.value + a.x * b.y + a.y * b.x + a.value * b.xy,
            yy: a.yy * b.value + a.y * b.y * 2.0 + a.value * b.yy,
        }
    }
}

impl<T: Scalar> Div for Jet<T> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self * other.power(-1.0)
    }
}

impl<T: Scalar> Add<f64> for Jet<T> {
    type Output = Self;
    fn add(self, number: f64) -> Self {
        Self { value: self.value + number, ..self }
    }
}

impl<T: Scalar> Sub<f64> for Jet<T> {
    type Output = Self;
    fn sub(self, number: f64) -> Self {
        Self { value: self.value - number, ..self }
    }
}

impl<T: Scalar> Mul<f64> for Jet<T> {
    type Output = Self;
    fn mul(self, number: f64) -> Self {
        Self {
            value: self.value * number,
            x: self.x * number,
            y: self.y * number,
            xx: self.xx * number,
            xy: self.xy * number,
            yy: self.yy * number,
        }
    }
}

impl<T: Scalar> Div<f64> for Jet<T> {
    type Output = Self;
    fn div(self, number: f64) -> Self {
        self * (1.0 / number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_complex::Complex64;

    /// Every operation against differences of its own values, on the real line and off it.
    #[test]
    fn derivatives_are_those_of_differences() {
        fn f<T: Scalar>(x: Jet<T>, y: Jet<T>) -> Jet<T> {
            let a = (x * y + 2.0).power(1.7) / (y * 3.0 - 0.5);
            -(a.root() - x / 4.0) * (x - y).power(-3.0)
        }
        let i = Complex64::new(0.0, 0.3);
        let (x, y) = (i + 2.1, i * 0.5 + 0.8);
        let h = 1e-4;
        let at = |dx: f64, dy: f64| f(Jet::first(x + dx * h), Jet::second(y + dy * h)).value;
        let exact = f(Jet::first(x), Jet::second(y));
        let cross = at(1.0, 1.0) - at(1.0, -1.0) - at(-1.0, 1.0) + at(-1.0, -1.0);
        let twice = exact.value * 2.0;
        for (found, wanted) in [
            (exact.x, (at(1.0, 0.0) - at(-1.0, 0.0)) / (2.0 * h)),
            (exact.y, (at(0.0, 1.0) - at(0.0, -1.0)) / (2.0 * h)),
            (exact.xx, (at(1.0, 0.0) + at(-1.0, 0.0) - twice) / (h * h)),
            (exact.yy, (at(0.0, 1.0) + at(0.0, -1.0) - twice) / (h * h)),
            (exact.xy, cross / (4.0 * h * h)),
        ] {
            assert!((found - wanted).norm() < 2e-6 * wanted.norm(), "{found} {wanted}");
        }
        let real = f(Jet::first(2.1), Jet::second(0.8));
        let on_axis = f(Jet::first(Complex64::from(2.1)), Jet::second(Complex64::from(0.8)));
        assert!((on_axis.xy - real.xy).norm() < 1e-12 * real.xy.abs());
    }

    /// Whole powers of zero, and broken ones of what rounding leaves of zero, are finite.
    #[test]
    fn powers_at_zero_are_finite() {
        let square = Jet::first(0.0).power(2.0);
        assert_eq!((square.value, square.x, square.xx), (0.0, 0.0, 2.0));
        let line = Jet::first(0.0).power(1.0);
        assert_eq!((line.value, line.x, line.xx), (0.0, 1.0, 0.0));
        let broken = Jet::first(-1e-17).power(1.25);
        assert!(broken.xx.is_finite() && broken.value < 1e-29);
    }
}
