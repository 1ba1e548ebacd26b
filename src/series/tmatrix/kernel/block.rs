//! T of one azimuthal order, and which of its waves couple.

use faer::{Mat, MatRef};
use num_complex::Complex64;

/// Degrees n that couple as magnetic waves, and those that couple to them as electric ones.
pub(in crate::series::tmatrix) struct System {
    pub magnetic: Vec<usize>,
    pub electric: Vec<usize>,
}

/// The systems of one order.
pub(in crate::series::tmatrix) fn systems(m: usize, top: usize, mirror: bool) -> Vec<System> {
    let all: Vec<usize> = (m.max(1)..=top).collect();
    if !mirror {
        return vec![System { magnetic: all.clone(), electric: all }];
    }
    let (even, odd): (Vec<usize>, Vec<usize>) = all.into_iter().partition(|n| n % 2 == 0);
    vec![
        System { magnetic: even.clone(), electric: odd.clone() },
        System { magnetic: odd, electric: even },
    ]
}

/// T of one order `m ≥ 0`: magnetic waves of degrees `max(m, 1)` to `top`, then electric ones turned
/// by i (times the sign of m), so that a block is symmetric and serves both signs of m.
#[derive(Clone, Debug)]
pub(in crate::series::tmatrix) struct OrderBlock {
    pub m: usize,
    pub top: usize,
    pub t: Mat<Complex64>,
}

impl OrderBlock {
    pub(in crate::series::tmatrix) fn zero(m: usize, top: usize) -> Self {
        let size = 2 * (top + 1).saturating_sub(m.max(1));
        Self { m, top, t: Mat::zeros(size, size) }
    }

    pub(in crate::series::tmatrix) fn first(&self) -> usize {
        self.m.max(1)
    }

    pub(in crate::series::tmatrix) fn degrees(&self) -> usize {
        self.t.nrows() / 2
    }

    /// Put the part that one system of coupled waves makes.
    pub(in crate::series::tmatrix) fn put(&mut self, system: &System, t: MatRef<'_, Complex64>) {
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
    pub(in crate::series::tmatrix) fn norm_and_oddness(&self) -> (f64, f64) {
        let (mut norm, mut odd) = (0.0, 0.0);
        for k in 0..self.t.ncols() {
            for i in 0..self.t.nrows() {
                norm += self.t[(i, k)].norm_sqr();
                odd += (self.t[(i, k)] - self.t[(k, i)]).norm_sqr();
            }
        }
        (norm, odd)
    }

    /// Squared norm of the difference to a block of the same order with at least as many degrees.
    pub(in crate::series::tmatrix) fn squared_distance(&self, finer: &Self) -> f64 {
        let (own, all) = (self.degrees(), finer.degrees());
        let here = |i: usize| {
            let (electric, degree) = (i / all, i % all);
            (degree < own).then_some(electric * own + degree)
        };
        let mut sum = 0.0;
        for k in 0..2 * all {
            for i in 0..2 * all {
                let known = match (here(i), here(k)) {
                    (Some(i), Some(k)) => self.t[(i, k)],
                    _ => Complex64::ZERO,
                };
                sum += (finer.t[(i, k)] - known).norm_sqr();
            }
        }
        sum
    }

    pub(in crate::series::tmatrix) fn symmetrise(&mut self) {
        for k in 0..self.t.ncols() {
            for i in 0..k {
                let mean = 0.5 * (self.t[(i, k)] + self.t[(k, i)]);
                (self.t[(i, k)], self.t[(k, i)]) = (mean, mean);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Waves that one block has and the other has not count whole; equal ones do not count, wherever they stand.
    #[test]
    fn distances_are_between_equal_waves() {
        let fill = |top: usize| {
            let mut block = OrderBlock::zero(1, top);
            let degrees = block.degrees();
            for k in 0..2 * degrees {
                for i in 0..2 * degrees {
                    let place = |i: usize| 100 * (i / degrees) + i % degrees;
                    block.t[(i, k)] = Complex64::new(place(i) as f64, place(k) as f64);
                }
            }
            block
        };
        let (coarse, fine) = (fill(3), fill(4));
        assert_eq!(fine.squared_distance(&fine), 0.0);
        let rest = fine.norm_and_oddness().0 - coarse.norm_and_oddness().0;
        assert!((coarse.squared_distance(&fine) - rest).abs() < 1e-9 * rest);
    }
}
