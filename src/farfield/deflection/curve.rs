//! Deflection curves: the rays of one order in one scattering plane, cut into segments with smooth data at knots.
//!
//! Between axial ray, folds, axis crossings and rim the exit angle is monotone: a *plain* segment,
//! one ray per direction. About a fold, a *pair* segment holds both rays in their analytic
//! combinations, on the lit and on the dark side. Knots sit at the same fractions of a segment on
//! every plane, so that all their data vary smoothly with azimuth too.

use super::fold::Fold;
use super::guide::PlaneGuide;
use super::landmark::Landmark;
use super::scan::{END, Edge, Scan, ScannedRays};
use super::scattering_plane::{Node, ScannedRay, ScatteringPlane};
use crate::shape::Silhouette;
use std::f64::consts::{FRAC_PI_2, PI};

/// Where the last ray is to be found in α, if it ends no segment.
const COARSE_END: f64 = 1e-5;

/// A plane with its landmarks found, ready to be cut into segments.
pub struct DeflectionCurve<'a> {
    rays: ScannedRays<'a>,
    pub(crate) landmarks: Vec<Landmark>,
    last: Node,
}

impl<'a> DeflectionCurve<'a> {
    /// Scan a plane. `None` when its rays do not form a chain this method understands.
    pub fn new(
        plane: ScatteringPlane<'a>,
        silhouette: &'a Silhouette<'a>,
        scan: Scan,
    ) -> Option<Self> {
        Self::guided(plane, silhouette, scan, None)
    }

    /// The same by a guide, whose rays are not traced.
    pub(crate) fn guided(
        plane: ScatteringPlane<'a>,
        silhouette: &'a Silhouette<'a>,
        scan: Scan,
        guide: Option<&PlaneGuide>,
    ) -> Option<Self> {
        let mut rays = ScannedRays::new(plane, silhouette, scan, guide)?;
        let (landmarks, last) = landmarks(&mut rays, FRAC_PI_2 / scan.nodes as f64, scan.limit)?;
        Some(Self { rays, landmarks, last })
    }

    /// The plane that this curve is.
    pub fn plane(&self) -> &ScatteringPlane<'a> {
        &self.rays.plane
    }

    /// The rays of the scan.
    pub(crate) fn nodes(&self) -> &[ScannedRay] {
        &self.rays.nodes
    }

    /// The ray at an edge of a plain segment.
    pub(crate) fn find(&self, edge: Edge, is_start: bool) -> Option<Node> {
        self.rays.find(edge, is_start)
    }

    /// The ray launched at `α`.
    pub(crate) fn interpolated(&self, alpha: f64) -> Option<Node> {
        self.rays.interpolated(alpha)
    }

    /// The last ray that leaves.
    pub fn last_ray(&self) -> &Node {
        &self.last
    }

    /// The ray launched at `sin α`.
    pub fn ray_at(&self, sin: f64) -> Option<Node> {
        self.rays.interpolated(sin.asin())
    }

    /// Exit angles relative to that of the ray at `sin α = start`: the farthest in the direction in
    /// which rays go from there to `sin α = full`, and that of the last ray.
    pub fn reaches(&self, start: f64, full: f64) -> Option<[f64; 2]> {
        let first = self.ray_at(start)?;
        let sense = (self.ray_at(full)?.angle - first.angle).signum();
        let beyond = self.rays.nodes.iter().filter(|n| n.alpha > first.alpha);
        let farthest = beyond.map(|n| sense * (n.angle - first.angle)).fold(0.0, f64::max);
        Some([sense * farthest, self.last.angle - first.angle])
    }

    /// Signature by which planes correspond.
    pub fn signature(&self) -> String {
        let letter = |l: &Landmark| match l {
            Landmark::Axial => 'A',
            Landmark::Fold(fold) if fold.lit > 0.0 => 'F',
            Landmark::Fold(_) => 'f',
            Landmark::Axis(_) => 'X',
            Landmark::Cut(_) => '|',
            Landmark::End(_) => 'E',
        };
        self.landmarks.iter().map(letter).collect()
    }

    /// For each fold: strength `ζ̂/δ`, and the angle available on the lit side of both its rays.
    pub fn folds(&self, axis_gap: f64) -> Vec<(f64, f64)> {
        let mut found = Vec::new();
        for (k, landmark) in self.landmarks.iter().enumerate() {
            let Landmark::Fold(fold) = landmark else { continue };
            let room = |other: &Landmark| match other {
                Landmark::Axial => (fold.angle - self.rays.plane.axis_angle()).abs(),
                Landmark::Axis(axis) => (fold.angle - axis).abs() - axis_gap,
                Landmark::Fold(next) => 0.5 * (fold.angle - next.angle).abs(),
                Landmark::End(node) => (fold.angle - node.angle).abs(),
                Landmark::Cut(_) => f64::INFINITY,
            };
            let available = room(&self.landmarks[k - 1]).min(room(&self.landmarks[k + 1]));
            found.push((fold.strength(&self.rays.plane).unwrap_or(1.0), available));
        }
        found
    }

    /// Launch point `sin α` of a landmark.
    pub(crate) fn launch(&self, landmark: &Landmark) -> Option<f64> {
        match landmark {
            Landmark::Axial => Some(0.0),
            Landmark::Fold(fold) => Some(fold.alpha.sin()),
            Landmark::End(node) => Some(node.alpha.sin()),
            Landmark::Axis(axis) => self.crossing(*axis),
            Landmark::Cut(alpha) => Some(alpha.sin()),
        }
    }

    /// Where the first scan crosses an axis.
    fn crossing(&self, axis: f64) -> Option<f64> {
        let crosses = |w: &&[ScannedRay]| (w[0].angle - axis) * (w[1].angle - axis) <= 0.0;
        self.rays.nodes.windows(2).skip(1).find(crosses).map(|w| w[0].alpha.sin())
    }

    /// The folds and their numbers among the landmarks.
    pub(crate) fn numbered_folds(&self) -> impl Iterator<Item = (usize, &Fold)> {
        self.landmarks.iter().enumerate().filter_map(|(k, landmark)| match landmark {
            Landmark::Fold(fold) => Some((k, fold)),
            _ => None,
        })
    }
}

/// The landmarks of rays launched up to `limit` (in α), and the last ray of all; rays beyond it are dropped.
fn landmarks(rays: &mut ScannedRays, step: f64, limit: f64) -> Option<(Vec<Landmark>, Node)> {
    let start = rays.plane.axis_angle();
    let mut landmarks = vec![Landmark::Axial];
    for k in 1..rays.nodes.len() {
        let (a, b) = (rays.nodes[k - 1], rays.nodes[k]);
        let half_turn = |n: &ScannedRay| ((n.angle - start) / PI).floor();
        let before = half_turn(&a);
        let crosses = before != half_turn(&b) && k > 1;
        if b.alpha > limit {
            if b.alpha - a.alpha > 1.5 * step {
                rays.nodes.truncate(k);
                break;
            }
        } else if crosses {
            // the multiple of π between the two angles
            let axis = start + PI * before.max(half_turn(&b));
            landmarks.push(Landmark::Axis(axis));
        } else if b.alpha - a.alpha > 1.5 * step {
            // total reflection: what lies beyond is not followed
            rays.nodes.truncate(k);
            break;
        } else if a.spread * b.spread < 0.0 && turns_back(&rays.nodes, k) {
            let fold = Fold::between(&rays.plane, rays.silhouette, &a, &b)?;
            landmarks.push(Landmark::Fold(fold));
        }
    }
    let scanned = *rays.nodes.last()?;
    // beyond the limit the last ray only says how far others may be continued
    let within = if scanned.alpha > limit { COARSE_END } else { END };
    let last = rays.end_after(&scanned, step, within)?;
    if last.alpha > scanned.alpha {
        let beyond = rays.plane.scanned(&last);
        rays.nodes.push(beyond);
    }
    let end = if last.alpha > limit { rays.interpolated(limit)? } else { last };
    landmarks.push(Landmark::End(Box::new(end)));
    Some((landmarks, last))
}

/// Whether the exit angle turns back between nodes `k - 1` and `k`: a fold of the plane. Else
/// a change of the spread's sign means that rays meet across the plane, as they do
/// near the axis for flattened particles.
fn turns_back(nodes: &[ScannedRay], k: usize) -> bool {
    let angle = |k: usize| nodes.get(k).map(|n| n.angle);
    let here = nodes[k].angle - nodes[k - 1].angle;
    let before = k.checked_sub(2).and_then(angle).map_or(here, |a| nodes[k - 1].angle - a);
    let after = angle(k + 1).map_or(here, |a| a - nodes[k].angle);
    before * after < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;
    use crate::trace::Tracer;

    fn with_curve(shape: &Shape, index: f64, order: u32, test: impl FnOnce(&DeflectionCurve)) {
        let tracer = Tracer::new(shape, index.into(), 1000.0, order);
        let silhouette = shape.silhouette().tabulated();
        let centre = super::super::scattering_plane::axial_ray(&tracer, order);
        let plane = ScatteringPlane::new(&tracer, order, 0.5, centre);
        let scan = Scan { nodes: 64 + 16 * order as usize, axis_gap: 0.02, limit: FRAC_PI_2 };
        test(&DeflectionCurve::new(plane, &silhouette, scan).unwrap());
    }

    /// Landmarks of water drops: no fold up to order 1, one from order 2 on, and the crossings of the
    /// axis before it; the same on a slightly flattened drop.
    #[test]
    fn landmarks_are_those_of_the_deflection() {
        let flattened = Shape::spheroid(0.995, 0.4).unwrap();
        for (order, signature) in
            [(0, "AE"), (1, "AE"), (2, "AfE"), (3, "AfE"), (4, "AXfE"), (6, "AXXfE")]
        {
            with_curve(&Shape::sphere(), 1.333, order, |curve| {
                assert_eq!(curve.signature(), signature, "{order}");
            });
            if order < 4 {
                with_curve(&flattened, 1.333, order, |curve| {
                    assert_eq!(curve.signature(), signature, "{order}");
                });
            }
        }
    }

    #[test]
    fn landmarks_stand_where_descartes_has_them() {
        with_curve(&Shape::sphere(), 1.333, 2, |curve| {
            let bow = (1.0 - (1.333f64 * 1.333 - 1.0) / 3.0).sqrt();
            let launches: Vec<f64> =
                curve.landmarks.iter().map(|mark| curve.launch(mark).unwrap()).collect();
            assert_eq!(launches[0], 0.0);
            assert!((launches[1] - bow).abs() < 1e-9 && launches[2] > 0.999_999);
            let (number, fold) = curve.numbered_folds().next().unwrap();
            assert!(number == 1 && fold.lit == -1.0);
            // room to the axial ray is 42°, to the last ray 14°: the lesser counts
            let [(strength, room)] = curve.folds(0.02)[..] else { panic!("one fold") };
            let last = 4.0 * (1.0f64 / 1.333).asin();
            assert!((room - (fold.angle - last)).abs() < 1e-3, "{room}");
            // van de Hulst 1957, sec. 13.2: h = (p² - 1)²/p² √((p² - n²)/(n² - 1)³), p one more than his
            let n: f64 = 1.333 * 1.333;
            let h = 9.0 / 4.0 * ((4.0 - n) / (n - 1.0).powi(3)).sqrt();
            assert!((strength * h.cbrt() - 1.0).abs() < 2e-3, "{strength}");
        });
    }

    /// From a ray before the bow the angle goes to the bow and part of the way back.
    #[test]
    fn reaches_tell_the_farthest_and_the_last_ray() {
        with_curve(&Shape::sphere(), 1.333, 3, |curve| {
            let angle = |b: f64| 6.0 * (b / 1.333).asin() - 2.0 * b.asin();
            let bow = (1.0 - (1.333f64 * 1.333 - 1.0) / 8.0).sqrt();
            let [farthest, last] = curve.reaches(0.7, 0.9).unwrap();
            assert!((farthest - (angle(bow) - angle(0.7))).abs() < 1e-4, "{farthest}");
            assert!((last - (angle(1.0) - angle(0.7))).abs() < 1e-3, "{last}");
            assert!((curve.ray_at(0.8).unwrap().angle - angle(0.8)).abs() < 1e-12);
        });
    }

    /// In a lighter medium the curve ends where nothing enters.
    #[test]
    fn total_reflection_ends_the_curve() {
        with_curve(&Shape::sphere(), 0.75, 1, |curve| {
            assert_eq!(curve.signature(), "AE");
            assert!((curve.last_ray().alpha - 0.75f64.asin()).abs() < 1e-8);
        });
    }
}
