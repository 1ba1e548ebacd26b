//! The tracer against numbers known from elsewhere: focal lines, rainbow angles, energy, caustics.

use gonio::math::vec3::Vec3;
use gonio::shape::{RaindropModel, Shape};
use gonio::trace::{Exit, Tracer, Wavefront, energy_by_fate};
use num_complex::Complex64;

const INDEX: f64 = 1.333;

fn exits(shape: &Shape, index: f64, u: f64, v: f64, last: u32) -> Vec<Exit<f64>> {
    let tracer = Tracer::new(shape, Complex64::new(index, 0.0), 1000.0, last);
    let mut all = Vec::new();
    tracer.trace(u, v, |exit| all.push(exit));
    all
}

/// Counts checked against the exact Debye series: p=0: 0; p=1: 2; p=2: 2 inside and 3 outside the
/// rainbow ray; p=3: 4 and 5.
#[test]
fn focal_lines_on_the_sphere() {
    let shape = Shape::sphere();
    let impact = |p: f64| (1.0 - (INDEX * INDEX - 1.0) / (p * p - 1.0)).sqrt();
    for (azimuth, b) in
        [(0.0f64, 0.02), (0.3, 0.3), (1.0, 0.6), (2.0, 0.84), (3.0, 0.9), (4.0, 0.97), (5.0, 0.999)]
    {
        let (u, v) = (b * azimuth.cos(), b * azimuth.sin());
        let all = exits(&shape, INDEX, u, v, 3);
        let expected =
            [0, 2, if b < impact(2.0) { 2 } else { 3 }, if b < impact(3.0) { 4 } else { 5 }];
        let found: Vec<u32> = all.iter().map(|e| e.focal_lines).collect();
        assert_eq!(found, expected, "b = {b}");
    }
}

/// Path and angle of a sphere in closed form: W = 2(p n cos θt - cos θi).
#[test]
fn path_on_the_sphere_three_ways() {
    let shapes = [
        Shape::sphere(),
        Shape::spheroid(1.0, 0.3).unwrap(),
        Shape::raindrop(0.3e-3, RaindropModel::BeardChuang1987, 0.3).unwrap(),
    ];
    for shape in &shapes {
        for b in [0.1f64, 0.5, 0.86, 0.99, 0.9999] {
            for exit in exits(shape, INDEX, b * 0.6, b * 0.8, 7) {
                let p = exit.order as f64;
                let (ti, tt) = (b.asin(), (b / INDEX).asin());
                let path = 2.0 * (p * INDEX * tt.cos() - ti.cos());
                assert!((exit.path - path).abs() < 1e-12, "path {} {path}", exit.path);
                let deviation = (p - 1.0) * std::f64::consts::PI + 2.0 * ti - 2.0 * p * tt;
                assert!((exit.direction.z - deviation.cos()).abs() < 1e-12);
            }
        }
    }
}

/// Smallest or largest deviation of order 2 on the vertical symmetry plane, degrees.
fn rainbow(shape: &Shape, index: f64, upper: bool) -> f64 {
    let sign = if upper { 1.0 } else { -1.0 };
    let angle = |b: f64| exits(shape, index, sign * b, 0.0, 2)[2].scattering_angle();
    let (mut low, mut high) = (0.6, 0.97);
    let ratio = 0.5 * (5f64.sqrt() - 1.0);
    for _ in 0..60 {
        let (a, b) = (high - ratio * (high - low), low + ratio * (high - low));
        if angle(a) < angle(b) { high = b } else { low = a }
    }
    angle(0.5 * (low + high)).to_degrees()
}

/// An independent two-dimensional trace gave these (n = 1.333).
#[test]
fn rainbow_angles_of_raindrops() {
    let rows = [
        (0.3, [137.9219, 137.9219, 137.9219, 137.9219]),
        (0.5, [138.7399, 139.6746, 139.5540, 138.6266]),
        (1.0, [142.8026, 149.8606, 149.7052, 140.8375]),
    ];
    for (radius, angles) in rows {
        for (i, expected) in angles.iter().enumerate() {
            let sun = if i < 2 { 0.0 } else { 20f64.to_radians() };
            let shape =
                Shape::raindrop(radius * 1e-3, RaindropModel::BeardChuang1987, sun).unwrap();
            let found = rainbow(&shape, INDEX, i % 2 == 0);
            assert!((found - expected).abs() < 2e-4, "{radius} mm, case {i}: {found} {expected}");
        }
    }
}

/// The Hamiltonian property dW = -x·ds ties path, position and differentials together.
#[test]
fn path_gradient_is_minus_the_reference_point() {
    let shape = Shape::raindrop(1e-3, RaindropModel::BeardChuang1987, 20f64.to_radians()).unwrap();
    let h = 1e-6;
    for (u, v) in [(0.2, 0.1), (-0.5, 0.4), (0.3, -0.8)] {
        for order in 0..5 {
            let at = |u: f64, v: f64| exits(&shape, INDEX, u, v, 4)[order];
            let centre = at(u, v);
            for k in 0..2 {
                let (du, dv) = if k == 0 { (h, 0.0) } else { (0.0, h) };
                let (plus, minus) = (at(u + du, v + dv), at(u - du, v - dv));
                let slope = (plus.path - minus.path) / (2.0 * h);
                let expected = -centre.reference.dot(centre.ds[k]);
                assert!((slope - expected).abs() < 1e-7, "order {order}: {slope} {expected}");
                let step = (plus.direction - minus.direction) * (0.5 / h);
                let error: Vec3<f64> = step - centre.ds[k];
                assert!(error.dot(error).sqrt() < 1e-6 * (1.0 + centre.ds[k].dot(centre.ds[k])));
            }
        }
    }
}

#[test]
fn energy_adds_up() {
    let drop = Shape::raindrop(1e-3, RaindropModel::BeardChuang1987, 0.35).unwrap();
    for shape in [Shape::sphere(), drop, Shape::spheroid(0.7, 0.5).unwrap()] {
        for index in [Complex64::new(1.333, 0.0), Complex64::new(1.333, 1e-5)] {
            let tracer = Tracer::new(&shape, index, 5000.0, 8);
            let fates = energy_by_fate(&tracer, &Wavefront::midpoints(&shape, 100, 100));
            // An absorbing interface mixes incident and reflected power: a term of order k per hit.
            assert!(fates.residual.abs() < 1e-6 + 9.0 * index.im, "{fates:?}");
            assert!(fates.left_by_order[1] > 0.5);
        }
    }
}
