//! The sweep: adding a segment's waves to a column of samples, forward in memory.
//!
//! Between two knots path and amplitudes are cubics in the angle. A phase is carried in turns; whole
//! turns fall away exactly. Sines and cosines are computed for eight samples side by side, then the
//! eight parts of S1 … S4 side by side for each; the loops are plain arithmetic over arrays, compiled
//! for several instruction sets and chosen at run time.

use super::segment::{
    Kind, Knot, PAIR_AMPLITUDE, PLAIN_AMPLITUDE, SLOPE, Segment, parabola_slopes,
};
use crate::math::airy;
use crate::math::phase::sin_cos_turns;
use crate::optics::AmplitudeMatrix;
use multiversion::multiversion;
use multiversion::target::target_cfg_f;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Amplitudes of one column by sample: real and imaginary parts of S1 … S4.
#[derive(Clone, Debug)]
pub struct Sums {
    rows: Vec<[f64; 8]>,
}

impl Sums {
    pub fn new(samples: usize) -> Self {
        Self { rows: vec![[0.0; 8]; samples] }
    }

    /// As amplitude matrices.
    pub fn amplitudes(&self) -> Vec<AmplitudeMatrix> {
        let matrix = |row: &[f64; 8]| {
            let at = |k: usize| Complex64::new(row[2 * k], row[2 * k + 1]);
            AmplitudeMatrix { s1: at(0), s2: at(1), s3: at(2), s4: at(3) }
        };
        self.rows.iter().map(matrix).collect()
    }
}

/// Which half of a meridian's plane a column is: the side of its azimuth, or the far side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Near,
    Far,
}

/// Samples whose phases are computed side by side.
const LANES: usize = 8;
/// Angle within which a sample counts as the axial ray.
const AXIAL: f64 = 2e-10;

/// Add a segment to the samples `theta` (ascending, radians) on one side of its plane.
pub fn add_segment(
    sums: &mut Sums,
    theta: &[f64],
    segment: &Segment,
    side: Side,
    size_parameter: f64,
) {
    let (first, last) = match (segment.knots.first(), segment.knots.last()) {
        (Some(a), Some(b)) => (a[0], b[0]),
        _ => return,
    };
    let (low, high) = (first.min(last), first.max(last));
    // ϑ = ±θ + 2πm: all turns m for which [0, π] meets the segment
    let (from, to) = match side {
        Side::Near => ((low - PI) / TAU, high / TAU),
        Side::Far => (low / TAU, (high + PI) / TAU),
    };
    for m in from.floor() as i64..=to.ceil() as i64 {
        sweep(&mut sums.rows, theta, segment, side, TAU * m as f64, size_parameter);
    }
}

/// One pass over the pieces between knots in the order of the samples, for one whole number of turns.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2+fma"))]
fn sweep(rows: &mut [[f64; 8]], theta: &[f64], segment: &Segment, side: Side, turn: f64, x: f64) {
    let sign = if side == Side::Near { 1.0 } else { -1.0 };
    let knots = &segment.knots;
    let pieces = knots.len() - 1;
    // θ grows with the unwrapped angle on the near side
    let forward = (knots[pieces][0] - knots[0][0]) * sign > 0.0;
    let mut slopes: Option<Vec<Knot>> = None;
    let mut at = usize::MAX;
    for step in 0..pieces {
        let k = if forward { step } else { pieces - 1 - step };
        let (a, b) = (sign * (knots[k][0] - turn), sign * (knots[k + 1][0] - turn));
        let (low, high) = (a.min(b), a.max(b));
        if high < -AXIAL || low > PI + AXIAL {
            continue;
        }
        let axial = k == 0 && matches!(segment.kind, Kind::Plain { from_axis: true, .. });
        let (low, high) = if axial { with_axial(low, high, side, a > b) } else { (low, high) };
        // samples of [low, high), walked to from those of the piece before
        let mut begin = if at == usize::MAX { theta.partition_point(|&t| t < low) } else { at };
        while begin > 0 && theta[begin - 1] >= low {
            begin -= 1;
        }
        while begin < theta.len() && theta[begin] < low {
            begin += 1;
        }
        let mut end = begin;
        while end < theta.len() && theta[end] < high {
            end += 1;
        }
        at = end;
        if begin == end {
            continue;
        }
        let samples = Samples { theta: &theta[begin..end], sign, turn };
        let rows = &mut rows[begin..end];
        match segment.kind {
            Kind::Plain { .. } | Kind::Wave => {
                let turns = match segment.kind {
                    Kind::Plain { focal_lines, .. } => -0.25 * f64::from(1 + focal_lines),
                    _ => 0.0,
                };
                if target_cfg_f!(target_feature = "fma") {
                    single::<true>(rows, &samples, &knots[k], &knots[k + 1], x, turns);
                } else {
                    single::<false>(rows, &samples, &knots[k], &knots[k + 1], x, turns);
                }
            }
            Kind::Pair { focal_lines } => {
                let turns = -0.25 - 0.125 * f64::from(focal_lines);
                let slopes = slopes.get_or_insert_with(|| parabola_slopes(knots));
                pair(rows, &samples, [&knots[k], &knots[k + 1]], &slopes[k..], x, turns);
            }
        }
    }
}

/// The piece next to the axial ray: that ray itself belongs to the near side alone, also where
/// rounding puts the sample on the axis a little beside it.
#[inline(always)]
fn with_axial(low: f64, high: f64, side: Side, falling: bool) -> (f64, f64) {
    let end = if falling { 1.0 } else { 0.0 };
    if side == Side::Near {
        return (low - AXIAL, high + end * AXIAL);
    }
    (low + (1.0 - end) * AXIAL, high - end * AXIAL)
}

/// Samples of one piece.
struct Samples<'a> {
    theta: &'a [f64],
    sign: f64,
    turn: f64,
}

impl Samples<'_> {
    /// Place between the knots, from 0 to 1, of samples from `start` on; beyond the last, 0.
    #[inline(always)]
    fn places(&self, start: usize, from: f64, inverse: f64) -> [f64; LANES] {
        let mut t = [0.0; LANES];
        let count = LANES.min(self.theta.len() - start);
        for (t, theta) in t.iter_mut().zip(&self.theta[start..start + count]) {
            *t = (self.sign * theta + self.turn - from) * inverse;
        }
        t
    }
}

/// Coefficients of the cubic with these values and slopes at 0 and 1.
#[inline(always)]
fn hermite(v0: f64, s0: f64, v1: f64, s1: f64) -> [f64; 4] {
    let d = v1 - v0;
    [v0, s0, 3.0 * d - 2.0 * s0 - s1, s0 + s1 - 2.0 * d]
}

#[inline(always)]
fn cubic(c: &[f64; 4], t: f64) -> f64 {
    c[0] + t * (c[1] + t * (c[2] + t * c[3]))
}

/// Weights of the values and slopes (per unit of angle) at both knots, `h` radians apart.
#[inline(always)]
fn hermite_weights(t: f64, h: f64) -> [f64; 4] {
    let u = 1.0 - t;
    [(1.0 + 2.0 * t) * u * u, t * u * u * h, t * t * (3.0 - 2.0 * t), -t * t * u * h]
}

/// One wave per sample.
#[inline(always)]
fn single<const FMA: bool>(
    rows: &mut [[f64; 8]],
    samples: &Samples,
    a: &Knot,
    b: &Knot,
    x: f64,
    turns: f64,
) {
    let h = b[0] - a[0];
    let path = hermite(a[1], a[2] * h, b[1], b[2] * h);
    let per_turn = x / TAU;
    let [va, sa, vb, sb] =
        [part(a, PLAIN_AMPLITUDE), part(a, SLOPE), part(b, PLAIN_AMPLITUDE), part(b, SLOPE)];
    for (block, rows) in rows.chunks_mut(LANES).enumerate() {
        let t = samples.places(LANES * block, a[0], 1.0 / h);
        let (mut sin, mut cos) = ([0.0; LANES], [0.0; LANES]);
        for k in 0..LANES {
            let (s, c) = sin_cos_turns(per_turn * cubic(&path, t[k]) + turns);
            (sin[k], cos[k]) = (x * s, x * c);
        }
        for (k, row) in rows.iter_mut().enumerate() {
            let w = hermite_weights(t[k], h);
            let mut v = [0.0; 8];
            for c in 0..8 {
                let values = madd::<FMA>(w[0], va[c], w[2] * vb[c]);
                v[c] = madd::<FMA>(w[1], sa[c], madd::<FMA>(w[3], sb[c], values));
            }
            for e in 0..4 {
                let (re, im) = (v[2 * e], v[2 * e + 1]);
                row[2 * e] = madd::<FMA>(re, cos[k], madd::<FMA>(-im, sin[k], row[2 * e]));
                row[2 * e + 1] = madd::<FMA>(re, sin[k], madd::<FMA>(im, cos[k], row[2 * e + 1]));
            }
        }
    }
}

/// `a b + c`, in one instruction where the machine has it (elsewhere that would be a slow call).
#[inline(always)]
fn madd<const FMA: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FMA { a.mul_add(b, c) } else { a * b + c }
}

/// Eight channels of a knot from one on.
#[inline(always)]
fn part(knot: &Knot, first: usize) -> [f64; 8] {
    std::array::from_fn(|c| knot[first + c])
}

/// The uniform Airy formula for two rays.
#[inline(always)]
fn pair(
    rows: &mut [[f64; 8]],
    samples: &Samples,
    [a, b]: [&Knot; 2],
    slopes: &[Knot],
    x: f64,
    turns: f64,
) {
    let sixth = x.powf(1.0 / 6.0);
    let two_thirds = sixth.powi(4);
    let (scale0, scale1) = (x * PI.sqrt() * sixth, x * PI.sqrt() / sixth);
    let per_turn = x / TAU;
    let h = b[0] - a[0];
    let path = hermite(a[1], a[2] * h, b[1], b[2] * h);
    let zeta = hermite(a[3], a[4] * h, b[3], b[4] * h);
    for (block, rows) in rows.chunks_mut(LANES).enumerate() {
        let t = samples.places(LANES * block, a[0], 1.0 / h);
        for (k, row) in rows.iter_mut().enumerate() {
            let (s, c) = sin_cos_turns(per_turn * cubic(&path, t[k]) + turns);
            let (ai, slope) = airy::ai(-two_thirds * cubic(&zeta, t[k]));
            let (w0, w1) = (scale0 * ai, scale1 * slope);
            let w = hermite_weights(t[k], h);
            let g = |channel: usize| {
                let i = PAIR_AMPLITUDE + channel;
                w[0] * a[i] + w[1] * slopes[0][i] + w[2] * b[i] + w[3] * slopes[1][i]
            };
            for e in 0..4 {
                // w0 g₀ + i w1 g₁
                let re = w0 * g(2 * e) - w1 * g(9 + 2 * e);
                let im = w0 * g(2 * e + 1) + w1 * g(8 + 2 * e);
                row[2 * e] += re * c - im * s;
                row[2 * e + 1] += re * s + im * c;
            }
        }
    }
}
