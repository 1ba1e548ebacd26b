//! Products of two partial waves behind the cut on the way from one size to the next: the mean of
//! their geometric sum `first/(1 - u)` (see `behind.rs`).
//!
//! Nearly everywhere u moves little and the mean of both ends is as good; that runs over the waves
//! in SIMD lanes. Where u turns about 1 the mean along the spiral takes its place.

use super::debye::Behind;
use multiversion::multiversion;
use num_complex::Complex64;
use std::ops::Range;

/// Where u turns by less than this fraction of |1 - u| (squared) the mean of both ends is as good.
const STRAIGHT: f64 = 1e-3;
/// |1 - u|² that is nothing but rounding.
const NOTHING: f64 = f64::EPSILON * f64::EPSILON;

/// Complex numbers by their parts.
#[derive(Clone, Debug, Default)]
pub(super) struct Parts {
    pub re: Vec<f64>,
    pub im: Vec<f64>,
}

impl Parts {
    /// With zeros behind, so that lanes may reach beyond the end.
    fn padded(values: impl Iterator<Item = Complex64>) -> Self {
        let padding = std::iter::repeat_n(Complex64::ZERO, LANES);
        let (re, im) = values.chain(padding).map(|value| (value.re, value.im)).unzip();
        Self { re, im }
    }

    /// Of this length, zeros at the end.
    pub fn resize(&mut self, length: usize) {
        self.re.resize(length, 0.0);
        self.im.resize(length, 0.0);
    }

    /// Add the numbers of a list that is not longer.
    pub fn add(&mut self, other: &Parts) {
        self.re.iter_mut().zip(&other.re).for_each(|(sum, value)| *sum += value);
        self.im.iter_mut().zip(&other.im).for_each(|(sum, value)| *sum += value);
    }

    fn at(&self, n: usize) -> Complex64 {
        Complex64::new(self.re[n], self.im[n])
    }
}

/// The waves of one polarisation at one end of a stretch.
#[derive(Clone, Debug)]
pub(super) struct End {
    /// First order behind the cut, with the root of half the weight.
    first: Parts,
    /// R11.
    internal: Parts,
    /// 1/R11, or 0 where nothing turns.
    inverse: Parts,
}

impl End {
    pub fn new(waves: &[Behind], weight: f64) -> Self {
        let root = (0.5 * weight).sqrt();
        let inverse = |r: Complex64| if r.norm_sqr() < 1e-6 { Complex64::ZERO } else { r.inv() };
        Self {
            first: Parts::padded(waves.iter().map(|wave| wave.first * root)),
            internal: Parts::padded(waves.iter().map(|wave| wave.internal)),
            inverse: Parts::padded(waves.iter().map(|wave| inverse(wave.internal))),
        }
    }

    /// Number of waves.
    pub fn len(&self) -> usize {
        self.first.re.len() - LANES
    }

    /// First product behind the cut, and u, of the wave n with a wave m.
    fn product(&self, n: usize, other: &End, m: usize) -> (Complex64, Complex64) {
        let steps = 1.0 + self.inverse.at(n) + other.inverse.at(m).conj();
        let first = self.first.at(n) * other.first.at(m).conj() * steps;
        (first, self.internal.at(n) * other.internal.at(m).conj())
    }
}

/// Waves carried together.
const LANES: usize = 8;
type Lanes = [f64; LANES];

/// Some neighbouring waves of an [`End`]: real, then imaginary parts.
#[derive(Clone, Copy)]
struct Row {
    first: [Lanes; 2],
    internal: [Lanes; 2],
    inverse: [Lanes; 2],
}

impl Row {
    #[inline(always)]
    fn new(end: &End, n: usize) -> Self {
        let load = |parts: &Parts| {
            let (mut re, mut im) = ([0.0; LANES], [0.0; LANES]);
            re.copy_from_slice(&parts.re[n..n + LANES]);
            im.copy_from_slice(&parts.im[n..n + LANES]);
            [re, im]
        };
        Self { first: load(&end.first), internal: load(&end.internal), inverse: load(&end.inverse) }
    }
}

/// A product's geometric sum, 1 - u and the square of that, of some pairs of waves.
struct Sums {
    sum: [Lanes; 2],
    rest: [Lanes; 2],
    square: Lanes,
}

impl Sums {
    #[inline(always)]
    fn new(a: &Row, b: &Row) -> Self {
        let (mut sum_re, mut sum_im, mut squares) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        let (mut rests_re, mut rests_im) = ([0.0; LANES], [0.0; LANES]);
        for l in 0..LANES {
            // first_n first*_m (1 + 1/R_n + 1/R*_m) and 1 - u = 1 - R_n R*_m, by parts.
            let step_re = 1.0 + a.inverse[0][l] + b.inverse[0][l];
            let step_im = a.inverse[1][l] - b.inverse[1][l];
            let first_re = a.first[0][l] * b.first[0][l] + a.first[1][l] * b.first[1][l];
            let first_im = a.first[1][l] * b.first[0][l] - a.first[0][l] * b.first[1][l];
            let power_re = first_re * step_re - first_im * step_im;
            let power_im = first_re * step_im + first_im * step_re;
            let rest_re =
                1.0 - (a.internal[0][l] * b.internal[0][l] + a.internal[1][l] * b.internal[1][l]);
            let rest_im = a.internal[0][l] * b.internal[1][l] - a.internal[1][l] * b.internal[0][l];
            let square = rest_re * rest_re + rest_im * rest_im;
            // Without any width a resonance has no power either.
            let keep = if square < NOTHING { 0.0 } else { 1.0 };
            let inverse = keep / square.max(NOTHING);
            sum_re[l] = inverse * (power_re * rest_re + power_im * rest_im);
            sum_im[l] = inverse * (power_im * rest_re - power_re * rest_im);
            rests_re[l] = rest_re;
            rests_im[l] = rest_im;
            squares[l] = square;
        }
        Self { sum: [sum_re, sum_im], rest: [rests_re, rests_im], square: squares }
    }
}

/// Add to `sums` the means of the products of the waves n of `from` with the waves n + `distance`
/// of `to`, each at both ends.
pub(super) fn add_means(
    from: [&End; 2],
    to: [&End; 2],
    distance: usize,
    places: Range<usize>,
    sums: &mut Parts,
) {
    for first in places.clone().step_by(LANES) {
        let (mut re, mut im, mut turned) = ([0.0; LANES], [0.0; LANES], [false; LANES]);
        straight(from, to, [first, first + distance], &mut re, &mut im, &mut turned);
        for (l, n) in (first..places.end.min(first + LANES)).enumerate() {
            let mean = if turned[l] {
                along_spiral([0, 1].map(|k| from[k].product(n, to[k], n + distance)))
            } else {
                Complex64::new(re[l], im[l])
            };
            sums.re[n] += mean.re;
            sums.im[n] += mean.im;
        }
    }
}

/// The mean of both ends, for waves from `first` on, and whether u turns too much for it.
#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
fn straight(
    from: [&End; 2],
    to: [&End; 2],
    first: [usize; 2],
    re: &mut Lanes,
    im: &mut Lanes,
    turned: &mut [bool; LANES],
) {
    let start = Sums::new(&Row::new(from[0], first[0]), &Row::new(to[0], first[1]));
    let end = Sums::new(&Row::new(from[1], first[0]), &Row::new(to[1], first[1]));
    for l in 0..LANES {
        re[l] = start.sum[0][l] + end.sum[0][l];
        im[l] = start.sum[1][l] + end.sum[1][l];
        let turn = [end.rest[0][l] - start.rest[0][l], end.rest[1][l] - start.rest[1][l]];
        let square = turn[0] * turn[0] + turn[1] * turn[1];
        let least = start.square[l].min(end.square[l]);
        turned[l] = square >= STRAIGHT * least && square >= 1e-28;
    }
}

/// The mean along the spiral on which u runs from one end to the other, both given by the first
/// product and u.
fn along_spiral([(p0, u0), (p1, u1)]: [(Complex64, Complex64); 2]) -> Complex64 {
    let (d0, d1) = (1.0 - u0, 1.0 - u1);
    if d0.norm_sqr().min(d1.norm_sqr()) < NOTHING {
        return Complex64::ZERO;
    }
    (p0 + p1) * (1.0 - ln_ratio(d0, d1) / ln_ratio(u0, u1))
}

/// `ln(to/from)`.
fn ln_ratio(from: Complex64, to: Complex64) -> Complex64 {
    // ln((1 + w)/(1 - w)) = 2 artanh w; the next term is below 1e-8.
    let w = (to - from) / (to + from);
    let square = w * w;
    if square.norm_sqr() < 4e-4 {
        return 2.0 * w * (1.0 + square * (1.0 / 3.0 + square * (0.2 + square / 7.0)));
    }
    let ratio = to * from.conj();
    Complex64::new(0.5 * (to.norm_sqr() / from.norm_sqr()).ln(), ratio.im.atan2(ratio.re))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(phase: f64, loss: f64) -> Behind {
        let internal = Complex64::from_polar(1.0 - loss, phase);
        Behind { first: Complex64::new(0.3, 0.1), internal }
    }

    /// Against a fine sum along the spiral, straight and turning, next to a resonance and far.
    #[test]
    fn means_are_those_along_the_spiral() {
        for (from, to, loss) in [(0.5, 0.52, 0.3), (-0.2, 0.3, 0.01), (-1e-3, 3e-3, 1e-4)] {
            let (still, one) = (wave(0.0, 0.0), wave(from, loss));
            let other = wave(to, loss);
            let ends = |wave| End::new(&[still, wave], 2.0);
            let (first, last) = (ends(one), ends(other));
            let mut sums = Parts::default();
            sums.resize(2);
            add_means([&first, &last], [&first, &last], 1, 0..1, &mut sums);
            let count = 200_000;
            let mut expected = Complex64::ZERO;
            let (p0, u0) = first.product(0, &first, 1);
            let (p1, u1) = last.product(0, &last, 1);
            for i in 0..count {
                let t = (f64::from(i) + 0.5) / f64::from(count);
                let u = u0 * (t * (u1 / u0).ln()).exp();
                expected += (p0 + p1) / (1.0 - u) / f64::from(count);
            }
            let error = (sums.at(0) - expected).norm() / expected.norm();
            assert!(error < 3e-4, "{from} to {to}: {error:e}");
        }
    }
}
