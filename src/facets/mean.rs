//! Means over orientations: Mueller matrices, cross-sections, and how far they may be off by the number of
//! orientations.

use super::Body;
use super::beams::{Incidence, Settings, split};
use super::far_field::FarField;
use super::lobes::Lobes;
use super::orientation::{Stand, offset, point};
use crate::cancel;
use crate::math::parallel::*;
use crate::optics::AmplitudeMatrix;
use std::f64::consts::TAU;

/// Where a mean is taken.
#[derive(Clone, Copy, Debug)]
pub enum Azimuths<'a> {
    /// At these (radians), in the frame of the sun.
    At(&'a [f64]),
    /// Over all of them, by so many in each orientation: for what does not depend on azimuth.
    Mean(usize),
}

/// What is asked of a mean.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    /// The crystal in its own frame.
    pub body: &'a Body,
    /// How it stands.
    pub stand: Stand,
    /// Radians.
    pub sun_elevation: f64,
    /// Index and size.
    pub light: Incidence,
    /// How far beams are followed.
    pub settings: Settings,
    /// Scattering angles, radians.
    pub theta: &'a [f64],
    /// Widths of cells (radians) over which a value is a mean, by place; empty: none is.
    pub cells: &'a [(f64, f64)],
    /// Azimuths.
    pub azimuths: Azimuths<'a>,
    /// All 16 elements, or the first alone.
    pub whole: bool,
    /// Orientations of each replica.
    pub count: u32,
    /// Replicas.
    pub replicas: u32,
}

/// Sums over orientations, divided by their number.
#[derive(Clone, Debug, Default)]
pub struct Sums {
    /// Mueller elements (S11 is `k² dC/dΩ`): by θ, then azimuth, then element.
    pub mueller: Vec<f64>,
    /// By the optical theorem, in squared radii of the sphere of equal volume.
    pub extinction: f64,
    /// Area of the shadow.
    pub shadow: f64,
    /// Absorption cross-section.
    pub absorption: f64,
    /// Scattering cross-section by the power over the sphere, and the same times the cosine.
    pub scattering: f64,
    /// Scattering cross-section times mean cosine.
    pub forward: f64,
    /// Shares of the light on the shadow by order.
    pub left_by_order: Vec<f64>,
    /// Of it: totally reflected to the end, and otherwise not followed.
    pub trapped: [f64; 2],
    /// Polygons on the surface.
    pub polygons: f64,
}

/// Directions over the sphere by which power is added up in each orientation.
const DIRECTIONS: usize = 96;
/// The same for one orientation alone.
const DIRECTIONS_FIXED: usize = 40_000;

impl Sums {
    /// Add a share of another.
    pub(super) fn add(&mut self, other: &Self, share: f64) {
        let add = |to: &mut Vec<f64>, from: &[f64]| {
            to.resize(to.len().max(from.len()), 0.0);
            to.iter_mut().zip(from).for_each(|(to, from)| *to += share * from);
        };
        add(&mut self.mueller, &other.mueller);
        add(&mut self.left_by_order, &other.left_by_order);
        self.extinction += share * other.extinction;
        self.shadow += share * other.shadow;
        self.absorption += share * other.absorption;
        self.scattering += share * other.scattering;
        self.forward += share * other.forward;
        self.polygons += share * other.polygons;
        for (to, from) in self.trapped.iter_mut().zip(other.trapped) {
            *to += share * from;
        }
    }

    /// The mean of several.
    pub fn mean(parts: &[Sums]) -> Self {
        let mut sums = Sums::default();
        parts.iter().for_each(|part| sums.add(part, 1.0 / parts.len() as f64));
        sums
    }
}

/// Mean area of the shadow, in squared radii of the sphere of equal volume.
pub fn mean_shadow(body: &Body, stand: Stand, sun_elevation: f64, count: u32) -> f64 {
    let area = |turn: glam::DMat3| body.shadow(turn.transpose() * glam::DVec3::Z);
    match stand {
        // Cauchy
        Stand::Random => body.surface() / 4.0,
        _ => {
            let at = |index| area(stand.rotation(point(index, 0), sun_elevation));
            (0..count).map(at).sum::<f64>() / f64::from(count)
        }
    }
}

impl Request<'_> {
    fn elements(&self) -> usize {
        if self.whole { 16 } else { 1 }
    }

    /// The sums of each replica; their mean is the result, their scatter its error.
    pub fn replicas(&self) -> Vec<Sums> {
        if self.stand.is_fixed() {
            return vec![self.one(0, 0)];
        }
        (0..self.replicas).map(|replica| self.replica(replica)).collect()
    }

    /// One replica, in pieces that do not depend on the number of threads.
    fn replica(&self, replica: u32) -> Sums {
        let piece = self.count.div_ceil(16).max(1);
        let starts: Vec<u32> = (0..self.count).step_by(piece as usize).collect();
        let parts: Vec<Sums> = starts
            .into_par_iter()
            .map(|start| {
                let mut sums = Sums::default();
                for index in start..(start + piece).min(self.count) {
                    cancel::checkpoint();
                    sums.add(&self.one(index, replica), 1.0 / f64::from(self.count));
                }
                sums
            })
            .collect();
        let mut sums = Sums::default();
        parts.iter().for_each(|part| sums.add(part, 1.0));
        sums
    }

    /// One orientation.
    fn one(&self, index: u32, replica: u32) -> Sums {
        let turn = self.stand.rotation(point(index, replica), self.sun_elevation);
        let body = self.body.turned(&turn);
        let beams = split(&body, &self.light, &self.settings);
        let far = FarField::new(&beams, &self.light);
        let lobes = Lobes::new(&beams, self.light.size_parameter);
        let k2 = self.light.size_parameter.powi(2);
        let start = [0, 1, 2].map(|d| offset(index.wrapping_mul(3).wrapping_add(d), replica + 7));

        let ahead = far.amplitudes(&[(0.0, 0.0)])[0];
        let count = if self.stand.is_fixed() { DIRECTIONS_FIXED } else { DIRECTIONS };
        let drawn = lobes.directions(count, start);
        let power = |drawn: &[(f64, f64, f64)]| -> [f64; 2] {
            let ways: Vec<(f64, f64)> = drawn.iter().map(|d| (d.0, d.1)).collect();
            let mut sums = [0.0; 2];
            for (s, (theta, _, solid)) in far.amplitudes(&ways).iter().zip(drawn) {
                let part = s.s11() * solid / k2;
                sums[0] += part;
                sums[1] += part * theta.cos();
            }
            sums
        };
        let [scattering, forward] = drawn
            .par_chunks(4096)
            .map(power)
            .collect::<Vec<_>>()
            .into_iter()
            .fold([0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
        Sums {
            mueller: self.rows(&far, &lobes, start[0]),
            extinction: TAU / k2 * (ahead.s1 + ahead.s2).re,
            shadow: beams.shadow,
            absorption: beams.budget.absorbed * beams.shadow,
            scattering,
            forward,
            left_by_order: beams.budget.left_by_order.iter().map(|p| p * beams.shadow).collect(),
            trapped: [beams.budget.totally_reflected, beams.budget.truncated]
                .map(|p| p * beams.shadow),
            polygons: far.polygons() as f64,
        }
    }

    /// Mueller elements of one orientation.
    fn rows(&self, far: &FarField, lobes: &Lobes, start: f64) -> Vec<f64> {
        let elements = self.elements();
        let shift = |i: usize| (start + i as f64 * crate::math::GOLDEN).fract();
        let row = |i: usize| -> Vec<f64> {
            let theta = self.theta[i];
            let cell = self.cells.get(i).copied();
            match self.azimuths {
                Azimuths::Mean(count) => {
                    let at = cell.map_or(theta, |cell| within(cell, shift(7 * i + 3)));
                    let drawn = lobes.azimuths(at, count, shift(i));
                    let ways: Vec<(f64, f64)> = drawn.iter().map(|d| (at, d.0)).collect();
                    let weights: Vec<f64> = drawn.iter().map(|d| d.1).collect();
                    weighted(&far.amplitudes(&ways), &weights, elements)
                }
                Azimuths::At(azimuths) => {
                    let points = match cell {
                        None => 1,
                        Some(_) if !self.stand.is_fixed() => 1,
                        Some((low, high)) => in_cell((high - low) * self.light.size_parameter),
                    };
                    let share = 1.0 / points as f64;
                    let at = |p: usize| {
                        let u = (p as f64 + if points > 1 { 0.5 } else { shift(i) }) * share;
                        cell.map_or(theta, |cell| within(cell, u))
                    };
                    let of = |&phi: &f64| (0..points).map(move |p| (at(p), phi));
                    let ways: Vec<(f64, f64)> = azimuths.iter().flat_map(of).collect();
                    let seen = far.amplitudes(&ways);
                    let shares = vec![share; points];
                    let line = seen.chunks(points).flat_map(|s| weighted(s, &shares, elements));
                    line.collect()
                }
            }
        };
        if self.stand.is_fixed() {
            let rows: Vec<Vec<f64>> = (0..self.theta.len()).into_par_iter().map(row).collect();
            return rows.concat();
        }
        (0..self.theta.len()).flat_map(row).collect()
    }
}

/// Angles within a cell of so many radians of phase.
fn in_cell(phase: f64) -> usize {
    (phase * 1.5).ceil().clamp(8.0, 4096.0) as usize
}

/// The angle in a cell that a share of its solid angle lies below.
fn within((low, high): (f64, f64), share: f64) -> f64 {
    let depth = |theta: f64| 2.0 * (0.5 * theta).sin().powi(2);
    let at = depth(low) + share * (depth(high) - depth(low));
    2.0 * (0.5 * at).sqrt().min(1.0).asin()
}

/// Weighted sum of Mueller matrices.
fn weighted(amplitudes: &[AmplitudeMatrix], weights: &[f64], elements: usize) -> Vec<f64> {
    let mut sum = vec![0.0; elements];
    for (s, weight) in amplitudes.iter().zip(weights) {
        if elements == 1 {
            sum[0] += weight * s.s11();
        } else {
            let mueller = s.mueller();
            sum.iter_mut()
                .zip(mueller.iter().flatten())
                .for_each(|(to, from)| *to += weight * from);
        }
    }
    sum
}
