//! Steps of the fourth-order Magnus integration, eight partial waves at once.
//!
//! Both systems read `y' = A y` with a traceless 2 × 2 matrix; over a step h with the Gauss nodes 1, 2
//! (Magnus 1954; Iserles & Nørsett 1999)
//! ```text
//! Ω = h/2 (A₁ + A₂) + (√3/12) h² [A₂, A₁] = ( d  u )     e^Ω = cosh w + Ω sinh w/w,  w² = d² + u v
//!                                           ( v -d )
//! ```
//! u, v, d are affine in l(l+1). `cosh(w/2)` and `sinh(w/2)/(w/2)` are power series in w²/4, doubled
//! once: no branch between the oscillating and the evanescent side, and no roots.

use crate::math::fused::multiply_add;
use multiversion::multiversion;
use multiversion::target::target_cfg_f;
use num_complex::Complex64;

/// Partial waves carried together.
pub(super) const LANES: usize = 8;
pub(super) type Lanes = [f64; LANES];

/// 1/(2k)! and 1/(2k+1)!: for `|w²/4| < 4` what is left out is below 2e-13 of the largest term, and
/// below rounding where waves oscillate (`|w²/4| < 0.3`).
const COSH: [f64; 10] = [
    1.0,
    1.0 / 2.0,
    1.0 / 24.0,
    1.0 / 720.0,
    1.0 / 40_320.0,
    1.0 / 3_628_800.0,
    1.0 / 479_001_600.0,
    1.0 / 87_178_291_200.0,
    1.0 / 20_922_789_888_000.0,
    1.0 / 6_402_373_705_728_000.0,
];
const SINH: [f64; 10] = [
    1.0,
    1.0 / 6.0,
    1.0 / 120.0,
    1.0 / 5_040.0,
    1.0 / 362_880.0,
    1.0 / 39_916_800.0,
    1.0 / 6_227_020_800.0,
    1.0 / 1_307_674_368_000.0,
    1.0 / 355_687_428_096_000.0,
    1.0 / 121_645_100_408_832_000.0,
];
/// Steps between which fields are brought back to 1.
const RESCALE: usize = 16;

/// u, d, v of one polarisation; d and v as `first + l(l+1) second`.
#[derive(Clone, Copy, Debug)]
struct Generator<T> {
    u: T,
    d: [T; 2],
    v: [T; 2],
}

/// One step for both polarisations.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step<T> {
    magnetic: Generator<T>,
    electric: Generator<T>,
}

impl Step<Complex64> {
    /// A step between two radii for a size parameter, with `n²` at radius r.
    pub fn new(from: f64, to: f64, x: f64, squared: impl Fn(f64) -> Complex64) -> Self {
        let offset = 0.5 / 3f64.sqrt();
        let step = to - from;
        let (r1, r2) = (from + step * (0.5 - offset), from + step * (0.5 + offset));
        let (n1, n2) = (squared(r1), squared(r2));
        let (i1, i2) = (1.0 / (r1 * r1 * x * x), 1.0 / (r2 * r2 * x * x));
        let (j1, j2) = (i1 / n1, i2 / n2);
        let h = step * x;
        let w = 3f64.sqrt() / 12.0 * h * h;
        let half = 0.5 * h;
        Step {
            magnetic: Generator {
                u: h.into(),
                d: [w * (n2 - n1), (w * (i1 - i2)).into()],
                v: [-half * (n1 + n2), (half * (i1 + i2)).into()],
            },
            electric: Generator {
                u: half * (n1 + n2),
                d: [w * (n1 - n2), w * (n2 * j1 - n1 * j2)],
                v: [(-h).into(), half * (j1 + j2)],
            },
        }
    }

    /// Without absorption.
    pub fn real(&self) -> Step<f64> {
        let real = |g: &Generator<Complex64>| Generator {
            u: g.u.re,
            d: g.d.map(|value| value.re),
            v: g.v.map(|value| value.re),
        };
        Step { magnetic: real(&self.magnetic), electric: real(&self.electric) }
    }
}

/// Field and conjugate of the two polarisations.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fields<F> {
    pub magnetic: [F; 2],
    pub electric: [F; 2],
}

/// Numbers in lanes.
pub(super) trait Field: Copy {
    type Scalar: Copy;
    /// `first + l(l+1) second`.
    fn affine<const FMA: bool>(coefficients: &[Self::Scalar; 2], ll: &Lanes) -> Self;
    fn splat(value: Self::Scalar) -> Self;
    fn real(value: f64) -> Self;
    fn times<const FMA: bool>(self, other: Self) -> Self;
    /// `self · factor + add`.
    fn fused<const FMA: bool>(self, factor: Self, add: Self) -> Self;
    fn negative(self) -> Self;
    /// Divide both by their size.
    fn rescale(pair: &mut [Self; 2]);
}

/// Real numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Real(pub Lanes);

/// Complex numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Complex {
    pub re: Lanes,
    pub im: Lanes,
}

#[inline(always)]
fn each(f: impl Fn(usize) -> f64) -> Lanes {
    let mut out = [0.0; LANES];
    for (l, value) in out.iter_mut().enumerate() {
        *value = f(l);
    }
    out
}

impl Field for Real {
    type Scalar = f64;
    #[inline(always)]
    fn affine<const FMA: bool>(c: &[f64; 2], ll: &Lanes) -> Self {
        Real(each(|l| multiply_add::<FMA>(ll[l], c[1], c[0])))
    }
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Real([value; LANES])
    }
    #[inline(always)]
    fn real(value: f64) -> Self {
        Real([value; LANES])
    }
    #[inline(always)]
    fn times<const FMA: bool>(self, other: Self) -> Self {
        Real(each(|l| self.0[l] * other.0[l]))
    }
    #[inline(always)]
    fn fused<const FMA: bool>(self, factor: Self, add: Self) -> Self {
        Real(each(|l| multiply_add::<FMA>(self.0[l], factor.0[l], add.0[l])))
    }
    #[inline(always)]
    fn negative(self) -> Self {
        Real(each(|l| -self.0[l]))
    }
    #[inline(always)]
    fn rescale([p, q]: &mut [Self; 2]) {
        for l in 0..LANES {
            let inverse = 1.0 / (p.0[l].abs() + q.0[l].abs());
            p.0[l] *= inverse;
            q.0[l] *= inverse;
        }
    }
}

impl Field for Complex {
    type Scalar = Complex64;
    #[inline(always)]
    fn affine<const FMA: bool>(c: &[Complex64; 2], ll: &Lanes) -> Self {
        Complex {
            re: each(|l| multiply_add::<FMA>(ll[l], c[1].re, c[0].re)),
            im: each(|l| multiply_add::<FMA>(ll[l], c[1].im, c[0].im)),
        }
    }
    #[inline(always)]
    fn splat(value: Complex64) -> Self {
        Complex { re: [value.re; LANES], im: [value.im; LANES] }
    }
    #[inline(always)]
    fn real(value: f64) -> Self {
        Complex { re: [value; LANES], im: [0.0; LANES] }
    }
    #[inline(always)]
    fn times<const FMA: bool>(self, o: Self) -> Self {
        let fma = multiply_add::<FMA>;
        Complex {
            re: each(|l| fma(self.re[l], o.re[l], -(self.im[l] * o.im[l]))),
            im: each(|l| fma(self.re[l], o.im[l], self.im[l] * o.re[l])),
        }
    }
    #[inline(always)]
    fn fused<const FMA: bool>(self, f: Self, add: Self) -> Self {
        let fma = multiply_add::<FMA>;
        Complex {
            re: each(|l| fma(self.re[l], f.re[l], fma(-self.im[l], f.im[l], add.re[l]))),
            im: each(|l| fma(self.re[l], f.im[l], fma(self.im[l], f.re[l], add.im[l]))),
        }
    }
    #[inline(always)]
    fn negative(self) -> Self {
        Complex { re: each(|l| -self.re[l]), im: each(|l| -self.im[l]) }
    }
    #[inline(always)]
    fn rescale([p, q]: &mut [Self; 2]) {
        for l in 0..LANES {
            let size = p.re[l].abs() + p.im[l].abs() + q.re[l].abs() + q.im[l].abs();
            let inverse = 1.0 / size;
            for value in [&mut p.re[l], &mut p.im[l], &mut q.re[l], &mut q.im[l]] {
                *value *= inverse;
            }
        }
    }
}

/// Carry eight real waves over steps.
#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
pub(super) fn advance_real(steps: &[Step<f64>], ll: &Lanes, fields: &mut Fields<Real>) {
    if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
        advance::<true, Real>(steps, ll, fields);
    } else {
        advance::<false, Real>(steps, ll, fields);
    }
}

/// Carry eight complex waves over steps.
#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
pub(super) fn advance_complex(steps: &[Step<Complex64>], ll: &Lanes, fields: &mut Fields<Complex>) {
    if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
        advance::<true, Complex>(steps, ll, fields);
    } else {
        advance::<false, Complex>(steps, ll, fields);
    }
}

#[inline(always)]
fn advance<const FMA: bool, F: Field>(
    steps: &[Step<F::Scalar>],
    ll: &Lanes,
    fields: &mut Fields<F>,
) {
    let mut own = *fields;
    for stretch in steps.chunks(RESCALE) {
        for step in stretch {
            turn::<FMA, F>(&step.magnetic, ll, &mut own.magnetic);
            turn::<FMA, F>(&step.electric, ll, &mut own.electric);
        }
        F::rescale(&mut own.magnetic);
        F::rescale(&mut own.electric);
    }
    *fields = own;
}

/// `y → e^Ω y`.
#[inline(always)]
fn turn<const FMA: bool, F: Field>(g: &Generator<F::Scalar>, ll: &Lanes, y: &mut [F; 2]) {
    let (u, d, v) = (F::splat(g.u), F::affine::<FMA>(&g.d, ll), F::affine::<FMA>(&g.v, ll));
    let quarter = d.fused::<FMA>(d, u.times::<FMA>(v)).times::<FMA>(F::real(0.25));
    let (mut cosh, mut sinh) = (F::real(COSH[9]), F::real(SINH[9]));
    for k in (0..9).rev() {
        cosh = cosh.fused::<FMA>(quarter, F::real(COSH[k]));
        sinh = sinh.fused::<FMA>(quarter, F::real(SINH[k]));
    }
    // cosh w = 2 cosh²(w/2) - 1, sinh w / w = cosh(w/2) sinh(w/2)/(w/2)
    sinh = sinh.times::<FMA>(cosh);
    let doubled = cosh.times::<FMA>(F::real(2.0));
    cosh = doubled.fused::<FMA>(cosh, F::real(-1.0));
    let [p, q] = *y;
    let along_p = d.fused::<FMA>(p, u.times::<FMA>(q));
    let along_q = v.fused::<FMA>(p, d.negative().times::<FMA>(q));
    *y = [
        sinh.fused::<FMA>(along_p, cosh.times::<FMA>(p)),
        sinh.fused::<FMA>(along_q, cosh.times::<FMA>(q)),
    ];
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A constant index: e^Ω of a step is a rotation by the optical length where l = 0.
    #[test]
    fn constant_index_turns_by_the_optical_length() {
        for n in [Complex64::new(1.4, 0.0), Complex64::new(1.2, 0.3)] {
            let steps: Vec<Step<Complex64>> = (0..40)
                .map(|k| Step::new(0.5 + 0.01 * k as f64, 0.51 + 0.01 * k as f64, 50.0, |_| n * n))
                .collect();
            let zero = Complex { re: [0.0; LANES], im: [0.0; LANES] };
            let one = Complex { re: [1.0; LANES], im: [0.0; LANES] };
            let mut fields = Fields { magnetic: [zero, one], electric: [zero, one] };
            advance_complex(&steps, &[0.0; LANES], &mut fields);
            let value = |f: Complex| Complex64::new(f.re[3], f.im[3]);
            let right = (n * 20.0).tan() / n;
            assert!((value(fields.magnetic[0]) / value(fields.magnetic[1]) - right).norm() < 1e-11);
            let right = (n * 20.0).tan() * n;
            assert!((value(fields.electric[0]) / value(fields.electric[1]) - right).norm() < 1e-11);
        }
    }
}
