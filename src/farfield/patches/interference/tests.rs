//! Tests of `interference`.

use super::super::sheets::sheets;
use super::*;
use crate::shape::Shape;
use crate::trace::{Tracer, Wavefront};
use std::f64::consts::FRAC_PI_2;

const INDEX: f64 = 1.333;

/// Transmitted rays of a sphere: amplitude and phase of each patch are those of the ray that leaves
/// there, and rays are counted by order.
#[test]
fn patches_have_the_waves_of_their_rays() {
    let x = 200.0;
    let shape = Shape::sphere();
    let tracer = Tracer::new(&shape, INDEX.into(), x, 1);
    let wavefront = Wavefront::corners(&shape, 60, 120, 0.0);
    let sphere = CollectingSphere::new(sheets(&tracer, &wavefront, &[1]));
    let interference = Interference {
        size_parameter: x,
        interpolation: PathInterpolation::Gradient,
        largest_jacobian: f64::INFINITY,
    };
    for theta in [0.2, 0.5, 0.9] {
        let direction = Direction::new(theta, 0.41);
        let found = interference.collect(&sphere, &direction);
        assert_eq!(found.rays_by_order, [0, 1]);
        // the impact of the ray that is turned by this angle
        let (mut low, mut high) = (0.0f64, 1.0f64);
        for _ in 0..60 {
            let b = 0.5 * (low + high);
            if 2.0 * (b.asin() - (b / INDEX).asin()) < theta { low = b } else { high = b }
        }
        // it leaves on the other side of the axis
        let exit = tracer.trace_order(-low * 0.41f64.cos(), -low * 0.41f64.sin(), 1).unwrap();
        let Direction { theta_hat, phi_hat, cos_phi, sin_phi, .. } = direction;
        let transfer = crate::trace::transfer(&exit.field, theta_hat, phi_hat, cos_phi, sin_phi);
        let phase = x * exit.path - FRAC_PI_2 * f64::from(1 + exit.focal_lines);
        let ray = transfer * (Complex64::cis(phase) * (x / exit.spread().abs().sqrt()));
        let off = (found.amplitude - ray).s11().sqrt() / ray.s11().sqrt();
        assert!(off < 5e-3, "{theta}: {off}");
        assert!((found.incoherent[0][0] / ray.s11() - 1.0).abs() < 0.01);
    }
}

fn corners() -> [Corner; 3] {
    let wavefront = Wavefront::corners(&Shape::sphere(), 40, 80, 0.0);
    let shape = Shape::sphere();
    let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 1);
    let sheet = &sheets(&tracer, &wavefront, &[1])[0];
    sheet.triangles[900].map(|i| sheet.corners[i as usize])
}

/// Inside a patch the path by gradients is a hundred times nearer the ray's than that by corners.
#[test]
fn gradients_interpolate_the_path() {
    let corners = corners();
    let [a, b, c] = [0, 1, 2].map(|k| corners[k].place);
    let shape = Shape::sphere();
    let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 1);
    let exit =
        tracer.trace_order((a[0] + b[0] + c[0]) / 3.0, (a[1] + b[1] + c[1]) / 3.0, 1).unwrap();
    let d = exit.direction;
    let edge = |i: usize, j: usize| d.dot(corners[i].direction.cross(corners[j].direction));
    let weights = [edge(1, 2), edge(2, 0), edge(0, 1)];
    let sum: f64 = weights.iter().sum();
    let weights = weights.map(|w| w / sum);
    let path = |interpolation| {
        let interference =
            Interference { size_parameter: 1.0, interpolation, largest_jacobian: f64::INFINITY };
        interference.path(&[&corners[0], &corners[1], &corners[2]], weights, d)
    };
    let linear = (path(PathInterpolation::Linear) - exit.path).abs();
    let gradient = (path(PathInterpolation::Gradient) - exit.path).abs();
    assert!(linear > 1e-5 && gradient < 0.02 * linear, "{linear} {gradient}");
}

/// Where a caustic runs through a patch its mean area per solid angle stands for what would be infinite;
/// the branch's focal lines are those of a corner on it.
#[test]
fn a_caustic_in_a_patch_leaves_a_finite_mean() {
    let mut corners = corners();
    let sheet = crate::farfield::patches::sheets::Sheet {
        order: 1,
        corners: corners.to_vec(),
        triangles: vec![[0, 1, 2]],
    };
    let third = [1.0 / 3.0; 3];
    let hit = |sense: f64| Hit { sheet: &sheet, triangle: 0, weights: third, sense };
    let sense = corners[0].spread.signum();
    let refs = |c: &[Corner; 3]| [c[0], c[1], c[2]];
    let all = refs(&corners);
    let plain = jacobian(&[&all[0], &all[1], &all[2]], &hit(sense));
    let mean = jacobian(&[&all[0], &all[1], &all[2]], &hit(-sense));
    assert!((mean / plain - 1.0).abs() < 0.05, "{plain} {mean}");
    corners[2].spread *= -1.0;
    corners[2].focal_lines += 1;
    let all = refs(&corners);
    assert_eq!(focal_lines(&[&all[0], &all[1], &all[2]], -sense), corners[2].focal_lines);
    assert_eq!(focal_lines(&[&all[0], &all[1], &all[2]], sense), corners[0].focal_lines);
}

/// A ring focused on the axis has `π x b²/2` at most, none where it is no ring.
#[test]
fn rings_on_the_axis_are_bounded() {
    let mut corner = corners()[0];
    let at = |corner: &Corner, x: f64| {
        let interference = Interference {
            size_parameter: x,
            interpolation: PathInterpolation::Gradient,
            largest_jacobian: f64::INFINITY,
        };
        interference.at_axis(&[corner; 3])
    };
    corner.reference = Vec3::new(0.3, 0.4, 0.0);
    assert!((at(&corner, 100.0) - 0.5 * std::f64::consts::PI * 25.0).abs() < 1e-12);
    assert_eq!(at(&corner, 10.0), f64::INFINITY);
}
