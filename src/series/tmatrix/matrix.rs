//! The T-matrix of a body: blocks by order, and what is known about it without any direction.

use super::kernel::block::OrderBlock;
use super::kernel::range::{self, Solver};
use num_complex::Complex64;

/// The T-matrix of a body of revolution.
#[derive(Clone, Debug)]
pub struct TMatrix {
    /// By order m ≥ 0; those beyond are nothing.
    pub(super) blocks: Vec<OrderBlock>,
    pub(super) top: usize,
    pub(super) size_parameter: f64,
    pub(super) index: Complex64,
    /// Height of the waves' origin above the body's centre, in radii.
    pub(super) origin: f64,
    /// Whether the body is its own mirror image in the plane through its centre.
    pub(super) mirror: bool,
    pub(super) solver: Solver,
    pub(super) degrees: usize,
    pub(super) asymmetry: f64,
    /// Error by what the last degrees have changed, where that was tried.
    pub(super) drift: f64,
}

impl TMatrix {
    /// Estimated error of amplitudes, root mean square over all directions, relative to their own.
    pub fn error(&self) -> f64 {
        range::error_of(self.asymmetry, self.degrees).max(self.drift)
    }

    /// Relative norm of what reciprocity says should vanish.
    pub fn asymmetry(&self) -> f64 {
        self.asymmetry
    }

    /// The method that found it, and the highest degree it used.
    pub fn solver(&self) -> (Solver, usize) {
        (self.solver, self.degrees)
    }

    /// The size parameter it belongs to.
    pub fn size_parameter(&self) -> f64 {
        self.size_parameter
    }

    /// Index relative to the medium around.
    pub fn index(&self) -> Complex64 {
        self.index
    }

    /// Relative norm of the difference to a T of more degrees.
    pub(super) fn distance(&self, finer: &Self) -> f64 {
        let weight = |m: usize| if m == 0 { 1.0 } else { 2.0 };
        let (mut norm, mut distance) = (0.0, 0.0);
        for (m, block) in finer.blocks.iter().enumerate() {
            let square = block.norm_and_oddness().0;
            norm += weight(m) * square;
            let known = self.blocks.get(m).map(|own| own.squared_distance(block));
            distance += weight(m) * known.unwrap_or(square);
        }
        (distance / norm).sqrt()
    }

    /// k times the height of the waves' origin.
    pub(super) fn shift(&self) -> f64 {
        self.size_parameter * self.origin
    }

    /// Extinction and scattering efficiency averaged over random orientation: traces of T
    /// (Mishchenko, Travis & Lacis 2002, eqs. 5.107 and 5.141).
    pub fn random_efficiencies(&self) -> (f64, f64) {
        let scale = 2.0 / (self.size_parameter * self.size_parameter);
        let (mut extinction, mut scattering) = (0.0, 0.0);
        for block in &self.blocks {
            let weight = if block.m == 0 { scale } else { 2.0 * scale };
            let trace: f64 = (0..block.t.nrows()).map(|i| block.t[(i, i)].re).sum();
            extinction -= weight * trace;
            scattering += weight * block.norm_and_oddness().0;
        }
        (extinction, scattering)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;

    /// A T of a few more degrees is as far away as it says; itself it is not away from.
    #[test]
    fn distances_are_about_the_stated_errors() {
        let shape = Shape::spheroid(0.7, 0.0).unwrap();
        let of = |tolerance| TMatrix::new(&shape, 6.0, Complex64::from(1.4), tolerance).unwrap();
        let (rough, fine) = (of(1e-2), of(1e-9));
        assert_eq!(fine.distance(&fine), 0.0);
        let distance = rough.distance(&fine);
        assert!((0.1..10.0).contains(&(rough.error() / distance)), "{} {distance}", rough.error());
    }
}
