//! Riccati–Bessel functions by the recurrences that are stable in each region.
//!
//! `ψ_n(z) = z j_n(z)`, `χ_n(z) = -z y_n(z)`, so that `ξ_n = ψ_n - iχ_n = z h_n⁽¹⁾(z)`
//! (Bohren & Huffman 1983, sec. 4.3). Every function obeys
//! `f_{n+1} = ((2n + 1)/z) f_n - f_{n-1}`. ψ is the minimal solution beyond `n ≈ |z|`: there only
//! the downward direction is stable, and the ratio `u_n = ψ_n/ψ_{n-1}` is what to carry.

use num_complex::Complex64;
use std::ops::{Mul, Sub};

/// A field in which the ratio recurrence runs: real for a transparent sphere, complex otherwise.
pub trait Field: Copy + Mul<f64, Output = Self> + Sub<Output = Self> {
    /// Zero of the field.
    const ZERO: Self;
    /// The reciprocal; an exact zero is nudged by a rounding error of `scale`, so that a pole of
    /// the logarithmic derivative stays finite.
    fn reciprocal(self, scale: f64) -> Self;
    /// The modulus.
    fn modulus(self) -> f64;
}

impl Field for f64 {
    const ZERO: Self = 0.0;
    fn reciprocal(self, scale: f64) -> Self {
        if self == 0.0 { 1.0 / (f64::EPSILON * scale) } else { 1.0 / self }
    }
    fn modulus(self) -> f64 {
        self.abs()
    }
}

impl Field for Complex64 {
    const ZERO: Self = Complex64::ZERO;
    fn reciprocal(self, scale: f64) -> Self {
        if self.re == 0.0 && self.im == 0.0 {
            Complex64::new(1.0 / (f64::EPSILON * scale), 0.0)
        } else {
            let inverse = 1.0 / self.norm_sqr();
            Complex64::new(self.re * inverse, -self.im * inverse)
        }
    }
    fn modulus(self) -> f64 {
        self.norm()
    }
}

/// First index of the downward recurrence, so that its arbitrary start is forgotten (to less than
/// a rounding error) when it reaches both `top` and the turning point `n = |z|`.
///
/// At `n = |z| + s` one step shrinks an error by `exp(-2√(2s/|z|))`; the product over `s` from 0
/// to `S` is `exp(-(4√2/3) S^{3/2}/√|z|)`, which is 1e-26 for `S = 10 |z|^{1/3}`.
fn downward_start(top: usize, modulus: f64) -> usize {
    top.max(modulus.ceil() as usize) + (10.0 * modulus.cbrt()).ceil() as usize + 50
}

/// `u_n = ψ_n(z)/ψ_{n-1}(z)` for n = 1 … `top` (at index n; index 0 is not used), by
/// `u_n = 1/((2n + 1)/z - u_{n+1})` downward.
pub fn ratios<F: Field>(z: F, top: usize) -> Vec<F> {
    let modulus = z.modulus();
    let inverse = z.reciprocal(modulus);
    let mut out = vec![F::ZERO; top + 1];
    let mut u = F::ZERO;
    let step = |n: usize, u: F| {
        let c = (2 * n + 1) as f64;
        (inverse * c - u).reciprocal(c / modulus)
    };
    for n in (top + 1..=downward_start(top, modulus)).rev() {
        u = step(n, u);
    }
    for n in (1..=top).rev() {
        u = step(n, u);
        out[n] = u;
    }
    out
}

/// ψ_n(x) and χ_n(x) of a real argument, n = 0 … `top`.
pub struct PsiChi {
    /// `ψ_n`, regular at the origin.
    pub psi: Vec<f64>,
    /// `χ_n`, irregular at the origin.
    pub chi: Vec<f64>,
    /// `u_n = ψ_n/ψ_{n-1}` for n = 1 … `top + 1`.
    pub ratio: Vec<f64>,
    /// Up to this n ψ was carried upward (oscillating region); beyond, by the ratio.
    pub turning: usize,
}

/// ψ and χ of a real `x > 0`: both upward to `n = x`, from there ψ by its downward ratio and χ
/// still upward (it grows).
pub fn psi_chi(x: f64, top: usize) -> PsiChi {
    let ratio = ratios(x, top + 1);
    let turning = (x as usize).min(top);
    let (sin, cos) = x.sin_cos();
    let inverse = 1.0 / x;
    let (mut psi, mut chi) = (Vec::with_capacity(top + 1), Vec::with_capacity(top + 1));
    psi.push(sin);
    chi.push(cos);
    // n = -1: ψ = cos x, χ = -sin x
    let (mut psi_before, mut chi_before) = (cos, -sin);
    for n in 0..top {
        let factor = (2 * n + 1) as f64 * inverse;
        let next_psi =
            if n < turning { factor * psi[n] - psi_before } else { psi[n] * ratio[n + 1] };
        let next_chi = factor * chi[n] - chi_before;
        (psi_before, chi_before) = (psi[n], chi[n]);
        psi.push(next_psi);
        chi.push(next_chi);
    }
    PsiChi { psi, chi, ratio, turning }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// j_2 in closed form: ψ_2 = (3/x² - 1) sin x - (3/x) cos x, χ_2 with cos and -sin.
    #[test]
    fn second_order_closed_form() {
        for x in [0.5f64, 2.0, 30.0] {
            let f = psi_chi(x, 12);
            let (s, c) = x.sin_cos();
            let psi = (3.0 / (x * x) - 1.0) * s - 3.0 / x * c;
            let chi = (3.0 / (x * x) - 1.0) * c + 3.0 / x * s;
            assert!((f.psi[2] - psi).abs() < 1e-13, "{x}: {} {psi}", f.psi[2]);
            assert!((f.chi[2] - chi).abs() < 1e-13 * chi.abs().max(1.0), "{x}");
        }
    }

    /// Wronskian ψ_{n-1} χ_n - ψ_n χ_{n-1} = 1 across the turning point.
    #[test]
    fn wronskian_holds_everywhere() {
        for x in [1e-3, 0.7, 50.0, 1000.0] {
            let f = psi_chi(x, x as usize + 40);
            for n in 1..f.psi.len() {
                let w = f.psi[n - 1] * f.chi[n] - f.psi[n] * f.chi[n - 1];
                assert!((w - 1.0).abs() < 1e-11, "x {x} n {n}: {w}");
            }
        }
    }

    #[test]
    fn real_and_complex_ratios_agree() {
        let (real, complex) = (ratios(133.3, 120), ratios(Complex64::new(133.3, 0.0), 120));
        for n in 1..=120 {
            assert!((real[n] - complex[n].re).abs() < 1e-9 * real[n].abs().max(1.0), "{n}");
        }
    }
}
