//! The average over the sun's disc about the axis: the glory and the corona.
//!
//! Far from the axis the curves of equal scattering angle cross the disc as straight chords, and one
//! kernel averages along the angle alone (`sun_disc::filter`). About 0° and 180° they are circles, and
//! the planes of scattering turn from one side of the disc to the other. There the curve is first
//! freed of its fast beats by the same low-pass filter, the curve continued beyond the axis as its own
//! mirror image, and then averaged over the points of the disc, every point with its own angle
//! ```text
//! cos θ' = cos θ cos ρ - sin θ sin ρ cos ψ
//! ```
//! and its own plane of scattering, turned by χ: what is polarised along it counts with cos 2χ for the
//! plane that is asked for.

use super::sampling::{AXIS_MARGIN, Band};
use crate::color::{LimbDarkening, SUN_ANGULAR_RADIUS};
use crate::math::gauss_legendre;
use crate::sun_disc::SunFilter;
use std::f64::consts::PI;

/// XYZ of the parallel part, then of the perpendicular one.
pub(super) type Stimuli = [f64; 6];

/// Rings of the disc, and points of half a ring: beats of 3000 per radian turn 14 times from the
/// centre to the limb.
const RINGS: usize = 20;
const TURNS: usize = 40;
/// Points of the filtered curve per radian of the fastest beat that passes.
const PER_BEAT: f64 = 4.0;

/// Which axis an angle lies near.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// 0°.
    Forward,
    /// 180°.
    Backward,
}

impl Axis {
    /// The axis that a scattering angle (radians) is near to, if the disc must be taken as a disc.
    pub fn near(theta: f64) -> Option<Self> {
        match theta {
            _ if theta < AXIS_MARGIN => Some(Self::Forward),
            _ if theta > PI - AXIS_MARGIN => Some(Self::Backward),
            _ => None,
        }
    }

    /// Angle away from this axis.
    fn away(self, theta: f64) -> f64 {
        match self {
            Self::Forward => theta,
            Self::Backward => PI - theta,
        }
    }
}

/// Samples of a curve on an even grid of the whole circle.
#[derive(Clone, Copy, Debug)]
pub struct Samples<'a> {
    /// Place of the first one: its angle is that many steps.
    pub first: usize,
    pub band: &'a Band,
    pub values: &'a [Stimuli],
}

impl Samples<'_> {
    /// At any multiple of the step; the curve is even about 0 and about π.
    fn at(&self, place: i64) -> Stimuli {
        let turn = self.band.per_turn as i64;
        let folded = place.rem_euclid(turn);
        let folded = folded.min(turn - folded) as usize;
        let inside = folded.checked_sub(self.first).and_then(|i| self.values.get(i));
        inside.copied().unwrap_or_default()
    }
}

/// Averages about one axis, at the angles `centres` (radians) near it.
pub fn average(
    axis: Axis,
    filter: &SunFilter,
    limb: &LimbDarkening,
    samples: Samples,
    centres: &[f64],
) -> Vec<Stimuli> {
    let farthest = centres.iter().map(|&t| axis.away(t)).fold(0.0, f64::max);
    let smooth = Smooth::new(axis, filter, samples, farthest + SUN_ANGULAR_RADIUS);
    let rings = rings(limb);
    centres.iter().map(|&theta| smooth.over_disc(axis.away(theta), &rings)).collect()
}

/// Distances from the disc's centre and shares of its light, by Gauss's rule over rings of equal area.
fn rings(limb: &LimbDarkening) -> Vec<(f64, f64)> {
    let ring = |(node, weight): (f64, f64)| {
        let square = 0.5 * (1.0 + node);
        let light = limb.brightness((1.0 - square).sqrt());
        (SUN_ANGULAR_RADIUS * square.sqrt(), 0.5 * weight * light)
    };
    let mut rings: Vec<(f64, f64)> = gauss_legendre::nodes(RINGS).into_iter().map(ring).collect();
    let light: f64 = rings.iter().map(|ring| ring.1).sum();
    rings.iter_mut().for_each(|ring| ring.1 /= light);
    rings
}

/// The curve without its fast beats, by the angle from the axis.
struct Smooth {
    step: f64,
    values: Vec<Stimuli>,
}

impl Smooth {
    fn new(axis: Axis, filter: &SunFilter, samples: Samples, reach: f64) -> Self {
        let step = 1.0 / (PER_BEAT * filter.highest());
        let grid = samples.band.step();
        // Three more for the cubic at the end.
        let count = (reach / step).ceil() as usize + 3;
        let value = |i: usize| {
            let away = i as f64 * step;
            let theta = match axis {
                Axis::Forward => away,
                Axis::Backward => PI - away,
            };
            let (from, to) = (theta - filter.half_width(), theta + filter.half_width());
            let mut sum = Stimuli::default();
            for place in (from / grid).ceil() as i64..=(to / grid).floor() as i64 {
                let weight = grid * filter.low_pass(place as f64 * grid - theta);
                let sample = samples.at(place);
                sum.iter_mut().zip(sample).for_each(|(sum, value)| *sum += weight * value);
            }
            sum
        };
        Self { step, values: (0..count).map(value).collect() }
    }

    /// Cubic through the four nearest points.
    fn at(&self, away: f64) -> Stimuli {
        let place = away / self.step;
        let cell = place.floor();
        let t = place - cell;
        let weights = [
            -t * (t - 1.0) * (t - 2.0) / 6.0,
            (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
            -(t + 1.0) * t * (t - 2.0) / 2.0,
            (t + 1.0) * t * (t - 1.0) / 6.0,
        ];
        let mut out = Stimuli::default();
        for (k, weight) in weights.into_iter().enumerate() {
            // The curve is even about the axis.
            let i = (cell as i64 + k as i64 - 1).unsigned_abs() as usize;
            let value = &self.values[i.min(self.values.len() - 1)];
            out.iter_mut().zip(value).for_each(|(sum, value)| *sum += weight * value);
        }
        out
    }

    /// The mean over a disc whose centre lies at an angle from the axis.
    fn over_disc(&self, centre: f64, rings: &[(f64, f64)]) -> Stimuli {
        let (sine, cosine) = centre.sin_cos();
        let (mut total, mut difference) = ([0.0; 3], [0.0; 3]);
        for &(rho, share) in rings {
            let (s, c) = rho.sin_cos();
            for j in 0..TURNS {
                let (side, along) = (PI * (j as f64 + 0.5) / TURNS as f64).sin_cos();
                let (x, y) = (sine * c + cosine * s * along, s * side);
                let square = x * x + y * y;
                let away = square.sqrt().atan2(cosine * c - sine * s * along);
                // cos 2χ of the plane of scattering there; on the axis itself there is none.
                let turn = if square > 0.0 { (x * x - y * y) / square } else { 0.0 };
                let value = self.at(away);
                let weight = share / TURNS as f64;
                for k in 0..3 {
                    total[k] += weight * (value[k] + value[3 + k]);
                    difference[k] += weight * turn * (value[k] - value[3 + k]);
                }
            }
        }
        std::array::from_fn(|k| {
            let sign = if k < 3 { 1.0 } else { -1.0 };
            0.5 * (total[k % 3] + sign * difference[k % 3])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sun_disc::DiscPoints;
    use std::f64::consts::TAU;

    /// A slow ring about the axis as a sum over directions of the disc gives it, a fast one not at
    /// all; far enough from the axis as the kernel along the angle gives it.
    #[test]
    fn rings_about_the_axis_as_seen_through_the_disc() {
        let (cutoff, transition, highest) = (1500.0, 1000.0, 4000.0);
        let filter = SunFilter::new(cutoff, transition);
        let limb = LimbDarkening::at(550e-9);
        let per_turn = (highest + cutoff + transition) as usize;
        let band = Band { places: 0..1, per_turn };
        let disc = DiscPoints::new(SUN_ANGULAR_RADIUS, 60, 240);
        for (axis, frequency) in [
            (Axis::Backward, 0.0),
            (Axis::Backward, 300.0),
            (Axis::Backward, 1400.0),
            (Axis::Backward, 3900.0),
            (Axis::Forward, 700.0),
        ] {
            let curve = |away: f64| (frequency * away).cos();
            let values: Vec<Stimuli> = (0..=per_turn / 2)
                .map(|k| {
                    let theta = TAU * k as f64 / per_turn as f64;
                    let away = axis.away(theta);
                    [curve(away), 0.0, 0.0, 0.25, 0.0, 0.0]
                })
                .collect();
            let samples = Samples { first: 0, band: &band, values: &values };
            for degrees in [0.0, 0.1, 0.3, 0.9, 1.3] {
                let away = f64::to_radians(degrees);
                let theta = if axis == Axis::Forward { away } else { PI - away };
                let got = average(axis, &filter, &limb, samples, &[theta])[0];
                let (mut sum, mut norm) = (0.0, 0.0);
                for (ring, &mu) in disc.mu.iter().enumerate() {
                    for (there, _) in disc.around(ring, away, 0.0) {
                        let weight = limb.brightness(mu);
                        sum += weight * (0.25 + curve(there));
                        norm += weight;
                    }
                }
                let kept = frequency < cutoff + 0.5 * transition;
                let expected = if kept { sum / norm } else { 0.25 };
                let sum = got[0] + got[3];
                assert!((sum - expected).abs() < 5e-3, "{frequency} {degrees}: {sum} {expected}");
                // On the axis no polarisation is left.
                assert!(degrees > 0.0 || (got[0] - got[3]).abs() < 1e-9, "{got:?}");
            }
        }
    }

    /// At the border of the two averages they agree.
    #[test]
    fn both_averages_meet() {
        let filter = SunFilter::new(1500.0, 1000.0);
        let limb = LimbDarkening::at(550e-9);
        let band = Band { places: 0..1, per_turn: 8000 };
        let curve = |theta: f64| (350.0 * (PI - theta)).cos() + 2.0;
        let value = |theta: f64| [curve(theta), 0.0, 0.0, 0.0, 0.0, 0.0];
        let theta: Vec<f64> = (0..=4000).map(|k| f64::from(k) * band.step()).collect();
        let values: Vec<Stimuli> = theta.iter().map(|&t| value(t)).collect();
        let samples = Samples { first: 0, band: &band, values: &values };
        let centre = PI - AXIS_MARGIN;
        let disc = average(Axis::Backward, &filter, &limb, samples, &[centre])[0];
        let along = filter.kernel(&limb).average(&theta, band.step(), &values, &[centre])[0];
        let total = disc[0] + disc[3];
        // Straight chords miss the bend: the mean angle moves by R²/8 cot θ = 2.6e-5, times 350.
        assert!((total - along[0]).abs() < 1e-2, "{total} {}", along[0]);
        assert!(disc[3] < 1e-2, "{disc:?}");
    }
}
