//! Tests of `wave_kernels`.

use super::*;
use crate::farfield::branch::knots::{PairKnot, SingleKnot};

const X: f64 = 300.0;

fn theta() -> Vec<f64> {
    (0..40).map(|i| 0.5 + 0.01 * i as f64).collect()
}

fn piece(theta: &[f64]) -> Piece<'_> {
    Piece { theta, begin: 3, end: 27, sign: 1.0, turn: 0.0 }
}

fn elements(scale: f64) -> [Complex64; 4] {
    std::array::from_fn(|e| scale * Complex64::new(1.0 + e as f64, 0.3 * e as f64 - 0.2))
}

/// Every sample of the piece has the wave, in whole and broken blocks, and no other sample is touched.
fn check(rows: &[Vec<f64>; 8], theta: &[f64], wave: impl Fn(f64) -> [Complex64; 4]) {
    for (i, &t) in theta.iter().enumerate() {
        for (e, known) in wave(t).into_iter().enumerate() {
            let found = Complex64::new(rows[2 * e][i], rows[2 * e + 1][i]);
            let known = if (3..27).contains(&i) { known } else { Complex64::ZERO };
            assert!((found - known).norm() < 1e-9 * X, "{i} {e}: {found} {known}");
        }
    }
}

#[test]
fn one_wave_is_its_amplitude_turned_by_its_path() {
    let theta = theta();
    let (slope, rate) = (0.7, elements(0.4));
    let knot = |angle: f64| {
        Knot::from(SingleKnot {
            angle,
            path: 1.5 + slope * angle,
            path_slope: slope,
            amplitudes: std::array::from_fn(|e| elements(1.0)[e] + rate[e] * angle),
            rates: rate,
        })
    };
    let mut rows: [Vec<f64>; 8] = std::array::from_fn(|_| vec![0.0; theta.len()]);
    single::<false>(&mut rows, &piece(&theta), &knot(0.45), &knot(0.85), X, 0.25);
    let mut fused: [Vec<f64>; 8] = std::array::from_fn(|_| vec![0.0; theta.len()]);
    single::<true>(&mut fused, &piece(&theta), &knot(0.45), &knot(0.85), X, 0.25);
    let wave = |t: f64| {
        let turned = Complex64::from_polar(X, X * (1.5 + slope * t) + 0.25 * TAU);
        std::array::from_fn(|e| (elements(1.0)[e] + rate[e] * t) * turned)
    };
    check(&rows, &theta, wave);
    check(&fused, &theta, wave);
}

/// Far from the fold, two rays as the asymptotic forms of the Airy functions say.
#[test]
fn a_pair_far_from_its_fold_is_two_rays() {
    let theta = theta();
    // ζ̂³ᐟ² · 2/3 is half the difference of both paths
    let (path, zeta) = (2.0_f64, 1.2_f64);
    let knot = |angle: f64| {
        Knot::from(PairKnot {
            angle,
            path,
            zeta,
            sums: elements(1.0),
            differences: elements(0.5),
            ..PairKnot::default()
        })
    };
    let flat = Knot::from(PairKnot::default());
    let mut rows: [Vec<f64>; 8] = std::array::from_fn(|_| vec![0.0; theta.len()]);
    pair::<false>(&mut rows, &piece(&theta), [&knot(0.45), &knot(0.85)], &[flat, flat], X, 0.0);
    let half = 2.0 / 3.0 * zeta.powf(1.5);
    let quarter = PI / 4.0;
    for (i, row) in rows.iter().enumerate() {
        assert!(row[..3].iter().chain(&row[27..]).all(|&value| value == 0.0), "{i}");
    }
    for e in 0..4 {
        let (sum, difference) = (elements(1.0)[e], elements(0.5)[e]);
        let root = zeta.powf(0.25);
        let first = (sum / root - difference * root)
            * Complex64::from_polar(0.5 * X, X * (path - half) + quarter);
        let second = (sum / root + difference * root)
            * Complex64::from_polar(0.5 * X, X * (path + half) - quarter);
        let found = Complex64::new(rows[2 * e][10], rows[2 * e + 1][10]);
        // the next terms of the asymptotic series are 5/(72 x · half) and 7/(72 x · half)
        let bright = first.norm() + second.norm();
        assert!((found - first - second).norm() < 5e-4 * bright, "{e}: {found} {}", first + second);
    }
}
