//! How many waves, and by which method: decided by what T itself says about its error.
//!
//! Reciprocity makes T symmetric, and nothing in either method enforces that: the relative norm of
//! its odd part is a meter of its error that needs no second computation. Degrees are raised until one
//! order's asymmetry meets the aim, or no longer falls; then all orders are computed with that many.

use super::kernel::block::OrderBlock;
use super::kernel::error::TMatrixError;
use super::kernel::range::{
    self, DRIFT_STEP, Expectation, LEAST_SIZE, MOST_DEGREES, MOST_FITTED, RESONANCES_LOST, STALLED,
    Solver,
};
use super::kernel::surface::Surface;
use super::kernel::waves::{NodeWaves, on_surface};
use super::kernel::{least_squares, null_field};
use super::matrix::TMatrix;
use crate::cancel;
use crate::math::parallel::*;
use crate::shape::Shape;
use num_complex::Complex64;

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
        check_size(size_parameter)?;
        let problem = Problem::new(shape, size_parameter, index)?;
        let choice = problem.choose(tolerance, f64::INFINITY)?;
        let found = problem.all_orders(choice.solver, choice.degrees)?;
        let found =
            if range::asymmetry_is_silent(choice.degrees, index) && found.error() <= tolerance {
                problem.settled(found, tolerance)?
            } else {
                found
            };
        if found.error() > tolerance {
            return Err(problem.not_converged(tolerance, found.error(), found.degrees));
        }
        Ok(found)
    }
}

/// How a T-matrix would be found, by a trial of one order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outlook {
    /// By which method.
    pub solver: Solver,
    /// Highest degree of spherical waves.
    pub degrees: usize,
    /// Error of amplitudes to be expected, as [`TMatrix::error`] states it.
    pub error: f64,
    /// Seconds of one core for the whole.
    pub cpu_seconds: f64,
}

/// How the T-matrix of a body would be found to a tolerance, within so many seconds of one core: a trial of
/// one order, a hundredth of the whole.
///
/// # Errors
/// As [`TMatrix::new`]; and where all that converges would take longer.
pub fn outlook(
    shape: &Shape,
    size_parameter: f64,
    index: Complex64,
    tolerance: f64,
    seconds: f64,
) -> Result<Outlook, TMatrixError> {
    check_size(size_parameter)?;
    Problem::new(shape, size_parameter, index)?.choose(tolerance, seconds)
}

/// Whether a body of this size is served at all, before anything of it is computed.
///
/// # Errors
/// A size that is none, or too large.
pub fn check(shape: &Shape, size_parameter: f64) -> Result<(), TMatrixError> {
    check_size(size_parameter)?;
    let degrees = range::degrees(size_parameter * shape.bounding_radius().min(1.0));
    if degrees > MOST_DEGREES {
        return Err(TMatrixError::TooLarge { size_parameter, degrees });
    }
    Ok(())
}

/// Where there are none this is all that is ever asked: nothing of what solves them is linked.
fn check_size(size_parameter: f64) -> Result<(), TMatrixError> {
    if !cfg!(feature = "tmatrix") {
        return Err(TMatrixError::LeftOut);
    }
    if size_parameter >= LEAST_SIZE && size_parameter.is_finite() {
        return Ok(());
    }
    Err(TMatrixError::Size(size_parameter))
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
        if index == Complex64::from(1.0) {
            return Err(TMatrixError::NoContrast);
        }
        let surface = Surface::new(shape)?;
        let limits = surface.limits()?;
        Ok(Self { surface, size_parameter, index, limits })
    }

    /// The first method whose trial meets the tolerance within so many seconds; else why there is none.
    fn choose(&self, tolerance: f64, seconds: f64) -> Result<Outlook, TMatrixError> {
        let size_parameter = self.size_parameter;
        let degrees = self.first_top();
        if degrees > MOST_DEGREES {
            return Err(TMatrixError::TooLarge { size_parameter, degrees });
        }
        let mut best: Option<Outlook> = None;
        for solver in [Solver::NullField, Solver::LeastSquares] {
            let cost = |degrees| range::seconds(solver, degrees, self.surface.mirror, self.index);
            if cost(degrees) > seconds {
                continue;
            }
            let (degrees, asymmetry) = self.best_top(solver, range::aim(tolerance), seconds)?;
            let (error, cpu_seconds) = (range::error_of(asymmetry, degrees), cost(degrees));
            let found = Outlook { solver, degrees, error, cpu_seconds };
            if error <= tolerance {
                return Ok(found);
            }
            if best.is_none_or(|best| error < best.error) {
                best = Some(found);
            }
        }
        let (reached, degrees) = best.map_or((f64::INFINITY, degrees), |b| (b.error, b.degrees));
        Err(self.not_converged(tolerance, reached, degrees))
    }

    fn not_converged(&self, tolerance: f64, reached: f64, degrees: usize) -> TMatrixError {
        let size_parameter = self.size_parameter;
        TMatrixError::NotConverged { size_parameter, tolerance, reached, degrees }
    }

    /// Degrees that a sphere about the body would need.
    fn first_top(&self) -> usize {
        range::degrees(self.size_parameter * self.limits.1)
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
        cancel::checkpoint();
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

    /// The number of degrees with which order 1 meets the aim, or is best, and its asymmetry there.
    fn best_top(
        &self,
        solver: Solver,
        aim: f64,
        seconds: f64,
    ) -> Result<(usize, f64), TMatrixError> {
        let first = self.first_top();
        let step = (first / 16).max(2);
        let most = match solver {
            Solver::NullField => MOST_DEGREES,
            Solver::LeastSquares => MOST_FITTED,
        };
        let (mut best, mut worse) = ((first, f64::INFINITY), 0);
        let mut top = first;
        let affordable =
            |top| range::seconds(solver, top, self.surface.mirror, self.index) <= seconds;
        while top <= most && worse < STALLED && affordable(top) {
            let asymmetry = self.trial(solver, top)?;
            if asymmetry < best.1 {
                worse = if asymmetry < 0.7 * best.1 { 0 } else { worse + 1 };
                best = (top, asymmetry);
            } else {
                worse += 1;
            }
            if asymmetry <= aim {
                break;
            }
            top += step;
        }
        Ok(best)
    }

    /// T with as many degrees as change no more than the tolerance; else the best that was found.
    fn settled(&self, first: TMatrix, tolerance: f64) -> Result<TMatrix, TMatrixError> {
        let most = match first.solver {
            Solver::NullField => MOST_DEGREES,
            Solver::LeastSquares => MOST_FITTED,
        };
        let step = (self.first_top() / 16).max(2);
        let first = match first.degrees + DRIFT_STEP > most {
            true => self.all_orders(first.solver, most - DRIFT_STEP)?,
            false => first,
        };
        let (mut coarse, mut best, mut stalled) = (first, None::<TMatrix>, 0);
        while coarse.degrees + DRIFT_STEP <= most && stalled < STALLED {
            let mut finer = self.all_orders(coarse.solver, coarse.degrees + DRIFT_STEP)?;
            let change = coarse.distance(&finer);
            finer.drift = range::error_of_change(change, coarse.asymmetry, finer.asymmetry);
            if finer.error() <= tolerance && change <= RESONANCES_LOST {
                return Ok(finer);
            }
            let next = finer.degrees + step;
            match &best {
                Some(known) if known.error() <= finer.error() => stalled += 1,
                _ => (best, stalled) = (Some(finer), 0),
            }
            if next > most {
                break;
            }
            coarse = self.all_orders(coarse.solver, next)?;
        }
        Ok(best.unwrap_or(coarse))
    }

    /// All orders, in batches, until those that follow are nothing.
    fn all_orders(&self, solver: Solver, top: usize) -> Result<TMatrix, TMatrixError> {
        const NOTHING: f64 = 1e-32;
        let waves = self.waves(top)?;
        let batch = 4 * current_num_threads();
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
            mirror: self.surface.mirror,
            solver,
            degrees: top,
            asymmetry,
            drift: 0.0,
        })
    }
}
