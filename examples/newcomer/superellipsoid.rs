//! A shape: the superellipsoid of revolution, `(ρ/a)^e + (|ζ|/c)^e = 1`.

use gonio::math::jet::Jet;
use gonio::math::scalar::Scalar;
use gonio::shape::Outline;

/// Half axes in any unit (the library scales by volume), and the exponent: 2 is the spheroid.
#[derive(Debug)]
pub struct Superellipsoid {
    pub horizontal: f64,
    pub vertical: f64,
    pub exponent: f64,
}

impl Outline for Superellipsoid {
    fn level<T: Scalar>(&self, q: Jet<T>, depth: Jet<T>) -> Jet<T> {
        // squares of the distances from the axis and from the equator, in half axes
        let height = depth * depth;
        let across = (q - height) / self.horizontal.powi(2);
        let along = height / self.vertical.powi(2);
        across.power(0.5 * self.exponent) + along.power(0.5 * self.exponent) - 1.0
    }
}
