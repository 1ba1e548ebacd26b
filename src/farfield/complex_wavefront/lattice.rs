//! The points of the sum: rings whose distances follow from the width of the integrand, each with its own
//! even number of points.
//!
//! Sums over even steps of a smooth integrand are exact but for what is smaller than the step; so steps may
//! change from ring to ring only smoothly. Rings stand at even steps of `t(α) = ∫ dα/h(α)`, symmetric
//! about the rim, where the integrand goes on as its mirror image.

use super::coarse::{RINGS, SPOKES, Steps};
use std::f64::consts::{FRAC_PI_2, TAU};
use std::ops::Range;

/// All rings of one order.
pub(super) struct Lattice {
    pub rings: Vec<Ring>,
}

/// One ring.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ring {
    pub alpha: f64,
    /// `sin α cos α Δα Δψ`.
    pub weight: f64,
    count: usize,
}

/// Rings over which steps are smoothed, to both sides.
const SMOOTHED: usize = 8;
/// Limits of the number of rings and of points on a ring.
const FEWEST: f64 = 24.0;
const MOST: f64 = 40_000.0;

impl Lattice {
    /// From the steps on the coarse rings, so many times as wide.
    pub(super) fn new(steps: &Steps, wider: f64) -> Self {
        let density = |axis: usize| {
            let largest = FRAC_PI_2 / FEWEST;
            smoothed(
                &steps.iter().map(|s| 1.0 / (wider * s[axis]).min(largest)).collect::<Vec<f64>>(),
            )
        };
        let (by_alpha, by_psi) = (density(0), density(1));
        let at = |values: &[f64], alpha: f64| {
            let place = (alpha / FRAC_PI_2 * RINGS as f64 - 0.5).clamp(0.0, (RINGS - 1) as f64);
            let i = (place as usize).min(RINGS - 2);
            let share = place - i as f64;
            values[i] + share * (values[i + 1] - values[i])
        };
        // fourth order steps of dα/dt = 1/density
        const PARTS: usize = 4;
        let mean = FRAC_PI_2 / RINGS as f64 * by_alpha.iter().sum::<f64>();
        let total = mean.ceil().clamp(FEWEST, MOST);
        let rate = |alpha: f64, scale: f64| scale / at(&by_alpha, alpha);
        let path = |scale: f64| -> (Vec<f64>, f64) {
            let step = 0.5 / PARTS as f64;
            let (mut alpha, mut places) = (0.0, Vec::with_capacity(total as usize));
            for k in 0..2 * PARTS * total as usize {
                if k % (2 * PARTS) == PARTS {
                    places.push(alpha);
                }
                let a = rate(alpha, scale);
                let b = rate(alpha + 0.5 * step * a, scale);
                let c = rate(alpha + 0.5 * step * b, scale);
                let d = rate(alpha + step * c, scale);
                alpha += step * (a + 2.0 * b + 2.0 * c + d) / 6.0;
            }
            (places, alpha)
        };
        let mut scale = mean / total;
        for _ in 0..6 {
            scale *= FRAC_PI_2 / path(scale).1;
        }
        let rings = path(scale).0.into_iter().map(|alpha| {
            let count = (TAU * at(&by_psi, alpha)).ceil().clamp(FEWEST, MOST);
            let step = rate(alpha, scale) * TAU / count;
            Ring { alpha, weight: alpha.sin() * alpha.cos() * step, count: count as usize }
        });
        Self { rings: rings.collect() }
    }
}

impl Ring {
    /// `Δα Δψ`.
    pub(super) fn step(&self) -> f64 {
        self.weight / (self.alpha.sin() * self.alpha.cos())
    }

    /// Numbers of the points between a spoke of the coarse grid and the next.
    pub(super) fn points_between(&self, spoke: usize) -> Range<usize> {
        let first = |spoke: usize| {
            (spoke as f64 / SPOKES as f64 * self.count as f64 - 0.5).ceil().max(0.0) as usize
        };
        first(spoke)..first(spoke + 1)
    }

    /// Azimuth of a point.
    pub(super) fn azimuth(&self, point: usize) -> f64 {
        (point as f64 + 0.5) / self.count as f64 * TAU
    }
}

/// The largest values nearby, smoothed.
fn smoothed(values: &[f64]) -> Vec<f64> {
    let window = |i: usize| i.saturating_sub(SMOOTHED)..(i + SMOOTHED + 1).min(values.len());
    let largest: Vec<f64> =
        (0..values.len()).map(|i| values[window(i)].iter().copied().fold(0.0, f64::max)).collect();
    let mut found = largest;
    for _ in 0..2 {
        found = (0..found.len())
            .map(|i| {
                let near = &found[window(i)];
                near.iter().sum::<f64>() / near.len() as f64
            })
            .collect();
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The weights add up to the area of a disc of radius 1, whatever the steps.
    #[test]
    fn weights_make_the_disc() {
        let steps: Steps =
            (0..RINGS).map(|i| [0.02 / (1.0 + i as f64 * 0.03), 0.01 + 0.001 * i as f64]).collect();
        let lattice = Lattice::new(&steps, 1.0);
        let sum: f64 = lattice.rings.iter().map(|r| r.weight * r.count as f64).sum();
        assert!((sum - 0.5 * TAU).abs() < 1e-4, "{sum}");
    }

    /// Every point of a ring belongs to one pair of spokes.
    #[test]
    fn spokes_share_the_points() {
        for count in [24, 319, 320, 1777] {
            let ring = Ring { alpha: 1.0, weight: 1.0, count };
            let all: Vec<usize> = (0..SPOKES).flat_map(|j| ring.points_between(j)).collect();
            assert_eq!(all, (0..count).collect::<Vec<_>>());
        }
    }
}
