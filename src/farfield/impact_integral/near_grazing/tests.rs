//! Tests of `near_grazing`.

use super::*;
use crate::farfield::branch::window::Window;
use crate::farfield::deflection::scan::Scan;
use crate::farfield::deflection::scattering_plane::ScatteringPlane;
use crate::shape::Shape;
use crate::trace::Tracer;
use std::f64::consts::FRAC_PI_2;

/// Far from folds and rim the integral over impacts is the wave of its ray, by stationary phase:
/// amplitude, phase, focal lines and all, on both sides of the axis.
#[test]
fn the_integral_about_one_ray_is_that_ray_s_wave() {
    let x = 2e4;
    let index = Complex64::new(1.333, 0.0);
    for (order, azimuth) in [(1, 0.0), (2, 0.0), (3, 1.2)] {
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, index, x, order);
        let silhouette = shape.silhouette();
        let plane = ScatteringPlane::new(&tracer, order, azimuth, [0.0; 2]);
        let scan = Scan { nodes: 100, axis_gap: 0.02, limit: FRAC_PI_2 };
        let curve = DeflectionCurve::new(plane, &silhouette, scan).unwrap();
        let (rise, fall) = (Window { start: 0.3, full: 0.42 }, Window { start: 0.48, full: 0.6 });
        let rays = Rays::between(&curve, [0.3, 0.6], super::super::rays::RAYS - 1, None).unwrap();
        let weight = |sin: f64| rise.weight(sin) * (1.0 - fall.weight(sin));
        let integrand = rays.integrand(weight, 0.6, 2.0, index, x).unwrap();
        let before = Prefactor::between(&curve, [0.3, 0.31], x).unwrap();
        let node = curve.ray_at(0.45).unwrap();
        let (angle, path) = (node.angle, 0.1);
        let factor = before.towards(angle) / angle.sin().abs().sqrt();
        let knot = wave_knot([angle, path, 0.0], factor, &integrand.sum(angle, path, x), x);
        let found = |e: usize| knot.single().amplitudes[e] * Complex64::cis(x * path);
        let transfer = curve.plane().transfer(&node.exit, angle);
        let phase = x * node.exit.path - FRAC_PI_2 * f64::from(1 + node.exit.focal_lines);
        let ray = Complex64::cis(phase) / node.exit.spread().abs().sqrt();
        for (found, s) in [(found(0), transfer.s1), (found(1), transfer.s2)] {
            let expected = s * ray;
            assert!(
                (found - expected).norm() < 2e-3 * expected.norm(),
                "{order}: {found} {expected}"
            );
        }
    }
}

/// The slopes that a knot holds, by knots beside it on one reference.
#[test]
fn knots_hold_their_slopes() {
    const H: f64 = 1e-6;
    let x = 500.0;
    let mut integrand = Integrand::with_capacity(8);
    for k in 0..8 {
        let t = f64::from(k);
        let element = |e: f64| Complex64::new(1.0 + 0.1 * t * e, 0.3 * e - 0.05 * t);
        let elements = [element(0.0), element(1.0), element(2.0), element(3.0)];
        integrand.push(0.9 + 0.01 * t, 0.02 * t, elements);
    }
    integrand.fill_lanes();
    let (angle, path, slope) = (0.8, 0.3, -0.93);
    let at = |off: f64| {
        let (angle, path) = (angle + off, path + slope * off);
        let factor = Complex64::new(0.4, 0.7) / angle.sin().sqrt();
        wave_knot([angle, path, slope], factor, &integrand.sum(angle, path, x), x).single()
    };
    let (before, here, after) = (at(-H), at(0.0), at(H));
    for e in 0..4 {
        let rate = (after.amplitudes[e] - before.amplitudes[e]) / (2.0 * H);
        let off = rate - here.rates[e];
        assert!(off.re.abs() < 1e-4 * (1.0 + rate.re.abs()), "{e}: {rate}");
        assert!(off.im.abs() < 1e-4 * (1.0 + rate.im.abs()), "{e}: {rate}");
    }
    assert_eq!((here.angle, here.path, here.path_slope), (angle, path, slope));
}

/// Reference paths follow the knots' own slopes, from the anchor on.
#[test]
fn reference_paths_follow_their_slopes() {
    let knots: Vec<[f64; 2]> =
        [-0.3, -0.1, 0.02, 0.4, 0.9].iter().map(|&t| [t, 0.5 + 2.0 * t]).collect();
    let paths = turned_paths(&knots);
    let exact = |t: f64| 0.5 * t + t * t;
    for (knot, path) in knots.iter().zip(paths) {
        assert!((path - (exact(knot[0]) - exact(0.02))).abs() < 1e-14, "{knot:?}: {path}");
    }
}
