//! A table by rays of geometrical optics: powers by direction, for haloes of crystals so large that diffraction and
//! interference are lost in the sun's disc.
//!
//! All that leaves a body goes one way with all its power. A table's value is the power that falls into
//! the cell of a sample, over the cell's solid angle: cells without light are 0, and what goes straight on
//! through parallel facets is all in the cell straight ahead.

use super::mean::Sums;
use super::orientation::{offset, point};
use super::path::{Facets, Light, Limits, Sent};
use super::table::{Band, Errors, TableJob, budget};
use crate::cancel;
use crate::math::parallel::*;
use crate::math::vec3::Vec3;
use crate::optics::{AmplitudeMatrix, mirror_sign};
use crate::phase_table::{Axes, MethodPart, Slab};
use glam::{DMat3, DVec3};
use ndarray::Array3;
use std::f64::consts::TAU;

/// Rays on each orientation in a mean, and on one that stands still.
const RAYS: u32 = 16;
const RAYS_OF_ONE: u32 = 1 << 18;
/// Chords beyond which a ray inside is given up: light that is trapped between parallel facets.
const MOST_CHORDS: u32 = 100;

/// Most pieces of a replica that run side by side, and the numbers that all of them may hold.
const PIECES: usize = 16;
const HELD: usize = 64 << 20;

/// Where a direction falls in a table: edges half-way between samples, as
/// [`Axes::solid_angle`] has them.
struct Cells<'a> {
    axes: &'a Axes,
    theta: Vec<f64>,
    phi: Vec<f64>,
}

impl<'a> Cells<'a> {
    fn new(axes: &'a Axes) -> Self {
        let between = |samples: &[f64]| samples.windows(2).map(|w| 0.5 * (w[0] + w[1])).collect();
        Self { axes, theta: between(&axes.theta), phi: between(&axes.phi) }
    }

    /// Numbers of the cell in polar angle and azimuth, where there is one.
    fn of(&self, theta: f64, phi: f64) -> Option<(usize, usize)> {
        let (angles, azimuths) = (&self.axes.theta, &self.axes.phi);
        let inside = |samples: &[f64], x: f64| {
            const ROUNDING: f64 = 1e-12;
            samples[0] - ROUNDING <= x && x <= samples[samples.len() - 1] + ROUNDING
        };
        if !inside(angles, theta) {
            return None;
        }
        let i = self.theta.partition_point(|&edge| edge < theta);
        if azimuths.len() < 2 {
            return Some((i, 0));
        }
        let first = azimuths[0];
        let turned = first + (phi - first).rem_euclid(TAU);
        if inside(azimuths, turned) {
            return Some((i, self.phi.partition_point(|&edge| edge < turned)));
        }
        // on the seam of an axis that wraps, nearer to its end or to its beginning
        let last = azimuths[azimuths.len() - 1];
        let step = last - azimuths[azimuths.len() - 2];
        let wraps = (last + step - first - TAU).abs() < 1e-9 * TAU;
        let j = if turned - last < first + TAU - turned { azimuths.len() - 1 } else { 0 };
        wraps.then_some((i, j))
    }
}

/// What all orientations of a replica share.
struct Place<'a> {
    facets: &'a Facets,
    cells: &'a Cells<'a>,
    columns: usize,
    replica: u32,
}

/// One replica, or a piece of it: powers by column and cell, and the rest as of all means.
#[derive(Default)]
struct Powers {
    /// Mueller elements times the area that they are of: by θ, then column, then element.
    cells: Vec<f64>,
    sums: Sums,
}

impl Powers {
    fn add(&mut self, other: &Powers) {
        self.cells.resize(self.cells.len().max(other.cells.len()), 0.0);
        self.cells.iter_mut().zip(&other.cells).for_each(|(to, from)| *to += from);
        self.sums.add(&other.sums, 1.0);
    }
}

impl TableJob<'_> {
    /// The slab of rays alone; over the whole sphere its values add up to 1.
    pub fn ray_slab(&self) -> Slab {
        let elements = self.quantity.elements();
        let columns = self.places.iter().map(|place| place.0 + 1).max().unwrap_or(1);
        let replicas = self.request.replicas;
        let (mut all, mut squares) = (Powers::default(), Vec::new());
        for replica in 0..replicas {
            let one = self.replica(replica, columns, elements);
            squares.resize(one.cells.len() / elements, 0.0);
            squares
                .iter_mut()
                .zip(one.cells.chunks(elements))
                .for_each(|(to, c)| *to += c[0] * c[0]);
            all.add(&one);
        }
        let share = 1.0 / f64::from(replicas);
        let mut sums = Sums::default();
        sums.add(&all.sums, share);
        let weights = self.weights(columns);
        let value = |e: usize, i: usize, column: usize| {
            all.cells[(i * columns + column) * elements + e] * share
                / (weights[i * columns + column] * sums.scattering)
        };
        let values = Array3::from_shape_fn(
            (elements, self.axes.theta.len(), self.axes.phi.len()),
            |(e, i, j)| {
                let (column, mirror) = self.places[j];
                let sign = if mirror { mirror_sign(e) } else { 1.0 };
                (sign * value(e, i, column)) as f32
            },
        );
        let errors = self.scatter_of_replicas(&all.cells, &squares, &weights, elements, replicas);
        let (error, error_by_band) = errors.means();
        let area = self.radius * self.radius;
        let left_out: f64 = sums.trapped.iter().sum::<f64>() / sums.shadow;
        let sum_before_peak = (0..self.axes.theta.len() * columns)
            .map(|c| value(0, c / columns, c % columns) * weights[c])
            .sum();
        let error_estimate = error.max(left_out);
        Slab {
            wavelength: self.wavelength,
            index: self.request.light.index,
            outside_index: 1.0,
            values,
            caustic_order: None,
            scattering_cross_section: (sums.shadow - sums.absorption) * area,
            extinction_cross_section: sums.shadow * area,
            absorption_cross_section: sums.absorption * area,
            forward_extinction: None,
            asymmetry: (sums.forward / sums.scattering).clamp(-1.0, 1.0),
            energy: Some(budget(&sums)),
            sum_before_peak,
            peak_share: 0.0,
            error_estimate,
            error_by_band: error_by_band.max(left_out),
            tolerance_met: Some(error_estimate <= self.tolerance),
            error_by_direction: errors.by_direction(),
            left_out,
            methods: vec![self.ray_part(errors.sampling())],
        }
    }

    /// Solid angle of the cells of each column: those of all azimuths that it serves.
    fn weights(&self, columns: usize) -> Vec<f64> {
        let (theta, phi) = self.axes.solid_angle_factors();
        let mut widths = vec![0.0; columns];
        for (&(column, _), width) in self.places.iter().zip(&phi) {
            widths[column] += width;
        }
        theta.iter().flat_map(|height| widths.iter().map(move |width| height * width)).collect()
    }

    fn replica(&self, replica: u32, columns: usize, elements: usize) -> Powers {
        let request = &self.request;
        let count = if request.stand.is_fixed() { 1 } else { request.count };
        let size = self.axes.theta.len() * columns * elements;
        let pieces = (HELD / size.max(1)).clamp(1, PIECES) as u32;
        let length = count.div_ceil(pieces).max(1);
        let starts: Vec<u32> = (0..count).step_by(length as usize).collect();
        let (cells, facets) = (Cells::new(self.axes), Facets::of(request.body));
        let at = Place { facets: &facets, cells: &cells, columns, replica };
        let parts: Vec<Powers> = starts
            .into_par_iter()
            .map(|start| {
                let mut powers = Powers { cells: vec![0.0; size], sums: Sums::default() };
                let mut lit = Vec::new();
                for index in start..(start + length).min(count) {
                    cancel::checkpoint();
                    self.add_orientation(&at, index, &mut lit, &mut powers);
                }
                powers
            })
            .collect();
        let mut all = Powers::default();
        parts.iter().for_each(|part| all.add(part));
        let share = 1.0 / f64::from(count);
        all.cells.iter_mut().for_each(|cell| *cell *= share);
        let mut sums = Sums::default();
        sums.add(&all.sums, share);
        Powers { cells: all.cells, sums }
    }

    /// Some rays on one orientation.
    fn add_orientation(
        &self,
        at: &Place<'_>,
        index: u32,
        lit: &mut Vec<(usize, f64)>,
        into: &mut Powers,
    ) {
        let request = &self.request;
        let elements = self.quantity.elements();
        let turn = request.stand.rotation(point(index, at.replica), request.sun_elevation);
        // rays are traced in the frame of the body
        let back = turn.transpose();
        let light = Light {
            direction: back * DVec3::Z,
            polarisations: [back * DVec3::X, back * DVec3::Y],
            index: request.light.index,
            wavenumber: request.light.size_parameter,
        };
        let limits = Limits { last_order: MOST_CHORDS, least_power: request.settings.least_power };
        let shadow = at.facets.lit(light.direction, lit);
        let rays = if request.stand.is_fixed() { RAYS_OF_ONE } else { RAYS };
        let mut sums = Sums { shadow, extinction: shadow, ..Sums::default() };
        let mut sent_order = Vec::new();
        for ray in 0..rays {
            let number = index.wrapping_mul(rays).wrapping_add(ray);
            // evenly over the shadow, and over the facets
            let share = (f64::from(ray) + offset(index, at.replica + 11)) / f64::from(rays);
            let place = lit.partition_point(|facet| facet.1 < share * shadow).min(lit.len() - 1);
            let facet = lit[place].0;
            let [u, v] = plane(number, at.replica);
            let area = shadow / f64::from(rays);
            let start = (facet, at.facets.point(facet, u, v));
            let rest = at.facets.follow(&light, start, &limits, |sent| {
                let power = sent.power * area;
                let way = turn * sent.direction;
                sums.scattering += power;
                sums.forward += power * way.z;
                sums.polygons += 1.0;
                let order = sent.order as usize;
                if sent_order.len() <= order {
                    sent_order.resize(order + 1, 0.0);
                }
                sent_order[order] += power;
                let theta = way.x.hypot(way.y).atan2(way.z);
                let phi = way.y.atan2(way.x);
                let Some((i, j)) = at.cells.of(theta, phi) else { return };
                let (column, mirror) = self.places[j];
                let start = (i * at.columns + column) * elements;
                let cell = &mut into.cells[start..start + elements];
                if elements == 1 {
                    cell[0] += power;
                    return;
                }
                let mueller = matrix(&sent, &turn, way, phi).mueller();
                for (e, m) in mueller.as_flattened().iter().enumerate() {
                    cell[e] += area * m * if mirror { mirror_sign(e) } else { 1.0 };
                }
            });
            sums.absorption += rest.absorbed * area;
            sums.trapped[0] += rest.trapped * area;
            sums.trapped[1] += rest.truncated * area;
        }
        sums.left_by_order = sent_order;
        into.sums.add(&sums, 1.0);
    }

    /// The scatter of the replicas by band of scattering angle, cell by cell.
    fn scatter_of_replicas(
        &self,
        total: &[f64],
        squares: &[f64],
        weights: &[f64],
        elements: usize,
        replicas: u32,
    ) -> Errors {
        let n = f64::from(replicas);
        let columns = weights.len() / self.axes.theta.len();
        let mut bands = Band::none();
        for (c, (cell, square)) in total.chunks(elements).zip(squares).enumerate() {
            let mean = cell[0] / n;
            let spread = (square - n * mean * mean).max(0.0);
            let variance = if n > 1.0 { spread / (n * (n - 1.0)) } else { 0.0 };
            // intensities, each for the solid angle that it stands for
            let weight = weights[c].max(f64::MIN_POSITIVE);
            Band::at(&mut bands, self.axes.theta[c / columns]).add(
                mean * mean / weight,
                variance / weight,
                weight,
            );
        }
        Errors::new(bands, self.method_error)
    }

    fn ray_part(&self, sampling: f64) -> MethodPart {
        let request = &self.request;
        let (count, rays) = match request.stand.is_fixed() {
            true => (request.replicas, RAYS_OF_ONE),
            false => (request.count * request.replicas, RAYS),
        };
        MethodPart {
            order: None,
            method: "rays through flat facets, without diffraction".into(),
            reason: format!(
                "a convex body of {} facets, powers by direction; {count} orientations with {rays} rays each, whose \
                 scatter is {:.2} % of the intensity in a cell",
                request.body.facets().len(),
                100.0 * sampling
            ),
            expected_error: Some(self.method_error),
            ..MethodPart::default()
        }
    }
}

/// The amplitudes of what leaves, scaled to power, in the scattering plane of its direction (see
/// [`crate::optics`]).
fn matrix(sent: &Sent, turn: &DMat3, way: DVec3, phi: f64) -> AmplitudeMatrix {
    let (sin, cos) = phi.sin_cos();
    let perpendicular = DVec3::new(sin, -cos, 0.0);
    let axes = [way.cross(perpendicular), perpendicular].map(|axis| turn.transpose() * axis);
    let [x, y] = sent.fields.map(|field| axes.map(|axis| Vec3::<f64>::from(axis).project(field)));
    AmplitudeMatrix {
        s2: x[0] * cos + y[0] * sin,
        s3: x[0] * sin - y[0] * cos,
        s4: x[1] * cos + y[1] * sin,
        s1: x[1] * sin - y[1] * cos,
    }
}

/// Two numbers from 0 to 1 that are spread evenly over a plane from ray to ray: multiples of the powers of the
/// plastic number's inverse, shifted by the replica.
fn plane(number: u32, replica: u32) -> [f64; 2] {
    const PLASTIC: [f64; 2] = [0.754_877_666_246_693, 0.569_840_290_998_053_3];
    let shift = point(replica, replica + 17);
    std::array::from_fn(|d| (shift[d] + f64::from(number) * PLASTIC[d]).fract())
}

#[cfg(test)]
mod tests;
