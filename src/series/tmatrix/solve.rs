//! How many waves, and by which method: decided by what T itself says about its error.
//!
//! Reciprocity makes T symmetric, and nothing in either method enforces that: the relative norm of
//! its odd part is a meter of its error that needs no second computation. Degrees are raised until one
//! order's asymmetry meets the aim, or no longer falls; then all orders are computed with that many.

use super::block::OrderBlock;
use super::error::TMatrixError;
use super::matrix::{Solver, TMatrix};
use super::range::{self, AIM, Expectation, LEAST_SIZE, MOST_DEGREES, MOST_FITTED, STALLED};
use super::surface::Surface;
use super::waves::{NodeWaves, on_surface};
use super::{least_squares, null_field};
use crate::shape::Shape;
use num_complex::Complex64;
use rayon::prelude::*;

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
            reached: asymmetry,
            degrees: top,
        };
        if expected > tolerance {
            return Err(refuse(expected));
        }
        let found = problem.all_orders(solver, top)?;
        if found.error() > tolerance { Err(refuse(found.asymmetry)) } else { Ok(found) }
    }
}

/// What the T-matrix of a body would cost, and whether it would converge.
///
/// # Errors
/// A body that is not star-shaped.
pub fn expectation(shape: &Shape, size_parameter: f64) -> Result<Expectation, TMatrixError> {
    let surface = Surface::new(shape)?;
    Ok(range::of_spread(size_parameter, surface.limits()?, surface.mirror))
}

/// What is solved for.
struct Problem<'a> {
    surface: Surface<'a>,
    size_parameter: f64,
    index: Complex64,
    /// Smallest and largest distance of the surface from the origin.
    limits: (f64, f64),
}

impl<'a> Problem<'a> {
    fn new(shape: &'a Shape, size_parameter: f64, index: Complex64) -> Result<Self, TMatrixError> {
        let surface = Surface::new(shape)?;
        let limits = surface.limits()?;
        Ok(Self { surface, size_parameter, index, limits })
    }

    /// Degrees that a sphere about the body would need.
    fn first_top(&self) -> usize {
        let reach = self.size_parameter * self.limits.1;
        (reach + 4.05 * reach.cbrt() + 2.0).ceil() as usize
    }

    /// Waves at the nodes. Products of two waves of degree n need n + 1 nodes on a sphere; what the
    /// radial functions add grows with the spread of distances.
    fn waves(&self, top: usize) -> Result<Vec<NodeWaves>, TMatrixError> {
        let spread = self.limits.1 / self.limits.0;
        let share = (0.15 + spread).min(2.0);
        let nodes = self.surface.nodes((top as f64 * share).ceil() as usize + 8)?;
        Ok(on_surface(&nodes, self.size_parameter, self.index, top))
    }

    fn block(&self, solver: Solver, waves: &[NodeWaves], m: usize, top: usize) -> OrderBlock {
        let mirror = self.surface.mirror;
        match solver {
            Solver::NullField => null_field::order_block(waves, self.index, m, top, mirror),
            Solver::LeastSquares => {
                let kept = self.first_top().min(top);
                least_squares::order_block(waves, self.index, m, (top, kept), mirror)
            }
        }
    }

    /// Asymmetry of order 1 alone.
    fn trial(&self, solver: Solver, top: usize) -> Result<f64, TMatrixError> {
        let waves = self.waves(top)?;
        let (norm, odd) = self.block(solver, &waves, 1, top).norm_and_oddness();
        let asymmetry = (odd / norm).sqrt();
        Ok(if asymmetry.is_finite() { asymmetry } else { f64::INFINITY })
    }

    /// The number of degrees with which order 1 is best, and its asymmetry there.
    fn best_top(&self, solver: Solver) -> Result<(usize, f64), TMatrixError> {
        let first = self.first_top();
        let step = (first / 16).max(2);
        let most = match solver {
            Solver::NullField => MOST_DEGREES,
            Solver::LeastSquares => MOST_FITTED.max(first),
        };
        let (mut best, mut worse) = ((first, f64::INFINITY), 0);
        let mut top = first;
        while top <= most && worse < STALLED {
            let asymmetry = self.trial(solver, top)?;
            if asymmetry < best.1 {
                worse = if asymmetry < 0.7 * best.1 { 0 } else { worse + 1 };
                best = (top, asymmetry);
            } else {
                worse += 1;
            }
            if asymmetry <= AIM {
                break;
            }
            top += step;
        }
        Ok(best)
    }

    /// All orders, in batches, until those that follow are nothing.
    fn all_orders(&self, solver: Solver, top: usize) -> Result<TMatrix, TMatrixError> {
        const NOTHING: f64 = 1e-32;
        let waves = self.waves(top)?;
        let batch = 4 * rayon::current_num_threads();
        let (mut blocks, mut norm, mut odd) = (Vec::new(), 0.0, 0.0);
        while blocks.len() <= top {
            let orders = blocks.len()..(blocks.len() + batch).min(top + 1);
            let next: Vec<OrderBlock> =
                orders.into_par_iter().map(|m| self.block(solver, &waves, m, top)).collect();
            let mut last = 0.0;
            for block in next {
                let weight = if block.m == 0 { 1.0 } else { 2.0 };
                let (square, difference) = block.norm_and_oddness();
                (norm, odd, last) = (norm + weight * square, odd + weight * difference, square);
                blocks.push(block);
            }
            if last < NOTHING * norm {
                break;
            }
        }
        let asymmetry = (odd / norm).sqrt();
        if !asymmetry.is_finite() {
            return Err(TMatrixError::Diverged { size_parameter: self.size_parameter });
        }
        // The even part is nearer to the truth than the whole.
        blocks.par_iter_mut().for_each(OrderBlock::symmetrise);
        Ok(TMatrix {
            top: blocks.first().map_or(top, |block| block.top),
            blocks,
            size_parameter: self.size_parameter,
            index: self.index,
            origin: self.surface.origin,
            solver,
            degrees: top,
            asymmetry,
        })
    }
}
