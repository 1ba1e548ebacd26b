//! Tests of `huygens_fresnel`.

use super::*;
use crate::shape::Shape;
use std::f64::consts::PI;

#[test]
fn focal_places_are_the_roots_of_the_cross_section() {
    for (a, b) in [(0.3, 1.7), (-0.4, 2.0), (-1.0, -2.0), (1.0, 1.0)] {
        let scale = -2.5;
        let mut found = focal_places([scale * a * b, -scale * (a + b), scale]);
        found.sort_by(f64::total_cmp);
        assert!((found[0] - f64::min(a, b)).abs() + (found[1] - f64::max(a, b)).abs() < 1e-14);
    }
    // a caustic at infinity
    let found = focal_places([1.0, -0.5, 0.0]);
    assert!(found.iter().any(|t| (t - 2.0).abs() < 1e-15) && found.iter().any(|t| t.is_infinite()));
}

/// The foci of a sphere's reflected rays lie inside it at `cos θ/2` of the radius before the surface
/// (tangential) and on the axis (sagittal).
#[test]
fn reflected_rays_have_coddington_s_foci() {
    let shape = Shape::sphere();
    let tracer = Tracer::new(&shape, 1.333.into(), 100.0, 0);
    for b in [0.2, 0.6, 0.9f64] {
        let exit = tracer.trace_order(b, 0.0, 0).unwrap();
        let source = Source::new(&exit, 1.0);
        let cos = (1.0 - b * b).sqrt();
        // the surface lies `cos` ahead of the plane through the centre
        let tangential = cos - 0.5 * cos;
        let sagittal = cos - 0.5 / cos;
        let mut found = source.focal;
        found.sort_by(f64::total_cmp);
        assert!((found[0] - sagittal.min(tangential)).abs() < 1e-12, "{b}: {found:?}");
        assert!((found[1] - sagittal.max(tangential)).abs() < 1e-12, "{b}: {found:?}");
        assert!((source.cross_section(tangential)).abs() < 1e-12);
        assert!((source.clearance(tangential + 0.01) - 0.01).abs() < 1e-12);
    }
}

/// A ray counts whole along its direction, half at the window's width, not at twice that.
#[test]
fn the_window_falls_off_about_the_direction() {
    let sum = HuygensFresnel::new(5000.0, 2);
    let shape = Shape::sphere();
    let tracer = Tracer::new(&shape, 1.333.into(), 5000.0, 2);
    let source = Source::new(&tracer.trace_order(0.5, 0.0, 2).unwrap(), 1.0);
    let s = source.direction;
    let aside = Vec3::new(0.0, 1.0, 0.0);
    let weight = |angle: f64| sum.weight(&source, s * angle.cos() + aside * angle.sin());
    assert!((weight(0.0) - 1.0).abs() < 1e-5 && (weight(sum.window) - 0.5).abs() < 1e-9);
    assert_eq!(weight(2.001 * sum.window), 0.0);
    assert!((weight(0.7 * sum.window) + weight(1.3 * sum.window) - 1.0).abs() < 1e-9);
    assert!((angle(s, aside) - 0.5 * PI).abs() < 1e-14);
    // wider for small particles, but not without end
    assert!(HuygensFresnel::new(500.0, 2).window > 2.0 * sum.window);
    assert!(HuygensFresnel::new(20.0, 2).window <= WIDEST_WINDOW.to_radians());
}

/// Where rays stand alone the sum is their wave.
#[test]
fn the_sum_over_plain_rays_is_their_wave() {
    let x = 600.0;
    let shape = Shape::sphere();
    let tracer = Tracer::new(&shape, 1.333.into(), x, 1);
    let sum = HuygensFresnel::new(x, 1);
    let b = 0.5f64;
    let exit = tracer.trace_order(-b, 0.0, 1).unwrap();
    let direction = Direction::new(exit.scattering_angle(), 0.0);
    let wave = sum.amplitudes(&tracer, &[direction])[0];
    let t = transfer(&exit.field, direction.theta_hat, direction.phi_hat, 1.0, 0.0);
    let phase = x * exit.path - FRAC_PI_2 * f64::from(1 + exit.focal_lines);
    let ray = t * (Complex64::cis(phase) * (x / exit.spread().abs().sqrt()));
    let off = (wave.amplitude - ray).s11().sqrt() / ray.s11().sqrt();
    assert!(off < 0.01 && wave.clearance > 0.1 && wave.rays > 1000, "{off} {wave:?}");
}
