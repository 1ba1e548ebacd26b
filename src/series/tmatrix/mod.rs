//! T-matrices: exact scattering by bodies of revolution (spheroids, raindrops) up to some hundred
//! wavelengths around, where ray pictures end.
//!
//! The T-matrix takes the regular spherical waves of any incident light to the outgoing ones of what
//! is scattered (Waterman 1971; Mishchenko, Travis & Lacis 2002). It belongs to the body, so that one
//! serves all directions and orientations. [`TMatrix::new`] finds it by the null-field method, by least
//! squares on the surface where that stalls, and refuses where both do; [`TMatrix::error`] says how
//! well it is known.
//!
//! ```
//! use gonio::series::tmatrix::{Scattered, TMatrix};
//! use gonio::shape::Shape;
//! use num_complex::Complex64;
//!
//! let shape = Shape::spheroid(0.8, 0.0)?;
//! let t = TMatrix::new(&shape, 3.0, Complex64::new(1.333, 0.0), 1e-6)?;
//! let q = Scattered::new(&t, 0.0).efficiencies();
//! assert!((q.q_ext - q.q_sca).abs() < 1e-9, "nothing is absorbed");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod far_field;
mod least_squares;
mod null_field;
pub mod range;
mod rotation;
mod solve;
mod surface;
mod waves;

pub use far_field::{FixedEfficiencies, Scattered};

use crate::shape::Shape;
use faer::{Mat, MatRef};
use null_field::System;
use num_complex::Complex64;
use solve::Problem;

/// Why there is no T-matrix.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TMatrixError {
    #[error(
        "the body is not star-shaped: a ray at {angle_deg:.1}° from its axis meets the surface more \
         than once"
    )]
    NotStarShaped { angle_deg: f64 },
    #[error("size parameter = {0}: the T-matrix accepts finite numbers of at least {LEAST_SIZE}")]
    Size(f64),
    #[error(
        "size parameter {size_parameter}: its T-matrix needs {degrees} degrees, at most {} are accepted \
         (minutes of time, gigabytes of memory); rays serve such particles",
        range::MOST_DEGREES
    )]
    TooLarge { size_parameter: f64, degrees: usize },
    #[error(
        "size parameter {size_parameter}: the T-matrix of this body does not converge to tolerance \
         {tolerance:e}; the best reached has error {reached:.1e} with {degrees} degrees"
    )]
    NotConverged { size_parameter: f64, tolerance: f64, reached: f64, degrees: usize },
    #[error("size parameter {size_parameter}: the T-matrix of this body overflows")]
    Diverged { size_parameter: f64 },
}

/// Smallest size parameter: below, squares of the radial functions leave the range of f64.
pub const LEAST_SIZE: f64 = 1e-6;

/// How T was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    NullField,
    LeastSquares,
}

/// The T-matrix of a body of revolution.
#[derive(Clone, Debug)]
pub struct TMatrix {
    /// By order m ≥ 0; those beyond are nothing.
    blocks: Vec<OrderBlock>,
    top: usize,
    size_parameter: f64,
    index: Complex64,
    /// Height of the waves' origin above the body's centre, in radii.
    origin: f64,
    solver: Solver,
    degrees: usize,
    asymmetry: f64,
}

impl TMatrix {
    /// For a body with a size parameter `2πa/λ` (a: sphere of equal volume, λ: in the medium around)
    /// and an index relative to that medium. `tolerance` is the relative error accepted; what is
    /// reached is mostly far better.
    ///
    /// # Errors
    /// A size or shape that is not served, or a tolerance that is not met.
    pub fn new(
        shape: &Shape,
        size_parameter: f64,
        index: Complex64,
        tolerance: f64,
    ) -> Result<Self, TMatrixError> {
        if !(size_parameter >= LEAST_SIZE && size_parameter.is_finite()) {
            return Err(TMatrixError::Size(size_parameter));
        }
        let problem = Problem::new(shape, size_parameter, index)?;
        let degrees = problem.first_top();
        if degrees > range::MOST_DEGREES {
            return Err(TMatrixError::TooLarge { size_parameter, degrees });
        }
        let (top, asymmetry) = problem.best_top(Solver::NullField)?;
        let mut choice = (Solver::NullField, top, asymmetry);
        if asymmetry > tolerance * range::MARGIN {
            let (top, fitted) = problem.best_top(Solver::LeastSquares)?;
            if fitted < asymmetry {
                choice = (Solver::LeastSquares, top, fitted);
            }
        }
        let (solver, top, expected) = choice;
        let refuse = |asymmetry: f64| TMatrixError::NotConverged {
            size_parameter,
            tolerance,
            reached: asymmetry / range::MARGIN,
            degrees: top,
        };
        if expected > tolerance {
            return Err(refuse(expected));
        }
        let found = problem.all_orders(solver, top)?;
        if found.error() > tolerance { Err(refuse(found.asymmetry)) } else { Ok(found) }
    }

    /// Estimated relative error (root mean square over directions) of amplitudes.
    pub fn error(&self) -> f64 {
        self.asymmetry.max(range::ROUNDING)
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

    /// k times the height of the waves' origin.
    fn shift(&self) -> f64 {
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

/// T of one order `m ≥ 0`: magnetic waves of degrees `max(m, 1)` to `top`, then electric ones turned
/// by i (times the sign of m), so that a block is symmetric and serves both signs of m.
#[derive(Clone, Debug)]
struct OrderBlock {
    m: usize,
    top: usize,
    t: Mat<Complex64>,
}

impl OrderBlock {
    fn zero(m: usize, top: usize) -> Self {
        let size = 2 * (top + 1).saturating_sub(m.max(1));
        Self { m, top, t: Mat::zeros(size, size) }
    }

    fn first(&self) -> usize {
        self.m.max(1)
    }

    fn degrees(&self) -> usize {
        self.t.nrows() / 2
    }

    /// Put the part that one system of coupled waves makes.
    fn put(&mut self, system: &System, t: MatRef<'_, Complex64>) {
        let (first, degrees) = (self.first(), self.degrees());
        let magnetic = system.magnetic.iter().map(|n| n - first);
        let place: Vec<usize> =
            magnetic.chain(system.electric.iter().map(|n| n - first + degrees)).collect();
        for (k, &to_column) in place.iter().enumerate() {
            for (i, &to_row) in place.iter().enumerate() {
                self.t[(to_row, to_column)] = t[(i, k)];
            }
        }
    }

    /// Squared norms of T and of `T - Tᵀ`.
    fn norm_and_oddness(&self) -> (f64, f64) {
        let (mut norm, mut odd) = (0.0, 0.0);
        for k in 0..self.t.ncols() {
            for i in 0..self.t.nrows() {
                norm += self.t[(i, k)].norm_sqr();
                odd += (self.t[(i, k)] - self.t[(k, i)]).norm_sqr();
            }
        }
        (norm, odd)
    }

    fn symmetrise(&mut self) {
        for k in 0..self.t.ncols() {
            for i in 0..k {
                let mean = 0.5 * (self.t[(i, k)] + self.t[(k, i)]);
                (self.t[(i, k)], self.t[(k, i)]) = (mean, mean);
            }
        }
    }
}

#[doc(hidden)]
pub fn trial(shape: &Shape, x: f64, index: Complex64, top: usize, g: usize, only: usize, lsq: bool) -> (f64, f64, f64) {
    let mut p = Problem::new(shape, x, index).unwrap();
    if let Ok(o) = std::env::var("ORIGIN") { p.surface.origin = o.parse().unwrap(); }
    let nodes = p.surface.nodes(g).unwrap();
    let w = waves::on_surface(&nodes, x, index, top);
    let b = if lsq { least_squares::order_block(&w, index, only, (top, p.first_top()), p.surface.mirror) } else { null_field::order_block(&w, index, only, top, p.surface.mirror) };
    let (n, o) = b.norm_and_oddness();
    (n, (o / n).sqrt(), p.surface.origin)
}
