//! The brute-force sum against Debye terms on the sphere, and the ray engine against the sum on
//! particles that are no spheres: the tables of `validation/engine.md`.
//!
//! `cargo run --release --example huygens_fresnel -- sphere|raindrop|spheroid`

use gonio::farfield::FarFieldSettings;
use gonio::farfield::{Direction, FarField};
use gonio::farfield::{HuygensFresnel, Wave};
use gonio::optics::AmplitudeMatrix;
use gonio::series::debye::{DebyeSeries, Term};
use gonio::shape::{RaindropModel, Shape};
use gonio::trace::Tracer;
use num_complex::Complex64;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    match std::env::args().nth(1).as_deref() {
        Some("sphere") => sphere(),
        Some("raindrop") => raindrop(),
        _ => Err("one of: sphere, raindrop".into()),
    }
}

fn angles(from: f64, to: f64, step: f64) -> Vec<f64> {
    let count = ((to - from) / step).round() as usize;
    (0..=count).map(|i| (from + i as f64 * step).to_radians()).collect()
}

fn l2(found: impl Iterator<Item = Complex64>, exact: impl Iterator<Item = Complex64>) -> f64 {
    let (mut error, mut norm) = (0.0, 0.0);
    for (f, e) in found.zip(exact) {
        error += (f - e).norm_sqr();
        norm += e.norm_sqr();
    }
    (error / norm).sqrt()
}

/// One order of the sphere against its exact Debye term.
fn sphere() -> Result<(), Box<dyn std::error::Error>> {
    println!("p | x | θ | rings | coefficients | S1 | S2 | clearance | ms per direction");
    let cases = [
        (2, 5000.0, 136.0, 144.0, 1.0),
        (2, 5000.0, 136.0, 144.0, 1.5),
        (2, 1000.0, 134.0, 146.0, 1.0),
        (3, 5000.0, 123.0, 131.0, 1.0),
    ];
    for (order, x, from, to, finer) in cases {
        let index = Complex64::new(1.333, 0.0);
        let theta = angles(from, to, 0.1);
        let exact = DebyeSeries::new(x, index)?.amplitudes(Term::Order(order), &theta);
        let directions: Vec<_> = theta.iter().map(|&t| Direction::new(t, 0.7)).collect();
        let mut sum = HuygensFresnel::new(x, order);
        sum.rings = (sum.rings as f64 * finer) as usize;
        sum.spokes = 2 * sum.rings;
        for curved in [false, true] {
            let shape = Shape::sphere();
            let mut tracer = Tracer::new(&shape, index, x, order);
            if curved {
                tracer = tracer.with_curved_interface(x);
            }
            let start = Instant::now();
            let waves = sum.amplitudes(&tracer, &directions);
            let ms = 1e3 * start.elapsed().as_secs_f64() / theta.len() as f64;
            let s1 = l2(waves.iter().map(|w| w.amplitude.s1), exact.iter().map(|e| e.0));
            let s2 = l2(waves.iter().map(|w| w.amplitude.s2), exact.iter().map(|e| e.1));
            let clear = waves.iter().map(|w| w.clearance).fold(f64::INFINITY, f64::min);
            let name = if curved { "curved" } else { "Fresnel" };
            println!(
                "{order} | {x} | {from}–{to} | {} | {name} | {:.3} % | {:.3} % | {clear:.3} | {ms:.1}",
                sum.rings,
                100.0 * s1,
                100.0 * s2
            );
        }
    }
    Ok(())
}

/// Amplitudes of the ray engine, one order.
fn engine(tracer: &Tracer, x: f64, order: u32, theta: &[f64], phi: f64) -> Vec<AmplitudeMatrix> {
    let settings = FarFieldSettings {
        size_parameter: x,
        orders: &[order],
        tolerance: 0.01,
        diffraction: false,
    };
    let far_field = FarField::meridians(tracer, &settings);
    let directions: Vec<(f64, f64)> = theta.iter().map(|&t| (t, phi)).collect();
    if !far_field.irregular().is_empty() {
        print!("(patches) ");
    }
    far_field.scatter(&directions, false)
}

/// The primary bow of a raindrop of 0.5 mm, sun at 20°, 650 nm: the engine against the sum.
fn raindrop() -> Result<(), Box<dyn std::error::Error>> {
    let sun = 20f64.to_radians();
    let (radius, wavelength) = (0.5e-3, 650e-9);
    let x = std::f64::consts::TAU * radius / wavelength;
    let index = Complex64::new(1.3314, 0.0);
    let shape = Shape::raindrop(radius, RaindropModel::BeardChuang1987, sun)?;
    let tracer = Tracer::new(&shape, index, x, 2).with_curved_interface(x);
    println!("azimuth | θ | S1 | S2 | S3 | S4 | S11 (l2) | S11 worst at θ | clearance");
    for azimuth in [0.0f64, 20.0, 40.0, 90.0, 135.0, 180.0] {
        for (from, to) in [(134.0, 138.0), (138.0, 148.0)] {
            let theta = angles(from, to, 0.1);
            let phi = azimuth.to_radians();
            let directions: Vec<_> = theta.iter().map(|&t| Direction::new(t, phi)).collect();
            let waves = HuygensFresnel::new(x, 2).amplitudes(&tracer, &directions);
            let found = engine(&tracer, x, 2, &theta, phi);
            report(azimuth, (from, to), &theta, &found, &waves);
        }
    }
    Ok(())
}

fn report(
    azimuth: f64,
    span: (f64, f64),
    theta: &[f64],
    found: &[AmplitudeMatrix],
    waves: &[Wave],
) {
    let all = |f: fn(&AmplitudeMatrix) -> Complex64| {
        l2(found.iter().map(f), waves.iter().map(|w| f(&w.amplitude)))
    };
    // cross terms relative to the whole matrix, since they may vanish
    let whole: f64 = waves.iter().map(|w| 2.0 * w.amplitude.s11()).sum::<f64>().sqrt();
    let cross = |f: fn(&AmplitudeMatrix) -> Complex64| {
        let square: f64 =
            found.iter().zip(waves).map(|(a, w)| (f(a) - f(&w.amplitude)).norm_sqr()).sum();
        square.sqrt() / whole
    };
    let real = |v: f64| Complex64::new(v, 0.0);
    let s11 =
        l2(found.iter().map(|s| real(s.s11())), waves.iter().map(|w| real(w.amplitude.s11())));
    let largest = waves.iter().map(|w| w.amplitude.s11()).fold(0.0, f64::max);
    let worst = found
        .iter()
        .zip(waves)
        .map(|(s, w)| (s.s11() - w.amplitude.s11()).abs() / largest)
        .enumerate()
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap_or_default();
    let clear = waves.iter().map(|w| w.clearance).fold(f64::INFINITY, f64::min);
    println!(
        "{azimuth} | {}–{} | {:.3} % | {:.3} % | {:.3} % | {:.3} % | {:.3} % | {:.3} % at {:.1} | {clear:.3}",
        span.0,
        span.1,
        100.0 * all(|s| s.s1),
        100.0 * all(|s| s.s2),
        100.0 * cross(|s| s.s3),
        100.0 * cross(|s| s.s4),
        100.0 * s11,
        100.0 * worst.1,
        theta[worst.0].to_degrees()
    );
}
