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
use super::stretch::{End, Parts, add_means};
use crate::math::parallel::*;
use multiversion::multiversion;

/// Pairs of partial waves up to this distance keep step long enough to count. Measured: 8 and 16
/// differ by less than 1e-6 behind order 24, by less than 1e-4 behind order 8.
const PAIRS: usize = 9;
/// Waves with less power than this behind the cut are left out.
const FAINT: f64 = 1e-13;

/// Sums of products of the waves n and n + d over sizes, index n - 1 in each list.
#[derive(Clone, Debug, Default)]
pub(super) struct Products {
    waves: usize,
    by_distance: [Pairs; PAIRS],
}

/// Products of two waves: a_n a*_m, b_n b*_m, a_n b*_m, b_n a*_m.
#[derive(Clone, Debug, Default)]
struct Pairs {
    aa: Parts,
    bb: Parts,
    ab: Parts,
    ba: Parts,
}

/// The waves behind the cut of one size.
#[derive(Clone, Debug)]
pub(super) struct Waves {
    electric: End,
    magnetic: End,
    /// Places of the waves that count.
    counting: std::ops::Range<usize>,
}

impl Waves {
    /// The waves of a size that counts `weight`.
    pub fn new(electric: &[Behind], magnetic: &[Behind], weight: f64) -> Self {
        let counts = |wave: &Behind| {
            let power = wave.first.norm_sqr();
            power > 0.0 && power > FAINT * (1.0 - wave.internal.norm_sqr())
        };
        let either = |n: &usize| counts(&electric[*n]) || counts(&magnetic[*n]);
        let first = (0..electric.len()).find(either).unwrap_or(electric.len());
        let end = (first..electric.len()).rfind(either).map_or(first, |last| last + 1);
        let (electric, magnetic) = (End::new(electric, weight), End::new(magnetic, weight));
        Self { electric, magnetic, counting: first..end }
    }
}

impl Products {
    /// Add the stretch between two neighbouring sizes, both of which count half.
    pub fn add_stretch(&mut self, from: &Waves, to: &Waves) {
        let common = from.electric.len().min(to.electric.len());
        let first = from.counting.start.min(to.counting.start);
        let end = from.counting.end.max(to.counting.end).min(common);
        if first >= end {
            return;
        }
        self.resize(self.waves.max(end));
        let electric = [&from.electric, &to.electric];
        let magnetic = [&from.magnetic, &to.magnetic];
        for (d, pairs) in self.by_distance.iter_mut().enumerate().take(end - first) {
            let places = first..end - d;
            add_means(electric, electric, d, places.clone(), &mut pairs.aa);
            add_means(magnetic, magnetic, d, places.clone(), &mut pairs.bb);
            add_means(electric, magnetic, d, places.clone(), &mut pairs.ab);
            add_means(magnetic, electric, d, places, &mut pairs.ba);
        }
    }

    fn resize(&mut self, waves: usize) {
        self.waves = waves;
        for pairs in &mut self.by_distance {
            for parts in [&mut pairs.aa, &mut pairs.bb, &mut pairs.ab, &mut pairs.ba] {
                parts.resize(waves);
            }
        }
    }

    /// Add another sum.
    pub fn add(&mut self, other: &Products) {
        self.resize(self.waves.max(other.waves));
        for (to, from) in self.by_distance.iter_mut().zip(&other.by_distance) {
            to.aa.add(&from.aa);
            to.bb.add(&from.bb);
            to.ab.add(&from.ab);
            to.ba.add(&from.ba);
        }
    }

    /// Number of partial waves that count.
    pub fn waves(&self) -> usize {
        self.waves
    }

    /// S11, S12, S33 and S34 at scattering angles (radians).
    pub fn elements(&self, theta: &[f64]) -> Vec<[f64; 4]> {
        let factors: Vec<[Factors; PAIRS]> = (0..self.waves)
            .map(|n| std::array::from_fn(|d| Factors::new(&self.by_distance[d], n)))
            .collect();
        let mut out = vec![[0.0; 4]; theta.len()];
        out.par_chunks_mut(LANES).zip(theta.par_chunks(LANES)).for_each(|(out, theta)| {
            let mut cosines = [0.0; LANES];
            cosines.iter_mut().zip(theta).for_each(|(cosine, theta)| *cosine = theta.cos());
            let sums = elements_at(&factors, &angular(self.waves, &cosines));
            for (l, row) in out.iter_mut().enumerate() {
                *row = sums.map(|lanes| lanes[l]);
            }
        });
        out
    }

    /// Σ (2n+1)(|a_n|² + |b_n|²), and the sum of Bohren & Huffman's sec. 4.5 for the asymmetry.
    pub fn sums(&self) -> (f64, f64) {
        let (mut scattered, mut forward) = (0.0, 0.0);
        let [same, next, ..] = &self.by_distance;
        for k in 0..self.waves {
            let n = (k + 1) as f64;
            scattered += (2.0 * n + 1.0) * (same.aa.re[k] + same.bb.re[k]);
            forward += (2.0 * n + 1.0) / (n * (n + 1.0)) * same.ab.re[k];
            forward += n * (n + 2.0) / (n + 1.0) * (next.aa.re[k] + next.bb.re[k]);
        }
        (scattered, forward)
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
    fn new(Pairs { aa, bb, ab, ba }: &Pairs, n: usize) -> Self {
        Self {
            same: aa.re[n] + bb.re[n],
            mixed: ab.re[n] + ba.re[n],
            same_difference: aa.re[n] - bb.re[n],
            mixed_difference: ab.re[n] - ba.re[n],
            same_skew: aa.im[n] - bb.im[n],
            mixed_skew: ab.im[n] - ba.im[n],
        }
    }
}

/// S11, S12, S33 and S34 at some angles from π_n and τ_n there.
#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
fn elements_at(factors: &[[Factors; PAIRS]], angular: &[(Lanes, Lanes)]) -> [Lanes; 4] {
    let mut total = [[0.0; LANES]; 4];
    for (n, (p, t)) in angular.iter().enumerate() {
        let mut sum = [[0.0; LANES]; 4];
        for (d, (q, u)) in angular[n..].iter().take(PAIRS).enumerate() {
            let f = factors[n][d];
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::gauss_legendre;
    use num_complex::Complex64;

    /// Waves made up, of both kinds: fields that leave and what is kept inside.
    fn waves(shift: f64) -> Waves {
        let wave = |n: usize, phase: f64| Behind {
            first: Complex64::from_polar(0.3 / (1.0 + 0.1 * n as f64), phase * n as f64 + shift),
            internal: Complex64::from_polar(0.6, 0.2 * n as f64 + shift),
        };
        let list = |phase: f64| (0..12).map(|n| wave(n, phase)).collect::<Vec<_>>();
        Waves::new(&list(0.7), &list(-0.4), 1.0)
    }

    fn products() -> Products {
        let mut sums = Products::default();
        sums.add_stretch(&waves(0.0), &waves(0.05));
        sums
    }

    /// `∫ S11 dμ = Σ (2n+1)(|a|² + |b|²)` and `∫ S11 μ dμ` twice the sum for the asymmetry: the functions of
    /// neighbouring waves are orthogonal, whatever pairs are left out.
    #[test]
    fn elements_integrate_to_their_sums() {
        let sums = products();
        assert_eq!(sums.waves(), 12);
        let nodes = gauss_legendre::nodes(60);
        let theta: Vec<f64> = nodes.iter().map(|(mu, _)| mu.acos()).collect();
        let elements = sums.elements(&theta);
        let (mut power, mut momentum) = (0.0, 0.0);
        for ((mu, weight), row) in nodes.iter().zip(&elements) {
            power += weight * row[0];
            momentum += weight * mu * row[0];
        }
        let (scattered, forward) = sums.sums();
        assert!(scattered > 0.0 && forward != 0.0);
        assert!((power / scattered - 1.0).abs() < 1e-12, "{power} {scattered}");
        assert!((momentum - 2.0 * forward).abs() < 1e-12 * scattered, "{momentum} {forward}");
    }

    /// Straight ahead and back S12 and S34 vanish and S33 is plus or minus S11.
    #[test]
    fn on_the_axis_there_is_no_plane() {
        let rows = products().elements(&[0.0, std::f64::consts::PI]);
        for (row, sign) in rows.iter().zip([1.0, -1.0]) {
            assert!(row[1].abs() + row[3].abs() < 1e-9 * row[0].abs(), "{row:?}");
            assert!((row[2] - sign * row[0]).abs() < 1e-9 * row[0].abs(), "{row:?}");
        }
    }

    /// Twice the same sum is twice as much; sums of fewer waves fit in.
    #[test]
    fn sums_add_up() {
        let mut twice = Products::default();
        twice.add(&products());
        twice.add(&products());
        let (a, b) = (products().sums(), twice.sums());
        assert!((b.0 - 2.0 * a.0).abs() < 1e-14 * b.0 && (b.1 - 2.0 * a.1).abs() < 1e-14 * b.0);
        twice.add(&Products::default());
        assert_eq!(twice.sums(), b);
    }

    /// Waves that hold nothing behind the cut do not count.
    #[test]
    fn faint_waves_are_left_out() {
        let none = Behind { first: Complex64::ZERO, internal: Complex64::from(0.5) };
        let some = Behind { first: Complex64::from(0.1), ..none };
        let waves = Waves::new(&[none, some, none, none], &[none, none, some, none], 1.0);
        assert_eq!(waves.counting, 1..3);
        let empty = Waves::new(&[none; 3], &[none; 3], 1.0);
        let mut sums = Products::default();
        sums.add_stretch(&empty, &empty);
        assert_eq!(sums.waves(), 0);
    }
}
