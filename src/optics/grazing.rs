//! Fresnel coefficients of a *curved* interface near grazing incidence.
//!
//! A plane wave's `cos θ` at the interface stands for the logarithmic derivative of the wave outside.
//! On a curved surface that wave is a Hankel function with a turning point, for which Olver's uniform
//! expansion gives Airy functions of `w = η e^{-iπ/3}` (Abramowitz & Stegun 9.3.37–45):
//! `η^{3/2} = (3/2) x ρ (sin γ - γ cos γ)`, γ the grazing angle, ρ the radius of curvature in the
//! plane of incidence. With `A = Ai(w)/asymptote` and `Λ = cos θ · (Ai'/asymptote')/A`, every
//! coefficient keeps its form: `r = (… - Λ)/(… + Λ)`, `t = 2 √(cos θ m cos θt)/(… + Λ)/A`, as the
//! coefficients of the Debye series show. The correction is of the order of `1/(x ρ cos³ θ)`: 10 %
//! per ray for the high orders whose bows are made near the rim.

use crate::math::scalar::Scalar;
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_3, FRAC_PI_6, PI};
use std::sync::OnceLock;

/// What replaces the cosine outside.
#[derive(Clone, Copy, Debug)]
pub struct Grazing {
    /// Λ: `cos θ` where the interface looks flat.
    pub lambda: Complex64,
    /// `√cos θ / A`.
    pub root: Complex64,
    /// `Λ` and `A*/A` of the incoming wave, for reflection outside.
    pub lambda_in: Complex64,
    /// Phase of the way from the turning point to the surface and back, as a factor.
    pub turn: Complex64,
}

/// Beyond this η the interface counts as flat.
const FLAT: f64 = 45.0;
/// The correction is faded out with `exp(-(η/FADE)²)`: where it is small, the next term of the
/// stationary-phase expansion, which is not carried here, is as large and of opposite sign
/// (for the sphere 1/12 against 5/12 of `i/(x cos³ θ)`, with more near a bow). Chosen where both
/// forms have the same error against exact Debye terms (p = 2, 3, x = 5000).
const FADE: f64 = 13.0;
/// Beyond this the asymptotic series of the Airy functions serve.
const SERIES: f64 = 9.0;

impl Grazing {
    /// For the square of the cosine outside (negative under total reflection), and the size
    /// parameter of the radius of curvature.
    pub fn new<T: Scalar>(cos_squared: T, curvature_size: f64) -> Self {
        let s = cos_squared.complex();
        // η is no less than s (xρ/2)^{2/3}
        if T::REAL && s.re > 0.0 && s.re.powi(3) * (0.5 * curvature_size).powi(2) > FLAT.powi(3) {
            return Self::flat(s);
        }
        let eta = eta_of(s, curvature_size);
        if eta.norm_sqr() > FLAT * FLAT {
            return Self::flat(s);
        }
        let share = (-(eta / FADE) * (eta / FADE)).exp();
        if eta.norm_sqr() > SERIES * SERIES && eta.re > 0.0 {
            return Self::series(s, eta).faded(s, share);
        }
        match Self::airy(eta, s, curvature_size) {
            Some((found, wave)) => found.with_phase(wave).faded(s, share),
            None => Self::flat(s),
        }
    }

    /// The same for integrals over rays, which need no fading: `root` carries the phase that the
    /// wave outside gathers between its turning point and the surface, `exp(-i ⅔ η^{3/2})`, so that
    /// it is analytic through grazing incidence. A path that goes with it must have
    /// [`Grazing::path_outside`] added.
    pub fn whole(cos_squared: f64, curvature_size: f64) -> Self {
        let s = Complex64::from(cos_squared);
        let eta = eta_of(s, curvature_size);
        if eta.re > SERIES {
            let wave = Complex64::cis(-(2.0 / 3.0) * eta.re * eta.re.sqrt());
            let found = Self::series(s, eta);
            return Self { root: found.root * wave, ..found };
        }
        Self::airy(eta, s, curvature_size).map_or_else(|| Self::flat(s), |(found, _)| found)
    }

    /// External reflection, perpendicular and parallel, as a partial wave of an impact has it: with
    /// the phase of the way from the turning point to the surface and back, analytic through grazing
    /// incidence, 1 far beyond (nothing taken from the wave): the `R` in the Debye series'
    /// `(1 - R)/2`, with Airy functions for Hankel functions outside and a flat interface inside.
    /// For the square of the cosine outside (negative beyond), the size parameter of the radius of
    /// curvature, and the index inside.
    pub fn reflection(cos_squared: f64, curvature_size: f64, index: Complex64) -> [Complex64; 2] {
        let s = Complex64::from(cos_squared);
        let eta = eta_of(s, curvature_size);
        let (found, turn) = if eta.re > SERIES {
            let found = if eta.re > FLAT { Self::flat(s) } else { Self::series(s, eta) };
            (found, found.turn * Complex64::cis(-(4.0 / 3.0) * eta.re * eta.re.sqrt()))
        } else {
            Self::airy(eta, s, curvature_size).map_or_else(
                || (Self::flat(s), Complex64::from(1.0)),
                |(found, _)| (found, found.turn),
            )
        };
        let square = 1.0 - (1.0 - s) / (index * index);
        let mut inside = square.root();
        if inside.im < 0.0 && square.re < 0.0 {
            inside = -inside;
        }
        // Hankel functions differ from their waves by -π/4 each
        let turn = Complex64::i() * turn;
        let (a, b) = (found.lambda_in, found.lambda);
        [
            turn * (a - index * inside) / (b + index * inside),
            turn * (index * a - inside) / (index * b + inside),
        ]
    }

    /// Path from the turning point of the wave outside to the surface, per radius of curvature:
    /// `sin γ - γ cos γ` for the sine of the grazing angle.
    pub fn path_outside(sin: f64) -> f64 {
        sin - sin.asin() * (1.0 - sin * sin).max(0.0).sqrt()
    }

    /// Airy functions of `η`; `root` and `turn` without the phase of the wave, `i ⅔ η^{3/2}`, which
    /// stands beside them.
    fn airy(eta: Complex64, s: Complex64, curvature_size: f64) -> Option<(Self, Complex64)> {
        let scale = shape_ratio(s).inv().root() / (0.5 * curvature_size).cbrt();
        let (out, inward) = if eta.im == 0.0 {
            let out = real_airy_pair(eta.re)?;
            (out, (out.0.conj(), out.1.conj()))
        } else {
            (airy_pair(eta, -1.0)?, airy_pair(eta, 1.0)?)
        };
        // √cos θ η^{-1/4} is smooth through grazing incidence
        let asymptote =
            |sign: f64| scale.root() * Complex64::from_polar(0.5 / PI.sqrt(), -sign * PI / 12.0);
        let (root, root_in) = (asymptote(-1.0) / out.0, asymptote(1.0) / inward.0);
        let found = Self {
            lambda: -Complex64::cis(FRAC_PI_6) * out.1 / out.0 * scale,
            root,
            lambda_in: -Complex64::cis(-FRAC_PI_6) * inward.1 / inward.0 * scale,
            turn: root / root_in,
        };
        Some((found, Complex64::i() * (2.0 / 3.0) * eta * eta.root()))
    }

    /// The phase of the wave put back into `root` and `turn`.
    fn with_phase(self, wave: Complex64) -> Self {
        Self { root: self.root * wave.exp(), turn: self.turn * (2.0 * wave).exp(), ..self }
    }

    /// Part of the way from the flat interface to this one.
    fn faded(self, cos_squared: Complex64, share: Complex64) -> Self {
        let flat = Self::flat(cos_squared);
        let mix = |from: Complex64, to: Complex64| from + share * (to - from);
        Self {
            lambda: mix(flat.lambda, self.lambda),
            root: mix(flat.root, self.root),
            lambda_in: mix(flat.lambda_in, self.lambda_in),
            turn: mix(flat.turn, self.turn),
        }
    }

    /// A flat interface.
    pub fn flat(cos_squared: Complex64) -> Self {
        let mut cos = cos_squared.root();
        if cos.im < 0.0 && cos_squared.re < 0.0 {
            cos = -cos;
        }
        let one = Complex64::new(1.0, 0.0);
        Self { lambda: cos, root: cos.root(), lambda_in: cos, turn: one }
    }

    /// Asymptotic series in `1/(i ⅔ η^{3/2})` (Abramowitz & Stegun 10.4.59–62).
    fn series(s: Complex64, eta: Complex64) -> Self {
        let big = Complex64::i() * (2.0 / 3.0) * eta * eta.root();
        let cos = s.root();
        let sums = |z: Complex64| {
            // Ai(w) with ⅔ w^{3/2} = z: Σ (-1)^k c_k z^{-k}, Ai': Σ (-1)^k d_k z^{-k}
            const C: [f64; 6] = [
                1.0,
                0.069444444444,
                0.037133487654,
                0.037993059128,
                0.057649190412,
                0.116099064026,
            ];
            const D: [f64; 6] = [
                1.0,
                -0.097222222222,
                -0.043885030864,
                -0.042462830889,
                -0.062662163492,
                -0.124105896027,
            ];
            let (mut a, mut b) = (Complex64::default(), Complex64::default());
            for k in (0..C.len()).rev() {
                a = -a / z + C[k];
                b = -b / z + D[k];
            }
            (a, b)
        };
        // w = η e^{-iπ/3}: ⅔ w^{3/2} = -i ⅔ η^{3/2}
        let (a, b) = sums(-big);
        let (a_in, b_in) = sums(big);
        Self {
            lambda: cos * b / a,
            root: cos.root() / a,
            lambda_in: cos * b_in / a_in,
            turn: a_in / a,
        }
    }
}

/// Below this `G/s` is its series.
const SERIES_OF_RATIO: f64 = 1e-3;

/// `G(s)/s` with `G = [3 (sin γ - γ cos γ)]^{2/3}` and `s = sin² γ`; analytic through `s = 0`.
fn shape_ratio(s: Complex64) -> Complex64 {
    if s.norm() < SERIES_OF_RATIO {
        return 1.0 + s * (4.0 / 15.0) + s * s * 0.1428;
    }
    if s.im == 0.0 {
        return real_shape_ratio(s.re).into();
    }
    let gamma = s.root().asin();
    let cubic = 3.0 * (gamma.sin() - gamma * gamma.cos()) / (gamma * gamma * gamma);
    cubic.powf(2.0 / 3.0) * gamma * gamma / s
}

/// The same for real `s`; below 0 the angle is imaginary and the ratio real all the same.
fn real_shape_ratio(s: f64) -> f64 {
    (3.0 * area(s)).powf(2.0 / 3.0) / s.abs()
}

/// `|sin γ - γ cos γ|`
fn area(s: f64) -> f64 {
    let size = s.abs().sqrt();
    if s > 0.0 {
        size - size.min(1.0).asin() * (1.0 - size * size).max(0.0).sqrt()
    } else {
        size.asinh() * (1.0 + size * size).sqrt() - size
    }
}

/// `η` for the squared cosine outside and the size parameter of the radius of curvature.
fn eta_of(s: Complex64, curvature_size: f64) -> Complex64 {
    if s.im == 0.0 && s.re.abs() >= SERIES_OF_RATIO {
        return (1.5 * area(s.re) * curvature_size).powf(2.0 / 3.0).copysign(s.re).into();
    }
    s * shape_ratio(s) * (0.5 * curvature_size).powf(2.0 / 3.0)
}

/// `Ai(η e^{±iπ/3})` and its derivative.
fn airy_pair(eta: Complex64, sign: f64) -> Option<(Complex64, Complex64)> {
    let w = eta * Complex64::cis(sign * FRAC_PI_3);
    Some((complex_bessel::airy(w).ok()?, complex_bessel::airyprime(w).ok()?))
}

/// The outgoing pair for real η, from a table: real rays ask for it at every surface point.
fn real_airy_pair(eta: f64) -> Option<(Complex64, Complex64)> {
    const FROM: f64 = -16.0;
    const PER_UNIT: f64 = 64.0;
    const COUNT: usize = ((SERIES + 1.0 - FROM) * PER_UNIT) as usize + 2;
    static TABLE: OnceLock<Vec<Option<(Complex64, Complex64)>>> = OnceLock::new();
    let table = TABLE.get_or_init(|| {
        (0..COUNT).map(|i| airy_pair((FROM + i as f64 / PER_UNIT).into(), -1.0)).collect()
    });
    let place = (eta - FROM) * PER_UNIT;
    if !(place >= 0.0 && place < (COUNT - 1) as f64) {
        return airy_pair(eta.into(), -1.0);
    }
    let i = place as usize;
    let t = place - i as f64;
    let ((a0, b0), (a1, b1)) = (table[i]?, table[i + 1]?);
    // d/dη of Ai(w) is e^{-iπ/3} Ai'(w), and Ai'' = w Ai
    let turn = Complex64::cis(-FRAC_PI_3);
    let h = 1.0 / PER_UNIT;
    let (w0, w1) = (turn * (FROM + i as f64 * h), turn * (FROM + (i + 1) as f64 * h));
    let hermite = |v0: Complex64, v1: Complex64, s0: Complex64, s1: Complex64| {
        let d = v1 - v0;
        v0 + (d + ((s0 * h - d) * (1.0 - t) + (d - s1 * h) * t) * (1.0 - t)) * t
    };
    Some((hermite(a0, a1, turn * b0, turn * b1), hermite(b0, b1, turn * w0 * a0, turn * w1 * a1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Series and library agree where they meet, and both tend to the flat interface.
    #[test]
    fn the_three_forms_agree() {
        for (cos, size) in [(0.2f64, 5000.0), (0.35, 1000.0)] {
            let eta =
                shape_ratio((cos * cos).into()).re * cos * cos * (0.5f64 * size).powf(2.0 / 3.0);
            assert!(eta > 3.0, "{eta}");
        }
        let size = 2.0 * (SERIES / (0.09 * shape_ratio(0.09.into()).re)).powf(1.5);
        let (below, above) = (Grazing::new(0.09, size * 0.9999), Grazing::new(0.09, size * 1.0001));
        assert!((below.lambda - above.lambda).norm() < 1e-5 * below.lambda.norm());
        assert!((below.root - above.root).norm() < 1e-4 * below.root.norm());
        assert!((below.turn - above.turn).norm() < 1e-4);
        let far = Grazing::new(0.25, 1e7);
        assert!((far.lambda - 0.5).norm() < 1e-4 && (far.root - 0.5f64.sqrt()).norm() < 1e-4);
    }

    #[test]
    fn table_meets_the_library() {
        for i in 0..2000 {
            let eta = -15.0 + i as f64 * 0.01203;
            let (a, b) = real_airy_pair(eta).unwrap();
            let (ea, eb) = airy_pair(eta.into(), -1.0).unwrap();
            assert!((a - ea).norm() < 1e-6 * ea.norm() && (b - eb).norm() < 1e-6 * eb.norm());
        }
    }

    #[test]
    fn shape_ratio_is_continuous() {
        let a = shape_ratio(Complex64::new(0.99999e-3, 0.0));
        let b = shape_ratio(Complex64::new(1.00001e-3, 0.0));
        assert!((a - b).norm() < 1e-7, "{a} {b}");
        for s in [-0.3, -0.01, 0.01, 0.5, 0.99] {
            let beside = shape_ratio(Complex64::new(s, 1e-13));
            assert!((beside - real_shape_ratio(s)).norm() < 1e-10, "{s}: {beside}");
        }
    }
}
