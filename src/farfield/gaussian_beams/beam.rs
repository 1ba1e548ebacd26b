//! A Gaussian beam: what a small Gaussian of launch points sends out about its exit ray.
//!
//! The phase over the launch points is taken to second degree, and its second derivatives change with
//! direction; the integral over them is again a Gaussian, of directions.

use super::launch::Launch;
use crate::farfield::direction::Direction;
use crate::math::phase::sin_cos_turns;
use crate::math::vec3::{Field, Vec3};
use crate::optics::AmplitudeMatrix;
use crate::trace::{Exit, transfer};
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, TAU};

/// A beam about one exit ray.
#[derive(Clone, Debug)]
pub(crate) struct Beam {
    pub direction: Vec3<f64>,
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
    pub reach: f64,
}

/// Width of the Gaussians of launch points, in `1/√x`, and their distance in widths: their sum is
/// even to 1e-4.
const WIDTH: f64 = 0.8;
const STEP: f64 = 1.5;
/// Exponent at which a beam no longer counts, and farthest angle at which one is looked at, in `1/√x`:
/// beyond, its second degree does not hold, and what beams at the rim spread there is not cancelled.
const FARTHEST_EXPONENT: f64 = 9.0;
pub(crate) const FARTHEST: f64 = 10.0;
/// Distance of the neighbours that tell second derivatives.
pub(crate) const APART: f64 = 1e-3;

/// Distance of neighbouring beams in launch coordinates.
pub(crate) fn step(size_parameter: f64) -> f64 {
    STEP * WIDTH / size_parameter.sqrt()
}

impl Beam {
    /// From an exit ray and `∂r/∂y` of those a little beside it, on both sides of either coordinate.
    /// `None` where nothing finite comes out.
    pub(crate) fn new(
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

    pub(crate) fn strength(&self) -> f64 {
        let square = |f: &Field| f.x.norm_sqr() + f.y.norm_sqr() + f.z.norm_sqr();
        self.field.iter().map(square).sum::<f64>().sqrt()
    }

    /// Real part of the exponent, as its own direction has it.
    fn fallen(&self, [p, q]: [f64; 2]) -> f64 {
        self.decay[0] * p * p + self.decay[1] * q * q + 2.0 * self.decay[2] * p * q
    }

    /// Its wave in a direction, if it reaches there.
    pub(crate) fn towards(&self, direction: &Direction, x: f64) -> Option<AmplitudeMatrix> {
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
pub(crate) fn moved(exit: &Exit<f64>, launch: &Launch) -> [Vec3<f64>; 2] {
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
