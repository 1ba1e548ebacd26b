//! From the field at the surface to the partial waves outside.
//!
//! With `h = c/p` the coefficient of Bohren & Huffman 1983, eq. 4.88, is `N/(N - iQ)`,
//! ```text
//! N = (c + p n/x) ψ_n - p ψ_{n-1}      Q = (c + p n/x) χ_n - p χ_{n-1}
//! ```
//! (p not divided by, for it may vanish). Beyond n = x, `N = ψ_n (c - p D_n(x))` with
//! `D_n = (n+1)/x - ψ_{n+1}/ψ_n`. The wave takes up `Re a - |a|² = -Im(c p*)/|N - iQ|²`.

use crate::math::riccati_bessel::{PsiChi, psi_chi};
use num_complex::Complex64;

/// Coefficients and `Σ (2n+1)(Re(a+b) - |a|² - |b|²)`.
#[derive(Clone, Debug, Default)]
pub(super) struct Coefficients {
    pub a: Vec<Complex64>,
    pub b: Vec<Complex64>,
    pub absorbed: f64,
}

/// Field and conjugate at the surface, one per partial wave; index 0 is n = 1.
#[derive(Clone, Debug, Default)]
pub(super) struct Surface<T> {
    pub electric: Vec<(T, T)>,
    pub magnetic: Vec<(T, T)>,
}

/// Coefficients of transparent spheres: `|1 - 2a| = 1` to rounding.
pub(super) fn transparent(x: f64, surface: &Surface<f64>) -> Coefficients {
    let outside = psi_chi(x, surface.electric.len());
    let one = |(k, &(p, c)): (usize, &(f64, f64))| {
        let (n, full) = (k + 1, c + p * (k + 1) as f64 / x);
        let numerator = if n <= outside.turning {
            full * outside.psi[n] - p * outside.psi[n - 1]
        } else {
            (c - p * log_derivative(&outside, n, x)) * outside.psi[n]
        };
        let q = full * outside.chi[n] - p * outside.chi[n - 1];
        let inverse = numerator / (numerator * numerator + q * q);
        Complex64::new(numerator * inverse, q * inverse)
    };
    Coefficients {
        a: surface.electric.iter().enumerate().map(one).collect(),
        b: surface.magnetic.iter().enumerate().map(one).collect(),
        absorbed: 0.0,
    }
}

/// Coefficients of absorbing spheres.
pub(super) fn absorbing(x: f64, surface: &Surface<Complex64>) -> Coefficients {
    let outside = psi_chi(x, surface.electric.len());
    let mut absorbed = 0.0;
    let mut one = |(k, &(p, c)): (usize, &(Complex64, Complex64))| {
        let (n, full) = (k + 1, c + p * ((k + 1) as f64 / x));
        let numerator = if n <= outside.turning {
            full * outside.psi[n] - p * outside.psi[n - 1]
        } else {
            (c - p * log_derivative(&outside, n, x)) * outside.psi[n]
        };
        let q = full * outside.chi[n] - p * outside.chi[n - 1];
        let denominator = numerator - Complex64::I * q;
        absorbed -= (2 * n + 1) as f64 * (c * p.conj()).im / denominator.norm_sqr();
        numerator / denominator
    };
    let a = surface.electric.iter().enumerate().map(&mut one).collect();
    let b = surface.magnetic.iter().enumerate().map(&mut one).collect();
    Coefficients { a, b, absorbed }
}

/// `ψ'_n/ψ_n` beyond the turning point.
fn log_derivative(outside: &PsiChi, n: usize, x: f64) -> f64 {
    (n + 1) as f64 / x - outside.ratio[n + 1]
}
