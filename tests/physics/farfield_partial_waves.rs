//! Orders of small particles as sums over partial waves from rays, against Debye terms: a sphere, and one
//! flattened by 1e-7 with the light aslant, over all scattering angles and both amplitudes.

use gonio::farfield::PartialWaves;
use gonio::farfield::WaveField;
use gonio::farfield::assignment::Thresholds;
use gonio::optics::AmplitudeMatrix;
use gonio::plan::{Engine, Plan};
use gonio::series::debye::{DebyeSeries, Term};
use gonio::shape::Shape;
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
