//! Abbe numbers in their three definitions, and conversions between them, Cauchy and Sellmeier.
//!
//! `V = (n_y − 1)/(n_F − n_C)`: with (d, F, C) as glass catalogues print it, with (D, F, C) as older
//! books do, with (e, F', C') as ISO 7944 does. Two-term Cauchy `n = A + B/λ²` has two numbers, so
//! it is fixed by index and Abbe number: `B = (n − 1)/(V (1/λ_F² − 1/λ_C²))`, `A = n − B/λ²`.

use crate::medium::dispersion::formula::Formula;
use crate::medium::error::{MediumError, invalid};
use serde::{Deserialize, Serialize};

/// Which lines an Abbe number is taken at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum AbbeLines {
    /// d (587.5618 nm) with F and C: V_d.
    #[default]
    #[serde(rename = "d")]
    HeliumD,
    /// D (589.2938 nm, the mean of the sodium lines) with F and C: V_D.
    #[serde(rename = "D")]
    SodiumD,
    /// e (546.0740 nm) with F' and C': V_e.
    #[serde(rename = "e")]
    MercuryE,
}

impl AbbeLines {
    /// The wavelengths in micrometres: middle, short, long.
    pub fn micrometres(self) -> [f64; 3] {
        match self {
            Self::HeliumD => [0.5875618, 0.4861327, 0.6562725],
            Self::SodiumD => [0.5892938, 0.4861327, 0.6562725],
            Self::MercuryE => [0.546074, 0.4799914, 0.6438469],
        }
    }

    /// `d`, `D` or `e`.
    pub fn parse(text: &str) -> Option<Self> {
        match text {
            "d" => Some(Self::HeliumD),
            "D" => Some(Self::SodiumD),
            "e" => Some(Self::MercuryE),
            _ => None,
        }
    }
}

/// Index at the middle line and Abbe number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Abbe {
    /// Refractive index at the line.
    pub index: f64,
    /// Dispersion: index less 1 over the difference of the indices at two other lines.
    pub number: f64,
}

impl Abbe {
    /// Of any law `n(µm)`.
    pub fn of(lines: AbbeLines, index: impl Fn(f64) -> f64) -> Self {
        let [n, short, long] = lines.micrometres().map(index);
        Self { index: n, number: (n - 1.0) / (short - long) }
    }

    /// The two-term Cauchy formula that has this index and this Abbe number: A, and B in µm².
    pub fn to_cauchy(self, lines: AbbeLines) -> Result<[f64; 2], MediumError> {
        if !(self.index > 1.0 && self.index < 10.0) {
            return Err(invalid("abbe: index", self.index, "more than 1 and less than 10"));
        }
        // A negative number is anomalous dispersion, which two terms cannot stand for.
        if !(self.number > 0.0 && self.number.is_finite()) {
            return Err(invalid("abbe: number", self.number, "a positive number"));
        }
        let [middle, short, long] = lines.micrometres();
        let b = (self.index - 1.0) / (self.number * (short.powi(-2) - long.powi(-2)));
        Ok([self.index - b * middle.powi(-2), b])
    }
}

/// Least-squares Cauchy formula with `terms` terms over a range in micrometres, from any law, and
/// the largest error of its 201 equally spaced samples in 1/λ².
pub fn fit_cauchy(
    terms: usize,
    range: (f64, f64),
    index: impl Fn(f64) -> Result<f64, MediumError>,
) -> Result<(Vec<f64>, f64), MediumError> {
    if !(1..=8).contains(&terms) {
        return Err(invalid("terms of the Cauchy formula", terms, "1 to 8"));
    }
    // In u, which runs from -1 to 1 as 1/λ² does over the range, the sums are well conditioned.
    let (low, high) = (range.1.powi(-2), range.0.powi(-2));
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    const SAMPLES: usize = 201;
    let mut samples = Vec::with_capacity(SAMPLES);
    for i in 0..SAMPLES {
        let u = 2.0 * i as f64 / (SAMPLES - 1) as f64 - 1.0;
        // Rounding must not step out of the range at its ends.
        let um = (middle + half * u).powf(-0.5).clamp(range.0, range.1);
        samples.push((u, index(um)?));
    }
    let in_u = least_squares(terms, &samples);
    let error = samples.iter().map(|&(u, n)| (horner(&in_u, u) - n).abs()).fold(0.0, f64::max);
    Ok((shift(&in_u, -middle / half, 1.0 / half), error))
}

/// One-term Sellmeier `n² = 1 + b λ²/(λ² − c)` that has a given index and Abbe number: b, and c
/// in µm².
pub fn abbe_to_sellmeier(abbe: Abbe, lines: AbbeLines) -> Result<[f64; 2], MediumError> {
    let [a, b] = abbe.to_cauchy(lines)?;
    let [_, short, long] = lines.micrometres();
    // 1/(n² − 1) = (1 − c/λ²)/b is a straight line in 1/λ²; start from the line through F and C.
    let squared = |um: f64| 1.0 / ((a + b * um.powi(-2)).powi(2) - 1.0);
    let slope = (squared(short) - squared(long)) / (short.powi(-2) - long.powi(-2));
    let start = squared(long) - slope * long.powi(-2);
    let mut x = [1.0 / start, -slope / start];
    // Newton's method for index and n_F − n_C, which the line meets almost.
    let spread = (abbe.index - 1.0) / abbe.number;
    let misfit = |[b, c]: [f64; 2]| {
        let n = lines.micrometres().map(|um| (1.0 + b * um * um / (um * um - c)).sqrt());
        [n[0] - abbe.index, n[1] - n[2] - spread]
    };
    for _ in 0..20 {
        let f = misfit(x);
        let step = [1e-7 * x[0], 1e-7 * x[1].abs().max(1e-6)];
        let (fb, fc) = (misfit([x[0] + step[0], x[1]]), misfit([x[0], x[1] + step[1]]));
        let d = |g: [f64; 2], h: f64, i: usize| (g[i] - f[i]) / h;
        let (p, q) = (d(fb, step[0], 0), d(fc, step[1], 0));
        let (r, s) = (d(fb, step[0], 1), d(fc, step[1], 1));
        let determinant = p * s - q * r;
        x[0] -= (f[0] * s - f[1] * q) / determinant;
        x[1] -= (f[1] * p - f[0] * r) / determinant;
    }
    Formula::sellmeier(&[x[0]], &[x[1]])?.check_range(long.min(short), long.max(short))?;
    Ok(x)
}

/// Polynomial coefficients by the normal equations in Legendre's polynomials, then as powers.
fn least_squares(terms: usize, samples: &[(f64, f64)]) -> Vec<f64> {
    let basis = legendre(terms);
    let mut matrix = vec![vec![0.0; terms + 1]; terms];
    for &(u, n) in samples {
        let values: Vec<f64> = basis.iter().map(|p| horner(p, u)).collect();
        for (row, v) in matrix.iter_mut().zip(&values) {
            for (cell, w) in row.iter_mut().zip(&values) {
                *cell += v * w;
            }
            row[terms] += v * n;
        }
    }
    let weights = solve(matrix);
    (0..terms)
        .map(|power| {
            basis.iter().zip(&weights).map(|(p, w)| w * p.get(power).unwrap_or(&0.0)).sum()
        })
        .collect()
}

/// Powers of the first `count` Legendre polynomials.
fn legendre(count: usize) -> Vec<Vec<f64>> {
    let mut all = vec![vec![1.0], vec![0.0, 1.0]];
    for l in 2..count {
        let (a, b) = ((2 * l - 1) as f64 / l as f64, (l - 1) as f64 / l as f64);
        let mut next = vec![0.0; l + 1];
        for (i, c) in all[l - 1].iter().enumerate() {
            next[i + 1] += a * c;
        }
        for (i, c) in all[l - 2].iter().enumerate() {
            next[i] -= b * c;
        }
        all.push(next);
    }
    all.truncate(count);
    all
}

/// Gauss's elimination with pivots; the last column is the right-hand side.
fn solve(mut m: Vec<Vec<f64>>) -> Vec<f64> {
    let n = m.len();
    for i in 0..n {
        let pivot = (i..n).max_by(|&a, &b| m[a][i].abs().total_cmp(&m[b][i].abs())).unwrap_or(i);
        m.swap(i, pivot);
        let (done, below) = m.split_at_mut(i + 1);
        for row in below {
            let factor = row[i] / done[i][i];
            for (cell, above) in row.iter_mut().zip(&done[i]).skip(i) {
                *cell -= factor * above;
            }
        }
    }
    let mut x = vec![0.0; n];
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|j| m[i][j] * x[j]).sum();
        x[i] = (m[i][n] - known) / m[i][i];
    }
    x
}

fn horner(c: &[f64], x: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Coefficients in x of a polynomial given in `u = offset + scale x`.
fn shift(c: &[f64], offset: f64, scale: f64) -> Vec<f64> {
    let mut result = vec![0.0; c.len()];
    let mut power = vec![1.0];
    for &c in c {
        for (r, p) in result.iter_mut().zip(&power) {
            *r += c * p;
        }
        let mut next = vec![0.0; power.len() + 1];
        for (i, p) in power.iter().enumerate() {
            next[i] += offset * p;
            next[i + 1] += scale * p;
        }
        power = next;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn abbe_to_cauchy_and_back_in_every_definition() {
        for lines in [AbbeLines::HeliumD, AbbeLines::SodiumD, AbbeLines::MercuryE] {
            let abbe = Abbe { index: 1.7, number: 30.0 };
            let [a, b] = abbe.to_cauchy(lines).unwrap();
            let back = Abbe::of(lines, |um| a + b / (um * um));
            assert!((back.index - 1.7).abs() < 1e-14 && (back.number - 30.0).abs() < 1e-10);
            let [b, c] = abbe_to_sellmeier(abbe, lines).unwrap();
            let back = Abbe::of(lines, |um| (1.0 + b * um * um / (um * um - c)).sqrt());
            assert!((back.index - 1.7).abs() < 1e-12 && (back.number - 30.0).abs() < 1e-8);
        }
    }

    #[test]
    fn a_fit_gives_back_its_own_coefficients() {
        let given = [1.5, 0.004, 1e-4, -2e-6];
        let law = |um: f64| Ok(horner(&given, um.powi(-2)));
        let (found, error) = fit_cauchy(4, (0.4, 0.8), law).unwrap();
        assert!(error < 1e-14);
        for (a, b) in found.iter().zip(given) {
            assert!((a - b).abs() < 1e-9 * b.abs().max(1e-3), "{found:?}");
        }
    }

    #[test]
    fn nonsense_is_refused() {
        for (index, number) in [(1.0, 50.0), (1.5, 0.0), (1.5, -3.0), (f64::NAN, 50.0)] {
            assert!(Abbe { index, number }.to_cauchy(AbbeLines::HeliumD).is_err());
        }
    }
}
