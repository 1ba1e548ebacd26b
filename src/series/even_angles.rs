//! Sums of a series at evenly spaced angles, by Fourier transform where they lie far from the axis.
//!
//! There every angular function is nearly a wave. With ν = n + ½, φ = νθ - π/4, Stieltjes'
//! expansion of P_n(cos θ) (Szegő 1975, Orthogonal Polynomials, th. 8.21.5), τ_n and π_n from its
//! derivative, to relative order 1/ν,
//! ```text
//! w_n τ_n = √(8ν/(π sin θ)) [cos φ - 7 cot θ/(8ν) sin φ]       w_n = (2n+1)/(n(n+1))
//! w_n π_n = √(8ν/(π sin θ)) sin φ/(ν sin θ)
//! ```
//! so that a series is four Fourier sums, of a_n, a_n/ν, b_n and b_n/ν times √ν, each at θ and at -θ.
//! The orders below 25/sin θ (`FAR`) are summed as they are ([`angular`]).
//!
//! A sum with L angles per turn is taken apart into eight by the remainder of n by eight, one in each
//! SIMD lane. They are transformed together at a length of L/8, which stays in the second-level
//! cache, and are put together only at the angles asked for.

use super::angular::{self, AngleSet};
use super::lanes::PartialWaves;
use crate::math::fused::multiply_add;
use crate::math::lane_fourier::{LANES, LaneFourier, Lanes, Row};
use multiversion::multiversion;
use multiversion::target::target_cfg_f;
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_4, PI, TAU};

/// From `n sin θ` of this on the expansion serves. Measured: the amplitudes are then right to 3e-5
/// of their root mean square at x = 900 and to 1e-6 at x = 4000.
const FAR: f64 = 25.0;
/// With fewer orders than this many times those below [`FAR`]`/sin θ` all are summed as they are.
const WORTH_IT: usize = 3;

/// S1 and S2 at every angle.
pub type Amplitudes = Vec<(Complex64, Complex64)>;

/// Scattering angles prepared for the sums of many series.
#[derive(Clone, Debug)]
pub struct AngleSums {
    direct: AngleSet,
    /// None where the angles are not even, or lie near the axis.
    far: Option<Far>,
}

/// Angles `2πk/L` for neighbouring k, far from the axis.
#[derive(Clone, Debug)]
struct Far {
    /// First order of the expansion.
    low: usize,
    places: Vec<Place>,
    /// `√(8ν/π)` and that over ν, by n.
    factors: Vec<[f64; 2]>,
    fourier: LaneFourier,
}

/// What one angle needs.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// `½ exp(i(r + ½)θ - iπ/4)/√sin θ` for the remainders r.
    turn: Row,
    /// 7/8 cot θ and 1/sin θ.
    slope: f64,
    inverse_sine: f64,
    /// Where θ and -θ stand in the transforms.
    at: usize,
    mirrored: usize,
}

impl AngleSums {
    /// Any angles (radians).
    pub fn any(theta: &[f64]) -> Self {
        Self { direct: AngleSet::new(theta), far: None }
    }

    /// The `count` angles from `2π first/per_turn` on; `per_turn` is of [`AngleSums::per_turn`].
    pub fn even(first: usize, count: usize, per_turn: usize) -> Self {
        let theta = Self::angles(first, count, per_turn);
        let far = Far::new(first, &theta, per_turn);
        Self { direct: AngleSet::new(&theta), far }
    }

    /// The next number of angles per turn that can be served.
    pub fn per_turn(least: usize) -> usize {
        LANES * LaneFourier::length_from(least.div_ceil(LANES))
    }

    /// Even angles, radians.
    pub fn angles(first: usize, count: usize, per_turn: usize) -> Vec<f64> {
        (first..first + count).map(|k| TAU * k as f64 / per_turn as f64).collect()
    }

    /// S1 and S2 of some series.
    pub fn amplitudes(&self, series: &[PartialWaves]) -> Vec<Amplitudes> {
        let longest = series.iter().map(|waves| waves.a.len()).max().unwrap_or(0);
        let Some(far) = self.far.as_ref().filter(|far| far.serves(longest)) else {
            return self.directly(series, usize::MAX);
        };
        let mut out = self.directly(series, far.low - 1);
        let mut sums = [(); 4].map(|()| vec![Row::ZERO; far.fourier.length()]);
        let mut spare = Vec::new();
        for (waves, out) in series.iter().zip(&mut out) {
            far.fill(waves, &mut sums);
            sums.iter_mut().for_each(|rows| far.fourier.transform(rows, &mut spare));
            put_together(&far.places, &sums, out);
        }
        out
    }

    /// The orders up to `last` by their recurrence, two series at a time.
    fn directly(&self, series: &[PartialWaves], last: usize) -> Vec<Amplitudes> {
        let mut out = Vec::with_capacity(series.len());
        for group in series.chunks(2) {
            match group {
                [one, other] => {
                    let both = [one.up_to(last), other.up_to(last)];
                    out.extend(angular::amplitudes_together(both, &self.direct));
                }
                alone => out.extend(alone.iter().map(|waves| {
                    let (a, b) = waves.up_to(last);
                    angular::amplitudes(a, b, &self.direct)
                })),
            }
        }
        out
    }
}

impl Far {
    fn new(first: usize, theta: &[f64], per_turn: usize) -> Option<Self> {
        let least_sine = theta.iter().fold(1.0_f64, |least, theta| least.min(theta.sin()));
        let low = (FAR / least_sine).ceil();
        if !(least_sine > 0.0 && low < per_turn as f64) {
            return None;
        }
        let length = per_turn / LANES;
        let place = |(i, &theta): (usize, &f64)| {
            let (sine, cosine) = theta.sin_cos();
            let mut turn = Row::ZERO;
            for r in 0..LANES {
                let half = Complex64::cis((r as f64 + 0.5) * theta - FRAC_PI_4);
                let half = half * 0.5 / sine.sqrt();
                (turn.re[r], turn.im[r]) = (half.re, half.im);
            }
            let at = (first + i) % length;
            let mirrored = (length - at) % length;
            Place { turn, slope: 0.875 * cosine / sine, inverse_sine: 1.0 / sine, at, mirrored }
        };
        let factor = |n: usize| {
            let nu = n as f64 + 0.5;
            let factor = (8.0 * nu / PI).sqrt();
            [factor, factor / nu]
        };
        Some(Self {
            low: low as usize,
            places: theta.iter().enumerate().map(place).collect(),
            factors: (0..per_turn).map(factor).collect(),
            fourier: LaneFourier::new(length),
        })
    }

    /// Whether series of so many terms have room and gain.
    fn serves(&self, terms: usize) -> bool {
        terms < self.factors.len() && WORTH_IT * self.low < terms
    }

    /// The four sequences, by n/8 and lane.
    fn fill(&self, waves: &PartialWaves, sums: &mut [Vec<Row>; 4]) {
        sums.iter_mut().for_each(|rows| rows.fill(Row::ZERO));
        for (n, [root, over]) in self.factors.iter().enumerate().take(waves.a.len() + 1) {
            if n < self.low {
                continue;
            }
            let (a, b) = (waves.a[n - 1], waves.b[n - 1]);
            let values = [a * root, a * over, b * root, b * over];
            for (rows, value) in sums.iter_mut().zip(values) {
                let row = &mut rows[n / LANES];
                (row.re[n % LANES], row.im[n % LANES]) = (value.re, value.im);
            }
        }
    }
}

/// Add the transforms of a, a/ν, b and b/ν to S1 and S2.
#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
fn put_together(places: &[Place], sums: &[Vec<Row>; 4], out: &mut [(Complex64, Complex64)]) {
    if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
        put::<true>(places, sums, out);
    } else {
        put::<false>(places, sums, out);
    }
}

#[inline(always)]
fn put<const FMA: bool>(
    places: &[Place],
    [a, a_over, b, b_over]: &[Vec<Row>; 4],
    out: &mut [(Complex64, Complex64)],
) {
    // The lanes are written before they are summed, else the compiler makes pairs of them.
    let mut lanes = [Row::ZERO; 2 * BLOCK];
    for (places, out) in places.chunks(BLOCK).zip(out.chunks_mut(BLOCK)) {
        for (place, pair) in places.iter().zip(lanes.chunks_exact_mut(2)) {
            let (at, mirrored) = (place.at, place.mirrored);
            let (s1, s2) = pair.split_at_mut(1);
            one::<FMA>(
                place,
                [&b[at], &b_over[at], &a_over[at]],
                [&b[mirrored], &b_over[mirrored], &a_over[mirrored]],
                &mut s1[0],
            );
            one::<FMA>(
                place,
                [&a[at], &a_over[at], &b_over[at]],
                [&a[mirrored], &a_over[mirrored], &b_over[mirrored]],
                &mut s2[0],
            );
        }
        for ((s1, s2), pair) in out.iter_mut().zip(lanes.chunks_exact(2)) {
            *s1 += Complex64::new(sum(&pair[0].re), sum(&pair[0].im));
            *s2 += Complex64::new(sum(&pair[1].re), sum(&pair[1].im));
        }
    }
}

/// Angles put together before their lanes are summed.
const BLOCK: usize = 16;

/// The lanes of one amplitude from the transforms of its τ, of that over ν, and of its π, at θ and
/// at -θ.
#[inline(always)]
fn one<const FMA: bool>(place: &Place, there: [&Row; 3], back: [&Row; 3], out: &mut Row) {
    let fma = multiply_add::<FMA>;
    let (c, d) = (place.slope, place.inverse_sine);
    let [there, there_over, there_other] = there;
    let [back, back_over, back_other] = back;
    for l in 0..LANES {
        // there + i(c over - d other) and back - i(c over - d other)
        let there_re = fma(-c, there_over.im[l], fma(d, there_other.im[l], there.re[l]));
        let there_im = fma(c, there_over.re[l], fma(-d, there_other.re[l], there.im[l]));
        let back_re = fma(c, back_over.im[l], fma(-d, back_other.im[l], back.re[l]));
        let back_im = fma(-c, back_over.re[l], fma(d, back_other.re[l], back.im[l]));
        let (cosine, sine) = (place.turn.re[l], place.turn.im[l]);
        out.re[l] = fma(cosine, there_re + back_re, sine * (back_im - there_im));
        out.im[l] = fma(cosine, there_im + back_im, sine * (there_re - back_re));
    }
}

/// Sum over the lanes, by halves.
#[inline(always)]
fn sum(lanes: &Lanes) -> f64 {
    let [a, b, c, d, e, f, g, h] = *lanes;
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::series::lanes::partial_waves;
    use crate::series::lorenz_mie::Sphere;

    /// Against the recurrence alone, relative to the root mean square.
    #[test]
    fn as_by_recurrence() {
        for (x, from, to) in
            [(60.0, 60, 160), (900.0, 100, 170), (4000.0, 118, 152), (12000.0, 118, 152)]
        {
            let sizes: Vec<_> =
                (0..3).map(|k| (x + f64::from(k), Complex64::new(1.333, 1e-8))).collect();
            let per_turn = AngleSums::per_turn(2 * x as usize + 2000);
            let (first, last) = (from * per_turn / 360, to * per_turn / 360);
            let even = AngleSums::even(first, last - first, per_turn);
            let theta = AngleSums::angles(first, last - first, per_turn);
            let all = even.amplitudes(&partial_waves(&sizes).unwrap());
            for (&(x, m), got) in sizes.iter().zip(all) {
                let expected = Sphere::new(x, m).unwrap().amplitudes(&theta);
                let power: f64 = expected.iter().map(|s| s.0.norm_sqr() + s.1.norm_sqr()).sum();
                let mut square = 0.0;
                for ((s1, s2), (e1, e2)) in got.iter().zip(&expected) {
                    square += (s1 - e1).norm_sqr() + (s2 - e2).norm_sqr();
                }
                let error = (square / power).sqrt();
                assert!(error < 4e-5, "{x}: {error:e}");
            }
        }
    }
}
