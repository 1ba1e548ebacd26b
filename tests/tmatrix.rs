//! The T-matrix of bodies of revolution against Lorenz–Mie, an independent T-matrix, and what every
//! true one obeys: reciprocity, energy, the same answer about any origin.

use gonio::optics::AmplitudeMatrix;
use gonio::series::lorenz_mie::Sphere;
use gonio::series::tmatrix::{Scattered, Solver, TMatrix, TMatrixError};
use gonio::shape::{RaindropModel, Shape};
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, PI};

const WATER: Complex64 = Complex64::new(1.333, 0.0);

fn drop_of(radius_mm: f64) -> Shape {
    Shape::raindrop(radius_mm * 1e-3, RaindropModel::BeardChuang1987, 0.0).unwrap()
}

/// A sphere through the general path, transparent and absorbing: 1e-10 of the largest amplitude.
#[test]
fn sphere_is_lorenz_mie() {
    for (x, index) in [(0.1, WATER), (8.0, Complex64::new(1.5, 0.1)), (40.0, WATER)] {
        let sphere = Sphere::new(x, index).unwrap();
        let scattered = Scattered::new(&TMatrix::new(&Shape::sphere(), x, index, 1e-6).unwrap(), 0.4);
        let theta: Vec<f64> = (0..=36).map(|i| PI * f64::from(i) / 36.0).collect();
        let directions: Vec<(f64, f64)> = theta.iter().map(|&t| (t, 0.7)).collect();
        let known = sphere.amplitudes_parallel(&theta);
        let scale = known[0].0.norm();
        for (s, (s1, s2)) in scattered.directions(&directions).iter().zip(known) {
            let wrong = (s.s1 - s1).norm().max((s.s2 - s2).norm()).max(s.s3.norm()).max(s.s4.norm());
            assert!(wrong < 1e-10 * scale, "x = {x}: {wrong:e} of {scale}");
        }
        let (q, known) = (scattered.efficiencies(), sphere.efficiencies());
        assert!((q.q_ext - known.q_ext).abs() < 1e-10 * known.q_ext);
        assert!((q.q_sca - known.q_sca).abs() < 1e-10 * known.q_sca);
        assert!((q.asymmetry - known.asymmetry).abs() < 1e-9);
    }
}

/// One row of the reference: drop, size, index, elevation, azimuth, angle, four amplitudes.
fn reference() -> Vec<Vec<f64>> {
    include_str!("data/tmatrix_raindrop.csv")
        .lines()
        .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
        .map(|line| line.split(',').map(|word| word.parse().unwrap()).collect())
        .collect()
}

/// Raindrops of 1 and 2 mm at x = 2, 10, 30 and a radar case: 1e-6 of each curve of the independent
/// T-matrix, whose seven digits leave 2e-7.
#[test]
fn raindrops_of_an_independent_t_matrix() {
    let rows = reference();
    let mut curves = 0;
    for body in rows.chunk_by(|a, b| a[..4] == b[..4]) {
        let [radius, x, n, k] = body[0][..4] else { panic!("four columns") };
        let t = TMatrix::new(&drop_of(radius), x, Complex64::new(n, k), 1e-3).unwrap();
        for curve in body.chunk_by(|a, b| a[4..6] == b[4..6]) {
            let scattered = Scattered::new(&t, curve[0][4].to_radians());
            let directions: Vec<(f64, f64)> =
                curve.iter().map(|row| (row[6].to_radians(), row[5].to_radians())).collect();
            let (mut wrong, mut scale) = (0.0, 0.0);
            for (row, s) in curve.iter().zip(scattered.directions(&directions)) {
                for (part, found) in [s.s1, s.s2, s.s3, s.s4].into_iter().enumerate() {
                    let known = Complex64::new(row[7 + 2 * part], row[8 + 2 * part]);
                    wrong += (found - known).norm_sqr();
                    scale += known.norm_sqr();
                }
            }
            let error = (wrong / scale).sqrt();
            assert!(error < 1e-6, "{:?}: {error:e}", &curve[0][..6]);
            curves += 1;
        }
    }
    assert!(curves > 36, "{curves}");
}

fn at(t: &TMatrix, elevation: f64, azimuth: f64, theta: f64) -> AmplitudeMatrix {
    Scattered::new(t, elevation).directions(&[(theta, azimuth)])[0]
}

/// Reciprocity and mirror symmetry, for a body without a horizontal plane of symmetry.
#[test]
fn reversed_paths_have_equal_amplitudes() {
    let t = TMatrix::new(&drop_of(1.0), 20.0, WATER, 1e-3).unwrap();
    let scale = at(&t, 0.0, 0.0, 0.0).s1.norm();
    for theta in [0.4, 1.3, 2.6] {
        let s = at(&t, 0.0, FRAC_PI_2, theta);
        assert!((s.s3 - s.s4).norm() < 1e-9 * scale, "{theta}: {} {}", s.s3, s.s4);
    }
    // light along elevation 0 that leaves upwards by 150°, and back along the same path
    let there = at(&t, 0.0, 0.0, 150f64.to_radians());
    let back = at(&t, 30f64.to_radians(), PI, 150f64.to_radians());
    assert!((there.s1 - back.s1).norm() < 1e-9 * scale, "{} {}", there.s1, back.s1);
    assert!((there.s2 - back.s2).norm() < 1e-9 * scale, "{} {}", there.s2, back.s2);
}

/// Without absorption all that is lost is scattered, at every elevation; random orientation is the
/// mean over them (Gauss quadrature over the axis, exact for this degree).
#[test]
fn energy_and_the_mean_over_orientations() {
    let t = TMatrix::new(&Shape::spheroid(0.8, 0.0).unwrap(), 6.0, WATER, 1e-3).unwrap();
    let (mut extinction, mut total) = (0.0, 0.0);
    for (sin, weight) in gonio::math::gauss_legendre::nodes(40) {
        let q = Scattered::new(&t, sin.asin()).efficiencies();
        assert!((q.q_ext - q.q_sca).abs() < 1e-8 * q.q_ext, "{q:?}");
        extinction += weight * q.q_ext;
        total += weight;
    }
    let (random, scattering) = t.random_efficiencies();
    assert!((extinction / total - random).abs() < 1e-9 * random, "{random}");
    assert!((random - scattering).abs() < 1e-9 * random);
}

/// A drop of 3 mm, where the null field stalls, is left to least squares; energy is kept.
#[test]
fn flat_drops_are_fitted_on_the_surface() {
    let t = TMatrix::new(&drop_of(3.0), 5.0, WATER, 1e-5).unwrap();
    assert_eq!(t.solver().0, Solver::LeastSquares);
    let q = Scattered::new(&t, 0.2).efficiencies();
    assert!((q.q_ext - q.q_sca).abs() < 1e-4 * q.q_ext, "{q:?}");
}

/// Beyond its limits there is no number.
#[test]
fn beyond_the_limits_is_refused() {
    let flat = Shape::spheroid(0.3, 0.0).unwrap();
    let refused = TMatrix::new(&flat, 20.0, WATER, 1e-3).unwrap_err();
    assert!(matches!(refused, TMatrixError::NotConverged { reached, .. } if reached > 1e-3));
    let large = TMatrix::new(&Shape::sphere(), 1000.0, WATER, 1e-3).unwrap_err();
    assert!(matches!(large, TMatrixError::TooLarge { .. }), "{large}");
    assert!(TMatrix::new(&flat, f64::NAN, WATER, 1e-3).is_err());
}
