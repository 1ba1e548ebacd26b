//! Lorenz–Mie: the exact amplitudes and efficiencies of a homogeneous sphere.
//!
//! Coefficients after Bohren & Huffman 1983, eq. 4.88, with `H = κ D_n(mx)` (κ = 1/m for a_n, m
//! for b_n) and `D_n = ψ'_n/ψ_n`:
//! ```text
//! a_n = [(H + n/x) ψ_n - ψ_{n-1}] / [(H + n/x) ξ_n - ξ_{n-1}] = N/(N - iQ)
//! ```
//! Where ψ is carried by its ratio `u_n` (n > x, so also the Rayleigh limit) the numerator is
//! `N = ψ_n (H - D_n(x))` with `D_n(z) = (n+1)/z - u_{n+1}(z)`, and the two leading terms are
//! subtracted by hand; nothing cancels as x → 0. The unitarity deficit
//! `Re a_n - |a_n|² = -Im H / |N - iQ|²` gives the absorption without cancellation.

use super::angular::{self, AngleSet};
use super::{Efficiencies, SeriesError, checked_term_count};
use crate::cancel;
use crate::math::riccati_bessel::{PsiChi, psi_chi, ratios};
use num_complex::Complex64;

/// A homogeneous sphere in vacuum with its solved partial waves.
#[derive(Clone, Debug)]
pub struct Sphere {
    size_parameter: f64,
    index: Complex64,
    a: Vec<Complex64>,
    b: Vec<Complex64>,
    efficiencies: Efficiencies,
}

/// One coefficient, and what it absorbs: `Re a - |a|²`.
struct Partial {
    coefficient: Complex64,
    absorbed: f64,
}

impl Sphere {
    /// Solve the sphere of size parameter `x = 2πr/λ` and index `n + ik` relative to the outside.
    pub fn new(size_parameter: f64, relative_index: Complex64) -> Result<Self, SeriesError> {
        let terms = checked_term_count(size_parameter, relative_index)?;
        let outside = psi_chi(size_parameter, terms);
        let (a, b, absorbed) = if relative_index.im == 0.0 {
            coefficients_real(size_parameter, relative_index.re, &outside)
        } else {
            coefficients_complex(size_parameter, relative_index, &outside)
        };
        let efficiencies = efficiencies(size_parameter, &a, &b, absorbed);
        Ok(Self { size_parameter, index: relative_index, a, b, efficiencies })
    }

    /// `x = 2πr/λ`.
    pub fn size_parameter(&self) -> f64 {
        self.size_parameter
    }

    /// Index relative to the outside, `n + ik`.
    pub fn relative_index(&self) -> Complex64 {
        self.index
    }

    /// Electric partial waves a_n; index 0 is n = 1.
    pub fn a(&self) -> &[Complex64] {
        &self.a
    }

    /// Magnetic partial waves b_n; index 0 is n = 1.
    pub fn b(&self) -> &[Complex64] {
        &self.b
    }

    /// Efficiencies and asymmetry.
    pub fn efficiencies(&self) -> Efficiencies {
        self.efficiencies
    }

    /// (S1, S2) at scattering angles in radians, on this thread.
    pub fn amplitudes(&self, theta: &[f64]) -> Vec<(Complex64, Complex64)> {
        self.amplitudes_at(&AngleSet::new(theta))
    }

    /// (S1, S2) at prepared angles, on this thread: for many spheres at the same angles.
    pub fn amplitudes_at(&self, set: &AngleSet) -> Vec<(Complex64, Complex64)> {
        angular::amplitudes(&self.a, &self.b, set)
    }

    /// (S1, S2) of several spheres at the same prepared angles: cheaper than one by one.
    pub fn amplitudes_together<const W: usize>(
        spheres: [&Self; W],
        set: &AngleSet,
    ) -> [Vec<(Complex64, Complex64)>; W] {
        angular::amplitudes_together(spheres.map(|s| (s.a.as_slice(), s.b.as_slice())), set)
    }

    /// (S1, S2) at scattering angles in radians, blocks of angles shared among all threads.
    pub fn amplitudes_parallel(&self, theta: &[f64]) -> Vec<(Complex64, Complex64)> {
        angular::amplitudes_parallel(&self.a, &self.b, &AngleSet::new(theta))
    }
}

/// Terms between looks whether to go on.
const OFTEN: usize = 1 << 16;

type Coefficients = (Vec<Complex64>, Vec<Complex64>, f64);

/// Transparent sphere: `N` and `Q` are real, so |1 - 2a_n| = 1 holds to rounding.
fn coefficients_real(x: f64, m: f64, outside: &PsiChi) -> Coefficients {
    let terms = outside.psi.len() - 1;
    let inside = ratios(m * x, terms + 1);
    let partial = |n: usize, h: f64, difference: f64| {
        let (numerator, q) = numerator_and_q(n, x, h, difference, outside);
        Complex64::new(numerator, 0.0) / Complex64::new(numerator, -q)
    };
    let contrast = (1.0 - m) * (1.0 + m) / (m * m);
    let (mut a, mut b) = (Vec::with_capacity(terms), Vec::with_capacity(terms));
    for n in 1..=terms {
        if n % OFTEN == 0 {
            cancel::checkpoint();
        }
        let lead = (n + 1) as f64 / x;
        let (u, u_outside) = (inside[n + 1], outside.ratio[n + 1]);
        let for_a = u_outside - u / m;
        a.push(partial(n, lead / (m * m) - u / m, lead * contrast + for_a));
        b.push(partial(n, lead - m * u, u_outside - m * u));
    }
    (a, b, 0.0)
}

/// `N` and `Q` of a real `H`, with `difference = H - D_n(x)`.
fn numerator_and_q(n: usize, x: f64, h: f64, difference: f64, f: &PsiChi) -> (f64, f64) {
    let full = h + n as f64 / x;
    let numerator =
        if n <= f.turning { full * f.psi[n] - f.psi[n - 1] } else { difference * f.psi[n] };
    (numerator, full * f.chi[n] - f.chi[n - 1])
}

/// Absorbing sphere.
fn coefficients_complex(x: f64, m: Complex64, outside: &PsiChi) -> Coefficients {
    let terms = outside.psi.len() - 1;
    let inside = ratios(m * x, terms + 1);
    let square = m * m;
    let contrast = (1.0 - m) * (1.0 + m) / square;
    let (mut a, mut b) = (Vec::with_capacity(terms), Vec::with_capacity(terms));
    let mut absorbed = 0.0;
    for n in 1..=terms {
        if n % OFTEN == 0 {
            cancel::checkpoint();
        }
        let lead = (n + 1) as f64 / x;
        let (u, u_outside) = (inside[n + 1], outside.ratio[n + 1]);
        let (over, times) = (u / m, u * m);
        let electric = partial_complex(
            n,
            x,
            lead / square - over,
            lead * contrast + u_outside - over,
            outside,
        );
        let magnetic = partial_complex(n, x, lead - times, u_outside - times, outside);
        absorbed += (2 * n + 1) as f64 * (electric.absorbed + magnetic.absorbed);
        a.push(electric.coefficient);
        b.push(magnetic.coefficient);
    }
    (a, b, absorbed)
}

/// One coefficient from a complex `H`, with `difference = H - D_n(x)`.
fn partial_complex(n: usize, x: f64, h: Complex64, difference: Complex64, f: &PsiChi) -> Partial {
    let full = h + n as f64 / x;
    let numerator =
        if n <= f.turning { full * f.psi[n] - f.psi[n - 1] } else { difference * f.psi[n] };
    let denominator = numerator - Complex64::I * (full * f.chi[n] - f.chi[n - 1]);
    Partial { coefficient: numerator / denominator, absorbed: -h.im / denominator.norm_sqr() }
}

/// Σ (2n+1)(|a_n|² + |b_n|²), and the sum for the asymmetry (Bohren & Huffman 1983, sec. 4.5).
pub(super) fn sums(a: &[Complex64], b: &[Complex64]) -> (f64, f64) {
    let (mut scattered, mut forward) = (0.0, 0.0);
    for k in 0..a.len() {
        let n = (k + 1) as f64;
        let odd = 2.0 * n + 1.0;
        scattered += odd * (a[k].norm_sqr() + b[k].norm_sqr());
        forward += odd / (n * (n + 1.0)) * (a[k] * b[k].conj()).re;
        if k + 1 < a.len() {
            let product = a[k] * a[k + 1].conj() + b[k] * b[k + 1].conj();
            forward += n * (n + 2.0) / (n + 1.0) * product.re;
        }
    }
    (scattered, forward)
}

/// Sums of Bohren & Huffman 1983, eqs. 4.61, 4.62 and of sec. 4.5; `absorbed` is
/// Σ (2n+1)(Re(a+b) - |a|² - |b|²).
pub(super) fn efficiencies(
    x: f64,
    a: &[Complex64],
    b: &[Complex64],
    absorbed: f64,
) -> Efficiencies {
    let (scattered, forward) = sums(a, b);
    let mut back = Complex64::ZERO;
    for k in 0..a.len() {
        let odd = (2 * k + 3) as f64; // 2n + 1
        let alternating = if k % 2 == 0 { -odd } else { odd };
        back += (a[k] - b[k]) * alternating;
    }
    let scale = 2.0 / (x * x);
    let (q_sca, q_abs) = (scale * scattered, scale * absorbed);
    Efficiencies {
        q_ext: q_sca + q_abs,
        q_sca,
        q_abs,
        q_back: (back / x).norm_sqr(),
        asymmetry: 2.0 * forward / scattered,
    }
}

#[cfg(test)]
mod tests;
