//! A segment: a stretch of a plane's far field as knots, between which path and amplitudes are
//! cubics in the exit angle. What a knot holds depends on the kind of segment.
//!
//! Knots of neighbouring planes are mixed number by number, so that all kinds are stored as one array,
//! as wide as whole vector registers. Its places have names here, [`SingleKnot`] and [`PairKnot`], and
//! nobody else counts them.

use num_complex::Complex64;

/// Places of a knot; 21 at most are in use.
pub const CHANNELS: usize = 24;
/// Places of [`SingleKnot`]: angle, path, slope, then S1 … S4 (re, im) and their slopes.
const SINGLE: usize = 3;
const SINGLE_RATES: usize = SINGLE + ELEMENTS;
/// Places of [`PairKnot`]: angle, path, slope, ζ̂, its slope, then g₀ and g₁ (re, im by element).
const PAIR: usize = 5;
const PAIR_SECOND: usize = PAIR + ELEMENTS;
/// Real and imaginary parts of S1 … S4.
const ELEMENTS: usize = 8;

/// Data at one knot.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Knot([f64; CHANNELS]);

/// One wave: that of a ray, `T/√|spread|`, or any wave against a reference path.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SingleKnot {
    /// Exit angle, radians.
    pub angle: f64,
    /// Path, radii.
    pub path: f64,
    /// Its slope by the exit angle.
    pub path_slope: f64,
    /// S1 … S4.
    pub amplitudes: [Complex64; 4],
    /// Their slopes by the exit angle.
    pub rates: [Complex64; 4],
}

/// Two rays about a fold.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PairKnot {
    /// Exit angle, radians.
    pub angle: f64,
    /// Mean path, radii.
    pub path: f64,
    /// Its slope by the exit angle.
    pub path_slope: f64,
    /// `ζ̂`, the argument of the Airy functions but for the power of the size parameter.
    pub zeta: f64,
    /// Its slope by the exit angle.
    pub zeta_slope: f64,
    /// `g₀` of S1 … S4.
    pub sums: [Complex64; 4],
    /// `g₁` of S1 … S4.
    pub differences: [Complex64; 4],
}

impl From<SingleKnot> for Knot {
    fn from(knot: SingleKnot) -> Self {
        let mut channels = [0.0; CHANNELS];
        channels[..SINGLE].copy_from_slice(&[knot.angle, knot.path, knot.path_slope]);
        put(&mut channels, SINGLE, &knot.amplitudes);
        put(&mut channels, SINGLE_RATES, &knot.rates);
        Self(channels)
    }
}

impl From<PairKnot> for Knot {
    fn from(knot: PairKnot) -> Self {
        let PairKnot { angle, path, path_slope, zeta, zeta_slope, sums, differences } = knot;
        let mut channels = [0.0; CHANNELS];
        channels[..PAIR].copy_from_slice(&[angle, path, path_slope, zeta, zeta_slope]);
        put(&mut channels, PAIR, &sums);
        put(&mut channels, PAIR_SECOND, &differences);
        Self(channels)
    }
}

fn put(channels: &mut [f64; CHANNELS], first: usize, elements: &[Complex64; 4]) {
    for (place, element) in channels[first..].chunks_exact_mut(2).zip(elements) {
        place.copy_from_slice(&[element.re, element.im]);
    }
}

impl Knot {
    /// Exit angle: that of every kind.
    #[inline(always)]
    pub fn angle(&self) -> f64 {
        self.0[0]
    }

    /// Of a segment with one wave.
    #[inline(always)]
    pub fn single(&self) -> SingleKnot {
        SingleKnot {
            angle: self.0[0],
            path: self.0[1],
            path_slope: self.0[2],
            amplitudes: self.elements(SINGLE),
            rates: self.elements(SINGLE_RATES),
        }
    }

    /// Of a segment with two rays.
    #[inline(always)]
    pub fn pair(&self) -> PairKnot {
        PairKnot {
            angle: self.0[0],
            path: self.0[1],
            path_slope: self.0[2],
            zeta: self.0[3],
            zeta_slope: self.0[4],
            sums: self.elements(PAIR),
            differences: self.elements(PAIR_SECOND),
        }
    }

    #[inline(always)]
    fn elements(&self, first: usize) -> [Complex64; 4] {
        let at = |e: usize| Complex64::new(self.0[first + 2 * e], self.0[first + 2 * e + 1]);
        [at(0), at(1), at(2), at(3)]
    }

    /// All numbers, for what treats them alike.
    pub fn channels(&self) -> &[f64; CHANNELS] {
        &self.0
    }

    /// All places, to be mixed number by number.
    pub fn channels_mut(&mut self) -> &mut [f64; CHANNELS] {
        &mut self.0
    }

    /// Whether all of it are numbers.
    pub fn is_finite(&self) -> bool {
        self.0.iter().all(|value| value.is_finite())
    }

    /// The sum of knots times their weights.
    #[must_use]
    pub fn weighted<'k>(parts: impl Iterator<Item = (f64, &'k Self)>) -> Self {
        let mut sum = Self::default();
        for (weight, knot) in parts {
            sum.0.iter_mut().zip(knot.0).for_each(|(sum, value)| *sum += weight * value);
        }
        sum
    }
}

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

impl Kind {
    /// Sign of each number of a knot in the mirror: S3 and S4 change theirs.
    pub(crate) fn parity(self) -> [f64; CHANNELS] {
        let groups = match self {
            Kind::Plain { .. } | Kind::Wave => [SINGLE, SINGLE_RATES],
            Kind::Pair { .. } => [PAIR, PAIR_SECOND],
        };
        let odd = |c: usize| groups.iter().any(|g| (g + ELEMENTS / 2..g + ELEMENTS).contains(&c));
        std::array::from_fn(|c| if odd(c) { -1.0 } else { 1.0 })
    }
}

/// A stretch of a curve.
#[derive(Clone, Debug)]
pub struct Segment {
    /// What the knots interpolate.
    pub kind: Kind,
    /// Angles monotone, ascending or descending.
    pub knots: Vec<Knot>,
}

impl Segment {
    /// Its waves, multiplied by a share.
    pub(crate) fn scale(&mut self, share: f64) {
        let first = match self.kind {
            Kind::Plain { .. } | Kind::Wave => SINGLE,
            Kind::Pair { .. } => PAIR,
        };
        for knot in &mut self.knots {
            knot.0[first..first + 2 * ELEMENTS].iter_mut().for_each(|value| *value *= share);
        }
    }

    /// Its image in the mirror plane.
    pub(crate) fn mirror(&mut self) {
        let parity = self.kind.parity();
        for knot in &mut self.knots {
            knot.0.iter_mut().zip(parity).for_each(|(value, sign)| *value *= sign);
        }
    }
}

/// Slopes of all numbers at all knots by angle, from parabolas through neighbours.
pub fn parabola_slopes(knots: &[Knot]) -> Vec<Knot> {
    let last = knots.len() - 1;
    if last < 2 {
        let (from, to) = (&knots[0].0, &knots[last].0);
        let h = 1.0 / (to[0] - from[0]);
        return vec![Knot(std::array::from_fn(|c| (to[c] - from[c]) * h)); last + 1];
    }
    (0..=last)
        .map(|k| {
            let j = k.clamp(1, last - 1);
            let [a, b, c] = [&knots[j - 1].0, &knots[j].0, &knots[j + 1].0];
            let x = knots[k].angle();
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
            Knot(slope)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn elements(from: f64) -> [Complex64; 4] {
        std::array::from_fn(|k| Complex64::new(from + k as f64, -from - k as f64))
    }

    fn single(angle: f64) -> SingleKnot {
        let (amplitudes, rates) = (elements(angle), elements(2.0 * angle));
        SingleKnot { angle, path: 1.0 + angle * angle, path_slope: 2.0 * angle, amplitudes, rates }
    }

    #[test]
    fn what_goes_in_comes_out() {
        assert_eq!(Knot::from(single(0.5)).single(), single(0.5));
        let (sums, differences) = (elements(3.0), elements(7.0));
        let pair = PairKnot {
            angle: 1.0,
            path: 2.0,
            path_slope: 3.0,
            zeta: 4.0,
            zeta_slope: 5.0,
            sums,
            differences,
        };
        assert_eq!(Knot::from(pair).pair(), pair);
    }

    #[test]
    fn the_mirror_turns_cross_polarised_elements_alone() {
        let knots = vec![Knot::from(single(0.5))];
        let mut segment = Segment { kind: Kind::Wave, knots };
        segment.mirror();
        let [mirrored, before] = [segment.knots[0].single(), single(0.5)];
        assert_eq!((mirrored.path, mirrored.path_slope), (before.path, before.path_slope));
        for (mirrored, before) in
            [(mirrored.amplitudes, before.amplitudes), (mirrored.rates, before.rates)]
        {
            assert_eq!(mirrored[..2], before[..2]);
            assert_eq!(mirrored[2..], [-before[2], -before[3]]);
        }
        segment.mirror();
        assert_eq!(segment.knots[0].single(), before);
    }

    fn of_all(angle: f64, value: f64) -> Knot {
        Knot(std::array::from_fn(|c| if c == 0 { angle } else { value * c as f64 }))
    }

    /// Uneven knots, both ends included; descending ones too.
    #[test]
    fn slopes_of_parabolas_are_exact() {
        let mut knots: Vec<Knot> = [0.2, 0.3, 0.7, 0.75, 1.6]
            .iter()
            .map(|&t: &f64| of_all(t, 1.0 - 2.0 * t + 3.0 * t * t))
            .collect();
        for _ in 0..2 {
            for (knot, slope) in knots.iter().zip(parabola_slopes(&knots)) {
                assert!((slope.angle() - 1.0).abs() < 1e-12);
                for (c, slope) in slope.0.iter().enumerate().skip(1) {
                    let exact = c as f64 * (6.0 * knot.angle() - 2.0);
                    assert!((slope - exact).abs() < 1e-10, "{slope} {exact}");
                }
            }
            knots.reverse();
        }
    }

    #[test]
    fn two_knots_have_the_slope_of_their_line() {
        let slopes = parabola_slopes(&[of_all(0.5, 1.0), of_all(1.0, 4.0)]);
        assert_eq!(slopes.len(), 2);
        assert!(slopes.iter().all(|slope| slope.0[1] == 6.0 && slope.0[2] == 12.0));
    }

    #[test]
    fn half_way_is_the_mean() {
        let ends = [Knot::from(single(0.0)), single(1.0).into()];
        let middle = Knot::weighted(ends.iter().map(|end| (0.5, end))).single();
        assert_eq!(middle.angle, 0.5);
        assert_eq!(middle.path, 1.5);
        assert!(!Knot::from(single(f64::NAN)).is_finite());
    }
}
