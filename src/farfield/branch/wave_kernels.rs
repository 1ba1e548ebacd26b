//! The waves of the samples between two knots, eight side by side.
//!
//! Between two knots path and amplitudes are cubics in the angle. A phase is carried in turns; whole
//! turns fall away exactly. Part by part of S1 … S4, each part in a row of its own; the loops are plain
//! arithmetic over arrays, compiled into every instruction set of the sweep that calls them.

use super::knots::Knot;
use crate::math::airy;
use crate::math::fused::multiply_add;
use crate::math::phase::sin_cos_turns_with;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Samples whose phases are computed side by side.
pub(super) const LANES: usize = 8;

/// Samples `begin..end` of one piece between two knots.
pub(super) struct Piece<'a> {
    /// All samples of the column, with room behind the last.
    pub theta: &'a [f64],
    pub begin: usize,
    pub end: usize,
    pub sign: f64,
    pub turn: f64,
}

/// A block of samples side by side.
type Lanes = [f64; LANES];

impl Piece<'_> {
    /// Places between the knots, from 0 to 1, of the block of samples from `start` on.
    #[inline(always)]
    fn places(&self, start: usize, from: f64, inverse: f64) -> Lanes {
        let theta = &self.theta[start..start + LANES];
        let mut places = [0.0; LANES];
        for k in 0..LANES {
            places[k] = (self.sign * theta[k] + self.turn - from) * inverse;
        }
        places
    }

    /// `scale` for samples of the piece, 0 for those of the block that lie beyond its end.
    #[inline(always)]
    fn inside(&self, start: usize, scale: f64) -> Lanes {
        let live = self.end - start;
        let mut scales = [0.0; LANES];
        for (k, place) in scales.iter_mut().enumerate() {
            *place = if k < live { scale } else { 0.0 };
        }
        scales
    }
}

/// Coefficients of the cubic with these values and slopes at 0 and 1.
#[inline(always)]
fn hermite(v0: f64, s0: f64, v1: f64, s1: f64) -> [f64; 4] {
    let d = v1 - v0;
    [v0, s0, 3.0 * d - 2.0 * s0 - s1, s0 + s1 - 2.0 * d]
}

/// Cubics of real and imaginary parts, from values and slopes at both ends, `h` apart.
#[inline(always)]
fn cubics_between(
    cubics: &mut [[f64; 4]; 8],
    [a, a_rate]: [&[Complex64; 4]; 2],
    [b, b_rate]: [&[Complex64; 4]; 2],
    h: f64,
) {
    for e in 0..4 {
        cubics[2 * e] = hermite(a[e].re, a_rate[e].re * h, b[e].re, b_rate[e].re * h);
        cubics[2 * e + 1] = hermite(a[e].im, a_rate[e].im * h, b[e].im, b_rate[e].im * h);
    }
}

#[inline(always)]
fn cubic<const FMA: bool>(c: &[f64; 4], t: f64) -> f64 {
    multiply_add::<FMA>(t, multiply_add::<FMA>(t, multiply_add::<FMA>(t, c[3], c[2]), c[1]), c[0])
}

/// A cubic at each lane. (A loop, since closures are not always compiled into the instruction set of
/// the function they stand in.)
#[inline(always)]
fn cubics_at<const FMA: bool>(c: &[f64; 4], t: &Lanes) -> Lanes {
    let mut values = [0.0; LANES];
    for k in 0..LANES {
        values[k] = cubic::<FMA>(c, t[k]);
    }
    values
}

/// Sine and cosine of `turns + per_turn · path`, times `scale`.
#[inline(always)]
fn waves<const FMA: bool>(
    path: &[f64; 4],
    t: &Lanes,
    per_turn: f64,
    turns: f64,
    scale: &Lanes,
) -> (Lanes, Lanes) {
    let (mut sin, mut cos) = ([0.0; LANES], [0.0; LANES]);
    for k in 0..LANES {
        let phase = per_turn * cubic::<FMA>(path, t[k]) + turns;
        let (s, c) = sin_cos_turns_with::<FMA>(phase);
        (sin[k], cos[k]) = (scale[k] * s, scale[k] * c);
    }
    (sin, cos)
}

/// Add `(re + i im)(cos + i sin)` to the block from `start` on of element `e`.
#[inline(always)]
fn add_turned<const FMA: bool>(
    rows: &mut [Vec<f64>; 8],
    e: usize,
    start: usize,
    [re, im]: [&Lanes; 2],
    sin: &Lanes,
    cos: &Lanes,
) {
    let row = &mut rows[2 * e][start..start + LANES];
    for k in 0..LANES {
        row[k] = multiply_add::<FMA>(re[k], cos[k], multiply_add::<FMA>(-im[k], sin[k], row[k]));
    }
    let row = &mut rows[2 * e + 1][start..start + LANES];
    for k in 0..LANES {
        row[k] = multiply_add::<FMA>(re[k], sin[k], multiply_add::<FMA>(im[k], cos[k], row[k]));
    }
}

/// One wave per sample.
#[inline(always)]
pub(super) fn single<const FMA: bool>(
    rows: &mut [Vec<f64>; 8],
    piece: &Piece,
    a: &Knot,
    b: &Knot,
    x: f64,
    turns: f64,
) {
    let (a, b) = (a.single(), b.single());
    let h = b.angle - a.angle;
    let path = hermite(a.path, a.path_slope * h, b.path, b.path_slope * h);
    let mut cubics = [[0.0; 4]; 8];
    cubics_between(&mut cubics, [&a.amplitudes, &a.rates], [&b.amplitudes, &b.rates], h);
    for start in (piece.begin..piece.end).step_by(LANES) {
        let t = piece.places(start, a.angle, 1.0 / h);
        let scale = piece.inside(start, x);
        let (sin, cos) = waves::<FMA>(&path, &t, x / TAU, turns, &scale);
        for e in 0..4 {
            let (re, im) =
                (cubics_at::<FMA>(&cubics[2 * e], &t), cubics_at::<FMA>(&cubics[2 * e + 1], &t));
            add_turned::<FMA>(rows, e, start, [&re, &im], &sin, &cos);
        }
    }
}

/// The uniform Airy formula for two rays.
#[inline(always)]
pub(super) fn pair<const FMA: bool>(
    rows: &mut [Vec<f64>; 8],
    piece: &Piece,
    [a, b]: [&Knot; 2],
    slopes: &[Knot],
    x: f64,
    turns: f64,
) {
    let sixth = x.powf(1.0 / 6.0);
    let two_thirds = sixth.powi(4);
    let (scale0, scale1) = (x * PI.sqrt() * sixth, x * PI.sqrt() / sixth);
    let (a, b) = (a.pair(), b.pair());
    let (rise, fall) = (slopes[0].pair(), slopes[1].pair());
    let h = b.angle - a.angle;
    let path = hermite(a.path, a.path_slope * h, b.path, b.path_slope * h);
    let zeta = hermite(a.zeta, a.zeta_slope * h, b.zeta, b.zeta_slope * h);
    let mut cubics = [[[0.0; 4]; 8]; 2];
    cubics_between(&mut cubics[0], [&a.sums, &rise.sums], [&b.sums, &fall.sums], h);
    let ends = [[&a.differences, &rise.differences], [&b.differences, &fall.differences]];
    cubics_between(&mut cubics[1], ends[0], ends[1], h);
    let [sums, differences] = cubics;
    for start in (piece.begin..piece.end).step_by(LANES) {
        let t = piece.places(start, a.angle, 1.0 / h);
        let (sin, cos) = waves::<FMA>(&path, &t, x / TAU, turns, &piece.inside(start, 1.0));
        let (mut w0, mut w1) = ([0.0; LANES], [0.0; LANES]);
        for k in 0..LANES.min(piece.end - start) {
            let (ai, slope) = airy::ai(-two_thirds * cubic::<FMA>(&zeta, t[k]));
            (w0[k], w1[k]) = (scale0 * ai, scale1 * slope);
        }
        for e in 0..4 {
            // w0 g₀ + i w1 g₁
            let (r, i) = (2 * e, 2 * e + 1);
            let (a, b) = (cubics_at::<FMA>(&sums[r], &t), cubics_at::<FMA>(&sums[i], &t));
            let c = cubics_at::<FMA>(&differences[i], &t);
            let d = cubics_at::<FMA>(&differences[r], &t);
            let (mut re, mut im) = ([0.0; LANES], [0.0; LANES]);
            for k in 0..LANES {
                re[k] = w0[k] * a[k] - w1[k] * c[k];
                im[k] = w0[k] * b[k] + w1[k] * d[k];
            }
            add_turned::<FMA>(rows, e, start, [&re, &im], &sin, &cos);
        }
    }
}

#[cfg(test)]
mod tests;
