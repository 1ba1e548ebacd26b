//! How many waves, and by which method: decided by what T itself says about its error.
//!
//! Reciprocity makes T symmetric, and nothing in either method enforces that: the relative norm of
//! its odd part is a meter of its error that needs no second computation. Degrees are raised until one
//! order's asymmetry meets the aim, or no longer falls; then all orders are computed with that many.

use super::range::{AIM, MOST_DEGREES, STALLED};
use super::surface::Surface;
use super::waves::{NodeWaves, on_surface};
use super::{OrderBlock, Solver, TMatrix, TMatrixError, least_squares, null_field};
use crate::shape::Shape;
use num_complex::Complex64;
use rayon::prelude::*;

/// What is solved for.
pub(super) struct Problem<'a> {
    pub surface: Surface<'a>,
    pub size_parameter: f64,
    pub index: Complex64,
    /// Largest size parameter: that of the sphere about the body.
    reach: f64,
}

impl<'a> Problem<'a> {
    pub(super) fn new(
        shape: &'a Shape,
        size_parameter: f64,
        index: Complex64,
    ) -> Result<Self, TMatrixError> {
        let surface = Surface::new(shape)?;
        let (_, farthest) = surface.limits()?;
        Ok(Self { surface, size_parameter, index, reach: size_parameter * farthest })
    }

    /// Degrees that a sphere about the body would need.
    pub(super) fn first_top(&self) -> usize {
        (self.reach + 4.05 * self.reach.cbrt() + 2.0).ceil() as usize
    }

    fn waves(&self, top: usize, nodes: usize) -> Result<Vec<NodeWaves>, TMatrixError> {
        let nodes = self.surface.nodes(nodes)?;
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
        let waves = self.waves(top, solver.nodes(top))?;
        let (norm, odd) = self.block(solver, &waves, 1, top).norm_and_oddness();
        let asymmetry = (odd / norm).sqrt();
        Ok(if asymmetry.is_finite() { asymmetry } else { f64::INFINITY })
    }

    /// The number of degrees with which order 1 is best, and its asymmetry there.
    pub(super) fn best_top(&self, solver: Solver) -> Result<(usize, f64), TMatrixError> {
        let first = self.first_top();
        let step = (first / 16).max(2);
        let most = solver.most_degrees().min(MOST_DEGREES);
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
    pub(super) fn all_orders(&self, solver: Solver, top: usize) -> Result<TMatrix, TMatrixError> {
        const NOTHING: f64 = 1e-32;
        let waves = self.waves(top, solver.nodes(top))?;
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

impl Solver {
    /// Gauss nodes for a number of degrees.
    fn nodes(self, top: usize) -> usize {
        match self {
            Self::NullField => 2 * top,
            Self::LeastSquares => 2 * top,
        }
    }

    fn most_degrees(self) -> usize {
        match self {
            Self::NullField => MOST_DEGREES,
            Self::LeastSquares => 140,
        }
    }
}
