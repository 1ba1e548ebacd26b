//! Kramers–Kronig against an exact causal pair and against a measured dye.

use gonio::medium::kramers_kronig::{Absorption, Between, Tails, extinction_from_index, maclaurin};
use gonio::medium::{MediumSpec, read_csv};
use std::path::{Path, PathBuf};

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// Rows of the Lorentz pair: wavelength in metres, n, k, background n.
fn lorentz_pair() -> Vec<[f64; 4]> {
    let text = std::fs::read_to_string(file("tests/data/medium/kk_lorentz_pair.csv")).unwrap();
    let rows = text.lines().filter(|l| !l.starts_with(['#', 'w']));
    rows.map(|line| {
        let v: Vec<f64> = line.split(',').map(|x| x.parse().unwrap()).collect();
        [v[0] / 1e6, v[1], v[2], v[3]]
    })
    .collect()
}

fn columns() -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let rows = lorentz_pair();
    let wavelength = rows.iter().map(|r| r[0]).collect();
    let change = rows.iter().map(|r| r[1] - r[3]).collect();
    (wavelength, rows.iter().map(|r| r[2]).collect(), change)
}

/// Largest error over rows within a band of wavelengths (nm).
fn worst(wavelength: &[f64], found: &[f64], exact: &[f64], band: (f64, f64)) -> f64 {
    wavelength
        .iter()
        .zip(found.iter().zip(exact))
        .filter(|(w, _)| (band.0 / 1e9 - 1e-12..=band.1 / 1e9 + 1e-12).contains(*w))
        .map(|(_, (a, b))| (a - b).abs())
        .fold(0.0, f64::max)
}

#[test]
fn an_exact_lorentz_pair() {
    let (wavelength, k, exact) = columns();
    assert_eq!(wavelength.len(), 121);
    let change = |tails, between| -> Vec<f64> {
        let absorption = Absorption::with(&wavelength, &k, tails, between).unwrap();
        wavelength.iter().map(|&w| absorption.index_change(w)).collect()
    };
    for (i, w) in wavelength.iter().enumerate().step_by(5) {
        let a = change(Tails::LorentzBand, Between::Spline)[i] - exact[i];
        let b = change(Tails::Taper, Between::Spline)[i] - exact[i];
        println!("{:.1} {a:.2e} {b:.2e}", w * 1e9);
    }
    let paper = maclaurin(&wavelength, &k).unwrap();
    for (label, found) in [
        ("maclaurin", paper.clone()),
        ("lines, taper", change(Tails::Taper, Between::Lines)),
        ("lines, band", change(Tails::LorentzBand, Between::Lines)),
        ("spline, taper", change(Tails::Taper, Between::Spline)),
        ("spline, band", change(Tails::LorentzBand, Between::Spline)),
    ] {
        let all = worst(&wavelength, &found, &exact, (300.0, 900.0));
        let visible = worst(&wavelength, &found, &exact, (400.0, 700.0));
        println!("{label:14} 300-900 nm {all:.2e}   400-700 nm {visible:.2e}");
    }
}
