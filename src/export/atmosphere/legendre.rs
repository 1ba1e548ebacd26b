//! Expansion of a phase matrix in generalised spherical functions d^l_mn.
//!
//! Mishchenko, Travis & Lacis 2002, eqs. 4.75–4.80 and appendix B: with ∫ P11 dμ = 2,
//! α1 = (2l+1)/2 ∫ P11 d_00, α2 ± α3 = (2l+1)/2 ∫ (P22 ± P33) d_2±2, α4 from P44, β1 from P12 and
//! β2 from P34 with d_02. The factor 2l+1 is **included**. Signs of β1 and β2 are ours (S12 < 0 in
//! the bow): a program with the opposite sense of Q negates both.

use crate::export::average::{Averaged, Curve};

/// Coefficients of one wavelength, each `count` long.
#[derive(Clone, Debug, PartialEq)]
pub struct Moments {
    pub alpha: [Vec<f64>; 4],
    pub beta: [Vec<f64>; 2],
}

/// Nodes and weights of Gauss–Legendre quadrature of order 4 on [−1, 1].
const GAUSS: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    (-0.339_981_043_584_856_26, 0.652_145_154_862_546_2),
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_2),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
];

/// Expand one curve into `count` coefficients per element. Between the samples the curve is a cubic
/// through four of them; α1 of l = 0 comes out as 1 and scales the rest.
pub fn expand(averaged: &Averaged, curve: &Curve, count: usize) -> Moments {
    let theta = &averaged.theta;
    let mut sums = vec![[0.0; 6]; count];
    for i in 0..theta.len().saturating_sub(1) {
        let (low, high) = (theta[i], theta[i + 1]);
        for (node, weight) in GAUSS {
            let angle = 0.5 * (low + high) + 0.5 * (high - low) * node;
            let (sine, cosine) = angle.sin_cos();
            // ∫ P dμ = 2 needs the factor 4π of a phase function in sr⁻¹.
            let factor = 0.5 * (high - low) * weight * sine * 4.0 * std::f64::consts::PI;
            let [p11, p12, p22, p33, p34, p44] =
                std::array::from_fn(|e| factor * cubic(theta, &curve.elements[e], i, angle));
            let mut d00 = Wigner::new(0, 0, cosine);
            let mut d02 = Wigner::new(0, 2, cosine);
            let mut d22 = Wigner::new(2, 2, cosine);
            let mut d2m2 = Wigner::new(2, -2, cosine);
            for sum in &mut sums {
                let [a, b, plus, minus] = [d00.next(), d02.next(), d22.next(), d2m2.next()];
                sum[0] += p11 * a;
                sum[1] += (p22 + p33) * plus;
                sum[2] += (p22 - p33) * minus;
                sum[3] += p44 * a;
                sum[4] += p12 * b;
                sum[5] += p34 * b;
            }
        }
    }
    let norm = 0.5 * sums.first().map_or(2.0, |sum| sum[0]);
    let scaled = |l: usize, value: f64| 0.5 * (2 * l + 1) as f64 * value / norm;
    let column = |pick: &dyn Fn(&[f64; 6]) -> f64| -> Vec<f64> {
        sums.iter().enumerate().map(|(l, sum)| scaled(l, pick(sum))).collect()
    };
    Moments {
        alpha: [
            column(&|s| s[0]),
            column(&|s| 0.5 * (s[1] + s[2])),
            column(&|s| 0.5 * (s[1] - s[2])),
            column(&|s| s[3]),
        ],
        beta: [column(&|s| s[4]), column(&|s| s[5])],
    }
}

/// Cubic through the samples around the interval that begins at `i` (Lagrange); linear where there
/// are too few.
fn cubic(x: &[f64], y: &[f64], i: usize, at: f64) -> f64 {
    let first = i.saturating_sub(1).min(x.len().saturating_sub(4));
    let last = (first + 4).min(x.len());
    (first..last)
        .map(|j| {
            let others = (first..last).filter(|&k| k != j);
            y[j] * others.map(|k| (at - x[k]) / (x[j] - x[k])).product::<f64>()
        })
        .sum()
}

/// d^l_mn(θ) for l = 0, 1, 2, … by upward recurrence (Mishchenko et al. 2002, eq. B.22).
struct Wigner {
    m: f64,
    n: f64,
    cosine: f64,
    l: usize,
    before: f64,
    now: f64,
}

impl Wigner {
    /// Only the pairs used here: (0, 0), (0, 2), (2, 2), (2, −2).
    fn new(m: i32, n: i32, cosine: f64) -> Wigner {
        let (up, down) = (1.0 + cosine, 1.0 - cosine);
        let now = match (m, n) {
            (0, 0) => 1.0,
            (0, 2) => 6f64.sqrt() / 4.0 * up * down,
            (2, 2) => 0.25 * up * up,
            _ => 0.25 * down * down,
        };
        Wigner { m: f64::from(m), n: f64::from(n), cosine, l: 0, before: 0.0, now }
    }

    /// The function of the present l; then l grows by one.
    fn next(&mut self) -> f64 {
        let first = self.m.abs().max(self.n.abs()) as usize;
        let l = self.l;
        self.l += 1;
        if l < first {
            return 0.0;
        }
        let value = self.now;
        let (m, n, s) = (self.m, self.n, l as f64);
        let root = |s: f64| ((s * s - m * m) * (s * s - n * n)).max(0.0).sqrt();
        let above = if l == 0 {
            self.cosine
        } else {
            ((2.0 * s + 1.0) * (s * (s + 1.0) * self.cosine - m * n) * self.now
                - (s + 1.0) * root(s) * self.before)
                / (s * root(s + 1.0))
        };
        (self.before, self.now) = (value, above);
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn averaged(elements: impl Fn(f64) -> [f64; 6]) -> (Averaged, Curve) {
        let theta: Vec<f64> = (0..=720).map(|i| PI * f64::from(i) / 720.0).collect();
        let rows: Vec<[f64; 6]> = theta.iter().map(|t| elements(t.cos())).collect();
        let curve = Curve {
            wavelength: 5e-7,
            elements: std::array::from_fn(|e| rows.iter().map(|row| row[e]).collect()),
            peak_share: 0.0,
            scattering_cross_section: 1.0,
            extinction_cross_section: 1.0,
            asymmetry: 0.0,
        };
        let averaged =
            Averaged { theta, curves: Vec::new(), cap: 0.0, polarised: true, spherical: true };
        (averaged, curve)
    }

    #[test]
    fn rayleigh_has_the_textbook_coefficients() {
        // Mishchenko et al. 2002, table 4.3, without depolarisation; β1 with our sign of Q.
        let (averaged, curve) = averaged(|c| {
            let f = 3.0 / (16.0 * PI);
            let (even, odd) = (f * (1.0 + c * c), 2.0 * f * c);
            [even, f * (c * c - 1.0), even, odd, 0.0, odd]
        });
        let moments = expand(&averaged, &curve, 6);
        let expected = [
            [1.0, 0.0, 0.5, 0.0, 0.0, 0.0],
            [0.0, 0.0, 3.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            [0.0, 1.5, 0.0, 0.0, 0.0, 0.0],
        ];
        for (found, expected) in moments.alpha.iter().zip(&expected) {
            for (a, b) in found.iter().zip(expected) {
                assert!((a - b).abs() < 1e-9, "{found:?} {expected:?}");
            }
        }
        assert!((moments.beta[0][2] + 1.5f64.sqrt()).abs() < 1e-9, "{:?}", moments.beta);
        assert!(moments.beta[1].iter().all(|b| b.abs() < 1e-12));
    }

    #[test]
    fn henyey_greenstein_has_powers_of_g() {
        let g = 0.8f64;
        let (averaged, curve) = averaged(|c| {
            let p = (1.0 - g * g) / (1.0 + g * g - 2.0 * g * c).powf(1.5) / (4.0 * PI);
            [p, 0.0, p, p, 0.0, p]
        });
        let moments = expand(&averaged, &curve, 64);
        for (l, a) in moments.alpha[0].iter().enumerate() {
            let expected = (2 * l + 1) as f64 * g.powi(l as i32);
            assert!((a - expected).abs() < 1e-6 * (2 * l + 1) as f64, "{l}: {a} {expected}");
        }
    }
}
