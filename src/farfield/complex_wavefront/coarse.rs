//! The coarse grid of traced rays of an order, and what the sum's integrand is between them.
//!
//! Rings at the midpoints of even steps of `α`, spokes at even steps of `ψ`; a ray starts at `sin α` of the
//! way from the centre to the rim. Across the centre a ring goes on at the opposite azimuth. Polynomials
//! through six rings and six spokes give every channel between them. A cell where they fail, found by
//! tracing a ray in its middle, has its rays traced one by one.

use super::channels::{
    CHANNELS, Channels, DIRECTION, FIELDS, PATH, Place, REFERENCE, by_launch, channels, steps,
    width,
};
use crate::math::parallel::*;
use crate::math::vec3::Vec3;
use crate::shape::Silhouette;
use crate::trace::{Exit, Tracer};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Rings and spokes.
pub(super) const RINGS: usize = 160;
pub(super) const SPOKES: usize = 320;
/// Neighbours in each direction of the interpolation.
const STENCIL: usize = 6;
/// Phase (radians) and share of the strongest neighbour's field by which interpolation may err.
const LARGEST_PHASE_ERROR: f64 = 0.02;
const LARGEST_FIELD_ERROR: f64 = 0.01;
/// Share of the spokes whose steps a ring's must not exceed.
const SERVED: f64 = 0.98;
/// Channels that change sign in the mirror image: y of vectors and of the field of light along x; x and
/// z of the field of light along y.
const ODD: [usize; 8] = [1, 4, 9, 10, 13, 14, 17, 18];

/// How a cell of the coarse grid is filled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// No ray leaves.
    Empty,
    /// Channels are interpolated.
    Smooth,
    /// Rays are traced one by one.
    Edge,
}

/// A cell between two rings and two spokes: where its rays go.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    pub kind: Kind,
    pub centre: Vec3<f64>,
    /// Least area in `(α, ψ)` that the wave of a ray at its corners stands for.
    pub width: f64,
    /// Angle from the centre within which all rays leave.
    pub radius: f64,
}

/// Largest steps `(α, ψ)` of the sum on each ring.
pub(super) type Steps = Vec<[f64; 2]>;

/// The coarse rays of one order.
pub(super) struct CoarseGrid {
    nodes: Vec<Option<Channels>>,
    widths: Vec<f64>,
    cells: Vec<Cell>,
    rims: Vec<f64>,
    pub steps: Steps,
}

/// A row of rings about a fine ring, and their weights.
pub(super) struct Rows {
    pub cell: usize,
    first: i64,
    weights: [f64; STENCIL],
}

/// What is kept of a traced ray of the coarse grid.
struct Node {
    channels: Channels,
    steps: [f64; 2],
    width: f64,
}

impl CoarseGrid {
    /// The coarse rays of one order.
    pub(super) fn of_order(tracer: &Tracer, order: u32, x: f64, place: Place) -> Self {
        Self::of_orders(tracer, &[order], x, place).swap_remove(0)
    }

    /// The coarse rays of some orders, traced together.
    pub(super) fn of_orders(tracer: &Tracer, orders: &[u32], x: f64, place: Place) -> Vec<Self> {
        let silhouette = tracer.shape().silhouette().tabulated();
        // one half of the spokes, the other half is their mirror image
        let half = SPOKES / 2 + 1;
        let traced: Vec<Vec<Option<Node>>> = (0..RINGS * half)
            .into_par_iter()
            .map(|n| {
                let at = [alpha(n / half), TAU * (n % half) as f64 / SPOKES as f64];
                let rays = rays(tracer, &silhouette, orders, at);
                rays.iter()
                    .map(|exit| Node::new(exit.as_ref()?, &silhouette, at, x, place))
                    .collect()
            })
            .collect();
        let probes: Vec<Vec<Option<Channels>>> = (0..(RINGS - 1) * (half - 1))
            .into_par_iter()
            .map(|n| {
                let (i, j) = (n / (half - 1), n % (half - 1));
                let at = [alpha(i) + 0.5 * RING, TAU * (j as f64 + 0.5) / SPOKES as f64];
                let rim = silhouette.radius(at[1]);
                let rays = rays(tracer, &silhouette, orders, at);
                rays.iter().map(|exit| channels(exit.as_ref()?, place, rim * rim)).collect()
            })
            .collect();
        let rims: Vec<f64> = (0..SILHOUETTE)
            .map(|j| silhouette.radius(TAU * j as f64 / SILHOUETTE as f64))
            .collect();
        (0..orders.len())
            .map(|p| {
                let nodes = unfold(|i, j| traced[i * half + j][p].as_ref().map(|n| n.channels));
                let steps = (0..RINGS)
                    .map(|i| ring_steps((0..half).filter_map(|j| traced[i * half + j][p].as_ref())))
                    .collect();
                let of_node = |i: usize, j: usize| {
                    let node = traced[i * half + j.min(SPOKES - j)][p].as_ref();
                    node.map_or(f64::INFINITY, |n| n.width)
                };
                let widths = (0..RINGS * SPOKES).map(|n| of_node(n / SPOKES, n % SPOKES)).collect();
                let mut grid = Self { nodes, widths, cells: Vec::new(), rims: rims.clone(), steps };
                let probe = |i: usize, j: usize| {
                    let folded = if j < half - 1 { j } else { SPOKES - 1 - j };
                    let found = probes[i * (half - 1) + folded][p]?;
                    Some(if folded == j { found } else { mirrored(found) })
                };
                grid.cells = (0..RINGS * SPOKES)
                    .map(|n| grid.judge(n / SPOKES, n % SPOKES, probe, x))
                    .collect();
                grid
            })
            .collect()
    }

    /// The cell between rings `i` and `i + 1` and spokes `j` and `j + 1`; the last also holds what lies
    /// beyond the last ring, the first what lies within the first.
    pub(super) fn cell(&self, i: usize, j: usize) -> &Cell {
        &self.cells[i * SPOKES + j]
    }

    /// The row of cells that holds a ring of the sum.
    pub(super) fn row_of(alpha: f64) -> usize {
        ((alpha / RING - 0.5).floor().max(0.0) as usize).min(RINGS - 2)
    }

    /// The rows about a ring of the sum.
    pub(super) fn rows(&self, alpha: f64) -> Rows {
        let at = alpha / RING - 0.5;
        let cell = Self::row_of(alpha);
        let first = (at.floor() as i64 - 2).min((RINGS - STENCIL) as i64);
        Rows { cell, first, weights: lagrange(at - first as f64) }
    }

    /// Channels on six spokes about a cell, at a ring.
    pub(super) fn row(&self, rows: &Rows, spoke: usize) -> [Channels; STENCIL] {
        std::array::from_fn(|b| {
            let mut sum = [0.0; CHANNELS];
            for (a, weight) in rows.weights.iter().enumerate() {
                let node = self.node(rows.first + a as i64, spoke as i64 - 2 + b as i64);
                let Some(node) = node else { return [f64::NAN; CHANNELS] };
                for (sum, value) in sum.iter_mut().zip(node) {
                    *sum += weight * value;
                }
            }
            sum
        })
    }

    /// Radius of the silhouette and its slope.
    pub(super) fn silhouette(&self, psi: f64) -> (f64, f64) {
        const H: f64 = 1e-3;
        let scale = SILHOUETTE as f64 / TAU;
        let at = psi * scale;
        let first = at.floor() as i64 - 2;
        let value = |a: usize| self.rims[(first + a as i64).rem_euclid(SILHOUETTE as i64) as usize];
        let radius = |at: f64| -> f64 {
            let weights = lagrange(at - first as f64);
            weights.iter().enumerate().map(|(a, w)| w * value(a)).sum()
        };
        (radius(at), (radius(at + H) - radius(at - H)) / (2.0 * H) * scale)
    }

    /// A traced ray; rings below the first go on at the opposite azimuth.
    fn node(&self, ring: i64, spoke: i64) -> Option<&Channels> {
        let (ring, spoke) =
            if ring < 0 { (-1 - ring, spoke + SPOKES as i64 / 2) } else { (ring, spoke) };
        self.nodes[ring as usize * SPOKES + spoke.rem_euclid(SPOKES as i64) as usize].as_ref()
    }

    /// What a cell is, from its neighbours and the ray in its middle.
    fn judge(
        &self,
        i: usize,
        j: usize,
        probe: impl Fn(usize, usize) -> Option<Channels>,
        x: f64,
    ) -> Cell {
        let empty =
            Cell { kind: Kind::Empty, centre: Vec3::default(), width: f64::INFINITY, radius: 0.0 };
        if i == RINGS - 1 {
            return empty;
        }
        let (i, j) = (i as i64, j as i64);
        let from = (i - 2).min((RINGS - STENCIL) as i64);
        let around: Vec<&Channels> = (from..from + STENCIL as i64)
            .flat_map(|a| (j - 2..j + 4).map(move |b| (a, b)))
            .filter_map(|(a, b)| self.node(a, b))
            .collect();
        let at_corners = [(i, j), (i, j + 1), (i + 1, j), (i + 1, j + 1)];
        let spokes = SPOKES as i64;
        let width = at_corners
            .map(|(a, b)| self.widths[(a * spokes + b.rem_euclid(spokes)) as usize])
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        let corners: Vec<&Channels> =
            at_corners.into_iter().filter_map(|(a, b)| self.node(a, b)).collect();
        let middle = probe(i as usize, j as usize);
        let known: Vec<Vec3<f64>> = corners.iter().copied().chain(&middle).map(direction).collect();
        if known.is_empty() {
            return empty;
        }
        let sum = known.iter().fold(Vec3::default(), |sum: Vec3<f64>, s| sum + *s);
        let centre = sum * (1.0 / sum.dot(sum).sqrt());
        let apart = |s: &Vec3<f64>| (*s - centre).dot(*s - centre).sqrt();
        let widest = known.iter().map(apart).fold(0.0, f64::max);
        let smooth = around.len() == STENCIL * STENCIL
            && middle.is_some_and(|middle| {
                let rows = self.rows(alpha(i as usize) + 0.5 * RING);
                let psi = TAU * (j as f64 + 0.5) / SPOKES as f64;
                let found = blend(&self.row(&rows, j as usize), psi, j as usize);
                agrees(&found, &middle, bounded_strength(&around), x)
            });
        let at_a_border = i == 0 || i == RINGS as i64 - 2;
        if smooth {
            let room = if at_a_border { 2.0 } else { 1.1 };
            return Cell { kind: Kind::Smooth, centre, width, radius: room * widest };
        }
        // next to total reflection directions run like a square root
        let radius = 2.0 * widest + 0.5 * RING.sqrt();
        Cell { kind: Kind::Edge, centre, width, radius }
    }
}

/// Samples of the silhouette's radius.
const SILHOUETTE: usize = 512;
/// Step between rings.
const RING: f64 = FRAC_PI_2 / RINGS as f64;

fn alpha(ring: usize) -> f64 {
    (ring as f64 + 0.5) * RING
}

impl Node {
    fn new(
        exit: &Exit<f64>,
        silhouette: &Silhouette,
        at: [f64; 2],
        x: f64,
        place: Place,
    ) -> Option<Self> {
        let (rim, slope) = silhouette.radius_and_slope(at[1]);
        let channels = channels(exit, place, rim * rim)?;
        let tangents = by_launch(exit, at, (rim, slope));
        let (steps, width) = (steps(tangents, x, place), width(tangents, x, place));
        Some(Self { channels, steps, width })
    }
}

/// Rays of some orders launched at a place, those that leave.
fn rays(
    tracer: &Tracer,
    silhouette: &Silhouette,
    orders: &[u32],
    [alpha, psi]: [f64; 2],
) -> Vec<Option<Exit<f64>>> {
    let radius = silhouette.radius(psi) * alpha.sin();
    let mut found = vec![None; orders.len()];
    let keep = |exit: Exit<f64>| {
        if let Some(p) = orders.iter().position(|&order| order == exit.order) {
            found[p] = Some(exit);
        }
    };
    let _ = tracer.trace(radius * psi.cos(), radius * psi.sin(), keep);
    found
}

/// The smallest steps of a ring that most of its rays need.
fn ring_steps<'n>(nodes: impl Iterator<Item = &'n Node>) -> [f64; 2] {
    let all: Vec<[f64; 2]> = nodes.map(|node| node.steps).collect();
    [0, 1].map(|axis| {
        let mut steps: Vec<f64> = all.iter().map(|s| s[axis]).filter(|s| s.is_finite()).collect();
        steps.sort_by(f64::total_cmp);
        let at = ((1.0 - SERVED) * steps.len() as f64) as usize;
        steps.get(at).copied().unwrap_or(f64::INFINITY)
    })
}

/// Nodes of all spokes from those of half of them.
fn unfold(node: impl Fn(usize, usize) -> Option<Channels>) -> Vec<Option<Channels>> {
    (0..RINGS * SPOKES)
        .map(|n| {
            let (i, j) = (n / SPOKES, n % SPOKES);
            if j <= SPOKES / 2 { node(i, j) } else { node(i, SPOKES - j).map(mirrored) }
        })
        .collect()
}

fn mirrored(mut channels: Channels) -> Channels {
    ODD.iter().for_each(|&c| channels[c] = -channels[c]);
    channels
}

/// Channels between six spokes about a cell.
#[inline]
pub(super) fn blend(row: &[Channels; STENCIL], psi: f64, spoke: usize) -> Channels {
    let weights = lagrange(psi / TAU * SPOKES as f64 - spoke as f64 + 2.0);
    let mut sum = [0.0; CHANNELS];
    for (values, weight) in row.iter().zip(weights) {
        for (sum, value) in sum.iter_mut().zip(values) {
            *sum += weight * value;
        }
    }
    sum
}

/// Weights of points 0 … 5 for a place among them.
fn lagrange(t: f64) -> [f64; STENCIL] {
    const SCALE: [f64; STENCIL] =
        [-1.0 / 120.0, 1.0 / 24.0, -1.0 / 12.0, 1.0 / 12.0, -1.0 / 24.0, 1.0 / 120.0];
    let off: [f64; STENCIL] = std::array::from_fn(|b| t - b as f64);
    std::array::from_fn(|a| {
        (0..STENCIL).filter(|&b| b != a).fold(SCALE[a], |product, b| product * off[b])
    })
}

fn vector(channels: &Channels, at: usize) -> Vec3<f64> {
    Vec3 { x: channels[at], y: channels[at + 1], z: channels[at + 2] }
}

fn direction(channels: &Channels) -> Vec3<f64> {
    vector(channels, DIRECTION)
}

fn strength(channels: &Channels) -> f64 {
    channels[FIELDS..].iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// The strongest field of some rays; one next to a singularity does not speak for the others.
fn bounded_strength(rays: &[&Channels]) -> f64 {
    const MOST: f64 = 4.0;
    let mut all: Vec<f64> = rays.iter().map(|ray| strength(ray)).collect();
    all.sort_by(f64::total_cmp);
    let median = all.get(all.len() / 2).copied().unwrap_or(0.0);
    all.last().map_or(0.0, |strongest| strongest.min(MOST * median))
}

/// Whether interpolated channels serve for those of the traced ray.
fn agrees(found: &Channels, traced: &Channels, strongest: f64, x: f64) -> bool {
    let along = direction(traced);
    let path = |c: &Channels| c[PATH] - along.dot(vector(c, REFERENCE));
    let off = |from: usize| -> f64 {
        found[from..].iter().zip(&traced[from..]).map(|(f, t)| (f - t) * (f - t)).sum::<f64>()
    };
    x * (path(found) - path(traced)).abs() < LARGEST_PHASE_ERROR
        && off(FIELDS).sqrt() < LARGEST_FIELD_ERROR * strongest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Polynomials of fifth degree are met exactly.
    #[test]
    fn weights_reproduce_polynomials() {
        let f = |t: f64| 1.0 - t + 0.3 * t.powi(3) - 0.02 * t.powi(5);
        for t in [2.0, 2.3, 2.99, 4.7, -0.4] {
            let sum: f64 = lagrange(t).iter().enumerate().map(|(k, w)| w * f(k as f64)).sum();
            assert!((sum - f(t)).abs() < 1e-12, "{t}");
        }
    }
}
