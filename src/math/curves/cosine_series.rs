//! Even trigonometric polynomials `Σ c_k cos kθ`, several curves at once: from their values on an
//! even grid to their values anywhere.
//!
//! A polynomial of degree M is known from its values at `θ_j = πj/M`, j = 0 … M; its coefficients
//! are themselves a cosine sum over the values (the discrete cosine transform of type I), so that
//! one sum serves both ways. It runs over the angles in SIMD lanes; cos kθ is turned on by a
//! rotation and set anew now and then, so that rounding does not add up.

use crate::math::parallel::*;
use multiversion::multiversion;
use std::f64::consts::PI;

/// Angles carried together, and orders after which cos kθ is set anew.
const LANES: usize = 16;
const RESET: usize = 256;

/// `C` even trigonometric polynomials of one degree.
#[derive(Clone, Debug, Default)]
pub struct CosineSeries<const C: usize> {
    coefficients: Vec<[f64; C]>,
}

/// The grid of a degree (even, so that it is its own mirror image about π/2): 0 … π, radians.
pub fn points(degree: usize) -> Vec<f64> {
    let point = |j: usize| PI * j as f64 / degree as f64;
    (0..=degree).map(|j| if 2 * j > degree { PI - point(degree - j) } else { point(j) }).collect()
}

impl<const C: usize> CosineSeries<C> {
    /// The polynomials with these values at [`points`].
    pub fn fit(values: &[[f64; C]]) -> Self {
        let degree = values.len() - 1;
        let ends_halved = |mut rows: Vec<[f64; C]>| {
            for end in [0, degree] {
                rows[end] = rows[end].map(|value| 0.5 * value);
            }
            rows
        };
        let scaled = values.iter().map(|row| row.map(|v| v * 2.0 / degree as f64)).collect();
        Self { coefficients: ends_halved(sums(&ends_halved(scaled), &points(degree))) }
    }

    /// Add other polynomials, of whatever degree.
    pub fn add(&mut self, other: &Self) {
        if self.coefficients.len() < other.coefficients.len() {
            self.coefficients.resize(other.coefficients.len(), [0.0; C]);
        }
        let pairs = self.coefficients.iter_mut().flatten().zip(other.coefficients.iter().flatten());
        pairs.for_each(|(sum, value)| *sum += value);
    }

    /// Values at some angles, radians.
    pub fn at(&self, theta: &[f64]) -> Vec<[f64; C]> {
        sums(&self.coefficients, theta)
    }
}

/// `Σ_k rows[k] cos kθ`.
fn sums<const C: usize>(rows: &[[f64; C]], theta: &[f64]) -> Vec<[f64; C]> {
    let mut out = vec![[0.0; C]; theta.len()];
    out.par_chunks_mut(LANES).zip(theta.par_chunks(LANES)).for_each(|(out, theta)| {
        let mut total = [[0.0; LANES]; C];
        for (k, rows) in rows.chunks(RESET).enumerate() {
            let mut start = [(0.0, 1.0); LANES];
            let mut turn = [(0.0, 1.0); LANES];
            for (l, theta) in theta.iter().enumerate() {
                start[l] = ((k * RESET) as f64 * theta).sin_cos();
                turn[l] = theta.sin_cos();
            }
            advance(rows, &start, &turn, &mut total);
        }
        for (l, row) in out.iter_mut().enumerate() {
            *row = std::array::from_fn(|c| total[c][l]);
        }
    });
    out
}

/// Add a chunk of orders; `start` and `turn` are (sin, cos) of its first order and of one step.
#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
fn advance<const C: usize>(
    rows: &[[f64; C]],
    start: &[(f64, f64); LANES],
    turn: &[(f64, f64); LANES],
    total: &mut [[f64; LANES]; C],
) {
    let (mut sine, mut cosine) = (start.map(|s| s.0), start.map(|s| s.1));
    let (turn_sine, turn_cosine) = (turn.map(|t| t.0), turn.map(|t| t.1));
    let mut sum = *total;
    for row in rows {
        for c in 0..C {
            for l in 0..LANES {
                sum[c][l] += row[c] * cosine[l];
            }
        }
        for l in 0..LANES {
            let next = cosine[l] * turn_cosine[l] - sine[l] * turn_sine[l];
            sine[l] = sine[l] * turn_cosine[l] + cosine[l] * turn_sine[l];
            cosine[l] = next;
        }
    }
    *total = sum;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A peak ten million times higher than the curve elsewhere, as forward scattering has it.
    #[test]
    fn polynomials_come_back_anywhere() {
        let degree = 1500;
        let curve = |theta: f64| {
            // Fejér's kernel of degree 700 (order n, height n²) and a ripple.
            let n = 701.0;
            let half = 0.5 * theta;
            let peak = if half == 0.0 { n * n } else { ((n * half).sin() / half.sin()).powi(2) };
            [100.0 * peak, 2.0 + (1499.0 * theta).cos()]
        };
        let values: Vec<[f64; 2]> = points(degree).into_iter().map(curve).collect();
        let series = CosineSeries::fit(&values);
        let theta: Vec<f64> = (0..=777).map(|i| PI * f64::from(i) / 777.0).collect();
        for (theta, row) in theta.iter().zip(series.at(&theta)) {
            let expected = curve(*theta);
            assert!((row[0] - expected[0]).abs() < 1e-6, "{theta}: {} {}", row[0], expected[0]);
            assert!((row[1] - expected[1]).abs() < 1e-11, "{theta}: {} {}", row[1], expected[1]);
        }
    }

    #[test]
    fn series_of_different_degrees_add_up() {
        let of = |degree: usize, k: f64| {
            let values: Vec<[f64; 1]> =
                points(degree).iter().map(|theta| [(k * theta).cos()]).collect();
            CosineSeries::fit(&values)
        };
        let mut sum = of(6, 5.0);
        sum.add(&of(40, 33.0));
        let [value] = sum.at(&[0.7])[0];
        assert!((value - (3.5f64.cos() + 23.1f64.cos())).abs() < 1e-13);
    }
}
