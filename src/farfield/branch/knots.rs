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

#[cfg(test)]
mod tests {
    use super::*;

    fn knot(angle: f64, value: f64) -> Knot {
        std::array::from_fn(|c| if c == 0 { angle } else { value * c as f64 })
    }

    /// Uneven knots, both ends included; descending ones too.
    #[test]
    fn slopes_of_parabolas_are_exact() {
        let mut knots: Vec<Knot> = [0.2, 0.3, 0.7, 0.75, 1.6]
            .iter()
            .map(|&t: &f64| knot(t, 1.0 - 2.0 * t + 3.0 * t * t))
            .collect();
        for _ in 0..2 {
            for (knot, slope) in knots.iter().zip(parabola_slopes(&knots)) {
                assert!((slope[0] - 1.0).abs() < 1e-12);
                for (c, slope) in slope.iter().enumerate().skip(1) {
                    let exact = c as f64 * (6.0 * knot[0] - 2.0);
                    assert!((slope - exact).abs() < 1e-10, "{slope} {exact}");
                }
            }
            knots.reverse();
        }
    }

    #[test]
    fn two_knots_have_the_slope_of_their_line() {
        let slopes = parabola_slopes(&[knot(0.5, 1.0), knot(1.0, 4.0)]);
        assert!(
            slopes.len() == 2 && slopes.iter().all(|slope| slope[1] == 6.0 && slope[2] == 12.0)
        );
    }
}
