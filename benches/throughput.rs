//! Rates of the ray engine: rays traced per second and core, directions answered per second.
//!
//! `cargo bench --bench throughput`; figures are rates, not verdicts.

use gonio::farfield::FarFieldSettings;
use gonio::farfield::sheets;
use gonio::farfield::{Direction, FarField};
use gonio::shape::{RaindropModel, Shape};
use gonio::trace::{Tracer, Wavefront};
use num_complex::Complex64;
use std::hint::black_box;
use std::time::Instant;

fn main() {
    let sun = 20f64.to_radians();
    let Ok(shape) = Shape::raindrop(0.5e-3, RaindropModel::BeardChuang1987, sun) else { return };
    let (index, size) = (Complex64::new(1.3317, 0.0), 4833.0);
    trace_rate(&shape, index);
    patch_rate(&shape, index, size);
    column_rate(&shape, index, size);
}

/// Rays with differentials, up to order 2, on one core.
fn trace_rate(shape: &Shape, index: Complex64) {
    let tracer = Tracer::new(shape, index, 1.0, 2);
    let wavefront = Wavefront::corners(shape, 150, 300, 0.0);
    let start = Instant::now();
    for n in 0..wavefront.len() {
        let (u, v) = wavefront.vertex(n);
        tracer.trace(u, v, |exit| {
            black_box(exit);
        });
    }
    let seconds = start.elapsed().as_secs_f64();
    println!(
        "rays (p = 0, 1, 2, differentials), one core: {:.3e} /s",
        wavefront.len() as f64 / seconds
    );
}

/// Scattered directions from the collecting sphere, one core.
fn patch_rate(shape: &Shape, index: Complex64, size: f64) {
    let tracer = Tracer::new(shape, index, 1.0, 3);
    let wavefront = Wavefront::corners(shape, 200, 400, 0.0123);
    let start = Instant::now();
    let sheets = sheets(&tracer, &wavefront, &[0, 1, 2, 3]);
    let far_field = FarField::patches(shape, sheets, size);
    println!("patches of 4 orders, traced and sorted: {:.2} s", start.elapsed().as_secs_f64());
    let golden = 2.399963229728653;
    let directions: Vec<(f64, f64)> = (0..40_000)
        .map(|i| {
            (
                (1.0 - (i as f64 + 0.5) / 20_000.0).acos(),
                (i as f64 * golden) % std::f64::consts::TAU,
            )
        })
        .collect();
    let start = Instant::now();
    black_box(far_field.scatter(&directions, false));
    let rate = directions.len() as f64 / start.elapsed().as_secs_f64();
    println!("directions from the collecting sphere, one core: {rate:.3e} /s");
    black_box(Direction::new(1.0, 1.0));
}

/// Samples of table columns by meridians (orders 0 to 3), one core.
fn column_rate(shape: &Shape, index: Complex64, size: f64) {
    let tracer = Tracer::new(shape, index, size, 3).with_curved_interface(size);
    let orders = [0, 1, 2, 3];
    let settings = FarFieldSettings {
        size_parameter: size,
        orders: &orders,
        tolerance: 0.01,
        diffraction: false,
    };
    let start = Instant::now();
    let far_field = FarField::meridians(&tracer, &settings);
    println!("meridians of 4 orders, all cores: {:.2} s", start.elapsed().as_secs_f64());
    let theta: Vec<f64> = (0..=1800).map(|i| (f64::from(i) * 0.1).to_radians()).collect();
    let start = Instant::now();
    for i in 0..50 {
        black_box(far_field.columns(&theta, &[0.06 * f64::from(i)], false));
    }
    let samples = 50.0 * theta.len() as f64;
    println!("samples by sweeping, one core: {:.3e} /s", samples / start.elapsed().as_secs_f64());
}
