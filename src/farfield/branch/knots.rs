//! A segment: a stretch of a plane's far field as knots, between which path and amplitudes are
//! cubics in the exit angle. What a knot holds depends on the kind of segment.

/// Numbers at a knot: angle, then
/// plain: path, its slope by angle, S1 … S4 (re, im) as `T/√|spread|`, their slopes;
/// pair: mean path, its slope, ζ̂, its slope, g₀ (re, im by element), g₁ (re, im by element);
/// wave: reference path, its slope, S1 … S4 against it, their slopes by angle.
/// 21 at most are in use; with 24 a knot fills whole vector registers.
pub const CHANNELS: usize = 24;
/// First channel of amplitudes in a plain knot (S3 and S4 follow at +4).
pub const PLAIN_AMPLITUDE: usize = 3;
/// First channel of the slopes of amplitudes by angle in a plain knot and in that of a wave.
pub const SLOPE: usize = 11;
/// First channel of g₀ in a pair knot; g₁ follows at +8.
pub const PAIR_AMPLITUDE: usize = 5;

/// Data at one knot.
pub type Knot = [f64; CHANNELS];

/// What a segment holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// One ray per direction; focal lines passed; whether it starts at the axial ray.
    Plain {
        /// Focal lines passed.
        focal_lines: u32,
        /// Whether it starts at the axial ray.
        from_axis: bool,
    },
    /// Two rays; sum of their focal lines.
    Pair {
        /// Sum over both rays.
        focal_lines: u32,
    },
    /// A wave that is no sum of rays, all phases in its amplitudes.
    Wave,
}

/// A stretch of a curve.
#[derive(Clone, Debug)]
pub struct Segment {
    /// What the knots interpolate.
    pub kind: Kind,
    /// Angles monotone, ascending or descending.
    pub knots: Vec<Knot>,
}

/// Slopes of all channels at all knots by angle, from parabolas through neighbours.
pub fn parabola_slopes(knots: &[Knot]) -> Vec<Knot> {
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
            let mut slope = [0.0; CHANNELS];
            for i in 0..CHANNELS {
                slope[i] = weights[0] * a[i] + weights[1] * b[i] + weights[2] * c[i];
            }
            slope
        })
        .collect()
}
