//! Sums of Gaussian beams, for orders whose rays are tangled.
//!
//! Where more than two rays coalesce (cusps, umbilics, the webs that strongly flattened drops make of
//! high orders) no formula for single rays or pairs holds, but the wave is still an integral over the
//! launch points `y` of its rays (Kirchhoff, on the plane through the centre normal to each exit ray),
//! `S(n) = -(x²/2π) ∬ T √|A| e^{-iπm/2} exp(ix [W + r·(s - n)]) d²y`, `A = |∂r/∂y|`,
//! `r` where the ray crosses its plane, `m` the focal lines passed up to there. Launch points are cut
//! into Gaussians of width `σ/√x` that add up to 1. Each sees a phase of second degree,
//! `(∂r/∂y)ᵀ(∂s/∂y) + ∂²r/∂y²·(s - n)`, so that its integral is a Gaussian of directions about its exit
//! ray: finite and smooth at every caustic. The error falls like `1/√x`. (Popov 1982; Heller 1991.)
//!
//! The plane must be the same for neighbouring rays: one that jumps from ray to ray leaves edges that
//! shine. Through the centre it meets no focus of a sphere's rays, and hardly one of a drop's.

use super::beam_launch::Launch;
use super::direction::Direction;
use crate::math::phase::sin_cos_turns;
use crate::math::vec3::{Field, Vec3};
use crate::optics::AmplitudeMatrix;
use crate::shape::Silhouette;
use crate::trace::{Exit, Tracer, transfer};
use num_complex::Complex64;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// All beams of some orders, of launch points on one side of the mirror plane.
pub struct GaussianBeams {
    size_parameter: f64,
    beams: Vec<Beam>,
    /// For each sector of exit azimuths, where its beams begin in `members`.
    starts: Vec<usize>,
    members: Vec<u32>,
}

/// A beam about one exit ray.
#[derive(Clone, Debug)]
struct Beam {
    direction: Vec3<f64>,
    /// Point of the exit ray that phases refer to, and path, in units of the radius.
    reference: Vec3<f64>,
    path: f64,
    /// `∂r/∂y`.
    moved: [Vec3<f64>; 2],
    /// Second derivatives of the phase by `y` in the ray's own direction: (1, 1), (2, 2), (1, 2); and
    /// `∂²r/∂y²`, along which they change with direction.
    bend: [f64; 3],
    bent: [Vec3<f64>; 3],
    /// Fields for incident light along x and y, all factors in them.
    field: [Field; 2],
    /// Real part of the exponent about its own direction, by `(∂r/∂y)·off`, and the largest angle
    /// from the exit ray at which it counts.
    decay: [f64; 3],
    reach: f64,
}

/// Width of the Gaussians of launch points, in `1/√x`, and their distance in widths: their sum is
/// even to 1e-4.
const WIDTH: f64 = 0.8;
const STEP: f64 = 1.5;
/// Exponent at which a beam no longer counts, and farthest angle at which one is looked at, in `1/√x`:
/// beyond, its second degree does not hold, and what beams at the rim spread there is not cancelled.
const FARTHEST_EXPONENT: f64 = 9.0;
const FARTHEST: f64 = 10.0;
/// Fields weaker than this share of the strongest of their order are left out.
const WEAKEST: f64 = 1e-4;
/// Distance of the neighbours that tell second derivatives.
const APART: f64 = 1e-3;
/// Sectors of azimuth in a whole turn.
const SECTORS: usize = 720;

impl GaussianBeams {
    /// Trace the beams of some orders, as far as they reach one of these azimuths.
    pub fn new(tracer: &Tracer, orders: &[u32], azimuths: &[f64], size_parameter: f64) -> Self {
        let silhouette = tracer.shape().silhouette().tabulated();
        let step = step(size_parameter);
        let rows = (1.0 / step).ceil() as i64;
        let half_planes = HalfPlanes::new(azimuths);
        let farthest = FARTHEST / size_parameter.sqrt();
        let reaches = |exit: &Exit<f64>| half_planes.near(exit.direction, farthest);
        let row = |j: i64| {
            let mut found: Vec<(u32, Beam)> = Vec::new();
            for i in -rows..rows {
                // rows lie half a step off the mirror plane, which pairs them
                let place = [(i as f64 + 0.5) * step, (j as f64 + 0.5) * step];
                found.extend(beams_at(tracer, &silhouette, orders, place, size_parameter, reaches));
            }
            found
        };
        let all: Vec<(u32, Beam)> = (0..rows).into_par_iter().flat_map_iter(row).collect();
        let strongest = |order: u32| {
            let of_order = all.iter().filter(|(p, _)| *p == order);
            of_order.map(|(_, beam)| beam.strength()).fold(0.0, f64::max)
        };
        let floors: Vec<(u32, f64)> =
            orders.iter().map(|&order| (order, WEAKEST * strongest(order))).collect();
        let counts = |(order, beam): &(u32, Beam)| {
            floors.iter().any(|(p, floor)| p == order && beam.strength() > *floor)
        };
        let beams = all.into_iter().filter(counts).map(|(_, beam)| beam).collect();
        Self::sorted(beams, size_parameter)
    }

    /// With the sectors of azimuth that each beam reaches.
    fn sorted(beams: Vec<Beam>, size_parameter: f64) -> Self {
        let mut counts = vec![0usize; SECTORS + 1];
        for beam in &beams {
            beam.sectors(|sector| counts[sector + 1] += 1);
        }
        let starts: Vec<usize> = counts
            .into_iter()
            .scan(0, |sum, count| {
                *sum += count;
                Some(*sum)
            })
            .collect();
        let mut next = starts.clone();
        let mut members = vec![0u32; starts[SECTORS]];
        for (number, beam) in beams.iter().enumerate() {
            beam.sectors(|sector| {
                members[next[sector]] = number as u32;
                next[sector] += 1;
            });
        }
        Self { size_parameter, beams, starts, members }
    }

    /// Add the waves in some directions of one azimuth, scattering angles ascending.
    pub fn add(&self, theta: &[f64], phi: f64, sums: &mut [AmplitudeMatrix]) {
        let directions: Vec<Direction> = theta.iter().map(|&t| Direction::new(t, phi)).collect();
        self.add_side(theta, &directions, phi, |i, wave| sums[i] += wave);
        // beams of the other side are mirror images
        let mirrored: Vec<Direction> = theta.iter().map(|&t| Direction::new(t, -phi)).collect();
        self.add_side(theta, &mirrored, -phi, |i, mut wave| {
            (wave.s3, wave.s4) = (-wave.s3, -wave.s4);
            sums[i] += wave;
        });
    }

    fn add_side(
        &self,
        theta: &[f64],
        directions: &[Direction],
        phi: f64,
        mut add: impl FnMut(usize, AmplitudeMatrix),
    ) {
        let sector = sector_of(phi);
        for &number in &self.members[self.starts[sector]..self.starts[sector + 1]] {
            let beam = &self.beams[number as usize];
            let centre = beam.direction.x.hypot(beam.direction.y).atan2(beam.direction.z);
            let from = theta.partition_point(|&t| t < centre - beam.reach);
            for (i, direction) in directions.iter().enumerate().skip(from) {
                if direction.theta > centre + beam.reach {
                    break;
                }
                if let Some(wave) = beam.towards(direction, self.size_parameter) {
                    add(i, wave);
                }
            }
        }
    }
}

/// The beams launched at a place, of those orders whose rays reach far enough.
fn beams_at(
    tracer: &Tracer,
    silhouette: &Silhouette,
    orders: &[u32],
    place: [f64; 2],
    x: f64,
    reaches: impl Fn(&Exit<f64>) -> bool,
) -> Vec<(u32, Beam)> {
    let rays = |off: [f64; 2]| -> Option<(Launch, Vec<Exit<f64>>)> {
        let launch = Launch::at(silhouette, [place[0] + off[0], place[1] + off[1]])?;
        let mut exits = Vec::new();
        let keep = |exit: Exit<f64>| exits.extend(orders.contains(&exit.order).then_some(exit));
        tracer.trace(launch.point[0], launch.point[1], keep)?;
        Some((launch, exits))
    };
    let Some((launch, exits)) = rays([0.0; 2]) else { return Vec::new() };
    if !exits.iter().any(&reaches) {
        return Vec::new();
    }
    let beside = [[-APART, 0.0], [APART, 0.0], [0.0, -APART], [0.0, APART]].map(rays);
    let [Some(a), Some(b), Some(c), Some(d)] = beside else { return Vec::new() };
    let beam = |exit: &Exit<f64>| {
        let of_order = |(launch, exits): &(Launch, Vec<Exit<f64>>)| {
            let exit = exits.iter().find(|other| other.order == exit.order)?;
            Some(moved(exit, launch))
        };
        let around = [[of_order(&a)?, of_order(&b)?], [of_order(&c)?, of_order(&d)?]];
        Some((exit.order, Beam::new(exit, &launch, &around, x)?))
    };
    exits.iter().filter(|exit| reaches(exit)).filter_map(beam).collect()
}

/// The half-planes of some azimuths and of their mirror images; none where they are so many that every
/// ray is near one.
struct HalfPlanes(Option<Vec<(f64, f64)>>);

impl HalfPlanes {
    fn new(azimuths: &[f64]) -> Self {
        const MOST: usize = 40;
        let both = |&azimuth: &f64| [azimuth.sin_cos(), (-azimuth).sin_cos()];
        Self((azimuths.len() <= MOST).then(|| azimuths.iter().flat_map(both).collect()))
    }

    /// Whether a direction comes nearer to one than an angle.
    fn near(&self, direction: Vec3<f64>, angle: f64) -> bool {
        let Some(planes) = &self.0 else { return true };
        let Vec3 { x, y, .. } = direction;
        let chord = angle.sin();
        planes.iter().any(|(sin, cos)| {
            let (along, aside) = (x * cos + y * sin, y * cos - x * sin);
            if along > 0.0 { aside.abs() < chord } else { x.hypot(y) < chord }
        })
    }
}

/// Distance of neighbouring beams in launch coordinates.
fn step(size_parameter: f64) -> f64 {
    STEP * WIDTH / size_parameter.sqrt()
}

fn sector_of(phi: f64) -> usize {
    ((phi.rem_euclid(TAU) / TAU * SECTORS as f64) as usize).min(SECTORS - 1)
}

impl Beam {
    /// From an exit ray and `∂r/∂y` of those a little beside it, on both sides of either coordinate.
    /// `None` where nothing finite comes out.
    fn new(
        exit: &Exit<f64>,
        launch: &Launch,
        around: &[[[Vec3<f64>; 2]; 2]; 2],
        x: f64,
    ) -> Option<Self> {
        let moved = moved(exit, launch);
        let turned = launch.by_place(&exit.ds);
        let rate = |k: usize| {
            let [before, after] = around[k];
            [0, 1].map(|l| (after[l] - before[l]) * (0.5 / APART))
        };
        let (by_first, by_second) = (rate(0), rate(1));
        let bent = [by_first[0], by_second[1], (by_first[1] + by_second[0]) * 0.5];
        let bend = [
            moved[0].dot(turned[0]),
            moved[1].dot(turned[1]),
            0.5 * (moved[0].dot(turned[1]) + moved[1].dot(turned[0])),
        ];
        let s = exit.direction;
        let determinant = s.dot(moved[0].cross(moved[1]));
        let lines = exit.focal_lines.saturating_sub(lines_ahead(moved, turned, s));
        let size =
            -(x * step(x) / WIDTH).powi(2) / TAU * (launch.determinant * determinant.abs()).sqrt();
        let factor = Complex64::cis(-FRAC_PI_2 * f64::from(lines)) * size;
        let scaled = |f: Field| Vec3 { x: f.x * factor, y: f.y * factor, z: f.z * factor };
        let mut beam = Self {
            direction: s,
            reference: exit.reference,
            path: exit.path,
            moved,
            bend,
            bent,
            field: exit.field.map(scaled),
            decay: Form::new(bend).inverse.map(|v| 0.5 * x * v.re),
            reach: 0.0,
        };
        beam.reach = beam.reach(x);
        (beam.strength().is_finite() && beam.reach.is_finite()).then_some(beam)
    }

    /// Angle from the exit ray at which the exponent has fallen enough.
    fn reach(&self, x: f64) -> f64 {
        let [e, f] = frame(self.direction);
        let at = |d: Vec3<f64>| self.fallen(self.moved.map(|m| m.dot(d)));
        let (p, q) = (at(e), at(f));
        let r = 0.5 * (at(e + f) - p - q);
        let slowest = 0.5 * (p + q) - (0.5 * (p - q)).hypot(r);
        (FARTHEST_EXPONENT / slowest.max(1e-9)).sqrt().min(FARTHEST / x.sqrt())
    }

    fn strength(&self) -> f64 {
        let square = |f: &Field| f.x.norm_sqr() + f.y.norm_sqr() + f.z.norm_sqr();
        self.field.iter().map(square).sum::<f64>().sqrt()
    }

    /// Real part of the exponent, as its own direction has it.
    fn fallen(&self, [p, q]: [f64; 2]) -> f64 {
        self.decay[0] * p * p + self.decay[1] * q * q + 2.0 * self.decay[2] * p * q
    }

    /// Its wave in a direction, if it reaches there.
    fn towards(&self, direction: &Direction, x: f64) -> Option<AmplitudeMatrix> {
        let off = direction.unit - self.direction;
        if off.dot(off) > self.reach * self.reach {
            return None;
        }
        let along = self.moved.map(|m| m.dot(off));
        if self.fallen(along) > FARTHEST_EXPONENT {
            return None;
        }
        let bend = [0, 1, 2].map(|k| self.bend[k] - self.bent[k].dot(off));
        let form = Form::new(bend);
        let exponent = form.over(along) * (0.5 * x);
        let phase = x * (self.path - self.reference.dot(off)) - exponent.im;
        let (sin, cos) = sin_cos_turns(phase / TAU);
        let size = (-exponent.re).exp();
        let matrix = transfer(
            &self.field,
            direction.theta_hat,
            direction.phi_hat,
            direction.cos_phi,
            direction.sin_phi,
        );
        Some(matrix * (Complex64::new(size * cos, size * sin) / form.root))
    }

    /// Hand every sector of azimuth that it reaches to `visit`.
    fn sectors(&self, mut visit: impl FnMut(usize)) {
        let sin = self.direction.x.hypot(self.direction.y);
        let theta = sin.atan2(self.direction.z);
        let centre = self.direction.y.atan2(self.direction.x);
        let half = if theta.min(PI - theta) <= self.reach {
            PI
        } else {
            (self.reach.sin() / sin).min(1.0).asin()
        };
        let width = TAU / SECTORS as f64;
        let from = ((centre - half) / width).floor() as i64;
        let to = ((centre + half) / width).floor() as i64;
        let to = to.min(from + SECTORS as i64 - 1);
        for sector in from..=to {
            visit(sector.rem_euclid(SECTORS as i64) as usize);
        }
    }
}

/// Two unit vectors normal to a direction and to each other.
fn frame(s: Vec3<f64>) -> [Vec3<f64>; 2] {
    let aside = if s.z.abs() < 0.9 {
        Vec3 { x: 0.0, y: 0.0, z: 1.0 }
    } else {
        Vec3 { x: 1.0, y: 0.0, z: 0.0 }
    };
    let first = aside.cross(s).normalized();
    [first, s.cross(first)]
}

/// The inverse of `1/σ² - iM`, and the root of its determinant.
struct Form {
    inverse: [Complex64; 3],
    root: Complex64,
}

impl Form {
    fn new([m11, m22, m12]: [f64; 3]) -> Self {
        const TIGHT: f64 = 1.0 / (WIDTH * WIDTH);
        let entry = |m: f64| Complex64::new(TIGHT, -m);
        let (a, b, c) = (entry(m11), entry(m22), Complex64::new(0.0, -m12));
        let determinant = a * b - c * c;
        // both eigenvalues have the same positive real part: a root for each
        let half = (0.25 * (m11 - m22) * (m11 - m22) + m12 * m12).sqrt();
        let mean = 0.5 * (m11 + m22);
        let root_of = |m: f64| {
            let re = (0.5 * (TIGHT + (TIGHT * TIGHT + m * m).sqrt())).sqrt();
            Complex64::new(re, -0.5 * m / re)
        };
        let root = root_of(mean + half) * root_of(mean - half);
        Self { inverse: [b, a, -c].map(|v| v / determinant), root }
    }

    /// `qᵀ (1/σ² - iM)⁻¹ q`.
    fn over(&self, [p, q]: [f64; 2]) -> Complex64 {
        self.inverse[0] * (p * p) + self.inverse[1] * (q * q) + self.inverse[2] * (2.0 * p * q)
    }
}

/// `∂r/∂y` of the foot of the perpendicular from the centre on the exit ray.
fn moved(exit: &Exit<f64>, launch: &Launch) -> [Vec3<f64>; 2] {
    let s = exit.direction;
    let whole = [0, 1].map(|k| exit.dx[k] - s * exit.reference.dot(exit.ds[k]));
    launch.by_place(&whole)
}

/// Focal lines that a ray passes beyond the plane through the centre: roots of `det(r + ts)`.
fn lines_ahead(moved: [Vec3<f64>; 2], turned: [Vec3<f64>; 2], s: Vec3<f64>) -> u32 {
    let det = |a: Vec3<f64>, b: Vec3<f64>| s.dot(a.cross(b));
    let (a, c) = (det(turned[0], turned[1]), det(moved[0], moved[1]));
    let b = det(moved[0], turned[1]) + det(turned[0], moved[1]);
    let discriminant = b * b - 4.0 * a * c;
    let ahead = |t: f64| u32::from(t.is_finite() && t > 0.0);
    if discriminant < 0.0 {
        return 0;
    }
    let half = -0.5 * (b + b.signum() * discriminant.sqrt());
    ahead(half / a) + ahead(c / half)
}
