//! The sweep: adding a segment's waves to a column of samples, forward in memory.
//!
//! It finds the samples between each two knots and chooses the kernel (`wave_kernels`), for several
//! instruction sets; which of them is chosen at run time.

use super::knots::{Kind, Knot, Segment, parabola_slopes};
use super::samples::{Samples, Side, Sums};
use super::wave_kernels::{Piece, pair, single};
use crate::cancel;
use multiversion::multiversion;
use multiversion::target::target_cfg_f;
use std::f64::consts::{PI, TAU};

/// Angle within which a sample counts as the axial ray.
const AXIAL: f64 = 2e-10;

/// Add a segment to the samples on one side of its plane.
pub fn add_segment(
    sums: &mut Sums,
    samples: &Samples,
    segment: &Segment,
    side: Side,
    size_parameter: f64,
) {
    cancel::checkpoint();
    let (first, last) = match (segment.knots.first(), segment.knots.last()) {
        (Some(a), Some(b)) => (a.angle(), b.angle()),
        _ => return,
    };
    let (low, high) = (first.min(last), first.max(last));
    // ϑ = ±θ + 2πm: all turns m for which [0, π] meets the segment
    let (from, to) = match side {
        Side::Near => ((low - PI) / TAU, high / TAU),
        Side::Far => (low / TAU, (high + PI) / TAU),
    };
    for m in from.floor() as i64..=to.ceil() as i64 {
        sweep(&mut sums.rows, samples, segment, side, TAU * m as f64, size_parameter);
    }
}

/// One pass over the pieces between knots in the order of the samples, for one whole number of turns.
#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
fn sweep(
    rows: &mut [Vec<f64>; 8],
    samples: &Samples,
    segment: &Segment,
    side: Side,
    turn: f64,
    x: f64,
) {
    let theta = samples.theta();
    let sign = if side == Side::Near { 1.0 } else { -1.0 };
    let knots = &segment.knots;
    let pieces = knots.len() - 1;
    // θ grows with the unwrapped angle on the near side
    let forward = (knots[pieces].angle() - knots[0].angle()) * sign > 0.0;
    let mut slopes: Option<Vec<Knot>> = None;
    let mut at = usize::MAX;
    for step in 0..pieces {
        let k = if forward { step } else { pieces - 1 - step };
        let (a, b) = (sign * (knots[k].angle() - turn), sign * (knots[k + 1].angle() - turn));
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
        let piece = Piece { theta: &samples.padded, begin, end, sign, turn };
        match segment.kind {
            Kind::Plain { .. } | Kind::Wave => {
                let turns = match segment.kind {
                    Kind::Plain { focal_lines, .. } => -0.25 * f64::from(1 + focal_lines),
                    _ => 0.0,
                };
                if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
                    single::<true>(rows, &piece, &knots[k], &knots[k + 1], x, turns);
                } else {
                    single::<false>(rows, &piece, &knots[k], &knots[k + 1], x, turns);
                }
            }
            Kind::Pair { focal_lines } => {
                let turns = -0.25 - 0.125 * f64::from(focal_lines);
                let slopes = slopes.get_or_insert_with(|| parabola_slopes(knots));
                let ends = [&knots[k], &knots[k + 1]];
                if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
                    pair::<true>(rows, &piece, ends, &slopes[k..], x, turns);
                } else {
                    pair::<false>(rows, &piece, ends, &slopes[k..], x, turns);
                }
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

#[cfg(test)]
mod tests;
