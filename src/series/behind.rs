//! The mean power of the orders behind a cut of the Debye series.
//!
//! A mean over sizes is a mean over the size parameter x, and two orders p ≠ q differ in phase by
//! about `x (W_p - W_q)`: their interference averages out, but for pairs of partial waves n, n+d
//! and p - q = 0, ±1 whose phases keep step while x changes. Their sum over all orders behind the
//! cut is geometric,
//! ```text
//! Σ_{p>last} t_n t*_m u^(p-last-1) = t_n t*_m / (1 - u)        u = R11_n R11*_m
//! ```
//! with `t = ½ T R11^last`, and for p - q = ±1 the same times 1/R11_n or 1/R11*_m. Where |u| → 1
//! (the resonances) this is a sharp function of x, but u itself is smooth; between two sizes it
//! runs as a spiral, on which the mean of `1/(1 - u)` is `1 - ln((1 - u₁)/(1 - u₀))/ln(u₁/u₀)`.
//! So no resonance, however narrow, needs a sample of its own.

use super::debye::Behind;
use multiversion::multiversion;
use num_complex::Complex64;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Pairs of partial waves up to this distance keep step long enough to count. Measured: 8 and 16
/// differ by less than 1e-6 behind order 24, by less than 1e-4 behind order 8.
const PAIRS: usize = 9;
/// Waves with less power than this behind the cut are left out.
const FAINT: f64 = 1e-13;
/// Where u turns by less than this fraction of |1 - u| the mean of both ends is as good.
const STRAIGHT: f64 = 1e-3;

/// Mean products of the waves n and n + d.
#[derive(Clone, Copy, Debug, Default)]
struct Pair {
    /// a_n a*_m, b_n b*_m, a_n b*_m, b_n a*_m.
    aa: Complex64,
    bb: Complex64,
    ab: Complex64,
    ba: Complex64,
}

/// Sums of products over sizes; index `(n - 1) * PAIRS + d`.
#[derive(Clone, Debug, Default)]
pub(super) struct Products {
    pairs: Vec<Pair>,
}

/// The waves behind the cut of one size.
#[derive(Clone, Debug)]
pub(super) struct Waves {
    pub electric: Vec<Behind>,
    pub magnetic: Vec<Behind>,
    /// What this size counts.
    pub weight: f64,
}

impl Products {
    /// Add the stretch between two neighbouring sizes, both of which count half.
    pub fn add_stretch(&mut self, from: &Waves, to: &Waves) {
        let count = from.electric.len().min(to.electric.len());
        let power = |wave: &Behind| wave.first.norm_sqr() / (1.0 - wave.internal.norm_sqr());
        let counts = |n: usize| {
            let waves = [&from.electric[n], &from.magnetic[n], &to.electric[n], &to.magnetic[n]];
            waves.iter().any(|wave| wave.first.norm_sqr() > 0.0 && power(wave) > FAINT)
        };
        let Some(first) = (0..count).find(|&n| counts(n)) else { return };
        let last = (first..count).rfind(|&n| counts(n)).unwrap_or(first);
        if self.pairs.len() < (last + 1) * PAIRS {
            self.pairs.resize((last + 1) * PAIRS, Pair::default());
        }
        let [electric, magnetic] = [
            stretches(&from.electric, &to.electric, from.weight, to.weight),
            stretches(&from.magnetic, &to.magnetic, from.weight, to.weight),
        ];
        for n in first..=last {
            for d in 0..PAIRS.min(last + 1 - n) {
                let pair = &mut self.pairs[n * PAIRS + d];
                pair.aa += electric[n].mean(&electric[n + d]);
                pair.bb += magnetic[n].mean(&magnetic[n + d]);
                pair.ab += electric[n].mean(&magnetic[n + d]);
                pair.ba += magnetic[n].mean(&electric[n + d]);
            }
        }
    }

    /// Add another sum.
    pub fn add(&mut self, other: &Products) {
        if self.pairs.len() < other.pairs.len() {
            self.pairs.resize(other.pairs.len(), Pair::default());
        }
        for (sum, pair) in self.pairs.iter_mut().zip(&other.pairs) {
            sum.aa += pair.aa;
            sum.bb += pair.bb;
            sum.ab += pair.ab;
            sum.ba += pair.ba;
        }
    }

    /// Number of partial waves that count.
    pub fn waves(&self) -> usize {
        self.pairs.len() / PAIRS
    }

    /// S11, S12, S33 and S34 at scattering angles (radians).
    pub fn elements(&self, theta: &[f64]) -> Vec<[f64; 4]> {
        let factors: Vec<Factors> = self.pairs.iter().map(Factors::new).collect();
        let mut out = vec![[0.0; 4]; theta.len()];
        out.par_chunks_mut(LANES).zip(theta.par_chunks(LANES)).for_each(|(out, theta)| {
            let mut cosines = [0.0; LANES];
            cosines.iter_mut().zip(theta).for_each(|(cosine, theta)| *cosine = theta.cos());
            let sums = elements_at(&factors, &angular(self.waves(), &cosines));
            for (l, row) in out.iter_mut().enumerate() {
                *row = sums.map(|lanes| lanes[l]);
            }
        });
        out
    }

    /// Σ (2n+1)(|a_n|² + |b_n|²), and the sum of Bohren & Huffman's sec. 4.5 for the asymmetry.
    pub fn sums(&self) -> (f64, f64) {
        let (mut scattered, mut forward) = (0.0, 0.0);
        for (k, pairs) in self.pairs.chunks_exact(PAIRS).enumerate() {
            let n = (k + 1) as f64;
            scattered += (2.0 * n + 1.0) * (pairs[0].aa.re + pairs[0].bb.re);
            forward += (2.0 * n + 1.0) / (n * (n + 1.0)) * pairs[0].ab.re;
            forward += n * (n + 2.0) / (n + 1.0) * (pairs[1].aa.re + pairs[1].bb.re);
        }
        (scattered, forward)
    }
}

/// One wave on the way from one size to the next.
#[derive(Clone, Copy)]
struct Stretch {
    /// First order behind the cut, with the root of the weight, at both ends.
    first: [Complex64; 2],
    internal: [Complex64; 2],
    /// 1/R11, or 0 where nothing turns.
    inverse: [Complex64; 2],
    /// ln of the change of R11.
    turn: Complex64,
}

fn stretches(from: &[Behind], to: &[Behind], before: f64, after: f64) -> Vec<Stretch> {
    let inverse = |r: Complex64| if r.norm_sqr() < 1e-6 { Complex64::ZERO } else { r.inv() };
    let (before, after) = ((0.5 * before).sqrt(), (0.5 * after).sqrt());
    from.iter()
        .zip(to)
        .map(|(a, b)| Stretch {
            first: [a.first * before, b.first * after],
            internal: [a.internal, b.internal],
            inverse: [inverse(a.internal), inverse(b.internal)],
            turn: (b.internal / a.internal).ln(),
        })
        .collect()
}

impl Stretch {
    /// Mean of the geometric sum of the products with another wave, times the weight.
    fn mean(&self, other: &Stretch) -> Complex64 {
        let end = |k: usize| {
            let steps = 1.0 + self.inverse[k] + other.inverse[k].conj();
            let power = self.first[k] * other.first[k].conj() * steps;
            (power, self.internal[k] * other.internal[k].conj())
        };
        let ((p0, u0), (p1, u1)) = (end(0), end(1));
        let (d0, d1) = (1.0 - u0, 1.0 - u1);
        let (n0, n1) = (d0.norm_sqr(), d1.norm_sqr());
        if n0.min(n1) < f64::EPSILON * f64::EPSILON {
            return Complex64::ZERO;
        }
        let turn = (u1 - u0).norm_sqr();
        if turn < STRAIGHT * n0.min(n1) || turn < 1e-28 {
            return p0 * d0.conj() / n0 + p1 * d1.conj() / n1;
        }
        // ln(u₁/u₀), its angle between -π and π.
        let mut spiral = self.turn + other.turn.conj();
        spiral.im -= TAU * (spiral.im / TAU).round();
        // Both lie in the right half plane, so that the ln of the ratio is that of the two.
        (p0 + p1) * (1.0 - (d1 * d0.conj() / n0).ln() / spiral)
    }
}

/// Angles carried together.
const LANES: usize = 16;
type Lanes = [f64; LANES];

/// What a pair of waves counts for the products of π_n, τ_n with those of its partner.
#[derive(Clone, Copy, Debug)]
struct Factors {
    same: f64,
    mixed: f64,
    same_difference: f64,
    mixed_difference: f64,
    same_skew: f64,
    mixed_skew: f64,
}

impl Factors {
    fn new(Pair { aa, bb, ab, ba }: &Pair) -> Self {
        Self {
            same: aa.re + bb.re,
            mixed: ab.re + ba.re,
            same_difference: aa.re - bb.re,
            mixed_difference: ab.re - ba.re,
            same_skew: aa.im - bb.im,
            mixed_skew: ab.im - ba.im,
        }
    }
}

/// S11, S12, S33 and S34 at some angles from π_n and τ_n there.
#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
fn elements_at(factors: &[Factors], angular: &[(Lanes, Lanes)]) -> [Lanes; 4] {
    let mut total = [[0.0; LANES]; 4];
    for (n, (p, t)) in angular.iter().enumerate() {
        let mut sum = [[0.0; LANES]; 4];
        for (d, (q, u)) in angular[n..].iter().take(PAIRS).enumerate() {
            let f = factors[n * PAIRS + d];
            for l in 0..LANES {
                let (pq, tu, pu, tq) = (p[l] * q[l], t[l] * u[l], p[l] * u[l], t[l] * q[l]);
                let (even, odd, cross, skew) = (pq + tu, tu - pq, pu + tq, tq - pu);
                sum[0][l] += f.same * even + f.mixed * cross;
                sum[1][l] += f.same_difference * odd + f.mixed_difference * skew;
                sum[2][l] += f.same * cross + f.mixed * even;
                sum[3][l] += f.same_skew * skew + f.mixed_skew * odd;
            }
            // The pair (n, n+d) and the pair (n+d, n), which are one for d = 0.
            if d == 0 {
                sum.iter_mut().flatten().for_each(|value| *value *= 0.5);
            }
        }
        total.iter_mut().flatten().zip(sum.iter().flatten()).for_each(|(to, from)| *to += from);
    }
    total
}

/// `(2n+1)/(n(n+1))` times π_n and τ_n for n = 1 … `count` at some cos θ.
fn angular(count: usize, cosines: &Lanes) -> Vec<(Lanes, Lanes)> {
    let (mut before, mut now) = ([0.0; LANES], [1.0; LANES]);
    (1..=count)
        .map(|n| {
            let n = n as f64;
            let weight = (2.0 * n + 1.0) / (n * (n + 1.0));
            let (mut pi, mut tau) = ([0.0; LANES], [0.0; LANES]);
            for l in 0..LANES {
                pi[l] = weight * now[l];
                tau[l] = weight * (n * cosines[l] * now[l] - (n + 1.0) * before[l]);
                let next =
                    ((2.0 * n + 1.0) * cosines[l] * now[l] - (n + 1.0) * before[l]) * n.recip();
                (before[l], now[l]) = (now[l], next);
            }
            (pi, tau)
        })
        .collect()
}
