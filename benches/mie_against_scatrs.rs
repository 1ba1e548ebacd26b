//! Lorenz–Mie against the fastest other program known, scatrs 0.3, on one thread and in one run:
//! efficiencies and S1, S2 at 1801 angles (0 … 180° by 0.1°) for several size parameters.
//!
//! `cargo bench --bench mie_against_scatrs` prints a table; the best of several alternating
//! repetitions counts, so that other load on the machine hurts both alike.

use gonio::series::lorenz_mie::Sphere;
use num_complex::{Complex, Complex64};
use scatrs::mie::{AmplitudeBuffers, Mie, MieOptions};
use std::hint::black_box;
use std::time::Instant;

const ANGLES: usize = 1801;
const INDEX: Complex64 = Complex64::new(1.333, 0.0);

fn ours(x: f64, theta: &[f64]) -> Vec<(Complex64, Complex64)> {
    let sphere = Sphere::new(x, INDEX).expect("the bench asks for valid spheres");
    black_box(sphere.efficiencies());
    sphere.amplitudes(theta)
}

fn theirs(x: f64, mu: &[f64]) -> Vec<(Complex64, Complex64)> {
    let mut mie = Mie::<f64>::new();
    let mut s1 = vec![Complex::new(0.0, 0.0); mu.len()];
    let mut s2 = s1.clone();
    let solution = mie
        .compute(x, INDEX, &MieOptions::new().with_allow_unvalidated(true))
        .expect("valid input");
    black_box(solution.efficiencies());
    let buffers = AmplitudeBuffers { s1: &mut s1, s2: &mut s2 };
    solution.amplitudes(mu, buffers).expect("valid input");
    s1.into_iter().zip(s2).collect()
}

fn seconds(work: impl FnOnce() -> Vec<(Complex64, Complex64)>) -> f64 {
    let start = Instant::now();
    black_box(work());
    start.elapsed().as_secs_f64()
}

fn main() {
    let step = std::f64::consts::PI / (ANGLES - 1) as f64;
    let theta: Vec<f64> = (0..ANGLES).map(|i| i as f64 * step).collect();
    let mu: Vec<f64> = theta.iter().map(|t| t.cos()).collect();
    println!("|       x | gonio (s) | scatrs (s) | ratio | median difference |");
    println!("|---------|-----------|------------|-------|-------------------|");
    for x in [10.0, 100.0, 1000.0, 5000.0, 10_000.0, 50_000.0] {
        let (mut best, mut other) = (f64::INFINITY, f64::INFINITY);
        for _ in 0..if x > 1e4 { 5 } else { 15 } {
            best = best.min(seconds(|| ours(x, &theta)));
            other = other.min(seconds(|| theirs(x, &mu)));
        }
        let mut differences: Vec<f64> = ours(x, &theta)
            .iter()
            .zip(theirs(x, &mu))
            .map(|(a, b)| (a.0 - b.0).norm() / a.0.norm())
            .collect();
        differences.sort_by(f64::total_cmp);
        let median = differences[ANGLES / 2];
        println!("| {x:7} | {best:9.6} | {other:10.6} | {:5.1} | {median:17.1e} |", other / best);
    }
}
