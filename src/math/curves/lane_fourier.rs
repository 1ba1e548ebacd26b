//! Fourier transforms of eight sequences at once, one in each SIMD lane:
//! `Y[k] = Σ_q X[q] exp(2πi qk/K)`.
//!
//! Stockham's form: every pass reads one buffer in order and writes the other so that nothing has to
//! be permuted at the end. Passes split by four, then by two and by three what is left.
//!
//! RustFFT transforms as fast, but one sequence after the other: the sums that want them side by side
//! then take a third longer (`validation/engine.md`).

use crate::math::fused::multiply_add;
use multiversion::multiversion;
use multiversion::target::target_cfg_f;
use std::f64::consts::TAU;

/// Sequences carried together.
pub const LANES: usize = 8;
/// Real numbers side by side.
pub type Lanes = [f64; LANES];

/// One complex number of every sequence.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Row {
    /// Real parts.
    pub re: Lanes,
    /// Imaginary parts.
    pub im: Lanes,
}

impl Row {
    /// Zero in every lane.
    pub const ZERO: Self = Self { re: [0.0; LANES], im: [0.0; LANES] };
}

/// The transform of one length.
#[derive(Clone, Debug)]
pub struct LaneFourier {
    /// `exp(2πi j/K)`: cosine and sine.
    roots: Vec<[f64; 2]>,
}

impl LaneFourier {
    /// The next length that can be transformed: a power of two, or three times one.
    pub fn length_from(least: usize) -> usize {
        let power = least.max(4).next_power_of_two();
        if 3 * power / 4 >= least.max(4) { 3 * power / 4 } else { power }
    }

    /// Prepare a length of [`LaneFourier::length_from`].
    pub fn new(length: usize) -> Self {
        let root = |j: usize| {
            let (sine, cosine) = (TAU * j as f64 / length as f64).sin_cos();
            [cosine, sine]
        };
        Self { roots: (0..length).map(root).collect() }
    }

    /// Length of the sequences.
    pub fn length(&self) -> usize {
        self.roots.len()
    }

    /// Transform `rows` in place; `spare` is room of the same length.
    pub fn transform(&self, rows: &mut Vec<Row>, spare: &mut Vec<Row>) {
        let length = self.roots.len();
        spare.resize(length, Row::ZERO);
        let mut stride = 1;
        while stride < length {
            let left = length / stride;
            if left.is_multiple_of(4) {
                by_four(rows, spare, &self.roots, stride);
                stride *= 4;
            } else if left.is_multiple_of(2) {
                by_two(rows, spare, &self.roots, stride);
                stride *= 2;
            } else {
                by_three(rows, spare, &self.roots, stride);
                stride *= 3;
            }
            std::mem::swap(rows, spare);
        }
    }
}

/// One pass; `$one` is the pass compiled with and without multiply-add.
macro_rules! pass {
    ($name:ident, $one:ident) => {
        #[multiversion(targets(
            "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
            "x86_64+avx2+fma",
            "aarch64+neon"
        ))]
        fn $name(from: &[Row], to: &mut [Row], roots: &[[f64; 2]], stride: usize) {
            if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
                $one::<true>(from, to, roots, stride);
            } else {
                $one::<false>(from, to, roots, stride);
            }
        }
    };
}

pass!(by_four, four);
pass!(by_two, two);
pass!(by_three, three);

#[inline(always)]
fn four<const FMA: bool>(from: &[Row], to: &mut [Row], roots: &[[f64; 2]], stride: usize) {
    let quarter = from.len() / 4;
    for (q, to) in to.chunks_exact_mut(4 * stride).enumerate() {
        let at = q * stride;
        let turns = [roots[at], roots[2 * at], roots[3 * at]];
        let (first, rest) = to.split_at_mut(stride);
        let (second, rest) = rest.split_at_mut(stride);
        let (third, fourth) = rest.split_at_mut(stride);
        for r in 0..stride {
            let (a, b) = (&from[at + r], &from[at + r + quarter]);
            let (c, d) = (&from[at + r + 2 * quarter], &from[at + r + 3 * quarter]);
            let (first, second) = (&mut first[r], &mut second[r]);
            of_four::<FMA>(a, b, c, d, turns, first, second, &mut third[r], &mut fourth[r]);
        }
    }
}

/// The rows are arguments so that the compiler knows them apart and the loop becomes vectors.
#[inline(always)]
#[expect(clippy::too_many_arguments)]
fn of_four<const FMA: bool>(
    a: &Row,
    b: &Row,
    c: &Row,
    d: &Row,
    turns: [[f64; 2]; 3],
    first: &mut Row,
    second: &mut Row,
    third: &mut Row,
    fourth: &mut Row,
) {
    for l in 0..LANES {
        let (even_re, even_im) = (a.re[l] + c.re[l], a.im[l] + c.im[l]);
        let (odd_re, odd_im) = (b.re[l] + d.re[l], b.im[l] + d.im[l]);
        let (even_off_re, even_off_im) = (a.re[l] - c.re[l], a.im[l] - c.im[l]);
        let (odd_off_re, odd_off_im) = (b.re[l] - d.re[l], b.im[l] - d.im[l]);
        (first.re[l], first.im[l]) = (even_re + odd_re, even_im + odd_im);
        (second.re[l], second.im[l]) =
            times::<FMA>(even_off_re - odd_off_im, even_off_im + odd_off_re, turns[0]);
        (third.re[l], third.im[l]) = times::<FMA>(even_re - odd_re, even_im - odd_im, turns[1]);
        (fourth.re[l], fourth.im[l]) =
            times::<FMA>(even_off_re + odd_off_im, even_off_im - odd_off_re, turns[2]);
    }
}

#[inline(always)]
fn two<const FMA: bool>(from: &[Row], to: &mut [Row], roots: &[[f64; 2]], stride: usize) {
    let half = from.len() / 2;
    for (q, to) in to.chunks_exact_mut(2 * stride).enumerate() {
        let at = q * stride;
        let (first, second) = to.split_at_mut(stride);
        for r in 0..stride {
            let (a, b) = (&from[at + r], &from[at + r + half]);
            of_two::<FMA>(a, b, roots[at], &mut first[r], &mut second[r]);
        }
    }
}

#[inline(always)]
fn of_two<const FMA: bool>(a: &Row, b: &Row, turn: [f64; 2], first: &mut Row, second: &mut Row) {
    for l in 0..LANES {
        (first.re[l], first.im[l]) = (a.re[l] + b.re[l], a.im[l] + b.im[l]);
        (second.re[l], second.im[l]) = times::<FMA>(a.re[l] - b.re[l], a.im[l] - b.im[l], turn);
    }
}

#[inline(always)]
fn three<const FMA: bool>(from: &[Row], to: &mut [Row], roots: &[[f64; 2]], stride: usize) {
    let third = from.len() / 3;
    for (q, to) in to.chunks_exact_mut(3 * stride).enumerate() {
        let at = q * stride;
        let turns = [roots[at], roots[2 * at]];
        let (first, rest) = to.split_at_mut(stride);
        let (second, last) = rest.split_at_mut(stride);
        for r in 0..stride {
            let a = &from[at + r];
            let (b, c) = (&from[at + r + third], &from[at + r + 2 * third]);
            of_three::<FMA>(a, b, c, turns, &mut first[r], &mut second[r], &mut last[r]);
        }
    }
}

#[inline(always)]
fn of_three<const FMA: bool>(
    a: &Row,
    b: &Row,
    c: &Row,
    turns: [[f64; 2]; 2],
    first: &mut Row,
    second: &mut Row,
    third: &mut Row,
) {
    let sine = 0.75f64.sqrt();
    for l in 0..LANES {
        let (sum_re, sum_im) = (b.re[l] + c.re[l], b.im[l] + c.im[l]);
        let (off_re, off_im) = (sine * (b.re[l] - c.re[l]), sine * (b.im[l] - c.im[l]));
        let (middle_re, middle_im) = (a.re[l] - 0.5 * sum_re, a.im[l] - 0.5 * sum_im);
        (first.re[l], first.im[l]) = (a.re[l] + sum_re, a.im[l] + sum_im);
        (second.re[l], second.im[l]) =
            times::<FMA>(middle_re - off_im, middle_im + off_re, turns[0]);
        (third.re[l], third.im[l]) = times::<FMA>(middle_re + off_im, middle_im - off_re, turns[1]);
    }
}

/// A complex number times another.
#[inline(always)]
fn times<const FMA: bool>(re: f64, im: f64, [cosine, sine]: [f64; 2]) -> (f64, f64) {
    let fma = multiply_add::<FMA>;
    (fma(cosine, re, -(sine * im)), fma(cosine, im, sine * re))
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_complex::Complex64;

    /// Against the sum as it is written, every lane with values of its own.
    #[test]
    fn transform_is_the_sum() {
        for length in [4, 6, 8, 12, 24, 32, 96, 128] {
            assert_eq!(LaneFourier::length_from(length), length);
            let value =
                |q: usize, l: usize| Complex64::cis((q * q + 3 * l) as f64) * (1 + l) as f64;
            let mut rows = vec![Row::ZERO; length];
            for (q, row) in rows.iter_mut().enumerate() {
                for l in 0..LANES {
                    (row.re[l], row.im[l]) = (value(q, l).re, value(q, l).im);
                }
            }
            LaneFourier::new(length).transform(&mut rows, &mut Vec::new());
            for (k, row) in rows.iter().enumerate() {
                for l in 0..LANES {
                    let turn = |q: usize| Complex64::cis(TAU * (q * k) as f64 / length as f64);
                    let sum: Complex64 = (0..length).map(|q| value(q, l) * turn(q)).sum();
                    let error = (sum - Complex64::new(row.re[l], row.im[l])).norm();
                    assert!(error < 1e-11, "{length}, {k}, {l}: {error:e}");
                }
            }
        }
    }

    #[test]
    fn lengths_waste_little() {
        for least in 1..5000 {
            let length = LaneFourier::length_from(least);
            assert!(length >= least && length <= (3 * least / 2).max(4), "{least}: {length}");
        }
    }
}
