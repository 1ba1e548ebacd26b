//! Kramers–Kronig from a finite range: what is missing, and a bound on it.

use crate::figures::figure::Figure;
use crate::figures::papers;
use crate::figures::plain::{BLACK, BLUE, GREEN, ORANGE, RED, evenly, points, sheet};
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::medium::kramers_kronig::{Absorption, Between, Tails, maclaurin};
use crate::render::plots::sheet::{Axis, Chart, Curve, Panel};
use std::f64::consts::PI;

pub(super) const TRUNCATION: Figure = Figure {
    name: "weidlich-kk",
    source: papers::ANOMALOUS_DISPERSION,
    caption: "Section 3.2 and appendix A: n from k of a Gaussian and of a Lorentzian band known from 400 to 700 nm only, by \
              splines with two kinds of tails and by Maclaurin's formula, and their errors",
    compare: "A Gaussian band ends within the range, and what is missing is next to nothing; a Lorentzian one does not, and \
              the error stays below the bound that its ends allow",
    scenes: &[],
    pictures: false,
    make,
};

/// Rows as the paper's appendix has them: every 5 nm.
const ROWS: usize = 61;
const RANGE: (f64, f64) = (400.0, 700.0);
/// The band: position and width (nm at its position), top of k.
const CENTRE: f64 = 550.0;
const WIDTH: f64 = 25.0;
const TOP: f64 = 0.04;

/// A band with its exact change of n.
struct Band {
    name: &'static str,
    k: fn(f64) -> f64,
    n: fn(f64) -> f64,
}

/// Frequency (1/λ) in units of the band's, and the width in the same.
fn frequency(nm: f64) -> f64 {
    CENTRE / nm
}
const SIGMA: f64 = WIDTH / CENTRE;

/// Dawson's integral by Rybicki's sum (Press et al. 2007, section 6.9).
fn dawson(x: f64) -> f64 {
    const H: f64 = 0.2;
    let nearest = 2.0 * (0.5 * x / H).round();
    let rest = x - nearest * H;
    let term = |n: i32| {
        let n = f64::from(n);
        (-(rest - n * H).powi(2)).exp() / (nearest + n)
    };
    (-25..25).map(|i| term(2 * i + 1)).sum::<f64>() / PI.sqrt()
}

/// `k₀ exp(-(ω - 1)²/2σ²)`, odd in ω, and its transform `-(2k₀/√π)(D(s₋) - D(s₊))`, `s± = (ω ± 1)/√2σ`.
const GAUSSIAN: Band = Band {
    name: "Gaussian",
    k: |nm| TOP * (-0.5 * ((frequency(nm) - 1.0) / SIGMA).powi(2)).exp(),
    n: |nm| {
        let scaled = |shift: f64| dawson((frequency(nm) + shift) / (2f64.sqrt() * SIGMA));
        -2.0 * TOP / PI.sqrt() * (scaled(-1.0) - scaled(1.0))
    },
};

/// `k + i(n - n_b)` of an oscillator, `k₀ γ/(1 - ω² - iγω)`, of the same width at half height.
const LORENTZIAN: Band = Band {
    name: "Lorentzian",
    k: |nm| {
        let (w, gamma) = (frequency(nm), 2.355 * SIGMA);
        TOP * gamma * gamma * w / ((1.0 - w * w).powi(2) + (gamma * w).powi(2))
    },
    n: |nm| {
        let (w, gamma) = (frequency(nm), 2.355 * SIGMA);
        TOP * gamma * (1.0 - w * w) / ((1.0 - w * w).powi(2) + (gamma * w).powi(2))
    },
};

/// How much beyond the ends can add to n, where k does not exceed its last value below the range's frequencies, and above
/// them falls at least as 1/ω²: `(1/π)(k₁ ln(ω²/(ω² - ω₁²)) - k₂ (ω₂/ω)² ln(1 - (ω/ω₂)²))`.
fn bound(nm: f64, k_long: f64, k_short: f64) -> f64 {
    let (w, low, high) = (frequency(nm), frequency(RANGE.1), frequency(RANGE.0));
    let below = k_long * -(1.0 - (low / w).powi(2)).ln();
    let above = k_short * (high / w).powi(2) * -(1.0 - (w / high).powi(2)).ln();
    (below + above) / PI
}

fn make(_: &Workshop) -> Result<Made, FigureError> {
    let rows = evenly(RANGE.0, RANGE.1, ROWS);
    let wavelength: Vec<f64> = rows.iter().map(|nm| nm * 1e-9).collect();
    // Errors a little off the ends, where the integral of a range that ends diverges.
    let inner = 405.0..=695.0;
    let (mut panels, mut errors, mut numbers) = (Vec::new(), Vec::new(), Vec::new());
    for band in [GAUSSIAN, LORENTZIAN] {
        let k: Vec<f64> = rows.iter().map(|&nm| (band.k)(nm)).collect();
        let exact: Vec<f64> = rows.iter().map(|&nm| (band.n)(nm)).collect();
        let by = |tails| -> Result<Vec<f64>, FigureError> {
            let absorption = Absorption::with(&wavelength, &k, tails, Between::Spline)?;
            Ok(wavelength.iter().map(|&w| absorption.index_change(w)).collect())
        };
        let ways = [
            ("spline, ends tapered", BLUE, by(Tails::Taper)?),
            ("spline, Lorentz tails", GREEN, by(Tails::LorentzBand)?),
            ("Maclaurin's formula", ORANGE, maclaurin(&wavelength, &k)?),
        ];
        let limit: Vec<f64> = rows.iter().map(|&nm| bound(nm, k[ROWS - 1], k[0])).collect();
        let mut curves =
            vec![Curve { width: 3, ..Curve::new("exact", BLACK, points(&rows, &exact)) }];
        let mut differences = Vec::new();
        let within = |values: &[f64]| {
            let inside = rows.iter().zip(values).filter(|(nm, _)| inner.contains(*nm));
            inside.map(|(_, v)| v.abs()).fold(0.0, f64::max)
        };
        for (name, colour, n) in ways {
            let off: Vec<f64> =
                n.iter().zip(&exact).map(|(a, b)| (a - b).abs().max(1e-12)).collect();
            numbers.push(Number::alone(
                format!("{}: largest error, {name}", band.name),
                "",
                within(&off),
            ));
            curves.push(Curve::new(name, colour, points(&rows, &n)).dashed());
            differences.push(Curve::new(name, colour, points(&rows, &off)));
        }
        numbers.push(Number::alone(
            format!("{}: bound on what is missing, largest", band.name),
            "",
            within(&limit),
        ));
        differences.push(Curve::new("bound", RED, points(&rows, &limit)).dashed());
        panels.push(Panel::Chart(Chart {
            title: format!("{} band: change of n", band.name),
            x: Axis::linear("wavelength (nm)", RANGE.0, RANGE.1),
            y: Axis::linear("n − background", -0.03, 0.03),
            curves,
            ..Chart::default()
        }));
        errors.push(Panel::Chart(Chart {
            title: format!("{} band: error", band.name),
            x: Axis::linear("wavelength (nm)", RANGE.0, RANGE.1),
            y: Axis::logarithmic("error of n", 1e-9, 0.1),
            curves: differences,
            ..Chart::default()
        }));
    }
    panels.extend(errors);
    let notes = [
        "Rows of 5 nm as in the paper's appendix. The bound is on what k beyond 400 and 700 nm can add, if it only falls there; 405 to 695 nm.",
        "The paper says that the error of truncation is generally quite small, and gives no number.",
    ];
    Ok(Made::new(
        sheet("Kramers–Kronig from a finite range", 2, (620, 400), panels, &notes),
        numbers,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Dawson's integral at tabulated places (Abramowitz & Stegun 1972, table 7.5).
    #[test]
    fn dawson_is_that_of_tables() {
        for (x, value) in
            [(0.0, 0.0), (0.5, 0.424_436_383_5), (1.0, 0.538_079_506_9), (2.0, 0.301_340_388_9)]
        {
            assert!((dawson(x) - value).abs() < 1e-7, "{x}: {}", dawson(x));
        }
        assert!((dawson(-1.0) + dawson(1.0)).abs() < 1e-12);
    }

    /// Both pairs are Kramers–Kronig pairs: the transform over a range without end gives their n.
    #[test]
    fn the_pairs_are_pairs() {
        let nm: Vec<f64> = (0..6000).map(|i| 550.0 / (0.02 + 0.001 * f64::from(i))).rev().collect();
        let wavelength: Vec<f64> = nm.iter().map(|nm| nm * 1e-9).collect();
        for band in [GAUSSIAN, LORENTZIAN] {
            let k: Vec<f64> = nm.iter().map(|&nm| (band.k)(nm)).collect();
            let absorption = Absorption::new(&wavelength, &k, Tails::Taper).unwrap();
            for at in [420.0, 520.0, 560.0, 680.0] {
                let (found, exact) = (absorption.index_change(at * 1e-9), (band.n)(at));
                assert!((found - exact).abs() < 2e-5, "{} {at}: {found} {exact}", band.name);
            }
        }
    }
}
