//! Chebyshev interpolation of smooth functions on an interval, several channels at once.

use std::f64::consts::PI;

/// Points of the first kind on `[from, to]`, ascending.
pub fn points(count: usize, from: f64, to: f64) -> Vec<f64> {
    (0..count)
        .map(|k| {
            let x = -((k as f64 + 0.5) * PI / count as f64).cos();
            0.5 * (from + to) + 0.5 * (to - from) * x
        })
        .collect()
}

/// A vector-valued polynomial in Chebyshev form.
#[derive(Clone, Debug, PartialEq)]
pub struct Chebyshev<const C: usize> {
    from: f64,
    to: f64,
    coefficients: Vec<[f64; C]>,
}

impl<const C: usize> Chebyshev<C> {
    /// Interpolate values given at [`points`].
    pub fn fit(values: &[[f64; C]], from: f64, to: f64) -> Self {
        let count = values.len();
        let mut coefficients = vec![[0.0; C]; count];
        for (k, value) in values.iter().enumerate() {
            // points ascend, so that x_k = cos(π - (k+½)π/count)
            let x = (PI - (k as f64 + 0.5) * PI / count as f64).cos();
            // T_n(x) by recurrence, twice but for the first
            let (mut before, mut here, mut twice) = (x, 1.0, 1.0);
            for row in &mut coefficients {
                for c in 0..C {
                    row[c] += twice * here * value[c] / count as f64;
                }
                (before, here, twice) = (here, 2.0 * x * here - before, 2.0);
            }
        }
        Self { from, to, coefficients }
    }

    /// What the polynomials `T_n` of the place from -1 to 1 are multiplied with.
    pub(crate) fn coefficients(&self) -> &[[f64; C]] {
        &self.coefficients
    }

    /// Values and derivatives at `x`.
    pub fn at(&self, x: f64) -> ([f64; C], [f64; C]) {
        let half = 0.5 * (self.to - self.from);
        let t = (x - 0.5 * (self.from + self.to)) / half;
        // T_n and U_{n-1} by recurrence; T_n' = n U_{n-1}
        let (mut t0, mut t1, mut u0, mut u1) = (1.0, t, 0.0, 1.0);
        let (mut value, mut slope) = ([0.0; C], [0.0; C]);
        for (n, row) in self.coefficients.iter().enumerate() {
            for c in 0..C {
                value[c] += row[c] * t0;
                slope[c] += row[c] * (n as f64 * u0) / half;
            }
            (t0, t1) = (t1, 2.0 * t * t1 - t0);
            (u0, u1) = (u1, 2.0 * t * u1 - u0);
        }
        (value, slope)
    }

    /// Values alone, by Clenshaw's recurrence.
    pub fn value(&self, x: f64) -> [f64; C] {
        let t = (2.0 * x - (self.from + self.to)) / (self.to - self.from);
        let (mut b1, mut b2) = ([0.0; C], [0.0; C]);
        for row in self.coefficients.iter().skip(1).rev() {
            for c in 0..C {
                (b1[c], b2[c]) = (row[c] + 2.0 * t * b1[c] - b2[c], b1[c]);
            }
        }
        let first = self.coefficients.first().copied().unwrap_or([0.0; C]);
        std::array::from_fn(|c| first[c] + t * b1[c] - b2[c])
    }

    /// Without the last terms that are nothing but rounding.
    pub fn rounded(mut self) -> Self {
        const ROUNDING: f64 = 1e-15;
        let size = |row: &[f64; C]| row.iter().fold(0.0, |size: f64, c| size.max(c.abs()));
        let largest = self.coefficients.iter().map(size).fold(0.0, f64::max);
        while self.coefficients.last().is_some_and(|row| size(row) < ROUNDING * largest) {
            self.coefficients.pop();
        }
        self
    }

    /// The terms up to this degree: the polynomial nearest in the least-squares sense, which
    /// extrapolates without taking up what in the values is not smooth.
    pub fn truncated(mut self, degree: usize) -> Self {
        self.coefficients.truncate(degree + 1);
        self
    }
}

impl<const C: usize> std::ops::Add for Chebyshev<C> {
    type Output = Self;

    /// The sum of two polynomials on the same interval.
    fn add(self, other: Self) -> Self {
        debug_assert!(self.from == other.from && self.to == other.to);
        let (mut long, short) = if self.coefficients.len() < other.coefficients.len() {
            (other, self)
        } else {
            (self, other)
        };
        for (sum, term) in long.coefficients.iter_mut().zip(short.coefficients) {
            for (sum, term) in sum.iter_mut().zip(term) {
                *sum += term;
            }
        }
        long
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_add_whatever_their_degrees() {
        let fit = |f: fn(f64) -> f64, count| {
            let values: Vec<[f64; 1]> = points(count, -1.0, 2.0).iter().map(|&x| [f(x)]).collect();
            Chebyshev::fit(&values, -1.0, 2.0)
        };
        let (square, line) = (fit(|x| x * x, 5), fit(|x| 1.0 + 3.0 * x, 2));
        for sum in [square.clone() + line.clone(), line + square] {
            assert!((sum.at(1.5).0[0] - 7.75).abs() < 1e-14);
            assert!((sum.at(3.0).1[0] - 9.0).abs() < 1e-13, "the slope too");
        }
    }

    #[test]
    fn an_analytic_function_is_met_with_its_slope() {
        let values: Vec<[f64; 1]> = points(24, -1.0, 3.0).iter().map(|x| [x.exp()]).collect();
        let series = Chebyshev::fit(&values, -1.0, 3.0);
        for x in [-1.0, 0.3, 2.9] {
            let ([value], [slope]) = series.at(x);
            assert!((value - x.exp()).abs() < 1e-13 * 20.0 && (slope - x.exp()).abs() < 1e-11);
            assert!((series.value(x)[0] - value).abs() < 1e-13 * 20.0, "{x}");
            assert!((series.clone().rounded().value(x)[0] - value).abs() < 1e-12, "{x}");
        }
    }
}
