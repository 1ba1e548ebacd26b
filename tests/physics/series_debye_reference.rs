//! The Debye series against multiple-precision references, and its sum against Lorenz–Mie.

use crate::support::{numbers, relative_l2};
use gonio::series::debye::{DebyeSeries, Term};
use gonio::series::lorenz_mie::Sphere;
use num_complex::Complex64;
use serde_json::Value;

const HIGH_PRECISION: &str = include_str!("../data/debye_high_precision.json");

#[test]
fn every_term_against_high_precision() {
    let data: Value = serde_json::from_str(HIGH_PRECISION).unwrap();
    for case in data["cases"].as_array().unwrap() {
        let number = |key: &str| case[key].as_f64().unwrap();
        let m = Complex64::new(number("m_re"), number("m_im"));
        let series = DebyeSeries::new(number("x"), m).unwrap();
        let theta: Vec<f64> = numbers(case, "theta_deg").iter().map(|t| t.to_radians()).collect();
        for p in 0..=number("p_max") as u32 {
            let terms =
                if p == 0 { vec![Term::Diffraction, Term::Order(0)] } else { vec![Term::Order(p)] };
            let got = series.sum(&terms, &theta);
            for (which, pick) in [("s1", 0), ("s2", 1)] {
                let re = numbers(case, &format!("p{p}_{which}_re"));
                let im = numbers(case, &format!("p{p}_{which}_im"));
                let pairs: Vec<_> = got
                    .iter()
                    .zip(re.iter().zip(im))
                    .map(|(g, (re, im))| {
                        (if pick == 0 { g.0 } else { g.1 }, Complex64::new(*re, im))
                    })
                    .collect();
                let error = relative_l2(pairs);
                println!("x {} m {m} p {p} {which}: {error:.1e}", number("x"));
                assert!(error <= 1e-9, "x {} m {m} p {p} {which}: {error:e}", number("x"));
            }
        }
    }
}

/// The geometric sum in closed form is Lorenz–Mie: real, light, strong absorbers, m < 1, large x.
#[test]
fn closed_sum_is_mie() {
    let theta: Vec<f64> = (0..=180).map(|t| f64::from(t).to_radians()).collect();
    for (x, m, bound) in [
        (0.5, Complex64::new(1.333, 0.0), 1e-12),
        (10.0, Complex64::new(1.5, 1.0), 1e-12),
        (100.0, Complex64::new(0.75, 0.0), 1e-11),
        (1000.0, Complex64::new(1.333, 0.0), 1e-11),
        (1000.0, Complex64::new(1.333, 0.05), 1e-11),
        (1000.0, Complex64::new(10.0, 10.0), 1e-11),
        (1000.0, Complex64::new(0.2, 0.1), 1e-11),
        (10_000.0, Complex64::new(1.333, 1e-4), 1e-10),
        (100_000.0, Complex64::new(1.333, 0.0), 1e-8),
        (100_000.0, Complex64::new(1.5, 1e-3), 1e-8),
        (100_000.0, Complex64::new(0.75, 0.0), 1e-8),
    ] {
        let debye = DebyeSeries::new(x, m).unwrap().amplitudes(Term::All, &theta);
        let mie = Sphere::new(x, m).unwrap().amplitudes(&theta);
        for pick in [0, 1] {
            let pairs: Vec<_> = debye
                .iter()
                .zip(&mie)
                .skip(5) // the forward peak would hide everything else
                .map(|(d, m)| if pick == 0 { (d.0, m.0) } else { (d.1, m.1) })
                .collect();
            let error = relative_l2(pairs);
            println!("x {x} m {m} S{}: {error:.1e}", pick + 1);
            assert!(error <= bound, "x {x} m {m} S{}: {error:e}", pick + 1);
        }
    }
}

/// Diffraction and all p ≤ 200 reach Lorenz–Mie to 1e-6 where the series converges that fast:
/// where the remainder's bound says so. Where an edge wave is almost totally reflected inside
/// (|R11| → 1: n between x and mx) it does not, and the remainder says that as well.
#[test]
fn two_hundred_orders_reach_mie_where_the_remainder_says_so() {
    let theta: Vec<f64> = (0..=180).map(|t| f64::from(t).to_radians()).collect();
    for (x, m, converges) in [
        (100.0, Complex64::new(1.333, 0.0), false),
        (1000.0, Complex64::new(1.333, 0.0), false),
        (100.0, Complex64::new(1.333, 0.01), true),
        (1000.0, Complex64::new(1.333, 1e-3), true),
        (1000.0, Complex64::new(1.5, 0.1), true),
    ] {
        let series = DebyeSeries::new(x, m).unwrap();
        let terms: Vec<Term> =
            std::iter::once(Term::Diffraction).chain((0..=200).map(Term::Order)).collect();
        let sum = series.sum(&terms, &theta);
        let mie = Sphere::new(x, m).unwrap().amplitudes(&theta);
        let pairs: Vec<_> = sum.iter().zip(&mie).skip(5).map(|(d, m)| (d.0, m.0)).collect();
        let (error, remainder) = (relative_l2(pairs), series.remainder(200));
        println!("x {x} m {m}: L2 {error:.1e}, largest remainder of a coefficient {remainder:.1e}");
        assert_eq!(error <= 1e-6, converges, "x {x} m {m}: {error:e}");
    }
}

/// Diffraction near the forward direction is the Airy pattern of the disc, x² J1(z)/z.
#[test]
fn diffraction_term_is_the_disc() {
    let x = 5000.0;
    let series = DebyeSeries::new(x, Complex64::new(1.333, 0.0)).unwrap();
    for z in [0.0f64, 1.0, 3.0, 8.0] {
        let theta = (z / x).asin();
        let (s1, s2) = series.amplitudes(Term::Diffraction, &[theta])[0];
        let disc = if z == 0.0 { 0.5 * x * x } else { x * x * libm::j1(z) / z };
        let mean = 0.5 * (s1 + s2).re;
        assert!((mean - disc).abs() < 1e-3 * 0.5 * x * x, "z {z}: {mean} {disc}");
    }
}
