//! Arcs: one meridian of one order, cut into segments with smooth data at knots.
//!
//! Between axial ray, folds, axis crossings and rim the exit angle is monotone: a *plain* segment,
//! one ray per direction. About a fold, a *pair* segment holds both rays in their analytic
//! combinations, on the lit and on the dark side. Knots sit at the same fractions of a segment on
//! every meridian, so that all their data vary smoothly with azimuth too.

use super::axis_wave::AxisWave;
use super::bow_wave::{self, Stretch};
use super::fold::{Fold, PAIR_CHANNELS};
use super::meridian::{GRAZING, Meridian, Node};
use super::rim::{RimLayout, RimWave};
use super::segment::{
    CHANNELS, Kind, Knot, PAIR_AMPLITUDE, PLAIN_AMPLITUDE, SLOPE, Segment, parabola_slopes,
};
use super::taper::Taper;
use crate::math::chebyshev::Chebyshev;
use crate::shape::Silhouette;
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, PI};

/// Settings shared by all meridians of an order, so that their segments correspond.
#[derive(Clone, Debug)]
pub struct ArcLayout {
    /// Nodes of the first scan.
    pub scan: usize,
    /// Angle about later axis crossings that is left out, radians.
    pub axis_gap: f64,
    pub folds: Vec<FoldLayout>,
    /// Launch coordinate at which the last plain segment is cut in two, where last rays differ: the
    /// inner part does not depend on them.
    pub cut: Option<f64>,
    /// Knots per radian of exit angle.
    pub density: f64,
    /// Pieces of each plain segment; empty while the layout is being found.
    pub knots: Vec<usize>,
    pub size_parameter: f64,
    /// Where an integral takes over from rays near the rim.
    pub rim: Option<RimLayout>,
    /// Where the edge wave takes over from reflected rays, by the cosine of the grazing angle.
    pub edge: Option<Taper>,
}

impl ArcLayout {
    /// The same with twice the knots.
    pub(super) fn finer(&self) -> Self {
        Self {
            density: 2.0 * self.density,
            knots: self.knots.iter().map(|count| 2 * count).collect(),
            folds: self.folds.iter().map(FoldLayout::finer).collect(),
            rim: self.rim.as_ref().map(RimLayout::finer),
            ..self.clone()
        }
    }
}

/// The segment about a fold.
#[derive(Clone, Debug)]
pub struct FoldLayout {
    /// Its reach on the dark and the lit side, radians.
    pub dark: f64,
    pub lit: f64,
    /// Argument of the Airy function per radian, where it grows fastest.
    pub per_angle: f64,
    /// For an integral over impacts in place of a pair: places of its knots, radians from the fold.
    pub integral: Option<Vec<f64>>,
}

impl FoldLayout {
    fn finer(&self) -> Self {
        let between = |knots: &Vec<f64>| {
            let halves = knots.windows(2).flat_map(|w| [w[0], 0.5 * (w[0] + w[1])]);
            halves.chain(knots.last().copied()).collect()
        };
        Self { integral: self.integral.as_ref().map(between), ..*self }
    }
}

/// Landmarks along a meridian.
#[derive(Clone, Debug)]
enum Landmark {
    Axial,
    Fold(Fold),
    /// Crossing of the axis between two nodes; unwrapped angle of the axis.
    Axis(f64),
    /// Just a launch coordinate, the same on all meridians.
    Cut(f64),
    /// Last ray that leaves: the rim, or the edge of total reflection.
    End(Box<Node>),
}

/// A meridian with its landmarks found, ready to be cut into segments.
pub struct Arc<'a> {
    meridian: Meridian<'a>,
    silhouette: &'a Silhouette<'a>,
    nodes: Vec<Node>,
    landmarks: Vec<Landmark>,
    last: Node,
}

/// Chebyshev points of a pair segment.
const PAIR_POINTS: usize = 20;
/// Ends of plain segments are bisected to this in α.
const END_TOLERANCE: f64 = 1e-9;

impl<'a> Arc<'a> {
    /// Scan a meridian. `None` when its rays do not form a chain this method understands.
    pub fn new(
        meridian: Meridian<'a>,
        silhouette: &'a Silhouette<'a>,
        layout: &ArcLayout,
    ) -> Option<Self> {
        let scan = meridian.scan(silhouette, layout.scan, layout.axis_gap);
        let nodes: Vec<Node> = scan.iter().flatten().copied().collect();
        if nodes.len() < 8 {
            return None;
        }
        let last = *nodes.last()?;
        let mut arc = Self { meridian, silhouette, nodes, landmarks: vec![Landmark::Axial], last };
        let limit = layout.rim.as_ref().map_or(FRAC_PI_2, |rim| rim.full.asin());
        arc.find_landmarks(FRAC_PI_2 / layout.scan as f64, limit)?;
        Some(arc)
    }

    /// Find the landmarks of rays launched up to `limit` (in α), and the last ray of all.
    fn find_landmarks(&mut self, step: f64, limit: f64) -> Option<()> {
        let start = self.meridian.axis_angle();
        for k in 1..self.nodes.len() {
            let (a, b) = (self.nodes[k - 1], self.nodes[k]);
            let half_turn = |n: &Node| ((n.angle - start) / PI).floor();
            let before = half_turn(&a);
            let crosses = before != half_turn(&b) && k > 1;
            if b.alpha > limit {
                if b.alpha - a.alpha > 1.5 * step {
                    self.nodes.truncate(k);
                    break;
                }
            } else if crosses {
                // the multiple of π between the two angles
                let axis = start + PI * before.max(half_turn(&b));
                self.landmarks.push(Landmark::Axis(axis));
            } else if b.alpha - a.alpha > 1.5 * step {
                // total reflection: what lies beyond is not followed
                self.nodes.truncate(k);
                break;
            } else if a.exit.spread() * b.exit.spread() < 0.0 && self.turns_back(k) {
                let fold = Fold::between(&self.meridian, self.silhouette, &a, &b)?;
                self.landmarks.push(Landmark::Fold(fold));
            }
        }
        let last = *self.nodes.last()?;
        self.last = self.end_after(last, step);
        if self.last.alpha > last.alpha {
            self.nodes.push(self.last);
        }
        let end = if self.last.alpha > limit { self.interpolated(limit)? } else { self.last };
        self.landmarks.push(Landmark::End(Box::new(end)));
        Some(())
    }

    /// Whether the exit angle turns back between nodes `k - 1` and `k`: a fold of the meridian. Else
    /// a change of the spread's sign means that rays meet across the meridian's plane, as they do
    /// near the axis for flattened particles.
    fn turns_back(&self, k: usize) -> bool {
        let angle = |k: usize| self.nodes.get(k).map(|n| n.angle);
        let here = self.nodes[k].angle - self.nodes[k - 1].angle;
        let before = k.checked_sub(2).and_then(angle).map_or(here, |a| self.nodes[k - 1].angle - a);
        let after = angle(k + 1).map_or(here, |a| a - self.nodes[k].angle);
        before * after < 0.0
    }

    /// The meridian that this arc is.
    pub fn meridian(&self) -> &Meridian<'a> {
        &self.meridian
    }

    /// The rays of the scan.
    pub(super) fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The last ray that leaves.
    pub fn last_ray(&self) -> &Node {
        &self.last
    }

    /// The ray launched at `sin α`.
    pub fn ray_at(&self, sin: f64) -> Option<Node> {
        self.interpolated(sin.asin())
    }

    /// Exit angles relative to that of the ray at `sin α = start`: the farthest in the direction in
    /// which rays go from there to `sin α = full`, and that of the last ray.
    pub fn reaches(&self, start: f64, full: f64) -> Option<[f64; 2]> {
        let first = self.ray_at(start)?;
        let sense = (self.ray_at(full)?.angle - first.angle).signum();
        let beyond = self.nodes.iter().filter(|n| n.alpha > first.alpha);
        let farthest = beyond.map(|n| sense * (n.angle - first.angle)).fold(0.0, f64::max);
        Some([sense * farthest, self.last.angle - first.angle])
    }

    /// The last ray that still leaves, within a step beyond a node. Rays farther out may leave
    /// again, but total reflection parts them from this stretch.
    fn end_after(&self, last: Node, step: f64) -> Node {
        let rim = FRAC_PI_2 - GRAZING;
        let (mut good, mut bad) = (last, (last.alpha + 1.01 * step).min(rim));
        if let Some(node) = self.meridian.node(self.silhouette, bad, last.psi, last.angle) {
            return node;
        }
        while bad - good.alpha > END_TOLERANCE {
            let middle = 0.5 * (bad + good.alpha);
            match self.meridian.node(self.silhouette, middle, good.psi, good.angle) {
                Some(node) => good = node,
                None => bad = middle,
            }
        }
        good
    }

    /// Signature by which meridians correspond.
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
                Landmark::Axial => (fold.angle - self.meridian.axis_angle()).abs(),
                Landmark::Axis(axis) => (fold.angle - axis).abs() - axis_gap,
                Landmark::Fold(next) => 0.5 * (fold.angle - next.angle).abs(),
                Landmark::End(node) => (fold.angle - node.angle).abs(),
                Landmark::Cut(_) => f64::INFINITY,
            };
            let available = room(&self.landmarks[k - 1]).min(room(&self.landmarks[k + 1]));
            found.push((fold.strength(&self.meridian).unwrap_or(1.0), available));
        }
        found
    }

    /// The rays at both ends of each plain segment. `None` where one cannot be found.
    pub fn ends(&self, layout: &ArcLayout) -> Option<Vec<[Node; 2]>> {
        let mut ends = Vec::new();
        let mut fold_number = 0;
        let cut = layout.cut.map(Landmark::Cut);
        for pair in self.marks(&cut).windows(2) {
            let before_fold = fold_number;
            fold_number += usize::from(matches!(pair[0], Landmark::Fold(_)));
            let edge = |number: usize| layout.folds.get(number).map(|f| f.lit);
            let from = self.edge(pair[0], edge(before_fold), layout)?;
            let to = self.edge(pair[1], edge(fold_number), layout)?;
            ends.push([self.find(from, true)?, self.find(to, false)?]);
        }
        Some(ends)
    }

    /// The landmarks, with one more before the last.
    fn marks<'l>(&'l self, cut: &'l Option<Landmark>) -> Vec<&'l Landmark> {
        let mut marks: Vec<&Landmark> = self.landmarks.iter().collect();
        if let Some(cut) = cut {
            marks.insert(marks.len() - 1, cut);
        }
        marks
    }

    /// Cut into segments between the ends found before. `None` where a ray cannot be found.
    pub fn segments(&self, layout: &ArcLayout, ends: &[[Node; 2]]) -> Option<Vec<Segment>> {
        let mut segments = Vec::new();
        let mut folds = layout.folds.iter();
        let cut = layout.cut.map(Landmark::Cut);
        for (k, (pair, count)) in self.marks(&cut).windows(2).zip(&layout.knots).enumerate() {
            if let Landmark::Fold(fold) = pair[0] {
                let about = folds.next()?;
                let x = layout.size_parameter;
                let stretch = || self.stretch(fold, k, x);
                let integral =
                    about.integral.as_ref().and_then(|places| Some((places, stretch()?)));
                segments.push(match integral {
                    Some((places, stretch)) => {
                        let rays = [&ends[k - 1][1], &ends[k][0]];
                        bow_wave::segment(self, fold, &stretch, rays, places, x)?
                    }
                    None => self.pair_segment(fold, about.dark, about.lit, layout)?,
                });
            }
            segments.push(self.plain_segment([pair[0], pair[1]], &ends[k], *count, layout)?);
        }
        if let Some(rim) = &layout.rim {
            segments.extend(RimWave::new(self, rim, layout.size_parameter)?.segments()?);
        }
        Some(segments)
    }

    /// The waves about the axis of rays that cross it, in a rotationally symmetric scene.
    pub(super) fn axis_waves(&self, layout: &ArcLayout) -> Vec<AxisWave> {
        let (reach, x) = (layout.axis_gap, layout.size_parameter);
        let launch = |landmark: &Landmark| self.launch(landmark);
        let crossing = |around: &[Landmark]| {
            let Landmark::Axis(axis) = around[1] else { return None };
            let side = |is_start| self.find(Edge::Axis { axis, gap: reach }, is_start);
            let (before, after) = (side(false)?, side(true)?);
            let limits = [launch(&around[0])?, launch(&around[2])?];
            let number = (axis / PI).round() as i64;
            let share = |sin: f64| layout.rim.as_ref().map_or(1.0, |rim| 1.0 - rim.weight(sin));
            AxisWave::of_crossing(self, share, [&before, &after], limits, number, reach, x)
        };
        let mut waves: Vec<AxisWave> = self.landmarks.windows(3).filter_map(crossing).collect();
        let rim = layout.rim.as_ref().and_then(|rim| RimWave::new(self, rim, x));
        waves.extend(rim.iter().flat_map(|rim| rim.about_axes(reach)));
        waves
    }

    /// Launch point `sin α` of a landmark.
    fn launch(&self, landmark: &Landmark) -> Option<f64> {
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
        let crosses = |w: &&[Node]| (w[0].angle - axis) * (w[1].angle - axis) <= 0.0;
        self.nodes.windows(2).skip(1).find(crosses).map(|w| w[0].alpha.sin())
    }

    /// The ray where a plain segment begins or ends at a landmark; towards the neighbour given by
    /// the reach of its fold or the axis gap.
    fn edge(&self, landmark: &Landmark, reach: Option<f64>, layout: &ArcLayout) -> Option<Edge> {
        Some(match landmark {
            Landmark::Axial => Edge::Alpha(0.0),
            Landmark::Cut(alpha) => Edge::Alpha(*alpha),
            Landmark::End(node) => Edge::Last(node.clone()),
            Landmark::Fold(fold) => {
                Edge::Angle { angle: fold.angle + fold.lit * reach?, near: fold.alpha }
            }
            Landmark::Axis(axis) => Edge::Axis { axis: *axis, gap: layout.axis_gap },
        })
    }

    /// For each fold: angle from it to the nearest ray of its segment that comes near total reflection
    /// inside; infinite where none does.
    pub(super) fn critical_angles(&self, ends: &[[Node; 2]]) -> Vec<f64> {
        let nearest = |(k, fold): (usize, &Fold)| {
            let [first, last] = [ends[k - 1][1], ends[k][0]];
            let between = |ray: &&Node| first.alpha < ray.alpha && ray.alpha < last.alpha;
            let scanned = self.nodes.iter().filter(between).copied();
            let rays = scanned.chain([first, last]).chain(self.interpolated(fold.alpha));
            rays.filter(|ray| bow_wave::meets_total_reflection(self, ray))
                .map(|ray| (ray.angle - fold.angle).abs())
                .fold(f64::INFINITY, f64::min)
        };
        self.numbered_folds().map(nearest).collect()
    }

    /// How far an integral over impacts reaches on the lit side of fold `number`. `None` where it
    /// does not serve.
    pub(super) fn integral_reach(&self, number: usize, size_parameter: f64) -> Option<f64> {
        let (k, fold) = self.numbered_folds().nth(number)?;
        Some(self.stretch(fold, k, size_parameter)?.reach)
    }

    /// The folds and their numbers among the landmarks.
    fn numbered_folds(&self) -> impl Iterator<Item = (usize, &Fold)> {
        self.landmarks.iter().enumerate().filter_map(|(k, landmark)| match landmark {
            Landmark::Fold(fold) => Some((k, fold)),
            _ => None,
        })
    }

    fn stretch(&self, fold: &Fold, k: usize, size_parameter: f64) -> Option<Stretch> {
        let limits = [self.launch(&self.landmarks[k - 1])?, self.launch(&self.landmarks[k + 1])?];
        Stretch::about(self, fold, limits, size_parameter)
    }

    fn pair_segment(
        &self,
        fold: &Fold,
        dark: f64,
        reach: f64,
        layout: &ArcLayout,
    ) -> Option<Segment> {
        let series = fold.sample(&self.meridian, dark, reach, PAIR_POINTS)?;
        let count = 2 + (1.5 * layout.density * (dark + reach)).ceil() as usize;
        let knots = (0..=count)
            .map(|k| pair_knot(fold, &series, -dark + (dark + reach) * k as f64 / count as f64))
            .collect();
        Some(Segment { kind: Kind::Pair { focal_lines: fold.focal_lines }, knots })
    }

    /// One ray per direction between two landmarks, at `count + 1` knots.
    fn plain_segment(
        &self,
        [start, end]: [&Landmark; 2],
        [a, b]: &[Node; 2],
        count: usize,
        layout: &ArcLayout,
    ) -> Option<Segment> {
        let closer = [
            matches!(start, Landmark::Axis(_)),
            matches!(end, Landmark::End(_) | Landmark::Axis(_)),
        ];
        let mut knots = Vec::with_capacity(count + 1);
        let mut focal_lines = a.exit.focal_lines;
        for k in 0..=count {
            let share = graded(k as f64 / count as f64, closer);
            let node = if k == 0 {
                *a
            } else if k == count {
                *b
            } else {
                self.interpolated(a.alpha + share * (b.alpha - a.alpha))?
            };
            if 2 * k == count || 2 * k == count + 1 {
                focal_lines = node.exit.focal_lines;
            }
            knots.push(self.plain_knot(&node, layout));
        }
        let slopes = parabola_slopes(&knots);
        for (knot, slope) in knots.iter_mut().zip(slopes) {
            knot[SLOPE..SLOPE + 8].copy_from_slice(&slope[PLAIN_AMPLITUDE..PLAIN_AMPLITUDE + 8]);
        }
        let from_axis = matches!(start, Landmark::Axial);
        Some(Segment { kind: Kind::Plain { focal_lines, from_axis }, knots })
    }

    /// A ray at `α`, its neighbours in the scan giving the guess.
    fn interpolated(&self, alpha: f64) -> Option<Node> {
        let nodes = &self.nodes;
        let k = nodes.partition_point(|n| n.alpha < alpha).clamp(1, nodes.len() - 1);
        let (a, b) = (&nodes[k - 1], &nodes[k]);
        let share = (alpha - a.alpha) / (b.alpha - a.alpha);
        let angle = a.angle + share * (b.angle - a.angle);
        // next to total reflection the azimuth runs like a square root: other guesses may do better
        [share, 0.0, 1.0, 0.5 * share, 0.5 + 0.5 * share].into_iter().find_map(|s| {
            self.meridian.node(self.silhouette, alpha, a.psi + s * (b.psi - a.psi), angle)
        })
    }

    /// Pieces between knots that a plain segment needs.
    pub fn pieces(ends: &[Node; 2], density: f64) -> usize {
        4 + (density * (ends[1].angle - ends[0].angle).abs()).ceil() as usize
    }

    /// The ray at an edge of a plain segment.
    fn find(&self, edge: Edge, is_start: bool) -> Option<Node> {
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
    fn at_angle(&self, angle: f64, near: f64, is_start: bool) -> Option<Node> {
        let nodes = &self.nodes;
        let window = |w: &[Node]| (w[0].angle - angle) * (w[1].angle - angle) <= 0.0;
        let bracket = if is_start {
            nodes.windows(2).find(|w| w[1].alpha >= near && window(w))
        } else {
            nodes.windows(2).rev().find(|w| w[0].alpha <= near && window(w))
        };
        let (mut a, mut b) = match bracket {
            Some(w) => (w[0], w[1]),
            // between the last node of the scan and the edge of the gap, extrapolate
            None => return self.beyond_scan(angle, near),
        };
        for _ in 0..40 {
            let share = ((angle - a.angle) / (b.angle - a.angle)).clamp(0.02, 0.98);
            let (alpha, psi) =
                (a.alpha + share * (b.alpha - a.alpha), a.psi + share * (b.psi - a.psi));
            let node = self.meridian.node(self.silhouette, alpha, psi, angle)?;
            if (node.angle - angle).abs() < 1e-13 || b.alpha - a.alpha < 1e-14 {
                return Some(Node { angle, ..node });
            }
            if (node.angle - angle) * (a.angle - angle) > 0.0 { a = node } else { b = node }
        }
        let node = self.meridian.node(self.silhouette, 0.5 * (a.alpha + b.alpha), a.psi, angle)?;
        Some(Node { angle, ..node })
    }

    /// A ray just outside the scanned stretch next to `α = near`, by Newton's method on the angle.
    fn beyond_scan(&self, angle: f64, near: f64) -> Option<Node> {
        let nearest = |n: &&Node| (n.alpha - near).abs();
        let mut node = *self.nodes.iter().min_by(|a, b| nearest(a).total_cmp(&nearest(b)))?;
        let h = 1e-5;
        for _ in 0..20 {
            let ahead =
                self.meridian.node(self.silhouette, node.alpha + h, node.psi, node.angle)?;
            let rate = (ahead.angle - node.angle) / h;
            let step = (angle - node.angle) / rate;
            if step.is_nan() || step.abs() >= 0.3 {
                return None;
            }
            node = self.meridian.node(self.silhouette, node.alpha + step, node.psi, angle)?;
            if (node.angle - angle).abs() < 1e-12 {
                return Some(Node { angle, ..node });
            }
        }
        None
    }

    /// The spread of a ray, kept from zero where rays meet across the plane.
    fn bounded_spread(&self, node: &Node) -> f64 {
        const NEAREST: f64 = 0.05;
        let spread = node.exit.spread().abs();
        let symmetric = self.meridian.tracer.shape().rotational_symmetry();
        if self.meridian.order <= 3 || symmetric {
            return spread;
        }
        let across = self.meridian.spread_across(&node.exit, node.angle).abs();
        spread * (across.max(NEAREST) / across)
    }

    fn plain_knot(&self, node: &Node, layout: &ArcLayout) -> Knot {
        let (_, growing) = self.meridian.frame(node.angle);
        let transfer = self.meridian.transfer(&node.exit, node.angle);
        let rim = layout.rim.as_ref().map(|rim| rim.weight(node.alpha.sin()));
        let edge =
            layout.edge.map(|edge| reflected_share(&edge, node.angle, layout.size_parameter));
        let share = edge.unwrap_or_else(|| (1.0 - rim.unwrap_or(0.0)).into());
        // No wave is stronger than the whole shadow in phase, |S| ≤ x² area/2π: the bound on rays
        // that focus at infinity, as about the axis for indices of 2 and 4.
        let spread = self.bounded_spread(node).max(4.0 / layout.size_parameter.powi(2));
        let size = share / spread.sqrt();
        let mut knot = [0.0; CHANNELS];
        knot[0] = node.angle;
        knot[1] = node.exit.path;
        knot[2] = -node.exit.reference.dot(growing);
        for (k, s) in [transfer.s1, transfer.s2, transfer.s3, transfer.s4].into_iter().enumerate() {
            let amplitude = s * size;
            knot[PLAIN_AMPLITUDE + 2 * k] = amplitude.re;
            knot[PLAIN_AMPLITUDE + 2 * k + 1] = amplitude.im;
        }
        knot
    }
}

/// What the edge wave leaves to a ray reflected by an angle: the complement of its weight, with the
/// next term of stationary phase, since the weight changes over few Fresnel zones.
fn reflected_share(edge: &Taper, angle: f64, x: f64) -> Complex64 {
    let cos = (0.5 * angle).cos();
    let [weight, slope, bend] = edge.with_derivatives(cos);
    if weight == 0.0 || weight == 1.0 {
        return (1.0 - weight).into();
    }
    // the phase x (L(β) - βϑ) of a sphere: second derivative, and its own relative slope
    let sin = (1.0 - cos * cos).sqrt();
    let (second, relative) = (-2.0 / sin, cos / (sin * sin));
    Complex64::new(1.0 - weight, (relative * slope - bend) / (2.0 * x * second))
}

/// A share of the way from 0 to 1 in steps that get closer towards either end: towards the rim or
/// total reflection the exit angle runs like a square root, and from the axis the amplitude falls
/// like one over it.
fn graded(share: f64, closer: [bool; 2]) -> f64 {
    match closer {
        [false, false] => share,
        [false, true] => share * (2.0 - share),
        [true, false] => share * share,
        [true, true] => share * share * (3.0 - 2.0 * share),
    }
}

/// Where a plain segment begins or ends.
#[derive(Clone, Debug)]
enum Edge {
    Alpha(f64),
    Last(Box<Node>),
    Angle { angle: f64, near: f64 },
    Axis { axis: f64, gap: f64 },
}

fn pair_knot(fold: &Fold, series: &Chebyshev<PAIR_CHANNELS>, delta: f64) -> Knot {
    let (value, slope) = series.at(delta);
    let mut knot = [0.0; CHANNELS];
    knot[0] = fold.angle + fold.lit * delta;
    knot[1] = value[0];
    knot[2] = fold.lit * slope[0];
    knot[3] = value[1];
    knot[4] = fold.lit * slope[1];
    let amplitudes = &value[2..];
    knot[PAIR_AMPLITUDE..PAIR_AMPLITUDE + amplitudes.len()].copy_from_slice(amplitudes);
    knot
}
