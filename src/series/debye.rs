//! The Debye series: every partial wave of Lorenz–Mie taken apart into diffraction, external
//! reflection and the waves that leave after 1, 2, 3 … chords.
//!
//! With `R22` (outside → outside), `R11` (inside → inside) and `T = T21 T12` the reflection and
//! transmission of spherical waves at the surface (Hovenac & Lock, J. Opt. Soc. Am. A 9, 781,
//! 1992)
//! ```text
//! a_n, b_n = ½ [1 - R22 - Σ_{p≥1} T R11^{p-1}]
//! ```
//! Written with `ξ⁽¹⁾ = ψ - iχ` (outgoing), `ξ⁽²⁾ = ψ + iχ`, their logarithmic derivatives
//! `L⁽¹⁾`, `L⁽²⁾` at `y = mx`, κ = 1/m for a_n and m for b_n:
//! ```text
//! Δ⁽ʲ⁾ = (κ L⁽ʲ⁾(y) + n/x) ξ_n(x) - ξ_{n-1}(x)
//! (1 - R22)/2 = [(κ L⁽²⁾(y) + n/x) ψ_n(x) - ψ_{n-1}(x)] / Δ⁽²⁾
//! R11 = -(ξ⁽¹⁾/ξ⁽²⁾)(y) Δ⁽¹⁾/Δ⁽²⁾            T = -4κ / (ξ⁽²⁾(y) Δ⁽²⁾)²
//! ```
//! Inside, ξ⁽¹⁾ grows with n and may be carried upward, ξ⁽²⁾ of an absorbing sphere may not: it
//! follows from ψ (its ratio downward) and the Wronskians `ψ ξ⁽¹⁾ (L⁽¹⁾ - D) = i`,
//! `ξ⁽¹⁾ ξ⁽²⁾ (L⁽¹⁾ - L⁽²⁾) = 2i`. Exponentials never stand alone, so nothing overflows. With the
//! same Wronskians the geometric sum is `T/(1 - R11) = -2iκ (L⁽²⁾ - D)/(Δ⁽²⁾ Δ)`, Δ from D, which
//! holds also where R11 → 1.
//!
//! # Where it does not converge
//! Partial waves with x < n < |m|x tunnel in and are almost totally reflected inside: |R11| → 1,
//! and a transparent sphere needs thousands of orders for them. For m < 1 the waves n > mx are
//! totally reflected outside; the series gives that to order 0 and infinitely many p together, so
//! that no single order means anything there. [`DebyeSeries::remainder`] tells.
//!
//! The ½ of diffraction, summed over all n, is a delta function in the forward direction; only its
//! part with impact parameter `(n + ½)/x ≤ 1` is the diffraction of the disc. That part is
//! [`Term::Diffraction`]; what is left of `(1 - R22)/2` is order 0. Their sum does not depend on
//! where the line is drawn.

use super::angular::{self, AngleSet};
use super::{SeriesError, checked_term_count};
use crate::math::riccati_bessel::{PsiChi, psi_chi, ratios};
use num_complex::Complex64;

/// One term of the series.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Term {
    /// Diffraction of the disc: ½ for every partial wave that meets the sphere.
    Diffraction,
    /// Waves that left after this many chords inside: 0 is external reflection alone.
    Order(u32),
    /// Diffraction and all orders, summed in closed form: Lorenz–Mie.
    All,
}

/// What one partial wave of one polarisation does at the surface.
#[derive(Clone, Copy, Debug)]
struct Interface {
    /// (1 - R22)/2.
    outside: Complex64,
    /// R11.
    internal: Complex64,
    /// T21 T12.
    transmission: Complex64,
    /// T21 T12 / (1 - R11): all internal orders.
    all_internal: Complex64,
    /// What the whole wave absorbs: `Re a - |a|²`.
    absorbed: f64,
}

/// The series cut behind an order. What is kept has no feature in x finer than the longest path
/// of its orders allows; the resonances of the sphere lie in what is behind.
#[derive(Clone, Debug)]
pub struct Cut {
    /// a_n and b_n of diffraction and the orders up to the cut.
    pub a: Vec<Complex64>,
    pub b: Vec<Complex64>,
    /// The waves behind the cut.
    pub electric: Vec<Behind>,
    pub magnetic: Vec<Behind>,
    /// Absorption efficiency without the beats of the waves behind the cut: its mean over sizes is
    /// the mean absorption, but it has no resonances.
    pub q_abs: f64,
}

/// A partial wave's orders behind a cut: `-first Σ_{j≥0} internal^j`.
#[derive(Clone, Copy, Debug)]
pub struct Behind {
    /// `½ T R11^last`: the first order behind the cut, `last + 1`.
    pub first: Complex64,
    /// R11.
    pub internal: Complex64,
}

/// Share of a wave that is not reflected inside, at least, and in units of what is transmitted.
const LOSS: f64 = 1e-10;
const LEAK: f64 = 0.5;

/// One polarisation of a partial wave cut behind an order.
struct CutWave {
    kept: Complex64,
    behind: Behind,
    /// `Re a - |a|²` without the beats of the orders behind.
    absorbed: f64,
}

impl Interface {
    /// Whether its orders fade: deep in absorbing spheres waves do not run about, |R| may exceed 1, and
    /// the sum over orders has a closed form but no meaning. A narrow resonance leaks what enters it.
    fn fades(&self, loss: f64) -> bool {
        loss > LOSS && loss * loss > LEAK * LEAK * self.transmission.norm_sqr()
    }

    /// The orders above one.
    fn rest(&self, order: u32) -> Complex64 {
        0.5 * self.all_internal * self.internal.powu(order)
    }

    /// Inside, the power of all orders together goes as
    /// `1/|1 - R|² = [1 + 2 Re Σ_{k≥1} R^k]/(1 - |R|²)` with R = R11, a series of beats of k chords
    /// (Poisson's kernel); what stands before it has beats of one chord at most.
    fn cut(&self, last: u32) -> CutWave {
        let r = self.internal;
        let loss = 1.0 - r.norm_sqr();
        if !self.fades(loss) {
            let kept = self.outside - 0.5 * self.all_internal;
            let behind = Behind { first: Complex64::ZERO, internal: r };
            return CutWave { kept, behind, absorbed: self.absorbed };
        }
        let turns = r.powu(last);
        let mut absorbed = 0.0;
        if self.absorbed != 0.0 {
            let away = 1.0 - r;
            let beats = r * (1.0 - turns) * away.conj();
            absorbed = self.absorbed * (away.norm_sqr() + 2.0 * beats.re) / loss;
        }
        let kept = self.outside - 0.5 * self.all_internal * (1.0 - turns);
        let behind = Behind { first: 0.5 * self.transmission * turns, internal: r };
        CutWave { kept, behind, absorbed }
    }
}

/// A sphere with its partial waves taken apart.
#[derive(Clone, Debug)]
pub struct DebyeSeries {
    size_parameter: f64,
    electric: Vec<Interface>,
    magnetic: Vec<Interface>,
}

impl DebyeSeries {
    /// Sphere of size parameter `x = 2πr/λ` and index `n + ik` relative to the outside.
    pub fn new(size_parameter: f64, relative_index: Complex64) -> Result<Self, SeriesError> {
        let terms = checked_term_count(size_parameter, relative_index)?;
        let (x, m) = (size_parameter, relative_index);
        let outside = psi_chi(x, terms);
        let (mut electric, mut magnetic) = (Vec::with_capacity(terms), Vec::with_capacity(terms));
        for (k, inside) in inside_waves(m * x, terms).into_iter().enumerate() {
            electric.push(interface(k + 1, x, 1.0 / m, &inside, &outside));
            magnetic.push(interface(k + 1, x, m, &inside, &outside));
        }
        Ok(Self { size_parameter, electric, magnetic })
    }

    /// (S1, S2) of one term at scattering angles in radians, on this thread.
    pub fn amplitudes(&self, term: Term, theta: &[f64]) -> Vec<(Complex64, Complex64)> {
        self.sum(&[term], theta)
    }

    /// (S1, S2) of several terms together.
    pub fn sum(&self, terms: &[Term], theta: &[f64]) -> Vec<(Complex64, Complex64)> {
        let (a, b) = self.coefficients(terms);
        angular::amplitudes(&a, &b, &AngleSet::new(theta))
    }

    /// As [`DebyeSeries::sum`], blocks of angles shared among all threads.
    pub fn sum_parallel(&self, terms: &[Term], theta: &[f64]) -> Vec<(Complex64, Complex64)> {
        let (a, b) = self.coefficients(terms);
        angular::amplitudes_parallel(&a, &b, &AngleSet::new(theta))
    }

    /// The parts of a_n and b_n (index 0 is n = 1) that belong to some terms.
    pub fn coefficients(&self, terms: &[Term]) -> (Vec<Complex64>, Vec<Complex64>) {
        let of = |waves: &[Interface]| {
            let part = |(k, wave): (usize, &Interface)| {
                terms.iter().map(|term| self.part(k + 1, wave, *term)).sum()
            };
            waves.iter().enumerate().map(part).collect()
        };
        (of(&self.electric), of(&self.magnetic))
    }

    /// What one term contributes to one coefficient.
    fn part(&self, n: usize, wave: &Interface, term: Term) -> Complex64 {
        let diffraction = if n as f64 + 0.5 <= self.size_parameter { 0.5 } else { 0.0 };
        match term {
            Term::Diffraction => diffraction.into(),
            Term::Order(0) => wave.outside - diffraction,
            Term::Order(p) => -0.5 * wave.transmission * wave.internal.powu(p - 1),
            Term::All => wave.outside - 0.5 * wave.all_internal,
        }
    }

    /// The series cut behind an order: see [`Cut`].
    pub fn cut(&self, last: u32) -> Cut {
        let count = self.electric.len();
        let (mut a, mut b) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let (mut electric, mut magnetic) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let mut absorbed = 0.0;
        for (k, (e, m)) in self.electric.iter().zip(&self.magnetic).enumerate() {
            let (e, m) = (e.cut(last), m.cut(last));
            absorbed += (2 * k + 3) as f64 * (e.absorbed + m.absorbed);
            a.push(e.kept);
            b.push(m.kept);
            electric.push(e.behind);
            magnetic.push(m.behind);
        }
        let q_abs = 2.0 / (self.size_parameter * self.size_parameter) * absorbed;
        Cut { a, b, electric, magnetic, q_abs }
    }

    /// What diffraction and all orders up to `last` leave out, relative to Lorenz–Mie without
    /// diffraction: root mean square of the amplitudes over all directions.
    pub fn missing_share(&self, last: u32) -> f64 {
        let (mut missing, mut scattered) = (0.0, 0.0);
        for (k, waves) in self.electric.iter().zip(&self.magnetic).enumerate() {
            for wave in [waves.0, waves.1] {
                let odd = (2 * k + 3) as f64;
                missing += odd * wave.rest(last).norm_sqr();
                let whole = self.part(k + 1, wave, Term::All);
                let diffraction = self.part(k + 1, wave, Term::Diffraction);
                scattered += odd * (whole - diffraction).norm_sqr();
            }
        }
        if missing == 0.0 { 0.0 } else { (missing / scattered).sqrt() }
    }

    /// Largest part of any coefficient that the orders above `order` still hold,
    /// `|½ T R11^order / (1 - R11)|`: the error of stopping there.
    pub fn remainder(&self, order: u32) -> f64 {
        let waves = self.electric.iter().chain(&self.magnetic);
        waves.map(|wave| wave.rest(order).norm()).fold(0.0, f64::max)
    }
}

/// Waves inside, at the surface.
struct Inside {
    /// L⁽¹⁾ and L⁽²⁾ at y.
    outgoing: Complex64,
    incoming: Complex64,
    /// ξ⁽¹⁾/ξ⁽²⁾ at y.
    ratio: Complex64,
    /// 1/ξ⁽²⁾² at y.
    inverse_square: Complex64,
    /// D_n(y) of the regular wave ψ.
    regular: Complex64,
}

/// Beyond this |ξ⁽¹⁾|² the wave does not reach the inside any more: T < 1e-150. Its square is still a
/// number.
const EVANESCENT: f64 = 1e150;

/// `Z_n` is scaled down when it has grown to this.
const TALL: f64 = 1e100;

/// L⁽ʲ⁾, ξ⁽¹⁾/ξ⁽²⁾ and ξ⁽²⁾⁻² at y for n = 1 … `terms`. Carries `Z_n = ξ⁽¹⁾_n exp(-iy)` upward,
/// scaled: `phase Z_n² = ξ⁽¹⁾²`.
fn inside_waves(y: Complex64, terms: usize) -> Vec<Inside> {
    let psi_ratio: Box<dyn Fn(usize) -> Complex64> = if y.im == 0.0 {
        let real = ratios(y.re, terms + 1);
        Box::new(move |n| real[n].into())
    } else {
        let complex = ratios(y, terms + 1);
        Box::new(move |n| complex[n])
    };
    let inverse = 1.0 / y;
    let mut exponent = 2.0 * Complex64::I * y;
    let mut phase = exponent.exp();
    let (mut before, mut z) = (Complex64::ONE, -Complex64::I);
    let mut evanescent = false;
    let mut out = Vec::with_capacity(terms);
    for n in 1..=terms {
        (before, z) = (z, (2 * n - 1) as f64 * inverse * z - before);
        if z.norm_sqr() > TALL * TALL {
            (before, z) = (before / TALL, z / TALL);
            exponent += 2.0 * TALL.ln();
            phase = exponent.exp();
        }
        let outgoing = before / z - n as f64 * inverse;
        let square = phase * z * z;
        evanescent |= square.l1_norm() > EVANESCENT;
        let regular = (n + 1) as f64 * inverse - psi_ratio(n + 1);
        if evanescent {
            (before, z) = (before / z, Complex64::ONE);
            let (ratio, inverse_square) = (-Complex64::ONE, Complex64::ZERO);
            out.push(Inside { outgoing, incoming: outgoing, ratio, inverse_square, regular });
            continue;
        }
        let product = 2.0 * Complex64::I / (outgoing - regular) - square;
        let ratio = square / product;
        out.push(Inside {
            outgoing,
            incoming: outgoing - 2.0 * Complex64::I / product,
            ratio,
            inverse_square: ratio / product,
            regular,
        });
    }
    out
}

/// R22, R11 and T of one partial wave.
fn interface(n: usize, x: f64, kappa: Complex64, inside: &Inside, f: &PsiChi) -> Interface {
    let xi = |n: usize| Complex64::new(f.psi[n], -f.chi[n]);
    let order = n as f64 / x;
    let delta = |derivative: Complex64| (kappa * derivative + order) * xi(n) - xi(n - 1);
    let (incoming, regular) = (delta(inside.incoming), delta(inside.regular));
    let numerator = if n <= f.turning {
        (kappa * inside.incoming + order) * f.psi[n] - f.psi[n - 1]
    } else {
        let derivative = (n + 1) as f64 / x - f.ratio[n + 1];
        (kappa * inside.incoming - derivative) * f.psi[n]
    };
    Interface {
        outside: numerator / incoming,
        internal: -inside.ratio * delta(inside.outgoing) / incoming,
        transmission: -4.0 * kappa * inside.inverse_square / (incoming * incoming),
        all_internal: -2.0 * Complex64::I * kappa * (inside.incoming - inside.regular)
            / (incoming * regular),
        // Without cancellation, as in `lorenz_mie.rs`: Δ from D is its N - iQ.
        absorbed: -(kappa * inside.regular).im / regular.norm_sqr(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The closed form of all internal orders against the geometric sum it stands for.
    #[test]
    fn closed_form_is_the_geometric_sum() {
        for m in [Complex64::new(1.333, 0.0), Complex64::new(1.333, 1e-3), Complex64::new(1.5, 0.5)]
        {
            let series = DebyeSeries::new(300.0, m).unwrap();
            for wave in series.electric.iter().chain(&series.magnetic) {
                let product = wave.all_internal * (1.0 - wave.internal);
                let error = (product - wave.transmission).norm();
                assert!(error < 1e-11, "m {m}: {error:e}");
            }
        }
    }

    /// A transparent surface conserves energy: |R11|² + |T| = 1 for every partial wave.
    #[test]
    fn transparent_surface_conserves_energy() {
        let series = DebyeSeries::new(300.0, Complex64::new(1.333, 0.0)).unwrap();
        for wave in series.electric.iter().chain(&series.magnetic) {
            let sum = wave.internal.norm_sqr() + wave.transmission.norm();
            assert!((sum - 1.0).abs() < 1e-11, "{sum}");
            let outside = 1.0 - 2.0 * wave.outside;
            assert!((outside.norm() - wave.internal.norm()).abs() < 1e-11);
        }
    }

    #[test]
    fn no_interface_no_scattering() {
        let series = DebyeSeries::new(50.0, Complex64::ONE).unwrap();
        let (a, b) = series.coefficients(&[Term::All]);
        assert!(a.iter().chain(&b).all(|c| c.norm() < 1e-12));
        assert!(series.electric.iter().take(50).all(|w| w.internal.norm() < 1e-12));
    }
}
