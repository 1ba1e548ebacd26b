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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{RaindropModel, Shape};
    use crate::trace::Tracer;

    #[test]
    fn forms_are_inverse_and_root_of_their_matrix() {
        let m = [0.7, -2.3, 1.1];
        let form = Form::new(m);
        let entry = |m: f64| Complex64::new(1.0 / (WIDTH * WIDTH), -m);
        let (a, b, c) = (entry(m[0]), entry(m[1]), Complex64::new(0.0, -m[2]));
        assert!((form.root * form.root - (a * b - c * c)).norm() < 1e-13);
        // the root is continuous from that of a matrix without imaginary part
        let mut before = Form::new([0.0; 3]).root;
        assert!((before - 1.0 / (WIDTH * WIDTH)).norm() < 1e-14);
        for k in 1..=100 {
            let next = Form::new(m.map(|m| m * f64::from(k) * 0.1)).root;
            assert!((next - before).norm() < (next + before).norm(), "{k}");
            before = next;
        }
        let [x, y, z] = form.inverse;
        for (value, expected) in
            [(a * x + c * z, 1.0), (a * z + c * y, 0.0), (c * x + b * z, 0.0), (c * z + b * y, 1.0)]
        {
            assert!((value - expected).norm() < 1e-14, "{value}");
        }
        let q = [0.3, -0.8];
        let over = x * q[0] * q[0] + y * q[1] * q[1] + z * 2.0 * q[0] * q[1];
        assert!((form.over(q) - over).norm() < 1e-14);
    }

    #[test]
    fn frames_are_across_their_direction() {
        for s in [Vec3::new(0.0, 0.0, 1.0), Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, -1.0, 0.0)] {
            let [a, b] = frame(s);
            assert!(a.dot(s).abs() + b.dot(s).abs() + a.dot(b).abs() < 1e-15);
            assert!((a.dot(a) - 1.0).abs() + (b.dot(b) - 1.0).abs() < 1e-14);
        }
    }

    /// A bundle with foci ahead of the plane through the centre, or behind it.
    #[test]
    fn lines_ahead_are_counted() {
        let s = Vec3::new(0.0, 0.0, 1.0);
        let lines = |f: f64, g: f64| {
            let (a, b) = (Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0));
            lines_ahead([a, b], [a * (-1.0 / f), b * (-1.0 / g)], s)
        };
        assert_eq!((lines(1.0, 3.0), lines(-1.0, 3.0), lines(-1.0, -3.0)), (2, 1, 0));
    }

    fn beam(x: f64) -> Beam {
        let shape = Shape::raindrop(0.8e-3, RaindropModel::BeardChuang1987, 0.4).unwrap();
        let silhouette = shape.silhouette();
        let tracer = Tracer::new(&shape, 1.333.into(), x, 2);
        let at = |y: [f64; 2]| {
            let launch = Launch::at(&silhouette, y).unwrap();
            let exit = tracer.trace_order(launch.point[0], launch.point[1], 2).unwrap();
            (launch, exit)
        };
        let (launch, exit) = at([0.4, 0.3]);
        let beside = |a: f64, b: f64| {
            let (launch, exit) = at([0.4 + a, 0.3 + b]);
            moved(&exit, &launch)
        };
        let around =
            [[beside(-APART, 0.0), beside(APART, 0.0)], [beside(0.0, -APART), beside(0.0, APART)]];
        // the foot on the ray moves with the launch point
        for (k, [before, after]) in
            [[[-1e-5, 0.0], [1e-5, 0.0]], [[0.0, -1e-5], [0.0, 1e-5]]].into_iter().enumerate()
        {
            let foot = |d: [f64; 2]| at([0.4 + d[0], 0.3 + d[1]]).1.reference;
            let off = (foot(after) - foot(before)) * 0.5e5 - moved(&exit, &launch)[k];
            assert!(off.dot(off).sqrt() < 1e-6, "{off:?}");
        }
        Beam::new(&exit, &launch, &around, x).unwrap()
    }

    /// A beam is strongest along its ray, falls off on all sides, and ends at its reach.
    #[test]
    fn beams_fall_off_about_their_ray() {
        let x = 4000.0;
        let beam = beam(x);
        let s = beam.direction;
        let (theta, phi) = (s.x.hypot(s.y).atan2(s.z), s.y.atan2(s.x));
        let size = |a: f64, b: f64| {
            let direction = Direction::new(theta + a, phi + b / theta.sin());
            beam.towards(&direction, x).map_or(0.0, |wave| wave.s11().sqrt())
        };
        let middle = size(0.0, 0.0);
        for (a, b) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (0.7, 0.7)] {
            let along = |share: f64| size(a * share * beam.reach, b * share * beam.reach);
            assert!(along(0.2) < middle && along(0.5) < along(0.2), "{a} {b}");
            assert_eq!(along(1.01), 0.0);
        }
        // along the ray: all of its strength over the root of the form
        let whole = beam.strength() / 2f64.sqrt() / Form::new(beam.bend).root.norm();
        assert!((middle / whole - 1.0).abs() < 0.02, "{middle} {whole}");
    }
}
