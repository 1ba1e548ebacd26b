//! The sum on a complex wavefront: one integral for a whole order, whatever its rays do.
//!
//! Where more than two rays coalesce no formula for single rays or pairs holds, but the wave is still
//! Kirchhoff's integral over one of the order's wavefronts (Born & Wolf 1999, §8.3). Every real wavefront
//! meets focal lines somewhere. One continued to a *complex* distance `τ = τ_r + iβ` along its rays meets
//! none, since rays have real focal lines only:
//! `S(n) = -ix (x/2πi) ∬ du dv T F exp ix[W - n·r + τ(1 - n·s)]`,
//! `F = e^{-iπm/2} √c₂ √(τ - t₁) √(τ - t₂)`, principal roots, with `s` the direction of a ray, `r` where it
//! crosses the plane through the centre normal to it, `W` its path, `t₁`, `t₂` the places of its focal
//! lines, `c₂ = |s·(∂ᵤs × ∂ᵥs)|` and `m` all focal lines to infinity (Deschamps 1971, complex source
//! points; Heller 1991, frozen Gaussians). The points of stationary phase are the rays along `n`, with
//! amplitude and phase of geometrical optics, and the factor `exp -xβ(1 - n·s)` comes by itself: only rays
//! within a few `1/√(xβ)` of a direction count, some hundred whatever `x`.
//!
//! All that the integrand needs is smooth in the launch point and interpolated from a coarse grid of traced
//! rays ([`coarse`]); where it is not, beside total reflection, rays are traced one by one. The points
//! of the sum form a [`lattice`] whose steps follow from the width of the integrand; [`kernel`] adds one
//! ray's wave to a column of scattering angles.
//!
//! What is not in it: waves beside the last ray of an order, at the rim or at total reflection, where the
//! integrand goes on beyond real rays. There it errs by some percent (sphere, order 2 beyond 150°), for bows
//! made next to the rim (orders from 4 on) by more.
//!
//! ```
//! use gonio::farfield::complex_wavefront::ComplexWavefront;
//! use gonio::shape::{RaindropModel, Shape};
//! use gonio::trace::Tracer;
//!
//! let (radius, sun, x) = (2e-3, 0.35, 19_333.0);
//! let drop = Shape::raindrop(radius, RaindropModel::BeardChuang1987, sun)?;
//! let tracer = Tracer::new(&drop, 1.3314.into(), x, 2).with_curved_interface(x);
//! let primary = ComplexWavefront::new(&tracer, &[(2, 1.0)], x);
//! let column = primary.columns(&[2.40, 2.41], &[1.0]).swap_remove(0);
//! assert!(column.iter().all(|s| s.s11() > 0.0));
//! # Ok::<(), gonio::shape::ShapeError>(())
//! ```

mod coarse;
mod kernel;
mod lattice;

use crate::math::vec3::Vec3;
use crate::optics::AmplitudeMatrix;
use crate::trace::{Exit, Tracer};
use coarse::{Channels, CoarseGrid, Kind, SPOKES, blend};
use kernel::{Column, Ray};
use lattice::Lattice;
use num_complex::Complex64;
use std::f64::consts::FRAC_PI_2;

/// The complex place of the wavefront along its rays, in radii from the plane through the centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Real part, between the focal lines of most rays that have been reflected inside.
    pub real: f64,
    /// Imaginary part, which makes the width of the window `1/√(xβ)`.
    pub imaginary: f64,
}

/// Where the wavefront stands. Error and cost change little about it (`τ_r` -0.3 to 0.1, `β` 0.3 to 1).
pub const PLACE: Place = Place { real: -0.3, imaginary: 0.7 };

/// Rays count as long as the window is above `exp -CUT_OFF`.
const CUT_OFF: f64 = 9.0;

/// All orders that are sums on a complex wavefront.
pub struct ComplexWavefront<'a> {
    tracer: Tracer<'a>,
    size_parameter: f64,
    place: Place,
    sheets: Vec<Sheet>,
}

/// One order, of which a share of the amplitude is summed.
struct Sheet {
    order: u32,
    share: f64,
    grid: CoarseGrid,
    lattice: Lattice,
}

impl<'a> ComplexWavefront<'a> {
    /// Trace the coarse rays of some orders, for a share of the amplitude of each.
    pub fn new(tracer: &Tracer<'a>, shares: &[(u32, f64)], size_parameter: f64) -> Self {
        Self::at(tracer, shares, size_parameter, PLACE)
    }

    /// The same with the wavefront at another place: what changes is error.
    pub fn at(
        tracer: &Tracer<'a>,
        shares: &[(u32, f64)],
        size_parameter: f64,
        place: Place,
    ) -> Self {
        let orders: Vec<u32> = shares.iter().map(|share| share.0).collect();
        let grids = CoarseGrid::of_orders(tracer, &orders, size_parameter, place);
        let sheets = shares
            .iter()
            .zip(grids)
            .map(|(&(order, share), grid)| {
                let lattice = Lattice::new(&grid.steps);
                Sheet { order, share, grid, lattice }
            })
            .collect();
        Self { tracer: tracer.clone(), size_parameter, place, sheets }
    }

    /// Amplitudes of all orders in directions of some azimuths, scattering angles ascending.
    pub fn columns(&self, theta: &[f64], azimuths: &[f64]) -> Vec<Vec<AmplitudeMatrix>> {
        let mut columns: Vec<Column> =
            azimuths.iter().map(|&phi| Column::new(theta, phi, self.size_parameter)).collect();
        for sheet in &self.sheets {
            self.add_sheet(sheet, theta, &mut columns);
        }
        columns.iter_mut().map(Column::finish).collect()
    }

    /// Add the waves in some directions of one azimuth, scattering angles ascending.
    pub fn add(&self, theta: &[f64], phi: f64, sums: &mut [AmplitudeMatrix]) {
        let found = self.columns(theta, &[phi]).swap_remove(0);
        sums.iter_mut().zip(found).for_each(|(sum, wave)| *sum += wave);
    }

    fn add_sheet(&self, sheet: &Sheet, theta: &[f64], columns: &mut [Column]) {
        let x = self.size_parameter;
        let (Some(&first), Some(&last)) = (theta.first(), theta.last()) else { return };
        let window = (2.0 * CUT_OFF / (x * self.place.imaginary)).sqrt().min(2.0);
        let mut near: Vec<usize> = Vec::with_capacity(columns.len());
        for ring in &sheet.lattice.rings {
            let rows = sheet.grid.rows(ring.alpha);
            for spoke in 0..SPOKES {
                let cell = sheet.grid.cell(rows.cell, spoke);
                if cell.kind == Kind::Empty {
                    continue;
                }
                near.clear();
                let reach = cell.radius + window;
                near.extend(
                    (0..columns.len())
                        .filter(|&c| columns[c].is_near(cell.centre, reach, [first, last])),
                );
                if near.is_empty() {
                    continue;
                }
                let points = ring.points_between(spoke);
                if points.is_empty() {
                    continue;
                }
                let values = (cell.kind == Kind::Smooth).then(|| sheet.grid.row(&rows, spoke));
                for point in points {
                    let psi = ring.azimuth(point);
                    let found = match &values {
                        Some(values) => Some(blend(values, psi, spoke)),
                        None => self.traced(sheet, ring.alpha, psi),
                    };
                    let Some(channels) = found else { continue };
                    let ray = Ray::new(&channels, ring.weight * sheet.share, self.place, x);
                    for &c in &near {
                        columns[c].add(&ray, window);
                    }
                }
            }
        }
    }

    /// The channels of one ray.
    fn traced(&self, sheet: &Sheet, alpha: f64, psi: f64) -> Option<Channels> {
        let rim = sheet.grid.silhouette_radius(psi);
        let place = [rim * alpha.sin() * psi.cos(), rim * alpha.sin() * psi.sin()];
        let exit = self.tracer.trace_order(place[0], place[1], sheet.order)?;
        channels(&exit, self.place, rim * rim)
    }
}

/// Numbers of the channels: direction, reference point, path, then real and imaginary parts of both
/// fields times `F` and the squared radius of the rim.
const DIRECTION: usize = 0;
const REFERENCE: usize = 3;
const PATH: usize = 6;
const FIELDS: usize = 7;

/// What the integrand needs of a ray.
fn channels(exit: &Exit<f64>, place: Place, rim_squared: f64) -> Option<Channels> {
    let factor = spreading(exit, place) * rim_squared;
    let Exit { direction: s, reference: r, .. } = exit;
    let mut found = [0.0; coarse::CHANNELS];
    found[..FIELDS].copy_from_slice(&[s.x, s.y, s.z, r.x, r.y, r.z, exit.path]);
    let parts = exit.field.iter().flat_map(|e| [e.x, e.y, e.z]);
    for (k, part) in parts.enumerate() {
        let value = part * factor;
        (found[FIELDS + 2 * k], found[FIELDS + 2 * k + 1]) = (value.re, value.im);
    }
    found.iter().all(|v| v.is_finite()).then_some(found)
}

/// `F`: root of the cross-section of the ray's tube at the complex place, with the phase of the focal lines
/// that lie beyond.
fn spreading(exit: &Exit<f64>, place: Place) -> Complex64 {
    let tau = Complex64::new(place.real, place.imaginary);
    let ([xu, xv], [su, sv], s) = (exit.dx, exit.ds, exit.direction);
    let c0 = s.dot(xu.cross(xv));
    let c1 = s.dot(xu.cross(sv)) + s.dot(su.cross(xv));
    let c2 = exit.spread();
    let discriminant = (c1 * c1 - 4.0 * c0 * c2).max(0.0);
    let q = -0.5 * (c1 + discriminant.sqrt().copysign(c1));
    // √|c2| √(τ - t1) with t1 = q/c2, finite where the focal line goes to infinity
    let far = ((tau * c2 - q) * c2.signum()).sqrt();
    let near = if q == 0.0 { tau.sqrt() } else { (tau - c0 / q).sqrt() };
    far * near * Complex64::cis(-FRAC_PI_2 * f64::from(exit.focal_lines))
}

/// Derivatives of direction and reference point by launch coordinates `(α, ψ)`, for a rim radius and its
/// slope at ψ.
fn by_launch(
    exit: &Exit<f64>,
    [alpha, psi]: [f64; 2],
    (rim, slope): (f64, f64),
) -> [[Vec3<f64>; 2]; 2] {
    let ((sin, cos), (sp, cp)) = (alpha.sin_cos(), psi.sin_cos());
    let by_alpha = [rim * cos * cp, rim * cos * sp];
    let by_psi = [sin * (slope * cp - rim * sp), sin * (slope * sp + rim * cp)];
    [by_alpha, by_psi]
        .map(|[a, b]| [exit.ds[0] * a + exit.ds[1] * b, exit.dx[0] * a + exit.dx[1] * b])
}
