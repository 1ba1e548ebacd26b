//! Orders of small particles as sums over partial waves from rays, against Debye terms: a sphere, and one
//! flattened by 1e-7 with the light aslant, over all scattering angles and both amplitudes.

use gonio::farfield::assignment::Thresholds;
use gonio::farfield::{FarField, FarFieldSettings, PartialWaves, WaveField};
use gonio::optics::AmplitudeMatrix;
use gonio::plan::{Engine, Plan};
use gonio::series::debye::{DebyeSeries, Term};
use gonio::shape::{RaindropModel, Shape};
use gonio::simulate;
use gonio::trace::Tracer;
use num_complex::Complex64;
use std::f64::consts::PI;

/// Relative L2 error of one order from 0 to 180°.
fn error(shape: &Shape, order: u32, x: f64) -> f64 {
    let index = Complex64::new(1.333, 0.0);
    let tracer = Tracer::new(shape, index, x, order).with_curved_interface(x);
    let (waves, missed) = PartialWaves::new(&tracer, &[order], x, &Thresholds::MEASURED);
    assert!(missed.is_empty());
    let theta: Vec<f64> = (0..=1000).map(|k| PI * f64::from(k) / 1000.0).collect();
    let mut found = vec![AmplitudeMatrix::default(); theta.len()];
    waves.add(&theta, 0.3, &mut found);
    let exact = DebyeSeries::new(x, index).unwrap().amplitudes(Term::Order(order), &theta);
    let off = |(f, (s1, s2)): (&AmplitudeMatrix, &(Complex64, Complex64))| {
        (f.s1 - s1).norm_sqr() + (f.s2 - s2).norm_sqr() + f.s3.norm_sqr() + f.s4.norm_sqr()
    };
    let wrong: f64 = found.iter().zip(&exact).map(off).sum();
    let all: f64 = exact.iter().map(|(s1, s2)| s1.norm_sqr() + s2.norm_sqr()).sum();
    (wrong / all).sqrt()
}

#[test]
fn partial_waves_from_rays_reproduce_debye_terms() {
    let shapes = [Shape::sphere(), Shape::spheroid(1.0 - 1e-7, 0.5).unwrap()];
    for (x, bounds) in [
        (50.0, [0.006, 0.056, 0.084, 0.13, 0.15, 0.20, 0.19]),
        (300.0, [0.001, 0.009, 0.015, 0.032, 0.031, 0.033, 0.036]),
    ] {
        for (order, bound) in (1..).zip(bounds) {
            for shape in &shapes {
                let error = error(shape, order, x);
                println!("x = {x}, p = {order}: {:.2} %", 1e2 * error);
                assert!(error < bound, "x = {x}, p = {order}: {error}");
            }
        }
    }
}

/// Shapes far from a sphere: orders whose rays cannot be followed that way are left to others, and all
/// amplitudes are finite.
#[test]
fn strongly_deformed_particles_have_finite_waves() {
    let index = Complex64::new(1.333, 0.0);
    for axis_ratio in [0.2, 0.3, 0.6, 1.5, 3.0, 5.0] {
        for x in [20.0, 200.0] {
            let shape = Shape::spheroid(axis_ratio, 0.35).unwrap();
            let orders = (0..=7).collect();
            let plan = Plan::direct(shape, 1.0, Engine::Meridians, orders, true, 0.01, None);
            let directions: Vec<(f64, f64)> =
                (0..=36).map(|k| (PI * f64::from(k) / 36.0, 0.7)).collect();
            let found = simulate::scatter(&plan, index, x, &directions);
            assert!(found.iter().all(|s| s.s11().is_finite()), "axis ratio {axis_ratio}, x = {x}");
            assert!(found[0].s11() > found[18].s11(), "axis ratio {axis_ratio}, x = {x}");
        }
    }
}

/// Behind the last ray of orders 1 and 3 of nearly round drops: waves of planes with an integral over rays near the
/// rim against sums over partial waves, whose rays are traced along other lines. Power in bands of 3°; without that
/// integral nothing is there of order 1, and of order 3 half is missing.
#[test]
fn penumbras_of_nearly_round_drops_are_those_of_partial_waves() {
    const IN_BAND: usize = 40;
    const X: f64 = 601.0;
    let index = Complex64::new(1.3314, 0.0);
    let power = |found: &[AmplitudeMatrix]| -> Vec<f64> {
        found.chunks(IN_BAND).map(|band| band.iter().map(AmplitudeMatrix::s11).sum()).collect()
    };
    for (radius, order, [from, to], bound) in [
        (0.41, 1, [60.0, 99.0], 0.02),
        (0.5, 1, [60.0, 90.0], 0.07),
        (0.41, 3, [90.0, 117.0], 0.02),
        (0.5, 3, [90.0, 117.0], 0.06),
    ] {
        let shape =
            Shape::raindrop(radius * 1e-3, RaindropModel::BeardChuang1987, PI / 9.0).unwrap();
        let tracer = Tracer::new(&shape, index, X, order).with_curved_interface(X);
        let bands = (to - from) / 3.0;
        let count = bands as usize * IN_BAND;
        let theta: Vec<f64> = (0..count)
            .map(|i| (from + (to - from) * (i as f64 + 0.5) / count as f64).to_radians())
            .collect();
        let (waves, missed) = PartialWaves::new(&tracer, &[order], X, &Thresholds::MEASURED);
        assert!(missed.is_empty());
        let settings = FarFieldSettings {
            size_parameter: X,
            orders: &[order],
            tolerance: 0.01,
            diffraction: false,
        };
        let planes = FarField::meridians(&tracer, &settings);
        for phi in [0.7, 2.5] {
            let mut exact = vec![AmplitudeMatrix::default(); count];
            waves.add(&theta, phi, &mut exact);
            let line: Vec<(f64, f64)> = theta.iter().map(|&t| (t, phi)).collect();
            let found = power(&planes.scatter(&line, false));
            let off = found.iter().zip(power(&exact)).map(|(f, e)| (f / e - 1.0).abs());
            let worst = off.fold(0.0, f64::max);
            println!("{radius} mm, p = {order}, φ = {phi}: {:.1} %", 1e2 * worst);
            assert!(worst < bound, "{radius} mm, p = {order}, φ = {phi}: {worst}");
        }
    }
}
