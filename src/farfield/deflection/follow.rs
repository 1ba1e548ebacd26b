//! Following a scattering plane from the axial ray to the rim, ray by ray.
//!
//! Where a plane crosses the axis again, rays of many azimuths leave in almost one direction and its
//! branches are entangled; so every stretch between crossings is followed from its own middle.

use super::guide::PlaneGuide;
use super::scattering_plane::{GRAZING, Node, ScannedRay, ScatteringPlane};
use crate::math::interpolate::lagrange;
use crate::shape::Silhouette;
use std::f64::consts::{FRAC_PI_2, PI};

impl ScatteringPlane<'_> {
    /// Follow the plane from the axial ray to the rim in even steps of α; gaps are `None`.
    ///
    /// Where the plane crosses the axis again, rays of many azimuths leave in almost one direction
    /// and its branches are entangled, within `axis_gap` of the axis. So every stretch between
    /// crossings is followed from its own middle, where rays are nearly those of a sphere, to both
    /// sides, until the first node inside the gap. Rays that a guide knows are not traced.
    pub(super) fn scan(
        &self,
        silhouette: &Silhouette,
        count: usize,
        axis_gap: f64,
        guide: Option<&PlaneGuide>,
    ) -> Vec<Option<ScannedRay>> {
        let mut nodes = vec![None; count];
        let stretches = self.stretches(count);
        for (j, &[from, seed, to]) in stretches.iter().enumerate() {
            let way = Way { plane: self, silhouette, count, axis_gap, guide };
            let start = if j == 0 { self.first_azimuth() } else { self.azimuth };
            let Some(first) = way.seed(seed, start, j > 0) else { continue };
            way.follow(&mut nodes, first, seed..to);
            if seed > from {
                way.follow(&mut nodes, first, (from..=seed).rev());
            }
        }
        nodes
    }

    /// Stretches between crossings of the axis on a sphere: first node, the one to start from, end.
    fn stretches(&self, count: usize) -> Vec<[usize; 3]> {
        let angle = |i: usize| self.angle_on_sphere(self.alpha(i, count)) - self.axis_angle();
        let crossings: Vec<usize> = (2..count)
            .take_while(|&i| angle(i).abs() >= angle(i - 1).abs())
            .filter(|&i| (angle(i) / PI).floor() != (angle(i - 1) / PI).floor())
            .collect();
        let bow = (1..count).find(|&i| angle(i).abs() < angle(i - 1).abs()).unwrap_or(count);
        let mut stretches = vec![[0, 0, crossings.first().copied().unwrap_or(count)]];
        for (j, &from) in crossings.iter().enumerate() {
            let to = crossings.get(j + 1).copied();
            // the angle's middle between the two ends
            let end = to.unwrap_or(bow);
            let middle = 0.5 * (angle(from) + angle(end - 1));
            let off = |i: &usize| (angle(*i) - middle).abs();
            let seed = (from..end).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(from);
            stretches.push([from, seed, to.unwrap_or(count)]);
        }
        stretches
    }

    /// Launch coordinate of a node of the scan.
    fn alpha(&self, i: usize, count: usize) -> f64 {
        (i as f64 + 0.5) * (FRAC_PI_2 - GRAZING) / count as f64
    }

    /// Search a ray of the plane at `α` over launch azimuths, for use beyond a crossing of the axis,
    /// where the plane may go on at quite another azimuth.
    fn search(&self, silhouette: &Silhouette, alpha: f64, near: f64, slack: f64) -> Option<Node> {
        const PROBES: usize = 24;
        const REACH: f64 = 1.3;
        let crossing = ((near - self.axis_angle()) / PI).round();
        if crossing == 0.0 || self.rotational {
            return None;
        }
        let probe = |k: usize| {
            let psi = self.azimuth + REACH * (2.0 * k as f64 / PROBES as f64 - 1.0);
            let exit = self.exit(self.place(silhouette, alpha, psi).0)?;
            Some((psi, exit.direction.dot(self.across())))
        };
        let probes: Vec<Option<(f64, f64)>> = (0..=PROBES).map(probe).collect();
        let mut best: Option<Node> = None;
        for pair in probes.windows(2) {
            let (Some(a), Some(b)) = (pair[0], pair[1]) else { continue };
            if a.1 * b.1 > 0.0 {
                continue;
            }
            let guess = a.0 + (b.0 - a.0) * a.1 / (a.1 - b.1);
            let Some(node) = self.node(silhouette, alpha, guess, near) else { continue };
            let off = |n: &Node| (n.angle - near).abs();
            if off(&node) < slack.max(0.2) && best.is_none_or(|b| off(&node) < off(&b)) {
                best = Some(node);
            }
        }
        best
    }

    /// Launch azimuth at the axial ray: where the linear map of directions points along the plane.
    fn first_azimuth(&self) -> f64 {
        let Some(exit) = self.exit(self.centre).filter(|_| !self.rotational) else {
            return self.azimuth;
        };
        // s·across = 0 to first order in the launch point
        let (a, b) = (exit.ds[0].dot(self.across()), exit.ds[1].dot(self.across()));
        let psi = (-a).atan2(b);
        let turn = (self.azimuth - psi) / PI;
        psi + PI * turn.round()
    }
}

/// Launch azimuths of the last nodes of a scan, to be continued.
struct Trail {
    /// `(α, ψ)`, the last one last.
    last: Vec<(f64, f64)>,
}

impl Trail {
    /// Nodes that a polynomial is continued from.
    const MOST: usize = 5;

    fn new(first: &ScannedRay) -> Self {
        Self { last: vec![(first.alpha, first.psi)] }
    }

    fn add(&mut self, node: &ScannedRay) {
        self.last.retain(|&(alpha, _)| alpha != node.alpha);
        if self.last.len() == Self::MOST {
            self.last.remove(0);
        }
        self.last.push((node.alpha, node.psi));
    }

    /// Guesses of the azimuth at `α`, the best first: next to total reflection it runs like a square root, and lower
    /// degrees do better. Over missing nodes high degrees lead to other branches, on the far side of the axis.
    fn guesses(&self, alpha: f64) -> impl Iterator<Item = f64> {
        let count = self.last.len();
        let next = match self.last[..] {
            [.., (a, _), (b, _)] => (alpha - b).abs() < 1.5 * (b - a).abs(),
            _ => true,
        };
        let highest = next.then_some(Self::MOST);
        let degrees = highest.into_iter().chain([2]).map(move |most| count.min(most));
        degrees.map(move |used| lagrange(&self.last[count - used..], alpha))
    }
}

/// Following a plane from node to node of a scan.
struct Way<'m, 'a, 's> {
    plane: &'m ScatteringPlane<'a>,
    silhouette: &'s Silhouette<'s>,
    count: usize,
    axis_gap: f64,
    guide: Option<&'s PlaneGuide<'s>>,
}

impl Way<'_, '_, '_> {
    /// A ray that is known without tracing.
    fn known(&self, i: usize) -> Option<ScannedRay> {
        let (alpha, [psi, angle, spread, across]) =
            (self.plane.alpha(i, self.count), self.guide?.ray(i)?);
        let (place, _) = self.plane.place(self.silhouette, alpha, psi);
        Some(ScannedRay { alpha, psi, place, angle, spread, across })
    }

    /// The node to start from, with the launch azimuth expected there.
    fn seed(&self, i: usize, azimuth: f64, search: bool) -> Option<ScannedRay> {
        let known = self.known(i);
        if known.is_some() {
            return known;
        }
        let (m, s) = (self.plane, self.silhouette);
        let alpha = m.alpha(i, self.count);
        let near = m.angle_on_sphere(alpha);
        let close = |node: &Node| !search || (node.angle - near).abs() < 0.5;
        m.node(s, alpha, azimuth, near)
            .filter(close)
            .or_else(|| m.search(s, alpha, near, 2.0 * self.axis_gap))
            .map(|node| m.scanned(&node))
    }

    /// Go from `first` over the nodes of a range; stop inside the gap about the axis.
    fn follow(
        &self,
        nodes: &mut [Option<ScannedRay>],
        first: ScannedRay,
        range: impl Iterator<Item = usize>,
    ) {
        let (m, s) = (self.plane, self.silhouette);
        let mut trail = Trail::new(&first);
        let mut before = first;
        for i in range {
            let alpha = m.alpha(i, self.count);
            let near = before.angle + m.angle_on_sphere(alpha) - m.angle_on_sphere(before.alpha);
            let traced = || {
                let node = trail.guesses(alpha).find_map(|psi| m.node(s, alpha, psi, near))?;
                Some(m.scanned(&node))
            };
            let Some(node) = self.known(i).or_else(traced) else { continue };
            trail.add(&node);
            nodes[i] = Some(node);
            before = node;
            let turns = (node.angle - m.axis_angle()) / PI;
            let crossing = turns.round();
            if crossing != 0.0 && (turns - crossing).abs() * PI < self.axis_gap {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;
    use crate::trace::Tracer;

    /// A square root's azimuths are continued by a polynomial to the next node, along the last two over missing ones.
    #[test]
    fn trails_are_continued_along_a_line_over_missing_nodes() {
        let mut trail = Trail { last: Vec::new() };
        for k in 0..6 {
            let alpha = 0.1 * f64::from(k);
            trail.last.push((alpha, (0.51 - alpha).sqrt()));
        }
        trail.last.remove(0);
        let line = |alpha: f64| {
            trail.last[4].1 + (trail.last[4].1 - trail.last[3].1) * (alpha - 0.5) / 0.1
        };
        let next: Vec<f64> = trail.guesses(0.6).collect();
        assert!(next.len() == 2 && (next[1] - line(0.6)).abs() < 1e-12 && next[0] < next[1] - 0.05);
        let far: Vec<f64> = trail.guesses(0.9).collect();
        assert!(far.len() == 1 && (far[0] - line(0.9)).abs() < 1e-12, "{far:?}");
    }

    /// The stretches of a scan follow on one another and leave nothing out.
    #[test]
    fn stretches_cover_the_scan() {
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, 1.333.into(), 100.0, 9);
        for (order, crossings) in [(1, 0), (2, 0), (3, 0), (4, 1), (6, 2), (9, 3)] {
            let plane = ScatteringPlane::new(&tracer, order, 0.0, [0.0; 2]);
            let stretches = plane.stretches(160);
            assert_eq!(stretches.len(), 1 + crossings, "{order}: {stretches:?}");
            assert!(stretches[0][0] == 0 && stretches.last().unwrap()[2] == 160);
            assert!(stretches.windows(2).all(|w| w[0][2] == w[1][0]), "{stretches:?}");
            assert!(stretches.iter().all(|[from, seed, to]| from <= seed && seed < to));
        }
    }
}
