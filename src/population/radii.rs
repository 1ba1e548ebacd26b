//! Radii that stand for a distribution, and what each of them counts.
//!
//! Between neighbouring radii the cross-section over the squared radius, `F = C/r²`, is taken to be linear:
//! it changes slowly, while `C` and the number of particles do not. With `F` linear the mean is exact whatever
//! the distribution is:
//! ```text
//!     ∫ n(r) C(r) dr = Σ_j F(r_j) w_j,     w_j = ∫ n(r) r² hat_j(r) dr
//! ```
//! Steps are even in the radius: bows move with it. Every second radius makes the coarser mean that the finer
//! one is compared with.

use crate::math::gauss_legendre;
use crate::size_distribution::SizeDistribution;

/// Gauss nodes per step and part of it.
const NODES: usize = 8;
/// Parts of a step: a distribution may fall by much within it.
const PARTS: usize = 4;

/// One radius and its weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Radius {
    /// Metres.
    pub radius: f64,
    /// From 0 at the least radius to 1 at the largest: an even step of it by radius.
    pub place: f64,
    /// `∫ n r² hat dr`, m².
    pub weight: f64,
    /// The same among every second radius; 0 for those between.
    pub coarse: f64,
}

/// Even radii from one to another; `steps` is even. Particles of one size have that many places at one radius.
///
/// ```
/// use gonio::population::radii;
/// use gonio::size_distribution::{SizeDistribution, SizeLaw};
/// let sizes = SizeDistribution::between(SizeLaw::marshall_palmer(5.0), 1e-4, 1.5e-3)?;
/// let all = radii(&sizes, (1e-4, 1.5e-3), 8);
/// let shadow: f64 = all.iter().map(|r| r.weight).sum();
/// assert!((shadow / sizes.moment(2.0) - 1.0).abs() < 1e-9);
/// # Ok::<(), gonio::size_distribution::SizeError>(())
/// ```
pub fn radii(sizes: &SizeDistribution, (from, to): (f64, f64), steps: usize) -> Vec<Radius> {
    let step = (to - from) / steps as f64;
    let at = |j: usize| from + (to - from) * j as f64 / steps as f64;
    let mut all: Vec<Radius> = (0..=steps)
        .map(|j| Radius { radius: at(j), place: j as f64 / steps as f64, weight: 0.0, coarse: 0.0 })
        .collect();
    if let Some(radius) = sizes.single() {
        // places alone are to be gone through, by the trapezoidal rule
        let last = steps;
        for (j, at) in all.iter_mut().enumerate() {
            let share = if j == 0 || j == last { 0.5 } else { 1.0 } / steps as f64;
            at.weight = share * radius * radius;
            at.coarse = if j % 2 == 0 { 2.0 * at.weight } else { 0.0 };
        }
        return all;
    }
    let rule = gauss_legendre::nodes(NODES);
    for cell in 0..steps {
        // a histogram's edges are kinks of the integrand
        let (low, high) = (at(cell), at(cell + 1));
        let mut edges: Vec<f64> =
            (0..=PARTS).map(|k| low + (high - low) * k as f64 / PARTS as f64).collect();
        edges.extend(sizes.law().breaks().iter().copied().filter(|r| *r > low && *r < high));
        edges.sort_by(f64::total_cmp);
        for pair in edges.windows(2) {
            let half = 0.5 * (pair[1] - pair[0]);
            for (node, share) in &rule {
                let radius = pair[0] + half * (node + 1.0);
                let weight = half * share * sizes.density(radius) * radius * radius;
                let place = (radius - from) / step - cell as f64;
                all[cell].weight += weight * (1.0 - place);
                all[cell + 1].weight += weight * place;
                let pair = cell - cell % 2;
                let place = 0.5 * (place + (cell % 2) as f64);
                all[pair].coarse += weight * (1.0 - place);
                all[pair + 2].coarse += weight * place;
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::size_distribution::SizeLaw;

    /// Of one size every place has the same weight.
    #[test]
    fn places_of_one_radius() {
        let all = radii(&SizeDistribution::delta(2e-4), (2e-4, 2e-4), 8);
        let sum = |of: fn(&Radius) -> f64| all.iter().map(of).sum::<f64>();
        assert!(all.iter().all(|at| at.radius == 2e-4) && all[3].place == 0.375);
        assert!((sum(|at| at.weight) / 4e-8 - 1.0).abs() < 1e-12);
        assert!((sum(|at| at.coarse) / 4e-8 - 1.0).abs() < 1e-12);
    }

    /// Both means are exact for `F` that is linear, whatever the distribution.
    #[test]
    fn linear_ratios_are_exact() {
        let edges: std::sync::Arc<[f64]> = [1e-4, 2.3e-4, 7e-4].into();
        let numbers: std::sync::Arc<[f64]> = [5.0, 1.0].into();
        for sizes in [
            SizeDistribution::between(SizeLaw::marshall_palmer(5.0), 1e-4, 7e-4).unwrap(),
            SizeDistribution::whole(SizeLaw::Histogram { edges, numbers }).unwrap(),
        ] {
            for steps in [2, 4, 10] {
                let all = radii(&sizes, (1e-4, 7e-4), steps);
                assert_eq!(all.len(), steps + 1);
                let sum = |power: i32, of: fn(&Radius) -> f64| -> f64 {
                    all.iter().map(|r| of(r) * r.radius.powi(power)).sum()
                };
                for (power, moment) in [(0, 2.0), (1, 3.0)] {
                    let known = sizes.moment(moment);
                    assert!(
                        (sum(power, |r| r.weight) / known - 1.0).abs() < 1e-9,
                        "{steps} {power}"
                    );
                    assert!(
                        (sum(power, |r| r.coarse) / known - 1.0).abs() < 1e-9,
                        "{steps} {power}"
                    );
                }
                assert!(all.iter().skip(1).step_by(2).all(|r| r.coarse == 0.0));
            }
        }
    }
}
