//! One drop, one answer.
//!
//! Figures: `cargo test --release --test physics one_drop:: -- --nocapture`.

use gonio::shape::{RaindropModel, Shape};
use gonio::trace::{Tracer, Wavefront, energy_by_fate};
use num_complex::Complex64;
use std::f64::consts::TAU;

const INDEX: Complex64 = Complex64::new(1.3314, 0.0);

fn size_parameter(radius_mm: f64) -> f64 {
    TAU * radius_mm * 1e-3 / 650e-9
}

/// The surface of large drops has a hollow below, which rays leave and must not be found beyond of.
#[test]
fn rays_of_large_drops_lose_nothing() {
    let mut worst = (0.0f64, 0.0, 0.0);
    for radius in [2.9, 3.2, 3.3, 3.5, 3.7, 3.9, 4.0, 4.1, 4.3, 4.5] {
        for sun in [-90.0, -60.0, -30.0, 0.0, 20.0, 50.0, 90.0f64] {
            let model = RaindropModel::ChuangBeard1990;
            let shape = Shape::raindrop(radius * 1e-3, model, sun.to_radians()).unwrap();
            let tracer = Tracer::new(&shape, INDEX, size_parameter(radius), 7);
            let fates = energy_by_fate(&tracer, &Wavefront::midpoints(&shape, 60, 60));
            if fates.residual.abs() > worst.0 {
                worst = (fates.residual.abs(), radius, sun);
            }
        }
    }
    println!("light unaccounted for: {:.1e} at {} mm, sun {}°", worst.0, worst.1, worst.2);
    assert!(worst.0 < 1e-6, "{worst:?}");
}
