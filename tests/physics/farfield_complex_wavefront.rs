//! The sum on a complex wavefront against Debye terms of the sphere, and against itself with the wavefront
//! elsewhere (against an independent sum: `one_drop`).

use gonio::farfield::FarField;
use gonio::farfield::FarFieldSettings;
use gonio::farfield::{ComplexWavefront, PLACE, Place, sheets};
use gonio::optics::AmplitudeMatrix;
use gonio::series::debye::{DebyeSeries, Term};
use gonio::shape::{RaindropModel, Shape};
use gonio::trace::{Tracer, Wavefront};
use num_complex::Complex64;
use std::f64::consts::TAU;

const INDEX: Complex64 = Complex64::new(1.3314, 0.0);

fn angles(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..=count).map(|i| (from + (to - from) * i as f64 / count as f64).to_radians()).collect()
}

fn size_parameter(radius_mm: f64) -> f64 {
    TAU * radius_mm * 1e-3 / 650e-9
}

fn raindrop(radius_mm: f64) -> Shape {
    let sun = 20f64.to_radians();
    Shape::raindrop(radius_mm * 1e-3, RaindropModel::BeardChuang1987, sun).unwrap()
}

fn sum(tracer: &Tracer, order: u32, x: f64, theta: &[f64], phi: f64) -> Vec<AmplitudeMatrix> {
    ComplexWavefront::new(tracer, order, x).columns(theta, &[phi]).swap_remove(0)
}

/// Relative L2 error of the whole amplitude matrix.
fn error(found: &[AmplitudeMatrix], truth: &[AmplitudeMatrix]) -> f64 {
    let off: f64 = found.iter().zip(truth).map(|(f, t)| (*f - *t).s11()).sum();
    (off / truth.iter().map(AmplitudeMatrix::s11).sum::<f64>()).sqrt()
}

/// Bright and dark sides of bows, plain rays and the axis; orders from 4 on are summed less finely. Where the
/// last rays contribute (order 2 from 150°, order 3 about its bow, whole bows from order 4 on) the wave ends with
/// them: a known defect.
#[test]
fn debye_terms_of_the_sphere() {
    let cases = [
        (1u32, 5000.0, 1.0, 60.0, 0.0035),
        (1, 20000.0, 1.0, 75.0, 0.0015),
        (2, 5000.0, 136.0, 148.0, 0.0055),
        (2, 20000.0, 136.5, 146.0, 0.0015),
        (2, 50000.0, 137.0, 146.0, 0.001),
        (2, 5000.0, 150.0, 175.0, 0.09),
        (3, 5000.0, 20.0, 90.0, 0.0015),
        (3, 5000.0, 118.0, 130.0, 0.05),
        (4, 5800.0, 62.0, 165.0, 0.02),
        (5, 5800.0, 105.0, 178.0, 0.02),
        (7, 5800.0, 1.0, 75.0, 0.02),
    ];
    for (order, x, from, to, bound) in cases {
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, INDEX, x, order).with_curved_interface(x);
        let theta = angles(from, to, 300);
        let exact: Vec<AmplitudeMatrix> = DebyeSeries::new(x, INDEX)
            .unwrap()
            .sum_parallel(&[Term::Order(order)], &theta)
            .iter()
            .map(|&(s1, s2)| AmplitudeMatrix { s1, s2, ..Default::default() })
            .collect();
        let error = error(&sum(&tracer, order, x, &theta, 0.7), &exact);
        println!("p = {order}, x = {x}, {from}–{to}°: {:.3} %", 1e2 * error);
        assert!(error < bound, "p = {order}, x = {x}, {from}–{to}°: {error}");
    }
}

/// Where the wavefront stands is nobody's business: what changes with it is error.
#[test]
fn another_wavefront_gives_the_same_wave() {
    let elsewhere = Place { real: 0.1, imaginary: 0.4 };
    let cases = [
        (1.5, 2u32, 45.0, 130.0, 148.0, 0.01),
        (2.5, 1, 45.0, 5.0, 60.0, 0.01),
        (3.0, 2, 135.0, 120.0, 175.0, 0.03),
    ];
    for (radius, order, azimuth, from, to, bound) in cases {
        let (shape, x) = (raindrop(radius), size_parameter(radius));
        let tracer = Tracer::new(&shape, INDEX, x, order).with_curved_interface(x);
        let (theta, phi) = (angles(from, to, 400), f64::to_radians(azimuth));
        let at = |place| {
            let wavefront = ComplexWavefront::at(&tracer, order, x, place);
            wavefront.columns(&theta, &[phi]).swap_remove(0)
        };
        let error = error(&at(elsewhere), &at(PLACE));
        println!("{radius} mm, p = {order}, {azimuth}°: {:.3} %", 1e2 * error);
        assert!(error < bound, "{radius} mm, p = {order}: {error}");
    }
}

/// A direction's wave does not depend on which others are asked for.
#[test]
fn directions_do_not_depend_on_each_other() {
    let (shape, x) = (raindrop(2.0), size_parameter(2.0));
    let tracer = Tracer::new(&shape, INDEX, x, 3).with_curved_interface(x);
    let wavefront = ComplexWavefront::new(&tracer, 3, x);
    let azimuths = [0.0, 0.3, 0.576, 2.0, 3.1];
    let columns = wavefront.columns(&angles(0.0, 180.0, 360), &azimuths);
    let typical = columns.iter().flatten().map(AmplitudeMatrix::s11).sum::<f64>();
    let typical = (typical / (361.0 * 5.0)).sqrt();
    for (&phi, column) in azimuths.iter().zip(&columns) {
        for i in [0, 100, 231, 290, 360] {
            let theta = (0.5 * i as f64).to_radians();
            let alone = wavefront.columns(&[theta], &[phi]).swap_remove(0)[0];
            let off = (alone - column[i]).s11().sqrt();
            assert!(off < 1e-3 * typical, "{phi}, {}: {off} of {typical}", 0.5 * i as f64);
        }
    }
}

/// External reflection is strongest at the rim, where launch points end. Where its scattering planes
/// do not correspond, plain rays serve.
#[test]
fn disordered_reflection_is_that_of_plain_rays() {
    let (shape, x) = (raindrop(3.0), size_parameter(3.0));
    let tracer = Tracer::new(&shape, INDEX, x, 0).with_curved_interface(x);
    let phi = 0.7;
    let settings =
        FarFieldSettings { size_parameter: x, orders: &[0], tolerance: 0.01, diffraction: false };
    let found = FarField::meridians(&tracer, &settings);
    assert_eq!(found.irregular(), [0]);
    let wavefront = Wavefront::corners(&shape, 300, 600, 0.01);
    let plain = FarField::patches(&shape, sheets(&tracer, &wavefront, &[0]), x);
    let directions: Vec<(f64, f64)> =
        angles(30.0, 150.0, 240).into_iter().map(|theta| (theta, phi)).collect();
    let error = error(&found.scatter(&directions, false), &plain.scatter(&directions, false));
    println!("3 mm, order 0: {:.2} %", 1e2 * error);
    assert!(error < 0.1, "{error}");
}
