//! Where rays of an order start and leave at any index, from scans at a few: a guide that spares the scans of single
//! wavelengths their tracing.
//!
//! At one launch coordinate α the launch azimuth of a plane's ray, its exit angle and the way in which its neighbours
//! part are analytic in the index, and polynomials through scans at Chebyshev's points give them at any other. Only the
//! search for rays rests on them: every ray whose wave counts is traced at the index itself, so that what a guide is off by
//! costs a step of Newton's method and no accuracy. A ray that one of the scans lacks, or that is not where another
//! scan at a further index has it (next to total reflection, between crossings of the axis), is unknown, and traced.

use super::scattering_plane::{ScannedRay, ScatteringPlane, axial_ray};
use crate::math::chebyshev;
use crate::math::parallel::*;
use crate::shape::Shape;
use crate::trace::Tracer;

/// Distance of the index from where rays cease to be analytic in it: that of vacuum, for a light medium.
const REACH: f64 = 0.3;
/// What polynomials over the index may err by.
const AIM: f64 = 1e-7;
/// Scans at most.
const MOST: usize = 6;
/// How far a ray may be from where the polynomials have it to count as known: angles, and relative spreads.
const KNOWN_ANGLE: f64 = 1e-5;
const KNOWN_SPREAD: f64 = 1e-3;

/// Launch azimuth, exit angle, spread and spread across.
type Channels = [f64; 4];

/// Indices at which rays are scanned.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct GuideIndices {
    /// Through which polynomials pass.
    nodes: Vec<f64>,
    /// At which they are checked.
    check: Option<f64>,
}

impl GuideIndices {
    /// For all indices between two.
    pub(crate) fn between(from: f64, to: f64) -> Self {
        let range = to - from;
        if range < f64::EPSILON {
            return Self { nodes: vec![from], check: None };
        }
        let count = (AIM.ln() / (range / (4.0 * REACH)).min(0.5).ln()).ceil() as usize;
        // at the ends polynomials err as much as anywhere
        Self { nodes: chebyshev::points(count.clamp(2, MOST), from, to), check: Some(from) }
    }

    /// All of them.
    fn all(&self) -> impl Iterator<Item = f64> {
        self.nodes.iter().copied().chain(self.check)
    }

    /// Weights of the scans for an index.
    fn weights(&self, index: f64) -> Vec<f64> {
        let weight = |(k, node): (usize, &f64)| {
            let others = self.nodes.iter().enumerate().filter(|(j, _)| *j != k);
            others.map(|(_, other)| (index - other) / (node - other)).product()
        };
        self.nodes.iter().enumerate().map(weight).collect()
    }
}

/// The rays of one order on some planes, at any index.
#[derive(Clone, Debug)]
pub(crate) struct OrderGuide {
    indices: GuideIndices,
    /// For each plane, ray by ray, their channels at each index; no numbers where a ray is unknown.
    planes: Vec<Vec<Channels>>,
}

impl OrderGuide {
    /// Scan planes of some azimuths at the indices: so many rays each, but for an angle about later crossings of the axis.
    pub(crate) fn new(
        shape: &Shape,
        order: u32,
        azimuths: &[f64],
        count: usize,
        axis_gap: f64,
        indices: &GuideIndices,
    ) -> Self {
        let silhouette = shape.silhouette().tabulated();
        let scans: Vec<Vec<Vec<Option<ScannedRay>>>> = indices
            .all()
            .map(|index| {
                let tracer = Tracer::new(shape, index.into(), 1.0, order);
                let centre = axial_ray(&tracer, order);
                let scan = |&azimuth: &f64| {
                    let plane = ScatteringPlane::new(&tracer, order, azimuth, centre);
                    plane.scan(&silhouette, count, axis_gap, None)
                };
                azimuths.par_iter().map(scan).collect()
            })
            .collect();
        let weights = indices.check.map(|index| indices.weights(index));
        let nodes = indices.nodes.len();
        let channels = |ray: &ScannedRay| [ray.psi, ray.angle, ray.spread, ray.across];
        let ray = |plane: usize, i: usize| -> Vec<Channels> {
            let unknown = || vec![[f64::NAN; 4]; nodes];
            let at = |scan: &Vec<Vec<Option<ScannedRay>>>| scan[plane][i].as_ref().map(channels);
            let Some(all) = scans.iter().map(at).collect::<Option<Vec<_>>>() else {
                return unknown();
            };
            let agrees = weights
                .as_ref()
                .is_none_or(|weights| agree(&blend(&all[..nodes], weights), &all[nodes]));
            if agrees { all[..nodes].to_vec() } else { unknown() }
        };
        let plane = |plane: usize| (0..count).flat_map(|i| ray(plane, i)).collect();
        Self { indices: indices.clone(), planes: (0..azimuths.len()).map(plane).collect() }
    }

    /// The guide of each plane at an index.
    pub(crate) fn at(&self, index: f64) -> Vec<PlaneGuide<'_>> {
        let weights = self.indices.weights(index);
        let guide = |rays| PlaneGuide { rays, weights: weights.clone() };
        self.planes.iter().map(guide).collect()
    }
}

/// The rays of one plane at one index.
#[derive(Clone, Debug)]
pub(crate) struct PlaneGuide<'g> {
    rays: &'g Vec<Channels>,
    weights: Vec<f64>,
}

impl PlaneGuide<'_> {
    /// Launch azimuth, exit angle, spread and spread across of a ray of the scan; `None` where it is unknown.
    pub(super) fn ray(&self, i: usize) -> Option<Channels> {
        let count = self.weights.len();
        let found = blend(self.rays.get(i * count..(i + 1) * count)?, &self.weights);
        found[0].is_finite().then_some(found)
    }
}

fn blend(nodes: &[Channels], weights: &[f64]) -> Channels {
    let mut sum = [0.0; 4];
    for (channels, weight) in nodes.iter().zip(weights) {
        sum.iter_mut().zip(channels).for_each(|(sum, value)| *sum += weight * value);
    }
    sum
}

/// Whether a ray is where the polynomials have it.
fn agree(found: &Channels, traced: &Channels) -> bool {
    let off = |c: usize| (found[c] - traced[c]).abs();
    let spread = |c: usize| off(c) < KNOWN_SPREAD * (traced[c].abs() + KNOWN_SPREAD);
    off(0) < KNOWN_ANGLE && off(1) < KNOWN_ANGLE && spread(2) && spread(3)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::RaindropModel;
    use std::f64::consts::PI;

    const COUNT: usize = 112;

    fn drop() -> Shape {
        Shape::raindrop(0.5e-3, RaindropModel::BeardChuang1987, 0.35).unwrap()
    }

    fn scanned(shape: &Shape, order: u32, azimuth: f64, index: f64) -> Vec<Option<ScannedRay>> {
        let tracer = Tracer::new(shape, index.into(), 1.0, order);
        let plane = ScatteringPlane::new(&tracer, order, azimuth, axial_ray(&tracer, order));
        plane.scan(&shape.silhouette().tabulated(), COUNT, 0.1, None)
    }

    /// Over the indices of water nearly all rays are known, and they are those of a scan at the index.
    #[test]
    fn known_rays_are_those_of_a_scan_at_the_index() {
        let shape = drop();
        let azimuths = [0.0, 0.7, PI];
        let indices = GuideIndices::between(1.330, 1.343);
        assert_eq!(indices.nodes.len(), 4);
        for order in [0, 3, 5] {
            let guide = OrderGuide::new(&shape, order, &azimuths, COUNT, 0.1, &indices);
            for (plane, azimuth) in guide.at(1.3371).iter().zip(azimuths) {
                let scan = scanned(&shape, order, azimuth, 1.3371);
                let mut known = 0;
                for (i, ray) in scan.iter().enumerate() {
                    let (Some([psi, angle, ..]), Some(ray)) = (plane.ray(i), ray) else { continue };
                    known += 1;
                    let off = (psi - ray.psi).abs() + (angle - ray.angle).abs();
                    assert!(off < 2e-5, "{order} {azimuth} {i}: {off:e}");
                }
                assert!(known > 9 * COUNT / 10, "{order} {azimuth}: {known}");
            }
        }
    }

    /// One index asks for one scan; a jump over a wide range for as many as there may be, and rays that are not
    /// analytic over it are unknown.
    #[test]
    fn what_is_not_smooth_over_the_index_is_unknown() {
        let one = GuideIndices::between(1.4, 1.4);
        assert_eq!((one.nodes.len(), one.check, one.weights(1.4)), (1, None, vec![1.0]));
        // over this range the crossing of the axis moves over most of the rays
        let wide = GuideIndices::between(1.2, 1.9);
        assert_eq!(wide.nodes.len(), MOST);
        let shape = drop();
        let guide = OrderGuide::new(&shape, 5, &[0.7], COUNT, 0.1, &wide);
        let plane = &guide.at(1.5)[0];
        let known = (0..COUNT).filter(|&i| plane.ray(i).is_some()).count();
        assert!(known < 9 * COUNT / 10, "{known}");
        let scan = scanned(&shape, 5, 0.7, 1.5);
        for (i, ray) in scan.iter().enumerate() {
            let (Some([psi, ..]), Some(ray)) = (plane.ray(i), ray) else { continue };
            assert!((psi - ray.psi).abs() < 1e-3, "{i}: {psi} {}", ray.psi);
        }
    }
}
