//! The ray engine against exact solutions of the sphere: single orders against Debye terms, the
//! whole against Lorenz–Mie. Bounds stand just above what was measured.

use crate::support::{angles, relative_l2};
use gonio::farfield::FarField;
use gonio::farfield::FarFieldSettings;
use gonio::optics::AmplitudeMatrix;
use gonio::series::debye::{DebyeSeries, Term};
use gonio::series::lorenz_mie::Sphere;
use gonio::shape::Shape;
use gonio::trace::Tracer;
use num_complex::Complex64;

/// Amplitudes of the ray engine on a sphere, all at one azimuth.
fn rays(
    x: f64,
    m: Complex64,
    orders: &[u32],
    diffraction: bool,
    theta: &[f64],
) -> Vec<AmplitudeMatrix> {
    rays_of(&Shape::sphere(), x, m, orders, diffraction, theta)
}

/// The same on any particle.
fn rays_of(
    shape: &Shape,
    x: f64,
    m: Complex64,
    orders: &[u32],
    diffraction: bool,
    theta: &[f64],
) -> Vec<AmplitudeMatrix> {
    let last = orders.iter().copied().max().unwrap();
    let tracer = Tracer::new(shape, m, x, last).with_curved_interface(x);
    let settings = FarFieldSettings { size_parameter: x, orders, tolerance: 0.01, diffraction };
    let far_field = FarField::meridians(&tracer, &settings);
    assert!(far_field.irregular().is_empty());
    let directions: Vec<(f64, f64)> = theta.iter().map(|&t| (t, 0.4)).collect();
    far_field.scatter(&directions, diffraction)
}

/// Relative errors of S1 and S2.
fn errors(found: &[AmplitudeMatrix], exact: &[(Complex64, Complex64)]) -> [f64; 2] {
    [
        relative_l2(found.iter().zip(exact).map(|(s, e)| (s.s1, e.0))),
        relative_l2(found.iter().zip(exact).map(|(s, e)| (s.s2, e.1))),
    ]
}

/// On a sphere orders from 2 on are integrals over impacts near the rim; a spheroid that is all but a
/// sphere has plain rays and pairs of rays up to order 3.
#[test]
fn one_order_against_its_debye_term() {
    let m = Complex64::new(1.333, 0.0);
    let all_but_a_sphere = Shape::spheroid(1.0 - 1e-7, 0.5).unwrap();
    assert!(!all_but_a_sphere.rotational_symmetry());
    let cases = [
        (2u32, 5000.0, 135.5, 150.0, 0.008, 0.016),
        (2, 1000.0, 134.0, 146.0, 0.025, 0.05),
        (3, 5000.0, 123.0, 131.0, 0.012, 0.024),
        (1, 5000.0, 0.0, 40.0, 0.001, 0.002),
    ];
    for (p, x, from, to, bound1, bound2) in cases {
        let theta = angles(from, to, 0.02);
        let exact = DebyeSeries::new(x, m).unwrap().amplitudes(Term::Order(p), &theta);
        for (name, shape) in [("sphere", &Shape::sphere()), ("pairs", &all_but_a_sphere)] {
            let found = rays_of(shape, x, m, &[p], false, &theta);
            let [s1, s2] = errors(&found, &exact);
            println!(
                "{name}: p = {p}, x = {x}, {from}–{to}°: S1 {:.3} %, S2 {:.3} %",
                100.0 * s1,
                100.0 * s2
            );
            assert!(s1 <= bound1 && s2 <= bound2, "{name}: p = {p}, x = {x}: S1 {s1}, S2 {s2}");
        }
    }
}

/// Order 1 up to its last ray, which leaves where total reflection would begin, and in the penumbra beyond: light that
/// enters and leaves by tunnelling at the rim.
#[test]
fn order_1_about_its_last_ray() {
    for (x, index, bound) in [
        (300.0, 1.333, 0.005),
        (700.0, 1.333, 0.004),
        (5000.0, 1.333, 0.004),
        (2000.0, 1.1, 0.007),
        (1000.0, 1.7, 0.004),
    ] {
        let m = Complex64::new(index, 0.0);
        let last_ray = 2.0 * (1.0 / index).acos().to_degrees();
        let width = 60.0 / f64::cbrt(x);
        for (from, to) in [(-2.0, -1.0), (-1.0, 0.0), (0.0, 1.0), (1.0, 2.0)] {
            let theta = angles(last_ray + from * width, last_ray + to * width, 0.05);
            let exact = DebyeSeries::new(x, m).unwrap().amplitudes(Term::Order(1), &theta);
            let [s1, s2] = errors(&rays(x, m, &[1], false, &theta), &exact);
            let [low, high] = [from, to].map(|t| last_ray + t * width);
            let percent = [100.0 * s1, 100.0 * s2];
            println!("x = {x}, n = {index}, {low:.1}–{high:.1}°: S1, S2 off by {percent:.2?} %");
            assert!(s1 <= bound && s2 <= 1.5 * bound, "x = {x}, {low}–{high}°: S1 {s1}, S2 {s2}");
        }
    }
}

/// Where the integral over impacts takes over from single rays: what one leaves to the other is all that there is.
#[test]
fn order_1_where_the_integral_takes_over() {
    for (x, bound) in [(200.0, 0.03), (700.0, 0.012), (5000.0, 0.006)] {
        let m = Complex64::new(1.333, 0.0);
        for from in (0..80).step_by(10) {
            let theta = angles(f64::from(from), f64::from(from + 10), 0.05);
            let exact = DebyeSeries::new(x, m).unwrap().amplitudes(Term::Order(1), &theta);
            let [s1, s2] = errors(&rays(x, m, &[1], false, &theta), &exact);
            println!("x = {x}, from {from}°: S1 {:.2} %, S2 {:.2} %", 100.0 * s1, 100.0 * s2);
            assert!(s1 <= bound && s2 <= bound, "x = {x}, from {from}°: S1 {s1}, S2 {s2}");
        }
    }
}

/// About the axis, where rays of all azimuths meet: the glory of single orders, also the strong ones
/// whose bow lies there (11 and 24 for water), the rays that creep along the surface (order 2), and
/// rays that cross the axis.
#[test]
fn about_the_axis_against_debye_terms() {
    let cases = [
        (2u32, 5000.0, 1.3314, 160.0, 180.0, 0.003),
        (2, 1000.0, 1.3314, 160.0, 180.0, 0.02),
        (5, 5000.0, 1.3314, 160.0, 180.0, 0.015),
        (6, 5000.0, 1.3314, 160.0, 180.0, 0.012),
        (11, 5000.0, 1.3314, 160.0, 180.0, 0.01),
        (24, 5000.0, 1.3314, 160.0, 180.0, 0.015),
        (4, 5000.0, 1.3314, 0.0, 20.0, 0.01),
        (9, 5000.0, 1.3314, 0.0, 20.0, 0.005),
        (2, 2000.0, 1.7, 160.0, 180.0, 0.025),
        (5, 2000.0, 1.7, 160.0, 180.0, 0.015),
        (11, 1000.0, 1.3314, 160.0, 180.0, 0.04),
        (11, 50000.0, 1.3314, 178.0, 180.0, 0.01),
    ];
    for (p, x, index, from, to, bound) in cases {
        let m = Complex64::new(index, 0.0);
        let theta = angles(from, to, 0.02);
        let exact = DebyeSeries::new(x, m).unwrap().sum_parallel(&[Term::Order(p)], &theta);
        let [s1, s2] = errors(&rays(x, m, &[p], false, &theta), &exact);
        println!(
            "p = {p}, x = {x}, n = {index}, {from}–{to}°: S1 {:.3} %, S2 {:.3} %",
            100.0 * s1,
            100.0 * s2
        );
        assert!(s1 <= bound && s2 <= bound, "p = {p}, x = {x}, {from}–{to}: S1 {s1}, S2 {s2}");
    }
}

/// Diffraction and external reflection, joined at the edge of the shadow, against the sum of the
/// series' two terms (which do not converge one by one).
#[test]
fn edge_wave_against_the_debye_series() {
    let cases = [
        (20.0, 1.333, 0.0, 100.0, 0.009),
        (100.0, 1.333, 0.0, 10.0, 0.0005),
        (100.0, 1.333, 10.0, 60.0, 0.008),
        (100.0, 1.333, 60.0, 150.0, 0.045),
        (1000.0, 1.333, 0.0, 10.0, 0.0005),
        (5000.0, 1.333, 0.0, 1.0, 0.0005),
        (5000.0, 1.333, 1.0, 15.0, 0.001),
        (5000.0, 1.333, 15.0, 80.0, 0.005),
        (50000.0, 1.333, 0.1, 10.0, 0.0005),
        (5000.0, 1.1, 1.0, 15.0, 0.001),
        (5000.0, 2.0, 1.0, 15.0, 0.0012),
    ];
    for (x, index, from, to, bound) in cases {
        let m = Complex64::new(index, 0.0);
        let theta = angles(from, to, 0.02);
        let found = rays(x, m, &[0], true, &theta);
        let terms = [Term::Order(0), Term::Diffraction];
        let exact = DebyeSeries::new(x, m).unwrap().sum_parallel(&terms, &theta);
        let [s1, s2] = errors(&found, &exact);
        println!(
            "x = {x}, n = {index}, {from}–{to}°: S1 {:.3} %, S2 {:.3} %",
            100.0 * s1,
            100.0 * s2
        );
        assert!(s1 <= bound && s2 <= bound, "x = {x}, {from}–{to}: S1 {s1}, S2 {s2}");
    }
}

#[test]
fn all_orders_against_lorenz_mie() {
    let m = Complex64::new(1.3314, 0.0);
    let orders: Vec<u32> = (0..=7).collect();
    let cases = [
        (5000.0, 10.0, 165.0, 0.025),
        (5000.0, 128.0, 137.0, 0.05),
        (5000.0, 120.0, 150.0, 0.02),
        (12000.0, 120.0, 150.0, 0.015),
    ];
    for (x, from, to, bound) in cases {
        let theta = angles(from, to, 0.01);
        let found = rays(x, m, &orders, true, &theta);
        let exact = Sphere::new(x, m).unwrap().amplitudes(&theta);
        let real = |v: f64| Complex64::new(v, 0.0);
        let error = relative_l2(
            found
                .iter()
                .zip(&exact)
                .map(|(s, e)| (real(2.0 * s.s11()), real(e.0.norm_sqr() + e.1.norm_sqr()))),
        );
        println!("x = {x}, {from}–{to}°: {:.3} %", 100.0 * error);
        assert!(error <= bound, "x = {x}, {from}–{to}: {error}");
    }
}

/// Far behind the caustics of high orders nothing may run away, down to small particles.
#[test]
fn dark_sides_stay_dark() {
    let m = Complex64::new(1.333, 0.0);
    let orders: Vec<u32> = (0..=7).collect();
    for x in [20.0, 60.0, 200.0, 628.0, 2000.0] {
        let theta = angles(0.5, 179.5, 0.1);
        let found = rays(x, m, &orders, true, &theta);
        let exact = Sphere::new(x, m).unwrap().amplitudes(&theta);
        let total = |f: &dyn Fn(usize) -> f64| -> f64 {
            (0..theta.len()).map(|i| f(i) * theta[i].sin()).sum()
        };
        let found_power = total(&|i| 2.0 * found[i].s11());
        let exact_power = total(&|i| exact[i].0.norm_sqr() + exact[i].1.norm_sqr());
        let ratio = found_power / exact_power;
        println!("x = {x}: scattered power {ratio:.4} of the exact one");
        assert!((0.8..1.25).contains(&ratio), "x = {x}: {ratio}");
    }
}
