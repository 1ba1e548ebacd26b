//! Arcs: one meridian of one order, cut into segments with smooth data at knots.
//!
//! Between axial ray, folds, axis crossings and rim the exit angle is monotone: a *plain* segment,
//! one ray per direction. About a fold, a *pair* segment holds both rays in their analytic
//! combinations, on the lit and on the dark side. Knots sit at the same fractions of a segment on
//! every meridian, so that all their data vary smoothly with azimuth too.

use super::arc_layout::ArcLayout;
use super::arc_search::Edge;
use super::axis_wave::AxisWave;
use super::bow_wave::{self, Stretch};
use super::fold::Fold;
use super::meridian::{Meridian, Node};
use super::rim::RimWave;
use crate::shape::Silhouette;
use std::f64::consts::{FRAC_PI_2, PI};

/// Landmarks along a meridian.
#[derive(Clone, Debug)]
pub(super) enum Landmark {
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
    pub(super) meridian: Meridian<'a>,
    pub(super) silhouette: &'a Silhouette<'a>,
    pub(super) nodes: Vec<Node>,
    pub(super) landmarks: Vec<Landmark>,
    last: Node,
}

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
    pub(super) fn marks<'l>(&'l self, cut: &'l Option<Landmark>) -> Vec<&'l Landmark> {
        let mut marks: Vec<&Landmark> = self.landmarks.iter().collect();
        if let Some(cut) = cut {
            marks.insert(marks.len() - 1, cut);
        }
        marks
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

    pub(super) fn stretch(&self, fold: &Fold, k: usize, size_parameter: f64) -> Option<Stretch> {
        let limits = [self.launch(&self.landmarks[k - 1])?, self.launch(&self.landmarks[k + 1])?];
        Stretch::about(self, fold, limits, size_parameter)
    }

    /// Pieces between knots that a plain segment needs.
    pub fn pieces(ends: &[Node; 2], density: f64) -> usize {
        4 + (density * (ends[1].angle - ends[0].angle).abs()).ceil() as usize
    }
}
