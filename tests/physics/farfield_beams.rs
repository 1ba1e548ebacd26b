//! Sums of Gaussian beams against Debye terms of the sphere and, on raindrops, against the
//! brute-force Huygens–Fresnel sum; and the check of meridians by beams.

use gonio::farfield::FarFieldSettings;
use gonio::farfield::{Direction, FarField, WaveField};
use gonio::farfield::{GaussianBeams, HuygensFresnel, sheets};
use gonio::optics::AmplitudeMatrix;
use gonio::series::debye::{DebyeSeries, Term};
use gonio::shape::{RaindropModel, Shape};
use gonio::trace::{Tracer, Wavefront};
use num_complex::Complex64;
use std::f64::consts::TAU;

fn angles(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..=count).map(|i| (from + (to - from) * i as f64 / count as f64).to_radians()).collect()
}

fn beams(tracer: &Tracer, order: u32, x: f64, theta: &[f64], phi: f64) -> Vec<AmplitudeMatrix> {
    let mut found = vec![AmplitudeMatrix::default(); theta.len()];
    GaussianBeams::new(tracer, &[order], &[phi], x).add(theta, phi, &mut found);
    found
}

/// Relative L2 error of the whole amplitude matrix.
fn error(found: &[AmplitudeMatrix], truth: &[AmplitudeMatrix]) -> f64 {
    let off: f64 = found.iter().zip(truth).map(|(f, t)| (*f - *t).s11()).sum();
    (off / truth.iter().map(AmplitudeMatrix::s11).sum::<f64>()).sqrt()
}

/// Bright and dark sides of bows, plain rays, and the axis; a body all but a sphere.
#[test]
fn beams_reproduce_debye_terms() {
    let index = Complex64::new(1.333, 0.0);
    let shape = Shape::spheroid(1.0 - 1e-9, 0.5).unwrap();
    let cases = [
        (1u32, 5000.0, 0.0, 28.0, 0.002),
        (1, 20000.0, 0.0, 40.0, 0.001),
        (1, 50000.0, 0.0, 60.0, 0.002),
        (2, 20000.0, 137.0, 143.0, 0.005),
        (2, 20000.0, 137.0, 160.0, 0.06),
        (3, 20000.0, 120.0, 130.0, 0.06),
        (2, 50000.0, 137.0, 160.0, 0.04),
        (3, 50000.0, 120.0, 130.0, 0.03),
        (2, 20000.0, 178.0, 180.0, 0.03),
    ];
    for (order, x, from, to, bound) in cases {
        let tracer = Tracer::new(&shape, index, x, order).with_curved_interface(x);
        let theta = angles(from, to, 300);
        let exact: Vec<AmplitudeMatrix> = DebyeSeries::new(x, index)
            .unwrap()
            .sum_parallel(&[Term::Order(order)], &theta)
            .iter()
            .map(|&(s1, s2)| AmplitudeMatrix { s1, s2, ..Default::default() })
            .collect();
        // both halves of the launch plane count, also across the mirror plane
        for phi in [0.7, -2.0] {
            let error = error(&beams(&tracer, order, x, &theta, phi), &exact);
            println!("p = {order}, x = {x}, {from}–{to}°: {:.3} %", 1e2 * error);
            assert!(error < bound, "p = {order}, x = {x}, {from}–{to}°: {error}");
        }
    }
}

/// Primary bows of raindrops, at azimuths on and off the plane of symmetry.
#[test]
fn beams_agree_with_the_huygens_fresnel_sum() {
    let index = Complex64::new(1.3314, 0.0);
    let cases = [
        (0.5, 40.0, 136.0, 141.0, 0.01),
        (1.0, 90.0, 137.0, 145.0, 0.025),
        (1.0, 180.0, 149.0, 151.0, 0.01),
        (2.0, 90.0, 137.5, 139.5, 0.03),
    ];
    for (radius_mm, azimuth, from, to, bound) in cases {
        let x = TAU * radius_mm * 1e-3 / 650e-9;
        let (sun, phi) = (20f64.to_radians(), f64::to_radians(azimuth));
        let shape = Shape::raindrop(radius_mm * 1e-3, RaindropModel::BeardChuang1987, sun).unwrap();
        let tracer = Tracer::new(&shape, index, x, 2).with_curved_interface(x);
        let theta = angles(from, to, 10);
        let directions: Vec<Direction> = theta.iter().map(|&t| Direction::new(t, phi)).collect();
        let waves = HuygensFresnel::new(x, 2).amplitudes(&tracer, &directions);
        let truth: Vec<AmplitudeMatrix> = waves.iter().map(|w| w.amplitude).collect();
        let error = error(&beams(&tracer, 2, x, &theta, phi), &truth);
        println!("{radius_mm} mm, azimuth {azimuth}°: {:.3} %", 1e2 * error);
        assert!(waves.iter().all(|w| w.clearance > 0.35), "the sum itself does not hold");
        assert!(error < bound, "{radius_mm} mm: {error}");
    }
}

/// Meridians that miss where rays gather are noticed, and left to beams.
#[test]
fn doubtful_meridians_are_left_to_beams() {
    let index = Complex64::new(1.3314, 0.0);
    let x = TAU * 2e-3 / 650e-9;
    let azimuths: Vec<f64> = (0..=180).map(|degree| f64::from(degree).to_radians()).collect();
    let irregular = |radius: f64| {
        let sun = 20f64.to_radians();
        let shape = Shape::raindrop(radius, RaindropModel::BeardChuang1987, sun).unwrap();
        let tracer = Tracer::new(&shape, index, x, 1).with_curved_interface(x);
        let settings = FarFieldSettings {
            size_parameter: x,
            orders: &[1],
            tolerance: 0.01,
            diffraction: false,
            checked: true,
            azimuths: &azimuths,
        };
        FarField::meridians(&tracer, &settings).irregular().to_vec()
    };
    assert_eq!(irregular(0.5e-3), Vec::<u32>::new());
    assert_eq!(irregular(2e-3), [1]);
}

/// External reflection is strongest at the rim, where launch points end: as beams it was wrong by more
/// than itself. Where its meridians are tangled, plain rays serve.
#[test]
fn tangled_reflection_is_that_of_plain_rays() {
    let x = TAU * 3e-3 / 650e-9;
    let shape = Shape::raindrop(3e-3, RaindropModel::BeardChuang1987, 20f64.to_radians()).unwrap();
    let tracer = Tracer::new(&shape, Complex64::new(1.3314, 0.0), x, 0).with_curved_interface(x);
    let phi = 0.7;
    let settings = FarFieldSettings {
        size_parameter: x,
        orders: &[0],
        tolerance: 0.01,
        diffraction: false,
        checked: true,
        azimuths: &[phi],
    };
    let tangled = FarField::meridians(&tracer, &settings);
    assert_eq!(tangled.irregular(), [0]);
    let wavefront = Wavefront::corners(&shape, 300, 600, 0.01);
    let plain = FarField::patches(&shape, sheets(&tracer, &wavefront, &[0]), x);
    let directions: Vec<(f64, f64)> =
        angles(30.0, 150.0, 240).into_iter().map(|theta| (theta, phi)).collect();
    let error = error(&tangled.scatter(&directions, false), &plain.scatter(&directions, false));
    println!("3 mm, order 0: {:.2} %", 1e2 * error);
    assert!(error < 0.1, "{error}");
}
