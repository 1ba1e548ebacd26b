//! The sum over the spheres of a mean.
//!
//! S1 and S2 of a series of N terms are polynomials in cos θ of degree N, so that the elements of
//! the Mueller matrix are even trigonometric polynomials of degree 2N: their values at 2N + 1 even
//! angles are all there is to know. Where that is less than the angles asked for, stretches
//! of spheres are summed on such a grid, each of the degree its largest sphere needs, and the mean
//! alone is carried to the asked angles ([`CosineSeries`]); that changes rounding only.
//!
//! Spheres enter with their exact coefficients, or with the Debye series cut behind an order and the
//! mean power of the rest. Of the latter, one pass serves the mean and the coarser one it is compared
//! with, which takes every second sphere and half as many orders.

use crate::math::cosine_series::{self, CosineSeries};
use crate::math::parallel::*;
use crate::series::angular::{self, AngleSet};
use crate::series::behind::{Products, Waves};
use crate::series::debye::{Cut, DebyeSeries};
use crate::series::lorenz_mie::{Sphere, sums};
use crate::series::{SeriesError, checked_term_count};
use num_complex::Complex64;
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

/// Stretches that are summed apart; a fixed number, so that threads do not change the sums.
const PARTS: usize = 64;

/// One sphere of an average.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    /// Radius and wavelength, metres.
    pub radius: f64,
    pub wavelength: f64,
    pub index: Complex64,
    /// Share of all particles, or of the band.
    pub weight: f64,
}

impl Node {
    fn size_parameter(&self) -> f64 {
        TAU * self.radius / self.wavelength
    }

    /// What one unit of |S|² is worth, m²/sr.
    fn area(&self) -> f64 {
        (self.wavelength / TAU).powi(2)
    }
}

/// What spheres add up to at some angles.
#[derive(Clone, Debug)]
pub(super) struct Summed {
    /// S11, S12, S33, S34 as areas per solid angle, m²/sr.
    pub elements: Vec<[f64; 4]>,
    /// Cross-sections, m².
    pub scattering: f64,
    pub absorption: f64,
    /// Scattering times the mean cosine.
    pub forward: f64,
    /// Extinction by the optical theorem: of the amplitudes straight ahead, not of powers.
    pub extinction: f64,
}

impl Summed {
    /// Nothing at so many angles.
    pub fn nothing(angles: usize) -> Summed {
        let elements = vec![[0.0; 4]; angles];
        Summed { elements, scattering: 0.0, absorption: 0.0, forward: 0.0, extinction: 0.0 }
    }

    /// With other spheres.
    pub fn plus(mut self, other: &Summed) -> Summed {
        add_rows(&mut self.elements, &other.elements);
        self.scattering += other.scattering;
        self.absorption += other.absorption;
        self.forward += other.forward;
        self.extinction += other.extinction;
        self
    }

    /// At the last angles alone.
    pub fn last(&self, count: usize) -> Summed {
        let elements = self.elements[self.elements.len() - count..].to_vec();
        Summed { elements, ..*self }
    }
}

/// Sum spheres with their exact coefficients at scattering angles (radians).
pub(super) fn exact(nodes: &[Node], theta: &[f64]) -> Result<Summed, SeriesError> {
    let set = AngleSet::new(theta);
    let length = nodes.len().div_ceil(PARTS).max(1);
    let parts: Vec<Sum> = nodes
        .par_chunks(length)
        .rev()
        .with_max_len(1)
        .map(|nodes| {
            let mut sum = Sum::new(&set, most_terms(nodes)?, 0);
            for node in nodes {
                let sphere = Sphere::new(node.size_parameter(), node.index)?;
                sum.add_waves(
                    sphere.a(),
                    sphere.b(),
                    sphere.efficiencies().q_abs,
                    node,
                    node.weight,
                );
            }
            Ok(sum)
        })
        .collect::<Result<_, SeriesError>>()?;
    let mut total = Total::default();
    parts.into_iter().for_each(|sum| total.add(sum));
    Ok(total.at(theta))
}

fn most_terms(nodes: &[Node]) -> Result<usize, SeriesError> {
    nodes.iter().try_fold(0, |most, node| {
        Ok(most.max(checked_term_count(node.size_parameter(), node.index)?))
    })
}

/// Sum all spheres with the series cut behind an order, and every second one with twice its weight
/// and half as many orders, each at its own scattering angles (radians).
pub(super) fn fine_and_coarse(
    nodes: &[Node],
    cut: u32,
    fine: &[f64],
    coarse: &[f64],
) -> Result<[Summed; 2], SeriesError> {
    let sets = [AngleSet::new(fine), AngleSet::new(coarse)];
    // Even, so that every stretch begins with a sphere of the coarser sum.
    let length = 2 * nodes.len().div_ceil(2 * PARTS);
    // The last parts hold the largest spheres: they are to begin first.
    let parts: Vec<[Sum; 2]> = (0..nodes.len().div_ceil(length))
        .into_par_iter()
        .rev()
        .with_max_len(1)
        .map(|k| part(nodes, k * length..((k + 1) * length).min(nodes.len()), &sets, cut))
        .collect::<Result<_, SeriesError>>()?;
    let mut totals = [Total::default(), Total::default()];
    for part in parts {
        for (total, sum) in totals.iter_mut().zip(part) {
            total.add(sum);
        }
    }
    let [first, second] = totals;
    Ok([first.at(fine), second.at(coarse)])
}

/// The spheres of one stretch, and the way to the first one of the next.
fn part<'a>(
    nodes: &[Node],
    range: std::ops::Range<usize>,
    sets: &'a [AngleSet; 2],
    cut: u32,
) -> Result<[Sum<'a>; 2], SeriesError> {
    let terms = most_terms(&nodes[range.clone()])?;
    let (mut fine, mut coarse) =
        (Sum::new(&sets[0], terms, cut), Sum::new(&sets[1], terms, cut / 2));
    let last = (range.end + 1).min(nodes.len());
    for (i, node) in nodes.iter().enumerate().take(last).skip(range.start) {
        let series = DebyeSeries::new(node.size_parameter(), node.index)?;
        let own = i < range.end;
        fine.add(&series, node, node.weight, own);
        if i.is_multiple_of(2) {
            coarse.add(&series, node, 2.0 * node.weight, own);
        }
    }
    Ok([fine, coarse])
}

/// Where a stretch is sampled.
#[derive(Debug)]
enum Samples<'a> {
    Asked(&'a AngleSet),
    /// The even grid of a degree.
    Grid(usize, AngleSet),
}

/// The sum over one stretch of spheres with the series cut behind one order.
#[derive(Debug)]
struct Sum<'a> {
    cut: u32,
    samples: Samples<'a>,
    elements: Vec<[f64; 4]>,
    /// Behind the cut, in units of area.
    behind: Products,
    before: Option<Waves>,
    scattering: f64,
    absorption: f64,
    forward: f64,
    extinction: f64,
}

impl<'a> Sum<'a> {
    fn new(asked: &'a AngleSet, terms: usize, cut: u32) -> Self {
        let degree = grid_degree(2 * terms);
        let samples = if degree / 2 < asked.recurrences() {
            Samples::Grid(degree, AngleSet::new(&cosine_series::points(degree)))
        } else {
            Samples::Asked(asked)
        };
        let mut sum = Self {
            cut,
            samples,
            elements: Vec::new(),
            behind: Products::default(),
            before: None,
            scattering: 0.0,
            absorption: 0.0,
            forward: 0.0,
            extinction: 0.0,
        };
        sum.elements.resize(sum.set().len(), [0.0; 4]);
        sum
    }

    fn set(&self) -> &AngleSet {
        match &self.samples {
            Samples::Asked(set) => set,
            Samples::Grid(_, set) => set,
        }
    }

    /// Add a sphere; if it is not `own`, only the way to it.
    fn add(&mut self, series: &DebyeSeries, node: &Node, weight: f64, own: bool) {
        let scale = weight * node.area();
        let Cut { a, b, electric, magnetic, q_abs } = series.cut(self.cut);
        let waves = Waves::new(&electric, &magnetic, scale);
        if let Some(before) = &self.before {
            self.behind.add_stretch(before, &waves);
        }
        self.before = Some(waves);
        if own {
            self.add_waves(&a, &b, q_abs, node, weight);
        }
    }

    /// Add partial waves, and what the sphere absorbs.
    fn add_waves(
        &mut self,
        a: &[Complex64],
        b: &[Complex64],
        q_abs: f64,
        node: &Node,
        weight: f64,
    ) {
        let scale = weight * node.area();
        let amplitudes = angular::amplitudes(a, b, self.set());
        for (sum, (s1, s2)) in self.elements.iter_mut().zip(amplitudes) {
            let (perpendicular, parallel, cross) = (s1.norm_sqr(), s2.norm_sqr(), s1 * s2.conj());
            sum[0] += scale * 0.5 * (parallel + perpendicular);
            sum[1] += scale * 0.5 * (parallel - perpendicular);
            sum[2] += scale * cross.re;
            sum[3] -= scale * cross.im;
        }
        let (scattered, forward) = sums(a, b);
        self.scattering += scale * TAU * scattered;
        self.forward += scale * 2.0 * TAU * forward;
        self.extinction += scale * TAU * straight_ahead(a, b);
        self.absorption += weight * q_abs * PI * node.radius * node.radius;
    }
}

/// The next degree of a ladder, in four steps per octave, for few transforms and little waste.
fn grid_degree(needed: usize) -> usize {
    let octave = (needed.max(16) + 1).next_power_of_two() / 2;
    (4..=8).map(|quarters| octave / 4 * quarters).find(|&d| d >= needed).unwrap_or(2 * octave)
}

/// All stretches together.
#[derive(Debug, Default)]
struct Total {
    /// At the asked angles.
    asked: Vec<[f64; 4]>,
    /// By the degree of the grid.
    grids: BTreeMap<usize, Vec<[f64; 4]>>,
    behind: Products,
    scattering: f64,
    absorption: f64,
    forward: f64,
    extinction: f64,
}

impl Total {
    fn add(&mut self, sum: Sum) {
        let to = match sum.samples {
            Samples::Asked(_) => &mut self.asked,
            Samples::Grid(degree, _) => self.grids.entry(degree).or_default(),
        };
        to.resize(sum.elements.len(), [0.0; 4]);
        add_rows(to, &sum.elements);
        self.behind.add(&sum.behind);
        self.scattering += sum.scattering;
        self.absorption += sum.absorption;
        self.forward += sum.forward;
        self.extinction += sum.extinction;
    }

    /// The sums at the asked angles, with the orders behind the cut.
    fn at(self, theta: &[f64]) -> Summed {
        let mut elements = self.asked;
        elements.resize(theta.len(), [0.0; 4]);
        let mut series = CosineSeries::default();
        for values in self.grids.values() {
            series.add(&CosineSeries::fit(values));
        }
        let degree = grid_degree(2 * self.behind.waves());
        if self.behind.waves() == 0 {
            // Exact coefficients leave nothing behind.
        } else if degree < theta.len() {
            let grid = cosine_series::points(degree);
            series.add(&CosineSeries::fit(&self.behind.elements(&grid)));
        } else {
            add_rows(&mut elements, &self.behind.elements(theta));
        }
        add_rows(&mut elements, &series.at(theta));
        let (scattered, forward) = self.behind.sums();
        let scattering = self.scattering + TAU * scattered;
        Summed {
            elements,
            scattering,
            absorption: self.absorption,
            forward: self.forward + 2.0 * TAU * forward,
            // Of the orders behind the cut the phases run through many turns: no amplitude is left.
            extinction: self.extinction,
        }
    }
}

/// `Σ (2n+1) Re(a_n + b_n)`: the real part of the amplitude straight ahead, twice.
fn straight_ahead(a: &[Complex64], b: &[Complex64]) -> f64 {
    let wave = |(k, (a, b)): (usize, (&Complex64, &Complex64))| (2 * k + 3) as f64 * (a + b).re;
    a.iter().zip(b).enumerate().map(wave).sum()
}

fn add_rows(to: &mut [[f64; 4]], from: &[[f64; 4]]) {
    let pairs = to.iter_mut().flatten().zip(from.iter().flatten());
    pairs.for_each(|(sum, value)| *sum += value);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ladder_wastes_little() {
        for needed in 1..5000 {
            let degree = grid_degree(needed);
            assert!(degree >= needed && degree.is_multiple_of(2), "{needed}: {degree}");
            assert!(degree <= (needed + needed / 4 + 1).max(16), "{needed}: {degree}");
        }
    }

    /// Summed on grids and carried to the angles, or summed at the angles: the same.
    #[test]
    fn grids_are_exact() {
        let node = |i: usize| Node {
            radius: 1e-6 + 1e-8 * i as f64,
            wavelength: 5e-7,
            index: Complex64::new(1.334, 1e-4),
            weight: 1.0 / (1 + i) as f64,
        };
        let nodes: Vec<Node> = (0..700).map(node).collect();
        let few: Vec<f64> = (0..=30).map(|i| PI * f64::from(i) / 30.0).collect();
        let many: Vec<f64> = (0..=3000).map(|i| PI * f64::from(i) / 3000.0).collect();
        let [direct, _] = fine_and_coarse(&nodes, 16, &few, &few).unwrap();
        let [carried, _] = fine_and_coarse(&nodes, 16, &many, &few).unwrap();
        for (a, b) in direct.elements.iter().zip(carried.elements.iter().step_by(100)) {
            for e in 0..4 {
                assert!((a[e] - b[e]).abs() < 1e-10 * a[0], "{e}: {} {}", a[e], b[e]);
            }
        }
    }
}
