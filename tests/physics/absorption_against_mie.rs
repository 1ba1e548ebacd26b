//! Absorption in the ray engine against the exact series: a sphere of x = 5000, k = 0 … 1e-3.
//!
//! Absorption enters as `exp(-k₀ κ d)` along every chord, as complex Fresnel coefficients, and as
//! absorbed power in the budget. It must not make the rays less exact than they are without it.

use gonio::plan::{Engine, Plan, last_order};
use gonio::series::debye::{DebyeSeries, Term};
use gonio::series::lorenz_mie::Sphere;
use gonio::shape::Shape;
use gonio::simulate;
use gonio::trace::{Tracer, Wavefront, energy_by_fate};
use num_complex::Complex64;
use std::f64::consts::PI;

const X: f64 = 5000.0;
const EXTINCTIONS: [f64; 5] = [0.0, 1e-6, 1e-5, 1e-4, 1e-3];

fn index(k: f64) -> Complex64 {
    Complex64::new(1.333, k)
}

fn grid(from: f64, to: f64, step: f64) -> Vec<f64> {
    let count = ((to - from) / step).round() as usize;
    (0..=count).map(|i| (from + i as f64 * step).to_radians()).collect()
}

fn plan(orders: Vec<u32>, diffraction: bool) -> Plan {
    Plan::direct(Shape::sphere(), 1.0, Engine::Meridians, orders, diffraction, 0.01, None)
}

/// Intensities of unpolarised light by rays.
fn rays(plan: &Plan, k: f64, theta: &[f64]) -> Vec<f64> {
    let directions: Vec<(f64, f64)> = theta.iter().map(|&t| (t, 0.0)).collect();
    simulate::scatter(plan, index(k), X, &directions).iter().map(|s| s.s11()).collect()
}

fn intensity((s1, s2): &(Complex64, Complex64)) -> f64 {
    0.5 * (s1.norm_sqr() + s2.norm_sqr())
}

/// Relative L2 error.
fn error(found: &[f64], exact: &[f64]) -> f64 {
    let square = |values: &mut dyn Iterator<Item = f64>| values.map(|v| v * v).sum::<f64>();
    let off = square(&mut found.iter().zip(exact).map(|(a, b)| a - b));
    (off / square(&mut exact.iter().copied())).sqrt()
}

/// All orders against Lorenz–Mie: no more than 1.5 times the error of the clear sphere.
#[test]
fn all_orders_are_no_worse_than_without_absorption() {
    let plan = plan((0..=last_order(1.333, 0.01)).collect(), true);
    for (name, theta) in [
        ("10–165°", grid(10.0, 165.0, 0.05)),
        ("0.5–10°", grid(0.5, 10.0, 0.02)),
        ("10–15°", grid(10.0, 15.0, 0.02)),
        ("15–165°", grid(15.0, 165.0, 0.05)),
        ("120–150°", grid(120.0, 150.0, 0.02)),
    ] {
        let errors: Vec<f64> = EXTINCTIONS
            .iter()
            .map(|&k| {
                let sphere = Sphere::new(X, index(k)).unwrap();
                let exact: Vec<f64> =
                    sphere.amplitudes_parallel(&theta).iter().map(intensity).collect();
                error(&rays(&plan, k, &theta), &exact)
            })
            .collect();
        println!("{name}: k = {EXTINCTIONS:?}: {errors:.4?}");
        for (k, found) in EXTINCTIONS.iter().zip(&errors) {
            assert!(*found <= 1.5 * errors[0], "{name} k {k:e}: {found} clear {}", errors[0]);
        }
    }
}

/// One order alone against its Debye term: the primary bow, and transmission.
#[test]
fn single_orders_are_no_worse_than_without_absorption() {
    for (order, from, to) in [(2, 135.5, 150.0), (1, 0.0, 40.0)] {
        let (plan, theta) = (plan(vec![order], false), grid(from, to, 0.05));
        let errors: Vec<f64> = EXTINCTIONS[..4]
            .iter()
            .map(|&k| {
                let series = DebyeSeries::new(X, index(k)).unwrap();
                let exact: Vec<f64> =
                    series.amplitudes(Term::Order(order), &theta).iter().map(intensity).collect();
                error(&rays(&plan, k, &theta), &exact)
            })
            .collect();
        println!("p = {order}: k = {:?}: {errors:.5?}", &EXTINCTIONS[..4]);
        for (k, found) in EXTINCTIONS.iter().zip(&errors) {
            assert!(*found <= 1.5 * errors[0], "p {order} k {k:e}: {found} clear {}", errors[0]);
        }
    }
}

/// Absorption and extinction with what tunnels in beyond the edge: Q_abs within 1 % for every k,
/// Q_ext within 0.2 % (the ripple of a clear sphere's resonances is 0.07 %).
#[test]
fn cross_sections_are_those_of_the_series() {
    let all = plan((0..=last_order(1.333, 0.01)).collect(), true);
    let shape = Shape::sphere();
    for k in EXTINCTIONS {
        let tracer = Tracer::new(&shape, index(k), X, last_order(1.333, 0.01));
        let fates = energy_by_fate(&tracer, &Wavefront::midpoints(&shape, 100, 4));
        let seen =
            simulate::scatter_with_sections(&all, index(k), X, &[(0.5, 0.0)], fates.absorbed, None);
        let sections = seen.unwrap().sections;
        let (q_ext, q_abs) = (sections.extinction / PI, sections.absorption / PI);
        let exact = Sphere::new(X, index(k)).unwrap().efficiencies();
        println!(
            "k {k:e}: Q_ext {q_ext:.5} ({:.5}), Q_abs {q_abs:.6} ({:.6})",
            exact.q_ext, exact.q_abs
        );
        assert!((q_ext / exact.q_ext - 1.0).abs() < 0.002, "k {k:e}: Q_ext {q_ext}");
        assert!((q_abs - exact.q_abs).abs() <= 0.01 * exact.q_abs, "k {k:e}: Q_abs {q_abs}");
    }
}

/// Absorbed power of the rays' budget against Q_abs, and nothing where k = 0.
#[test]
fn absorbed_power_is_that_of_the_series() {
    let shape = Shape::sphere();
    for k in EXTINCTIONS {
        let tracer = Tracer::new(&shape, index(k), X, last_order(1.333, 0.01));
        let fates = energy_by_fate(&tracer, &Wavefront::midpoints(&shape, 100, 4));
        let exact = Sphere::new(X, index(k)).unwrap().efficiencies().q_abs;
        println!("k {k:e}: rays {:.6}, series {exact:.6}", fates.absorbed);
        if k == 0.0 {
            assert_eq!(fates.absorbed, 0.0);
        } else {
            let ratio = fates.absorbed / exact;
            // At k = 1e-6 the waves that pass beyond the rim and tunnel in stay for many rounds,
            // and hold 1.5 % of what is absorbed; no ray stands for them (the test before has them).
            let bound = if k < 2e-6 { 0.017 } else { 0.01 };
            assert!((ratio - 1.0).abs() < bound, "k {k:e}: {ratio}");
        }
        assert!(fates.residual.abs() < 1e-6 + 10.0 * k, "k {k:e}: {:e}", fates.residual);
    }
}
