//! Searching rays along a curve: by launch coordinate, by angle, at the edges of its segments.

use super::guide::PlaneGuide;
use super::scattering_plane::{GRAZING, Node, SETTLED, ScannedRay, ScatteringPlane};
use crate::math::interpolate::lagrange;
use crate::shape::Silhouette;
use std::f64::consts::FRAC_PI_2;

/// Ends of plain segments are bisected to this in α.
pub(super) const END: f64 = 1e-9;
/// Rays of a scan without which no landmark can be told.
const FEWEST: usize = 8;

/// Steps of Newton's method, halving where it would leave its bracket.
const MOST_STEPS: usize = 60;

/// Where a plain segment begins or ends.
#[derive(Clone, Debug)]
pub(crate) enum Edge {
    Alpha(f64),
    Last(Box<Node>),
    Angle { angle: f64, near: f64 },
    Axis { axis: f64, gap: f64 },
}

/// How a scattering plane is scanned.
#[derive(Clone, Copy, Debug)]
pub struct Scan {
    /// Launch points from the axial ray to the rim.
    pub nodes: usize,
    /// Angle about later crossings of the axis that is left out, radians.
    pub axis_gap: f64,
    /// Launch coordinate α up to which landmarks are looked for.
    pub limit: f64,
}

/// The rays of a scan, and the search for others between them.
pub(crate) struct ScannedRays<'a> {
    pub plane: ScatteringPlane<'a>,
    pub silhouette: &'a Silhouette<'a>,
    pub nodes: Vec<ScannedRay>,
    /// Step of α from node to node where none is missing.
    step: f64,
}

impl<'a> ScannedRays<'a> {
    /// `None` where too few rays leave.
    pub(super) fn new(
        plane: ScatteringPlane<'a>,
        silhouette: &'a Silhouette<'a>,
        scan: Scan,
        guide: Option<&PlaneGuide>,
    ) -> Option<Self> {
        let found = plane.scan(silhouette, scan.nodes, scan.axis_gap, guide);
        let nodes: Vec<ScannedRay> = found.into_iter().flatten().collect();
        let step = FRAC_PI_2 / scan.nodes as f64;
        (nodes.len() >= FEWEST).then_some(Self { plane, silhouette, nodes, step })
    }

    /// The last ray that still leaves, within a step beyond a ray of the scan. Rays farther out may leave
    /// again, but total reflection parts them from this stretch. Found `within` so much in α.
    pub(crate) fn end_after(&self, last: &ScannedRay, step: f64, within: f64) -> Option<Node> {
        let rim = FRAC_PI_2 - GRAZING;
        let mut bad = (last.alpha + 1.01 * step).min(rim);
        if let Some(node) = self.plane.node(self.silhouette, bad, last.psi, last.angle) {
            return Some(node);
        }
        let mut good = self.plane.node(self.silhouette, last.alpha, last.psi, last.angle)?;
        while bad - good.alpha > within {
            let middle = 0.5 * (bad + good.alpha);
            match self.plane.node(self.silhouette, middle, good.psi, good.angle) {
                Some(node) => good = node,
                None => bad = middle,
            }
        }
        Some(good)
    }

    /// A ray at `α`, its neighbours in the scan giving the guess.
    pub(crate) fn interpolated(&self, alpha: f64) -> Option<Node> {
        let nodes = &self.nodes;
        let k = nodes.partition_point(|n| n.alpha < alpha).clamp(1, nodes.len() - 1);
        let (a, b) = (&nodes[k - 1], &nodes[k]);
        let share = (alpha - a.alpha) / (b.alpha - a.alpha);
        let angle = a.angle + share * (b.angle - a.angle);
        // next to total reflection the azimuth runs like a square root: other guesses may do better
        let linear = [share, 0.0, 1.0, 0.5 * share, 0.5 + 0.5 * share].into_iter();
        let linear = linear.map(|s| a.psi + s * (b.psi - a.psi));
        let guesses = self.smooth_azimuth(k, alpha).into_iter().chain(linear);
        guesses.into_iter().find_map(|psi| self.plane.node(self.silhouette, alpha, psi, angle))
    }

    /// The launch azimuth at `α` between nodes `k - 1` and `k`, by the polynomial through the nearest nodes, where none
    /// is missing among them.
    fn smooth_azimuth(&self, k: usize, alpha: f64) -> Option<f64> {
        const STENCIL: usize = 6;
        let nodes = &self.nodes;
        if self.plane.rotational || nodes.len() < STENCIL {
            return None;
        }
        let first = (k as i64 - STENCIL as i64 / 2).clamp(0, (nodes.len() - STENCIL) as i64);
        let near = &nodes[first as usize..first as usize + STENCIL];
        let whole = near.windows(2).all(|w| w[1].alpha - w[0].alpha < 1.5 * self.step);
        let points: [(f64, f64); STENCIL] = std::array::from_fn(|j| (near[j].alpha, near[j].psi));
        whole.then(|| lagrange(&points, alpha))
    }

    /// The ray at an edge of a plain segment.
    pub(crate) fn find(&self, edge: Edge, is_start: bool) -> Option<Node> {
        match edge {
            Edge::Alpha(alpha) => self.interpolated(alpha),
            Edge::Last(node) => Some(*node),
            Edge::Angle { angle, near } => self.at_angle(angle, near, is_start),
            Edge::Axis { axis, gap } => {
                // beyond the crossing where a segment starts, before it where one ends
                let k = self.nodes.windows(2).position(|w| {
                    (w[0].angle - axis) * (w[1].angle - axis) <= 0.0 && w[0].alpha > 0.0
                })?;
                let side = if is_start { self.nodes[k + 1] } else { self.nodes[k] };
                let angle = axis + gap * (side.angle - axis).signum();
                self.at_angle(angle, side.alpha, is_start)
            }
        }
    }

    /// The ray of a given angle, beyond (`is_start`) or before `α = near`.
    pub(crate) fn at_angle(&self, angle: f64, near: f64, is_start: bool) -> Option<Node> {
        let nodes = &self.nodes;
        let window = |w: &[ScannedRay]| (w[0].angle - angle) * (w[1].angle - angle) <= 0.0;
        let bracket = if is_start {
            nodes.windows(2).find(|w| w[1].alpha >= near && window(w))
        } else {
            nodes.windows(2).rev().find(|w| w[0].alpha <= near && window(w))
        };
        // between the last node of the scan and the edge of the gap, extrapolate
        let Some(bracket) = bracket else { return self.beyond_scan(angle, near) };
        let (a, b) = (&bracket[0], &bracket[1]);
        let (mut low, mut high) = (a.alpha, b.alpha);
        let mut alpha = low + (angle - a.angle) / (b.angle - a.angle) * (high - low);
        for _ in 0..MOST_STEPS {
            let node = self.interpolated(alpha)?;
            let off = node.angle - angle;
            if off * (a.angle - angle) > 0.0 {
                low = alpha
            } else {
                high = alpha
            }
            let rates = self.plane.rates(self.silhouette, &node);
            let step = -off / rates.angle;
            if step.abs() < SETTLED || high - low < 1e-14 {
                let settled = if step.abs() < SETTLED { node.moved(&rates, step) } else { node };
                return Some(Node { angle, ..settled });
            }
            alpha += step;
            if !(low < alpha && alpha < high) {
                alpha = 0.5 * (low + high);
            }
        }
        None
    }

    /// A ray just outside the scanned stretch next to `α = near`, by Newton's method on the angle.
    pub(crate) fn beyond_scan(&self, angle: f64, near: f64) -> Option<Node> {
        let off = |n: &&ScannedRay| (n.alpha - near).abs();
        let nearest = self.nodes.iter().min_by(|a, b| off(a).total_cmp(&off(b)))?;
        let mut node =
            self.plane.node(self.silhouette, nearest.alpha, nearest.psi, nearest.angle)?;
        for _ in 0..20 {
            let rates = self.plane.rates(self.silhouette, &node);
            let step = (angle - node.angle) / rates.angle;
            if step.is_nan() || step.abs() >= 0.3 {
                return None;
            }
            if step.abs() < SETTLED {
                return Some(Node { angle, ..node.moved(&rates, step) });
            }
            let psi = node.psi + step * rates.psi;
            node = self.plane.node(self.silhouette, node.alpha + step, psi, angle)?;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;
    use crate::trace::Tracer;

    /// Unwrapped angle of a sphere's ray.
    fn angle(index: f64, order: u32, alpha: f64) -> f64 {
        let axis = if order % 2 == 1 { 0.0 } else { std::f64::consts::PI };
        axis + 2.0 * (f64::from(order) * (alpha.sin() / index).asin() - alpha)
    }

    fn with_rays(index: f64, order: u32, test: impl FnOnce(&ScannedRays)) {
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, index.into(), 100.0, order);
        let silhouette = shape.silhouette();
        let plane = ScatteringPlane::new(&tracer, order, 0.3, [0.0; 2]);
        let scan = Scan { nodes: 96, axis_gap: 0.02, limit: FRAC_PI_2 };
        test(&ScannedRays::new(plane, &silhouette, scan, None).unwrap());
    }

    #[test]
    fn rays_are_found_by_launch_and_by_angle() {
        with_rays(1.333, 2, |rays| {
            for alpha in [0.05, 0.6, 1.2] {
                let node = rays.interpolated(alpha).unwrap();
                assert!((node.angle - angle(1.333, 2, alpha)).abs() < 1e-12);
            }
            // an angle near the bow has two rays, one before and one beyond it
            let wanted = angle(1.333, 2, 0.9);
            let bow = (1.0 - (1.333f64 * 1.333 - 1.0) / 3.0).sqrt().asin();
            let inner = rays.at_angle(wanted, bow, false).unwrap();
            let outer = rays.at_angle(wanted, bow, true).unwrap();
            assert!((inner.alpha - 0.9).abs() < 1e-11 && outer.alpha > bow + 0.1);
            assert!((angle(1.333, 2, outer.alpha) - wanted).abs() < 1e-11);
        });
    }

    #[test]
    fn edges_of_segments_are_rays() {
        with_rays(1.333, 4, |rays| {
            let end = rays.find(Edge::Alpha(0.4), true).unwrap();
            assert_eq!(rays.find(Edge::Last(Box::new(end)), false).unwrap().angle, end.angle);
            // this order crosses the forward axis before its bow
            let axis = std::f64::consts::TAU;
            let edge = Edge::Axis { axis, gap: 0.05 };
            let before = rays.find(edge.clone(), false).unwrap();
            let behind = rays.find(edge, true).unwrap();
            assert!((before.angle - (axis - 0.05)).abs() < 1e-12);
            assert!((behind.angle - (axis + 0.05)).abs() < 1e-12);
            assert!((angle(1.333, 4, behind.alpha) - behind.angle).abs() < 1e-11);
            let near = Edge::Angle { angle: axis - 0.3, near: before.alpha };
            assert!(rays.find(near, false).unwrap().alpha < before.alpha);
        });
    }

    /// In a lighter medium rays enter up to `sin α = n`.
    #[test]
    fn the_last_ray_is_where_total_reflection_begins() {
        with_rays(0.75, 1, |rays| {
            let step = FRAC_PI_2 / 96.0;
            let last = rays.nodes.iter().rfind(|n| n.alpha < 0.75f64.asin()).unwrap();
            let end = rays.end_after(last, step, END).unwrap();
            assert!((end.alpha - 0.75f64.asin()).abs() < 1e-8, "{}", end.alpha);
        });
    }

    /// Just outside the nodes Newton's method goes on.
    #[test]
    fn rays_beyond_the_scan_are_found() {
        with_rays(1.333, 1, |rays| {
            let beyond = 0.5 * rays.nodes[0].alpha;
            let wanted = angle(1.333, 1, beyond);
            let node = rays.at_angle(wanted, 0.0, true).unwrap();
            assert!((node.alpha - beyond).abs() < 1e-9 && node.angle == wanted);
            assert!(rays.beyond_scan(-2.9, 1.2).is_none());
        });
    }
}
