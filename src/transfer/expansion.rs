//! A phase matrix as a sum of generalised spherical functions.
//!
//! Mishchenko, Travis & Lacis 2002, eqs. 4.75–4.80 and appendix B: with ∫ P11 dμ = 2,
//! α1 = (2l+1)/2 ∫ P11 d_00, α2 ± α3 = (2l+1)/2 ∫ (P22 ± P33) d_2±2, α4 from P44, β1 from P12 and
//! β2 from P34 with d_02. The factor 2l+1 is **included**. Signs of β1 and β2 are ours (S12 < 0 in
//! the bow): a program with the opposite sense of Q negates both.

use crate::math::wigner::Wigner;

/// Coefficients of a phase matrix, each list of the same length.
///
/// ```
/// use gonio::transfer::Expansion;
///
/// // the asymmetry is a third of the second coefficient
/// let haze = Expansion::henyey_greenstein(0.8, 40);
/// assert!((haze.alpha[0][1] / 3.0 - 0.8).abs() < 1e-15);
/// assert_eq!(Expansion::rayleigh().alpha[0], [1.0, 0.0, 0.5]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Expansion {
    /// α1 to α4 by l = 0, 1, …
    pub alpha: [Vec<f64>; 4],
    /// β1 and β2.
    pub beta: [Vec<f64>; 2],
}

/// Nodes and weights of Gauss–Legendre quadrature of order 4 on [−1, 1].
const GAUSS: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    (-0.339_981_043_584_856_26, 0.652_145_154_862_546_2),
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_2),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
];

impl Expansion {
    /// Expand curves over scattering angles (radians, ascending), of the elements 11, 12, 22, 33, 34, 44 in sr⁻¹,
    /// into `count` coefficients of each kind. Between the samples a curve is a cubic through four of them.
    /// Scaled so that the first is 1; beside it what ∫ P11 dΩ over the curve was.
    pub fn of_curves(theta: &[f64], elements: &[Vec<f64>; 6], count: usize) -> (Self, f64) {
        let mut sums = vec![[0.0; 6]; count];
        for i in 0..theta.len().saturating_sub(1) {
            let (low, high) = (theta[i], theta[i + 1]);
            for (node, weight) in GAUSS {
                let angle = 0.5 * (low + high) + 0.5 * (high - low) * node;
                let (sine, cosine) = angle.sin_cos();
                // ∫ P dμ = 2 needs the factor 4π of a phase function in sr⁻¹.
                let factor = 0.5 * (high - low) * weight * sine * 4.0 * std::f64::consts::PI;
                let [p11, p12, p22, p33, p34, p44] =
                    std::array::from_fn(|e| factor * cubic(theta, &elements[e], i, angle));
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
        let expansion = Self {
            alpha: [
                column(&|s| s[0]),
                column(&|s| 0.5 * (s[1] + s[2])),
                column(&|s| 0.5 * (s[1] - s[2])),
                column(&|s| s[3]),
            ],
            beta: [column(&|s| s[4]), column(&|s| s[5])],
        };
        (expansion, norm)
    }

    /// All coefficients 0, `count` of each kind.
    pub fn zero(count: usize) -> Self {
        let zeros = || vec![0.0; count];
        Self { alpha: [zeros(), zeros(), zeros(), zeros()], beta: [zeros(), zeros()] }
    }

    /// Light scattered evenly to all sides, unpolarised.
    pub fn isotropic() -> Self {
        Self::henyey_greenstein(0.0, 1)
    }

    /// The phase function of Henyey & Greenstein 1941 of an asymmetry, `count` coefficients; it polarises nothing.
    pub fn henyey_greenstein(asymmetry: f64, count: usize) -> Self {
        let mut whole = Self::zero(count);
        let powers = |l: usize| (2 * l + 1) as f64 * asymmetry.powi(l as i32);
        whole.alpha[0] = (0..count).map(powers).collect();
        whole
    }

    /// Rayleigh's phase matrix without depolarisation (Mishchenko et al. 2002, table 4.3).
    pub fn rayleigh() -> Self {
        let mut whole = Self::zero(3);
        whole.alpha[0] = vec![1.0, 0.0, 0.5];
        whole.alpha[1][2] = 3.0;
        whole.alpha[3][1] = 1.5;
        whole.beta[0][2] = -1.5f64.sqrt();
        whole
    }

    /// Number of coefficients of each kind.
    pub fn len(&self) -> usize {
        self.alpha[0].len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Add another, each coefficient times `share`.
    pub fn add(&mut self, other: &Self, share: f64) {
        let lists = self.alpha.iter_mut().chain(&mut self.beta);
        for (sum, list) in lists.zip(other.alpha.iter().chain(&other.beta)) {
            sum.iter_mut().zip(list).for_each(|(sum, value)| *sum += share * value);
        }
    }

    /// Elements 11, 12, 22, 33, 34, 44 at a scattering angle, by its cosine; 4π times those per steradian.
    ///
    /// ```
    /// use gonio::transfer::Expansion;
    ///
    /// let [p11, p12, ..] = Expansion::rayleigh().elements(0.0);
    /// assert!((p11 - 0.75).abs() < 1e-15 && (p12 + 0.75).abs() < 1e-15);
    /// ```
    pub fn elements(&self, cosine: f64) -> [f64; 6] {
        let mut d = [(0, 0), (0, 2), (2, 2), (2, -2)].map(|(m, n)| Wigner::new(m, n, cosine));
        let [mut p11, mut p12, mut p34, mut p44, mut sum, mut difference] = [0.0; 6];
        for l in 0..self.len() {
            let [d00, d02, d22, d2m2] = d.each_mut().map(Wigner::next);
            let [a1, a2, a3, a4] = std::array::from_fn(|k| self.alpha[k][l]);
            p11 += a1 * d00;
            p44 += a4 * d00;
            p12 += self.beta[0][l] * d02;
            p34 += self.beta[1][l] * d02;
            sum += (a2 + a3) * d22;
            difference += (a2 - a3) * d2m2;
        }
        [p11, p12, 0.5 * (sum + difference), 0.5 * (sum - difference), p34, p44]
    }

    /// Row by row, what couples the components of one degree: entries 11, 12; 21, 22; 33, 34; 43, 44.
    pub(super) fn coupling(&self, l: usize) -> [[f64; 4]; 4] {
        let [a1, a2, a3, a4] = std::array::from_fn(|k| self.alpha[k][l]);
        let [b1, b2] = std::array::from_fn(|k| self.beta[k][l]);
        [[a1, b1, 0.0, 0.0], [b1, a2, 0.0, 0.0], [0.0, 0.0, a3, b2], [0.0, 0.0, -b2, a4]]
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn expanded(count: usize, elements: impl Fn(f64) -> [f64; 6]) -> (Expansion, f64) {
        let theta: Vec<f64> = (0..=720).map(|i| PI * f64::from(i) / 720.0).collect();
        let rows: Vec<[f64; 6]> = theta.iter().map(|t| elements(t.cos())).collect();
        let curves = std::array::from_fn(|e| rows.iter().map(|row| row[e]).collect());
        Expansion::of_curves(&theta, &curves, count)
    }

    /// The textbook's coefficients, β1 with our sign of Q.
    #[test]
    fn rayleigh_is_rayleigh() {
        let (found, norm) = expanded(6, |c| {
            let f = 3.0 / (16.0 * PI);
            let (even, odd) = (f * (1.0 + c * c), 2.0 * f * c);
            [even, f * (c * c - 1.0), even, odd, 0.0, odd]
        });
        let mut expected = Expansion::zero(6);
        expected.add(&Expansion::rayleigh(), 1.0);
        assert!((norm - 1.0).abs() < 1e-10);
        let lists = found.alpha.iter().chain(&found.beta);
        for (a, b) in lists.zip(expected.alpha.iter().chain(&expected.beta)) {
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9), "{a:?} {b:?}");
        }
    }

    #[test]
    fn henyey_greenstein_has_powers_of_g() {
        let g = 0.8f64;
        let (found, _) = expanded(64, |c| {
            let p = (1.0 - g * g) / (1.0 + g * g - 2.0 * g * c).powf(1.5) / (4.0 * PI);
            [p, 0.0, p, p, 0.0, p]
        });
        let expected = Expansion::henyey_greenstein(g, 64);
        for (l, (a, b)) in found.alpha[0].iter().zip(&expected.alpha[0]).enumerate() {
            assert!((a - b).abs() < 1e-6 * (2 * l + 1) as f64, "{l}: {a} {b}");
        }
    }

    /// Curves that begin beyond the forward peak tell how much light is there.
    #[test]
    fn a_missing_peak_is_told() {
        let theta: Vec<f64> =
            (0..=1600).map(|i| PI * (0.2 + 0.8 * f64::from(i) / 1600.0)).collect();
        let even = vec![0.25 / PI; theta.len()];
        let elements =
            [even.clone(), vec![0.0; 1601], even.clone(), even.clone(), vec![0.0; 1601], even];
        let (_, norm) = Expansion::of_curves(&theta, &elements, 2);
        assert!((norm - 0.5 * (1.0 + (0.2 * PI).cos())).abs() < 1e-9, "{norm}");
    }
}
