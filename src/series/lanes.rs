//! Partial waves of eight nearly transparent spheres at once, one in each SIMD lane.
//!
//! With ψ, χ and their derivatives at x and at y = mx (Bohren & Huffman 1983, eq. 4.88, times the
//! denominators)
//! ```text
//! a_n = N/(N - iQ)     N = ψ'(y) ψ(x) - m ψ(y) ψ'(x)     Q = ψ'(y) χ(x) - m ψ(y) χ'(x)
//! b_n the same with      m ψ'(y) ψ(x) - ψ(y) ψ'(x)       and χ likewise
//! ```
//! all carried upward side by side, so that nothing is kept and only the last quotient divides.
//! Upward, ψ takes up a rounding error that grows as χ does; where it has grown to the size of ψ,
//! a_n and b_n are themselves as small as a rounding error, so that their absolute error stays near
//! 1e-12. Where small numbers themselves count ([`Sphere`] states absorption without cancellation),
//! this is not for use.
//!
//! Weak absorption enters to first order, `ψ(y + iδ) = ψ + iδψ'`, `ψ'' = (n(n+1)/y² - 1) ψ`: real
//! arithmetic, and right to `δ²/2`.

use super::angular::Waves;
use super::lorenz_mie::Sphere;
use super::{SeriesError, checked_term_count};
use multiversion::multiversion;
use num_complex::Complex64;

/// Spheres carried together.
pub const LANES: usize = 8;
type Lanes = [f64; LANES];

/// The largest `δ = kx` that enters to first order: what it leaves out is below 1e-5.
const WEAK: f64 = 4e-3;
/// Orders between which the results are handed out.
const CHUNK: usize = 128;

/// Partial waves of one sphere; index 0 is n = 1.
#[derive(Clone, Debug, Default)]
pub struct PartialWaves {
    /// Electric coefficients, by multipole.
    pub a: Vec<Complex64>,
    /// Magnetic coefficients, by multipole.
    pub b: Vec<Complex64>,
}

impl PartialWaves {
    /// Those of the orders up to `last`.
    pub fn up_to(&self, last: usize) -> Waves<'_> {
        let count = self.a.len().min(last);
        (&self.a[..count], &self.b[..count])
    }
}

/// Partial waves of up to [`LANES`] spheres of size parameters x and indices n + ik.
///
/// # Errors
/// A size parameter or an index that [`Sphere::new`] does not accept.
pub fn partial_waves(spheres: &[(f64, Complex64)]) -> Result<Vec<PartialWaves>, SeriesError> {
    let mut terms = Vec::with_capacity(spheres.len());
    for &(x, index) in spheres {
        terms.push(checked_term_count(x, index)?);
    }
    // For m < 1 ψ(y) is the first to be lost, where the waves of the rim are still whole.
    if spheres.iter().any(|(x, index)| index.re < 1.0 || index.im * x > WEAK) {
        let exact = |&(x, index): &(f64, Complex64)| {
            let sphere = Sphere::new(x, index)?;
            Ok(PartialWaves { a: sphere.a().to_vec(), b: sphere.b().to_vec() })
        };
        return spheres.iter().map(exact).collect();
    }
    let room = |&terms: &usize| PartialWaves {
        a: Vec::with_capacity(terms),
        b: Vec::with_capacity(terms),
    };
    let mut out: Vec<PartialWaves> = terms.iter().map(room).collect();
    let mut state = State::new(spheres);
    let last = terms.iter().copied().max().unwrap_or(0);
    let mut chunk = vec![[[0.0; LANES]; 4]; CHUNK];
    for first in (0..last).step_by(CHUNK) {
        state = advance(state, first + 1, &mut chunk);
        for (l, waves) in out.iter_mut().enumerate() {
            let own = terms[l].saturating_sub(first).min(CHUNK);
            waves.a.extend(chunk[..own].iter().map(|row| Complex64::new(row[0][l], row[1][l])));
            waves.b.extend(chunk[..own].iter().map(|row| Complex64::new(row[2][l], row[3][l])));
        }
    }
    Ok(out)
}

/// What the recurrences carry: functions of the orders n - 1 and n.
#[derive(Clone, Copy, Debug)]
struct State {
    x_inverse: Lanes,
    y_inverse: Lanes,
    index: Lanes,
    absorption: Lanes,
    /// δ.
    depth: Lanes,
    psi: [Lanes; 2],
    chi: [Lanes; 2],
    inside: [Lanes; 2],
}

impl State {
    /// Before n = 1; lanes without a sphere repeat the first one.
    fn new(spheres: &[(f64, Complex64)]) -> Self {
        let zero = [0.0; LANES];
        let mut state = Self {
            x_inverse: zero,
            y_inverse: zero,
            index: zero,
            absorption: zero,
            depth: zero,
            psi: [zero; 2],
            chi: [zero; 2],
            inside: [zero; 2],
        };
        for l in 0..LANES {
            let (x, index) = *spheres.get(l).unwrap_or(&spheres[0]);
            let y = x * index.re;
            (state.x_inverse[l], state.y_inverse[l]) = (1.0 / x, 1.0 / y);
            (state.index[l], state.absorption[l]) = (index.re, index.im);
            state.depth[l] = index.im * x;
            // n = -1 and n = 0.
            (state.psi[0][l], state.psi[1][l]) = (x.cos(), x.sin());
            (state.chi[0][l], state.chi[1][l]) = (-x.sin(), x.cos());
            (state.inside[0][l], state.inside[1][l]) = (y.cos(), y.sin());
        }
        state
    }
}

/// Real and imaginary parts of a_n and b_n for as many orders as `out` is long, from `first` on.
#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
fn advance(mut state: State, first: usize, out: &mut [[Lanes; 4]]) -> State {
    for (k, [a_re, a_im, b_re, b_im]) in out.iter_mut().enumerate() {
        let n = (first + k) as f64;
        let odd = 2.0 * n - 1.0;
        for l in 0..LANES {
            let (over_x, over_y) = (state.x_inverse[l], state.y_inverse[l]);
            let (m, absorption, depth) = (state.index[l], state.absorption[l], state.depth[l]);
            let psi_before = state.psi[1][l];
            let psi = odd * over_x * psi_before - state.psi[0][l];
            let chi_before = state.chi[1][l];
            let chi = odd * over_x * chi_before - state.chi[0][l];
            let inside_before = state.inside[1][l];
            let inside = odd * over_y * inside_before - state.inside[0][l];
            (state.psi[0][l], state.psi[1][l]) = (psi_before, psi);
            (state.chi[0][l], state.chi[1][l]) = (chi_before, chi);
            (state.inside[0][l], state.inside[1][l]) = (inside_before, inside);

            let psi_slope = psi_before - n * over_x * psi;
            let chi_slope = chi_before - n * over_x * chi;
            let slope = inside_before - n * over_y * inside;
            let bend = (n * (n + 1.0) * over_y * over_y - 1.0) * inside * depth;

            // a_n: real and imaginary parts of N and Q.
            let (one, other) = (slope, m * inside);
            let (one_im, other_im) = (bend, m * depth * slope + absorption * inside);
            let (n_re, n_im) = (one * psi - other * psi_slope, one_im * psi - other_im * psi_slope);
            let (q_re, q_im) = (one * chi - other * chi_slope, one_im * chi - other_im * chi_slope);
            let (re, im) = (n_re + q_im, n_im - q_re);
            let inverse = 1.0 / (re * re + im * im);
            a_re[l] = (n_re * re + n_im * im) * inverse;
            a_im[l] = (n_im * re - n_re * im) * inverse;

            // b_n.
            let (one, other) = (m * slope, inside);
            let (one_im, other_im) = (m * bend + absorption * slope, depth * slope);
            let (n_re, n_im) = (one * psi - other * psi_slope, one_im * psi - other_im * psi_slope);
            let (q_re, q_im) = (one * chi - other * chi_slope, one_im * chi - other_im * chi_slope);
            let (re, im) = (n_re + q_im, n_im - q_re);
            let inverse = 1.0 / (re * re + im * im);
            b_re[l] = (n_re * re + n_im * im) * inverse;
            b_im[l] = (n_im * re - n_re * im) * inverse;
        }
    }
    state
}

#[cfg(test)]
mod tests {
    use super::*;

    fn worst(spheres: &[(f64, Complex64)]) -> f64 {
        let together = partial_waves(spheres).unwrap();
        let mut worst = 0.0_f64;
        for (&(x, index), waves) in spheres.iter().zip(together) {
            let exact = Sphere::new(x, index).unwrap();
            assert_eq!(exact.a().len(), waves.a.len());
            for (a, b) in exact.a().iter().zip(&waves.a).chain(exact.b().iter().zip(&waves.b)) {
                worst = worst.max((a - b).norm());
            }
        }
        worst
    }

    /// Transparent: what the upward recurrences lose.
    #[test]
    fn transparent_spheres_as_alone() {
        for x in [0.3, 2.0, 10.0, 60.0, 400.0, 3000.0, 16500.0] {
            for m in [0.75, 1.0001, 1.333, 1.5, 2.4] {
                let sphere = |k: usize| (x * (1.0 + 0.01 * k as f64), Complex64::from(m));
                let error = worst(&(0..5).map(sphere).collect::<Vec<_>>());
                assert!(error < 1e-8, "{x}, {m}: {error:e}");
            }
        }
    }

    #[test]
    fn weak_absorption_to_first_order() {
        for x in [30.0, 400.0, 12000.0] {
            for depth in [1e-5, 1e-4, 3.9e-3, 1e-2] {
                let error = worst(&[(x, Complex64::new(1.333, depth / x))]);
                assert!(error < 1e-8 + depth * depth, "{x}, {depth}: {error:e}");
            }
        }
    }
}
