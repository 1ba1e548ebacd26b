//! The sweep: adding a segment's waves to a column of samples, forward in memory.
//!
//! Between two knots path and amplitudes are cubics in the angle. A phase is carried in turns; whole
//! turns fall away exactly. The loops are plain arithmetic over arrays, compiled for several
//! instruction sets and chosen at run time.

use super::arc::{Kind, Knot, PAIR_AMPLITUDE, PLAIN_AMPLITUDE, Segment, WAVE_SLOPE};
use crate::math::airy;
use crate::math::phase::sin_cos_turns;
use crate::optics::AmplitudeMatrix;
use multiversion::multiversion;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Amplitudes of one column: real and imaginary parts of S1 … S4 by sample.
#[derive(Clone, Debug)]
pub struct Sums {
    pub parts: [Vec<f64>; 8],
}

impl Sums {
    pub fn new(samples: usize) -> Self {
        Self { parts: std::array::from_fn(|_| vec![0.0; samples]) }
    }

    /// As amplitude matrices.
    pub fn amplitudes(&self) -> Vec<AmplitudeMatrix> {
        let at = |k: usize, i: usize| Complex64::new(self.parts[2 * k][i], self.parts[2 * k + 1][i]);
        (0..self.parts[0].len())
            .map(|i| AmplitudeMatrix { s1: at(0, i), s2: at(1, i), s3: at(2, i), s4: at(3, i) })
            .collect()
    }
}

/// Which half of a meridian's plane a column is: the side of its azimuth, or the far side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Near,
    Far,
}

/// Samples handled at once; small enough for registers and the first cache.
const BLOCK: usize = 64;
/// Angle within which a sample counts as the axial ray.
const AXIAL: f64 = 1e-9;

/// Add a segment to the samples `theta` (ascending, radians) on one side of its plane.
pub fn add_segment(
    sums: &mut Sums,
    theta: &[f64],
    segment: &Segment,
    side: Side,
    size_parameter: f64,
) {
    let angle_of = |knot: &Knot| knot[0];
    let (first, last) = match (segment.knots.first(), segment.knots.last()) {
        (Some(a), Some(b)) => (angle_of(a), angle_of(b)),
        _ => return,
    };
    let (low, high) = (first.min(last), first.max(last));
    // ϑ = ±θ + 2πm: all turns m for which [0, π] meets the segment
    let (from, to) = match side {
        Side::Near => ((low - PI) / TAU, high / TAU),
        Side::Far => (low / TAU, (high + PI) / TAU),
    };
    for m in from.floor() as i64..=to.ceil() as i64 {
        sweep(sums, theta, segment, side, TAU * m as f64, size_parameter);
    }
}

/// One pass over the knots, for one whole number of turns.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2+fma"))]
fn sweep(sums: &mut Sums, theta: &[f64], segment: &Segment, side: Side, turn: f64, x: f64) {
    let sign = if side == Side::Near { 1.0 } else { -1.0 };
    // θ of an unwrapped angle
    let to_theta = |angle: f64| sign * (angle - turn);
    let knots = &segment.knots;
    let mut slopes: Option<Vec<Knot>> = None;
    let axial = matches!(segment.kind, Kind::Plain { from_axis: true, .. });
    for k in 1..knots.len() {
        let (a, b) = (to_theta(knots[k - 1][0]), to_theta(knots[k][0]));
        let (mut low, high) = (a.min(b), a.max(b));
        if high < -AXIAL || low > PI + AXIAL {
            continue;
        }
        // Half-open intervals; the axial ray itself belongs to the near side alone.
        let mut end = theta.partition_point(|&t| t < high);
        if axial && k == 1 {
            if side == Side::Near {
                low -= AXIAL;
                if a > b {
                    end = theta.partition_point(|&t| t <= high + AXIAL);
                }
            } else {
                low += if a < b { AXIAL } else { 0.0 };
                if a > b {
                    end = theta.partition_point(|&t| t < high - AXIAL);
                }
            }
        }
        let begin = theta.partition_point(|&t| t < low);
        if begin >= end {
            continue;
        }
        let slopes = slopes.get_or_insert_with(|| match segment.kind {
            Kind::Wave => knots.iter().map(wave_slopes).collect(),
            _ => amplitude_slopes(knots),
        });
        let channels = if matches!(segment.kind, Kind::Pair { .. }) { PAIR } else { SINGLE };
        let piece = Piece::new(&knots[k - 1], &knots[k], &slopes[k - 1], &slopes[k], channels);
        let mut at = begin;
        while at < end {
            let count = BLOCK.min(end - at);
            let mut t = [0.0; BLOCK];
            for (t, &theta) in t.iter_mut().zip(&theta[at..at + count]) {
                *t = (sign * theta + turn - piece.start) * piece.inverse;
            }
            match segment.kind {
                Kind::Plain { focal_lines, .. } => {
                    let turns = -0.25 * f64::from(1 + focal_lines);
                    plain(sums, at, &t[..count], &piece, x, turns);
                }
                Kind::Pair { focal_lines } => {
                    let turns = -0.25 - 0.125 * f64::from(focal_lines);
                    pair(sums, at, &t[..count], &piece, x, turns);
                }
                Kind::Wave => plain(sums, at, &t[..count], &piece, x, 0.0),
            }
            at += count;
        }
    }
}

/// Cubics between two knots, in `t` from 0 to 1.
struct Piece {
    start: f64,
    inverse: f64,
    path: [f64; 4],
    zeta: [f64; 4],
    amplitude: [[f64; 4]; PAIR],
}

/// Channels from the first amplitude of a plain knot on: S1 … S4; or ζ̂ and its slope, g₀ and g₁.
const SINGLE: usize = 8;
const PAIR: usize = 18;

impl Piece {
    #[inline(always)]
    fn new(a: &Knot, b: &Knot, sa: &Knot, sb: &Knot, channels: usize) -> Self {
        let h = b[0] - a[0];
        let hermite = |v0: f64, s0: f64, v1: f64, s1: f64| {
            let (s0, s1, d) = (s0 * h, s1 * h, v1 - v0);
            [v0, s0, 3.0 * d - 2.0 * s0 - s1, s0 + s1 - 2.0 * d]
        };
        let mut amplitude = [[0.0; 4]; PAIR];
        for (k, cubic) in amplitude.iter_mut().enumerate().take(channels) {
            let c = k + PLAIN_AMPLITUDE;
            *cubic = hermite(a[c], sa[c], b[c], sb[c]);
        }
        Self {
            start: a[0],
            inverse: 1.0 / h,
            path: hermite(a[1], a[2], b[1], b[2]),
            zeta: hermite(a[3], a[4], b[3], b[4]),
            amplitude,
        }
    }

    #[inline(always)]
    fn pair_amplitude(&self, channel: usize) -> &[f64; 4] {
        &self.amplitude[channel + PAIR_AMPLITUDE - PLAIN_AMPLITUDE]
    }
}

/// Slopes of the amplitudes of a wave, which stand in its knots.
fn wave_slopes(knot: &Knot) -> Knot {
    let mut slopes = [0.0; super::arc::CHANNELS];
    slopes[PLAIN_AMPLITUDE..PLAIN_AMPLITUDE + 8].copy_from_slice(&knot[WAVE_SLOPE..WAVE_SLOPE + 8]);
    slopes
}

/// Slopes of all channels at all knots, from parabolas through neighbours.
#[inline(always)]
fn amplitude_slopes(knots: &[Knot]) -> Vec<Knot> {
    let last = knots.len() - 1;
    if last < 2 {
        let h = 1.0 / (knots[last][0] - knots[0][0]);
        return vec![std::array::from_fn(|c| (knots[last][c] - knots[0][c]) * h); last + 1];
    }
    (0..=last)
        .map(|k| {
            let j = k.clamp(1, last - 1);
            let [a, b, c] = [&knots[j - 1], &knots[j], &knots[j + 1]];
            let x = knots[k][0];
            let (ab, ac, bc) = (a[0] - b[0], a[0] - c[0], b[0] - c[0]);
            let weights = [
                (2.0 * x - b[0] - c[0]) / (ab * ac),
                -(2.0 * x - a[0] - c[0]) / (ab * bc),
                (2.0 * x - a[0] - b[0]) / (ac * bc),
            ];
            std::array::from_fn(|i| weights[0] * a[i] + weights[1] * b[i] + weights[2] * c[i])
        })
        .collect()
}

#[inline(always)]
fn cubic(c: &[f64; 4], t: f64) -> f64 {
    c[0] + t * (c[1] + t * (c[2] + t * c[3]))
}

/// One ray per sample.
#[inline(always)]
fn plain(sums: &mut Sums, at: usize, t: &[f64], piece: &Piece, x: f64, turns: f64) {
    let mut sin = [0.0; BLOCK];
    let mut cos = [0.0; BLOCK];
    let per_turn = x / TAU;
    for ((&t, sin), cos) in t.iter().zip(&mut sin).zip(&mut cos) {
        let (s, c) = sin_cos_turns(per_turn * cubic(&piece.path, t) + turns);
        (*sin, *cos) = (x * s, x * c);
    }
    let mut parts = sums.parts.iter_mut();
    for element in 0..4 {
        let (re, im) = (&piece.amplitude[2 * element], &piece.amplitude[2 * element + 1]);
        let (Some(to_re), Some(to_im)) = (parts.next(), parts.next()) else { return };
        let (to_re, to_im) = (&mut to_re[at..at + t.len()], &mut to_im[at..at + t.len()]);
        for k in 0..t.len() {
            let (a, b) = (cubic(re, t[k]), cubic(im, t[k]));
            to_re[k] += a * cos[k] - b * sin[k];
            to_im[k] += a * sin[k] + b * cos[k];
        }
    }
}

/// The uniform Airy formula for two rays.
#[inline(always)]
fn pair(sums: &mut Sums, at: usize, t: &[f64], piece: &Piece, x: f64, turns: f64) {
    let sixth = x.powf(1.0 / 6.0);
    let two_thirds = sixth.powi(4);
    let (scale0, scale1) = (x * PI.sqrt() * sixth, x * PI.sqrt() / sixth);
    let per_turn = x / TAU;
    for (k, &t) in t.iter().enumerate() {
        let (s, c) = sin_cos_turns(per_turn * cubic(&piece.path, t) + turns);
        let (ai, slope) = airy::ai(-two_thirds * cubic(&piece.zeta, t));
        let (w0, w1) = (scale0 * ai, scale1 * slope);
        for element in 0..4 {
            let g = |channel: usize| cubic(piece.pair_amplitude(channel), t);
            let (a, b) = (g(2 * element), g(2 * element + 1));
            let (d, e) = (g(8 + 2 * element), g(9 + 2 * element));
            // w0 g₀ + i w1 g₁
            let (re, im) = (w0 * a - w1 * e, w0 * b + w1 * d);
            sums.parts[2 * element][at + k] += re * c - im * s;
            sums.parts[2 * element + 1][at + k] += re * s + im * c;
        }
    }
}
