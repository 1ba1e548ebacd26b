//! The mean over the sun's disc of a field over scattering angle and azimuth that is sampled at even angles.
//!
//! Every point of the disc sees another scattering angle and, near the axis, another azimuth:
//! ```text
//!     cos θ' = cos θ cos ρ - sin θ sin ρ cos ψ,    tan(φ' - φ) = sin ρ sin ψ / (sin θ cos ρ + cos θ sin ρ cos ψ)
//! ```
//! With weights of the samples about θ' (a cubic) and, where the azimuths are even too, about φ', the mean is a
//! fixed sum of samples. Further than [`NEAR_AXIS`] from the axis the azimuth changes by no more than 3° over the
//! disc, and is left alone: means of drops change with it as cos 2φ does. The turn of the plane of polarisation
//! is left out, as of spheres ([`super::DiscMean`]).

use super::mean::{cubic, rings};
use crate::color::{LimbDarkening, SUN_ANGULAR_RADIUS};
use crate::math::parallel::*;
use crate::optics::mirror_sign;
use ndarray::{Array3, ArrayView2, Axis};
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::ops::Range;

/// Samples per radius of the disc.
const PER_RADIUS: f64 = 5.0;
/// Rings of points on the disc.
const RINGS: usize = 10;
/// Nearer to the axis than this, radians, the azimuth counts.
const NEAR_AXIS: f64 = 5.0 * PI / 180.0;
/// Nearer to the light than this, values are means over their cells: the forward peak is as narrow as the disc.
const PEAK: f64 = 10.0 * SUN_ANGULAR_RADIUS;
/// Angles within a cell.
const WITHIN_CELL: usize = 12;
/// Neighbours in azimuth.
const STENCIL: usize = 6;

/// A sample's place: row of scattering angle, steps of azimuth on from that of the mean.
type Place = (usize, usize);

/// How samples add up to means over the disc.
#[derive(Clone, Debug)]
pub struct DiscField {
    /// Steps of a half-circle of scattering angle.
    count: usize,
    /// Those of its angles that are needed.
    needed: Range<usize>,
    /// Steps of a half-turn of azimuth; `None`: each azimuth is averaged by itself.
    half_turn: Option<usize>,
    /// Weights of each mean.
    means: Vec<Vec<(Place, f64)>>,
}

impl DiscField {
    /// Means at scattering angles (ascending, radians), over an even step of which they are taken near the light
    /// where `cells` says so. Azimuths stand at even steps of a `half_turn`, both ends in, or anywhere.
    pub fn new(
        theta: &[f64],
        limb: Option<LimbDarkening>,
        cells: bool,
        half_turn: Option<usize>,
    ) -> Self {
        let count = (PI / SUN_ANGULAR_RADIUS * PER_RADIUS).ceil() as usize;
        let disc = Disc { rings: rings(RINGS, limb), count, half_turn };
        let last = theta.len() - 1;
        let cell = |i: usize| {
            let low = if i == 0 { theta[0] } else { 0.5 * (theta[i - 1] + theta[i]) };
            let high = if i == last { theta[last] } else { 0.5 * (theta[i] + theta[i + 1]) };
            (low, high)
        };
        let means: Vec<Vec<(Place, f64)>> = (0..theta.len())
            .into_par_iter()
            .map(|i| {
                let (low, high) = cell(i);
                let mut sum = BTreeMap::new();
                if !(cells && theta[i] < PEAK && high > low) {
                    disc.add(theta[i], 1.0, &mut sum);
                    return sum.into_iter().collect();
                }
                let within = |k: usize| low + (high - low) * (k as f64 + 0.5) / WITHIN_CELL as f64;
                let total: f64 = (0..WITHIN_CELL).map(|k| within(k).sin()).sum();
                for angle in (0..WITHIN_CELL).map(within) {
                    disc.add(angle, angle.sin() / total, &mut sum);
                }
                sum.into_iter().collect()
            })
            .collect();
        let rows = || means.iter().flatten().map(|((row, _), _)| *row);
        let needed = rows().min().unwrap_or(0)..rows().max().unwrap_or(count) + 1;
        Self { count, needed, half_turn, means }
    }

    /// Scattering angles at which the field is needed, radians.
    pub fn fine_angles(&self) -> Vec<f64> {
        self.needed.clone().map(|row| PI * row as f64 / self.count as f64).collect()
    }

    /// The means of a field of shape (elements of the Mueller matrix, fine angles, azimuths); of one azimuth
    /// for all it stands for all.
    pub fn means(&self, field: &Array3<f64>) -> Array3<f64> {
        let (elements, _, azimuths) = field.dim();
        let mut out = Array3::zeros((elements, self.means.len(), azimuths));
        for (element, mut face) in out.axis_iter_mut(Axis(0)).enumerate() {
            let from = field.index_axis(Axis(0), element);
            let rows = face.axis_iter_mut(Axis(0)).into_par_iter().zip(&self.means);
            rows.for_each(|(mut row, weights)| {
                for (j, value) in row.iter_mut().enumerate() {
                    *value = self.mean(&from, mirror_sign(element), weights, j);
                }
            });
        }
        out
    }

    fn mean(
        &self,
        from: &ArrayView2<'_, f64>,
        mirrored: f64,
        weights: &[(Place, f64)],
        azimuth: usize,
    ) -> f64 {
        let sample = |&((row, turn), weight): &(Place, f64)| {
            let row = row - self.needed.start;
            let Some(steps) = self.half_turn.filter(|steps| from.ncols() == steps + 1) else {
                return weight * from[(row, azimuth)];
            };
            match (azimuth + turn) % (2 * steps) {
                place if place > steps => weight * mirrored * from[(row, 2 * steps - place)],
                place => weight * from[(row, place)],
            }
        };
        weights.iter().map(sample).sum()
    }
}

/// Whether any of some scattering angles is so near to the axis that its mean takes azimuths together.
pub(crate) fn near_axis(theta: &[f64]) -> bool {
    theta.iter().any(|theta| theta.min(PI - theta) < NEAR_AXIS)
}

/// The points of the disc, and where samples are.
struct Disc {
    rings: Vec<(f64, f64)>,
    count: usize,
    half_turn: Option<usize>,
}

impl Disc {
    /// Add the weights of the mean about one angle, `share` in all.
    fn add(&self, theta: f64, share: f64, sum: &mut BTreeMap<Place, f64>) {
        let (st, ct) = theta.sin_cos();
        let half_turn = self.half_turn.filter(|_| near_axis(&[theta]));
        // the other half of the disc is its mirror image
        let turns = 2 * self.rings.len();
        for (rho, light) in &self.rings {
            let (sr, cr) = rho.sin_cos();
            for k in 0..turns {
                let (s, c) = (PI * (k as f64 + 0.5) / turns as f64).sin_cos();
                let (along, x, y) = (ct * cr - st * sr * c, st * cr + ct * sr * c, sr * s);
                let (angle, turn) = (x.hypot(y).atan2(along), y.atan2(x));
                let weight = share * light / turns as f64;
                match half_turn {
                    None => self.add_point((angle, None), weight, sum),
                    Some(steps) => {
                        self.add_point((angle, Some((turn, steps))), 0.5 * weight, sum);
                        self.add_point((angle, Some((-turn, steps))), 0.5 * weight, sum);
                    }
                }
            }
        }
    }

    /// Add those of one point of it: its scattering angle, its turn of azimuth with the steps of a half-turn.
    fn add_point(
        &self,
        (angle, turn): (f64, Option<(f64, usize)>),
        weight: f64,
        sum: &mut BTreeMap<Place, f64>,
    ) {
        let place = angle / PI * self.count as f64;
        let cell = (place.floor() as usize).min(self.count - 1);
        let last = self.count as isize;
        for (k, share) in cubic(place - cell as f64).into_iter().enumerate() {
            // beyond the axis the field goes on on the other side
            let row = cell as isize + k as isize - 1;
            let (row, beyond) = if row < 0 {
                (-row, true)
            } else if row > last {
                (2 * last - row, true)
            } else {
                (row, false)
            };
            let Some((turn, steps)) = turn else {
                *sum.entry((row as usize, 0)).or_default() += weight * share;
                continue;
            };
            let turn = if beyond { turn + PI } else { turn };
            for (step, part) in around(turn, steps) {
                *sum.entry((row as usize, step)).or_default() += weight * share * part;
            }
        }
    }
}

/// The polynomial through the nearest azimuths at a turn: steps on, up to a whole turn, and weights.
fn around(turn: f64, steps: usize) -> [(usize, f64); STENCIL] {
    let place = turn.rem_euclid(TAU) / PI * steps as f64;
    let first = place.floor() as i64 - (STENCIL as i64 / 2 - 1);
    let at = place - first as f64;
    std::array::from_fn(|k| {
        let others = (0..STENCIL).filter(|&j| j != k);
        let weight = others.map(|j| (at - j as f64) / (k as f64 - j as f64)).product();
        ((first + k as i64).rem_euclid(2 * steps as i64) as usize, weight)
    })
}

#[cfg(test)]
mod tests;
