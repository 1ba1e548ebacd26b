//! Brute force that needs no asymptotics: the Huygens–Fresnel sum over the exit wavefront.
//!
//! Every ray of one order is a secondary source on one of its wavefronts: the points
//! `x_τ = x_ref + τ s` with `W + τ = C`, where `x_ref` lies on the plane through the centre normal
//! to the ray. `C` is chosen so that no focal line of the rays that matter lies on the surface:
//! `S(r̂) = -ix · (x/2πi) · Σ du dv · w · T · √|det Q_τ| · exp(ix [C - r̂·x_τ] - iπ/2 m_τ)`
//! (Kirchhoff's integral, the field on the surface by geometrical optics; Born & Wolf 1999, §8.3).
//! Being normal to its rays the surface mirrors none of them into another's direction, so that the
//! only stationary points are the rays that leave along `r̂`.
//! `det Q_τ` is the cross-section of the ray tube on the surface, `m_τ` the focal lines passed
//! before it, and `w` a smooth window in the angle between ray and direction. The sum is uniform
//! through every caustic of the far field, for any smooth particle, and slow: it is the truth for
//! particles that are no spheres, and reaches what the reference surface's own geometrical optics
//! does (errors of relative order 1/x, more near grazing rays).

use crate::farfield::direction::Direction;
use crate::math::parallel::*;
use crate::math::phase::sin_cos_turns;
use crate::math::vec3::{Field, Vec3};
use crate::optics::AmplitudeMatrix;
use crate::trace::{Exit, Tracer, Wavefront, transfer};
use num_complex::Complex64;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, TAU};

/// How the sum is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HuygensFresnel {
    /// Circumference of the sphere of equal volume over the wavelength.
    pub size_parameter: f64,
    /// Number of chords.
    pub order: u32,
    /// Grid of the emitting plane, see [`Wavefront::midpoints`].
    pub rings: usize,
    /// Rays about the axis.
    pub spokes: usize,
    /// Angle between ray and direction (radians) at which a ray counts half.
    pub window: f64,
}

/// The sum in one direction.
#[derive(Clone, Copy, Debug)]
pub struct Wave {
    /// The amplitude matrix.
    pub amplitude: AmplitudeMatrix,
    /// Path `C` of the reference surface, in radii.
    pub surface: f64,
    /// Smallest distance (radii) of the surface from a focal line of the rays in the window;
    /// below zero: minus the number of rays (of a coarse grid) on the other side of a focal line.
    pub clearance: f64,
    /// Rays summed.
    pub rays: usize,
}

/// Rays per side of the blocks that are skipped as a whole.
const BLOCK: usize = 8;
/// Reference surfaces that are tried, about the middle of the rays in the window, radii.
const SURFACES: std::ops::RangeInclusive<i32> = -30..=30;
const SURFACE_STEP: f64 = 0.05;
/// The window falls like the complementary error function, this many standard deviations wide on
/// either side of the half: what is cut off there is 7e-6 of the amplitude of the rays.
const DEVIATIONS: f64 = 4.35;
/// The window for size parameter 5000. Across one standard deviation the phase of neighbouring
/// rays turns by about 10 radians at a bow; that turn grows with `x` times the window squared.
const WINDOW: f64 = 6.5;
const WIDEST_WINDOW: f64 = 15.0;

impl HuygensFresnel {
    /// A grid fine enough for a size parameter, and a window wide enough.
    ///
    /// Neighbouring rays at the window's edge differ by less than half a period: the phase changes
    /// along the surface by `x |s - r̂|` per radius.
    pub fn new(size_parameter: f64, order: u32) -> Self {
        let rings = (0.3 * size_parameter).clamp(200.0, 3000.0) as usize;
        let degrees = (WINDOW * (5000.0 / size_parameter).sqrt()).min(WIDEST_WINDOW);
        let window = degrees.to_radians();
        Self { size_parameter, order, rings, spokes: 2 * rings, window }
    }

    /// The amplitudes in directions; the tracer says with which coefficients.
    pub fn amplitudes(&self, tracer: &Tracer, directions: &[Direction]) -> Vec<Wave> {
        let places = self.surfaces(tracer, directions);
        let wavefront = Wavefront::midpoints(tracer.shape(), self.rings, self.spokes);
        let sums: Vec<Vec<Sum>> = (0..self.rings.div_ceil(BLOCK))
            .into_par_iter()
            .map(|ring| self.ring_of_blocks(tracer, &wavefront, ring, directions, &places))
            .collect();
        let x = self.size_parameter;
        let factor = Complex64::new(0.0, -x) * Complex64::new(0.0, -x / TAU);
        let finish = |(d, direction): (usize, &Direction)| {
            let mut sum = Sum::default();
            sums.iter().for_each(|ring| sum.add(&ring[d]));
            let field = sum.field.map(|e| scaled(e, factor));
            let Direction { theta_hat, phi_hat, cos_phi, sin_phi, .. } = *direction;
            let amplitude = transfer(&field, theta_hat, phi_hat, cos_phi, sin_phi);
            let (surface, clearance) = places[d];
            Wave { amplitude, surface, clearance, rays: sum.rays }
        };
        directions.iter().enumerate().map(finish).collect()
    }

    /// For every direction the place of the reference surface that stays farthest from the focal
    /// lines of all rays in its window, and how far.
    fn surfaces(&self, tracer: &Tracer, directions: &[Direction]) -> Vec<(f64, f64)> {
        let coarse = Wavefront::midpoints(tracer.shape(), self.rings.div_ceil(BLOCK), 180);
        let rays: Vec<Source> = (0..coarse.rings.len())
            .into_par_iter()
            .flat_map_iter(|i| (0..coarse.spokes.len()).map(move |j| (i, j)))
            .filter_map(|(i, j)| self.source(tracer, &coarse, i, j))
            .collect();
        let best = |direction: &Direction| {
            let near: Vec<&Source> =
                rays.iter().filter(|r| self.weight(r, direction.unit) > 0.0).collect();
            // A surface that focal lines cross is no choice while there is another.
            let clearance = |place: f64| {
                let turned =
                    near.iter().filter(|ray| ray.cross_section(place - ray.path) < 0.0).count();
                let mixed = turned.min(near.len() - turned);
                if mixed > 0 {
                    return -(mixed as f64);
                }
                near.iter().map(|ray| ray.clearance(place - ray.path)).fold(f64::INFINITY, f64::min)
            };
            let middle = near.iter().map(|r| r.path).sum::<f64>() / near.len().max(1) as f64;
            let mut found = (middle, f64::NEG_INFINITY);
            for step in SURFACES {
                let place = middle + f64::from(step) * SURFACE_STEP;
                let clear = clearance(place);
                if clear > found.1 {
                    found = (place, clear);
                }
            }
            found
        };
        directions.par_iter().map(best).collect()
    }

    /// Sums of one ring of blocks over all directions.
    fn ring_of_blocks(
        &self,
        tracer: &Tracer,
        wavefront: &Wavefront,
        ring: usize,
        directions: &[Direction],
        places: &[(f64, f64)],
    ) -> Vec<Sum> {
        let mut sums = vec![Sum::default(); directions.len()];
        let mut rays = Vec::with_capacity(BLOCK * BLOCK);
        let mut wanted = Vec::new();
        let rings = ring * BLOCK..((ring + 1) * BLOCK).min(self.rings);
        for first in (0..self.spokes).step_by(BLOCK) {
            let spokes = first..(first + BLOCK).min(self.spokes);
            let middle = ((rings.start + rings.end) / 2, (spokes.start + spokes.end) / 2);
            let probe = self.source(tracer, wavefront, middle.0, middle.1 % self.spokes);
            let reach = 2.0 * self.window + self.block_turn();
            wanted.clear();
            wanted.extend((0..directions.len()).filter(|&d| {
                probe.as_ref().is_none_or(|p| angle(p.direction, directions[d].unit) < reach)
            }));
            if wanted.is_empty() {
                continue;
            }
            rays.clear();
            for i in rings.clone() {
                rays.extend(spokes.clone().filter_map(|j| self.source(tracer, wavefront, i, j)));
            }
            for &d in &wanted {
                for ray in &rays {
                    self.add(&mut sums[d], ray, directions[d].unit, places[d].0);
                }
            }
        }
        sums
    }

    /// By how much the exit direction may turn from the middle of a block to its corner: a chord
    /// turns a ray by at most twice the turn of the angle of incidence.
    fn block_turn(&self) -> f64 {
        let step = (FRAC_PI_2 / self.rings as f64).hypot(TAU / self.spokes as f64);
        f64::from(2 * self.order + 2) * step * BLOCK as f64
    }

    /// The secondary source of one ray of the grid.
    fn source(&self, tracer: &Tracer, grid: &Wavefront, i: usize, j: usize) -> Option<Source> {
        let (u, v) = grid.place(i, j);
        let exit = tracer.trace_order(u, v, self.order)?;
        Some(Source::new(&exit, grid.share(i, j)))
    }

    fn add(&self, sum: &mut Sum, ray: &Source, direction: Vec3<f64>, surface: f64) {
        let weight = self.weight(ray, direction);
        if weight == 0.0 {
            return;
        }
        let place = surface - ray.path;
        let size = weight * ray.share * ray.cross_section(place).abs().sqrt();
        let ahead = u32::from(ray.focal[0] > place) + u32::from(ray.focal[1] > place);
        let lines = f64::from(ray.focal_lines) - f64::from(ahead);
        let path = surface - direction.dot(ray.reference + ray.direction * place);
        let (sin, cos) = sin_cos_turns(self.size_parameter * path / TAU - 0.25 * lines);
        let wave = Complex64::new(cos, sin) * size;
        for (to, from) in sum.field.iter_mut().zip(ray.field) {
            *to = *to + scaled(from, wave);
        }
        sum.rays += 1;
    }

    /// The window: 1 near the direction, 0 at twice its width.
    fn weight(&self, ray: &Source, direction: Vec3<f64>) -> f64 {
        let away = angle(ray.direction, direction) / self.window - 1.0;
        if away >= 1.0 {
            return 0.0;
        }
        0.5 * libm::erfc(away * DEVIATIONS * FRAC_1_SQRT_2)
    }
}

/// Angle between nearby unit vectors, by their chord.
fn angle(a: Vec3<f64>, b: Vec3<f64>) -> f64 {
    let chord = a - b;
    2.0 * (0.5 * chord.dot(chord).sqrt()).min(1.0).asin()
}

fn scaled(e: Field, factor: Complex64) -> Field {
    Vec3 { x: e.x * factor, y: e.y * factor, z: e.z * factor }
}

/// One ray as a secondary source.
struct Source {
    direction: Vec3<f64>,
    reference: Vec3<f64>,
    path: f64,
    field: [Field; 2],
    /// Coefficients of `det Q_τ` in powers of τ.
    section: [f64; 3],
    /// Places of the focal lines.
    focal: [f64; 2],
    /// Focal lines passed on the way to infinity.
    focal_lines: u32,
    share: f64,
}

impl Source {
    fn new(exit: &Exit<f64>, share: f64) -> Self {
        let Exit { dx, ds, direction, .. } = exit;
        let section = [
            direction.dot(dx[0].cross(dx[1])),
            direction.dot(dx[0].cross(ds[1])) + direction.dot(ds[0].cross(dx[1])),
            exit.spread(),
        ];
        Self {
            direction: exit.direction,
            reference: exit.reference,
            path: exit.path,
            field: exit.field,
            section,
            focal: focal_places(section),
            focal_lines: exit.focal_lines,
            share,
        }
    }

    /// `det Q_τ`.
    fn cross_section(&self, place: f64) -> f64 {
        let [c0, c1, c2] = self.section;
        c0 + place * (c1 + place * c2)
    }

    /// Distance from the nearest focal line.
    fn clearance(&self, place: f64) -> f64 {
        self.focal.iter().map(|focal| (place - focal).abs()).fold(f64::INFINITY, f64::min)
    }
}

/// Roots of the cross-section; infinite where a caustic lies at infinity.
fn focal_places([c0, c1, c2]: [f64; 3]) -> [f64; 2] {
    let discriminant = (c1 * c1 - 4.0 * c0 * c2).max(0.0);
    let q = -0.5 * (c1 + discriminant.sqrt().copysign(c1));
    [q / c2, c0 / q]
}

/// A partial sum of fields, for light polarised along x and along y.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    field: [Field; 2],
    rays: usize,
}

impl Sum {
    fn add(&mut self, other: &Sum) {
        for (to, from) in self.field.iter_mut().zip(other.field) {
            *to = *to + from;
        }
        self.rays += other.rays;
    }
}

#[cfg(test)]
mod tests;
