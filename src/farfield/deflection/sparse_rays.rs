//! The rays at a segment's knots, of which most are polynomials through every third.
//!
//! Knots are as close as cubics in the exit angle need that are to hold a phase; what a single ray is changes far more
//! slowly along a segment. So every third is traced, and the others follow from the six nearest of those, in the segment's own
//! coordinate, which takes care of square roots at its ends. Each traced ray is compared with what its neighbours make of it:
//! that errs by about ten times what there is between two, and where it is too much (total reflection inside, caustics), the
//! rays beside it are traced too.

use super::scattering_plane::{Node, ScatteringPlane};
use num_complex::Complex64;
use std::collections::BTreeMap;

/// Knots from one traced ray to the next.
const STRIDE: usize = 3;
/// Traced rays that a polynomial passes through, and the fewest of a segment.
const STENCIL: usize = 6;
const FEWEST: usize = 7;
/// How far a traced ray may be from what its neighbours make of it: radians of phase, and shares of field and spread.
const OFF: f64 = 2e-4;
/// The same for the impact, times the size parameter: its share in the phase between two knots is a hundredth of that.
const IMPACT_OFF: f64 = 0.02;

/// What a knot is made of, as numbers: angle, path, impact, spread, spread across, then S1 … S4 of the transfer.
const CHANNELS: usize = 13;
const FIELDS: usize = 5;

/// What a knot is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct KnotRay([f64; CHANNELS]);

impl KnotRay {
    /// Of a traced ray.
    pub(crate) fn new(plane: &ScatteringPlane, node: &Node) -> Self {
        let (_, growing) = plane.frame(node.angle);
        let transfer = plane.transfer(&node.exit, node.angle);
        let mut channels = [0.0; CHANNELS];
        channels[..FIELDS].copy_from_slice(&[
            node.angle,
            node.exit.path,
            node.exit.reference.dot(growing),
            node.exit.spread(),
            plane.spread_across(&node.exit, node.angle),
        ]);
        let elements = [transfer.s1, transfer.s2, transfer.s3, transfer.s4];
        for (place, element) in channels[FIELDS..].chunks_exact_mut(2).zip(elements) {
            place.copy_from_slice(&[element.re, element.im]);
        }
        Self(channels)
    }

    /// Exit angle.
    pub(crate) fn angle(&self) -> f64 {
        self.0[0]
    }

    /// Path, and its slope by the exit angle.
    pub(crate) fn path(&self) -> [f64; 2] {
        [self.0[1], -self.0[2]]
    }

    /// Solid angle per area of the wavefront, and its part across the plane.
    pub(crate) fn spreads(&self) -> [f64; 2] {
        [self.0[3], self.0[4]]
    }

    /// S1 … S4 of the transfer.
    pub(crate) fn transfer(&self) -> [Complex64; 4] {
        std::array::from_fn(|e| Complex64::new(self.0[FIELDS + 2 * e], self.0[FIELDS + 2 * e + 1]))
    }

    /// The polynomial through traced rays, in the number of the knot.
    fn through(rays: &[(usize, Self)], at: usize) -> Self {
        let mut sum = [0.0; CHANNELS];
        for (k, ray) in rays {
            let others = rays.iter().filter(|other| other.0 != *k);
            let off = |one: usize| at as f64 - one as f64;
            let weight: f64 = others.map(|other| off(other.0) / (off(other.0) - off(*k))).product();
            sum.iter_mut().zip(ray.0).for_each(|(sum, value)| *sum += weight * value);
        }
        Self(sum)
    }

    /// Whether another is the same ray, so near that what lies between follows.
    fn agrees(&self, other: &Self, x: f64) -> bool {
        let (a, b) = (&self.0, &other.0);
        let off = |c: usize| (a[c] - b[c]).abs();
        let phase = x * (a[1] - b[1] + b[2] * (a[0] - b[0])).abs();
        let fields = FIELDS..CHANNELS;
        let size = fields.clone().map(|c| b[c].abs()).fold(0.0, f64::max);
        phase < OFF
            && x * off(2) < IMPACT_OFF
            && off(3) < OFF * b[3].abs()
            && off(4) < OFF * b[4].abs()
            && fields.clone().all(|c| off(c) < OFF * size)
    }
}

/// The rays at knots `0..=count`, most of them from others that `traced` finds, which it is asked for once each. `None` where one
/// cannot be found.
pub(crate) fn rays_at_knots(
    count: usize,
    x: f64,
    mut traced: impl FnMut(usize) -> Option<KnotRay>,
) -> Option<Vec<KnotRay>> {
    let known = count / STRIDE + 1;
    if known < FEWEST {
        return (0..=count).map(traced).collect();
    }
    let every: Vec<(usize, KnotRay)> =
        (0..known).map(|j| Some((STRIDE * j, traced(STRIDE * j)?))).collect::<Option<_>>()?;
    let about = |j: usize| j.saturating_sub(STENCIL / 2).min(known - STENCIL - 1);
    let follows: Vec<bool> = (0..known)
        .map(|j| {
            let near = about(j)..about(j) + STENCIL + 1;
            let others: Vec<(usize, KnotRay)> =
                every[near].iter().filter(|ray| ray.0 != STRIDE * j).copied().collect();
            // next to the ends rays change fastest
            let end = j == 0 || j + 1 == known;
            !end && KnotRay::through(&others, STRIDE * j).agrees(&every[j].1, x)
        })
        .collect();
    let mut rays: BTreeMap<usize, KnotRay> = every.iter().copied().collect();
    for k in 0..=count {
        if rays.contains_key(&k) {
            continue;
        }
        let j = k / STRIDE;
        let ray = if j + 1 < known && follows[j] && follows[j + 1] {
            let first = (j + 1).saturating_sub(STENCIL / 2).min(known - STENCIL);
            KnotRay::through(&every[first..first + STENCIL], k)
        } else {
            traced(k)?
        };
        rays.insert(k, ray);
    }
    Some(rays.into_values().collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A made-up ray with its impact as the slope of its path.
    fn ray(t: f64, kink: f64) -> KnotRay {
        let angle = 1.0 + 2.0 * t;
        let jump = if t > kink { (t - kink).sqrt() } else { 0.0 };
        let mut channels = [0.0; CHANNELS];
        channels[..FIELDS].copy_from_slice(&[
            angle,
            (0.5 * angle).sin(),
            -0.5 * (0.5 * angle).cos(),
            1.0 + t * t,
            2.0 - t,
        ]);
        for (c, value) in channels[FIELDS..].iter_mut().enumerate() {
            *value = (t + 0.3 * c as f64).cos() + jump;
        }
        KnotRay(channels)
    }

    /// Of smooth rays a third is traced, and the others come out within what is allowed.
    #[test]
    fn most_rays_follow_from_others() {
        let (count, x) = (46, 5000.0);
        let at = |k: usize| ray(k as f64 / count as f64, 2.0);
        let mut asked = Vec::new();
        let found = rays_at_knots(count, x, |k| {
            asked.push(k);
            Some(at(k))
        })
        .unwrap();
        assert_eq!(found.len(), count + 1);
        // every third, the last one behind them, and those next to the ends
        assert_eq!(asked.len(), 21, "{asked:?}");
        for (k, found) in found.iter().enumerate() {
            let off = found.0.iter().zip(at(k).0).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-7, "{k}: {off:e}");
        }
        let missing = rays_at_knots(count, x, |k| (k != 9).then(|| at(k)));
        assert!(missing.is_none());
    }

    /// About a kink rays are traced; few knots are all traced.
    #[test]
    fn rays_about_a_kink_are_traced() {
        let (count, x) = (60, 5000.0);
        let at = |k: usize| ray(k as f64 / count as f64, 0.5);
        let mut asked = Vec::new();
        let found = rays_at_knots(count, x, |k| {
            asked.push(k);
            Some(at(k))
        })
        .unwrap();
        assert!((25..50).contains(&asked.len()), "{}", asked.len());
        for (k, found) in found.iter().enumerate() {
            assert!(found.agrees(&at(k), x), "{k}");
        }
        let mut asked = 0;
        rays_at_knots(16, x, |k| {
            asked += 1;
            Some(at(k))
        });
        assert_eq!(asked, 17);
    }
}
