//! Fig. 7 and Table I: shapes of falling drops.

use crate::figures::figure::Figure;
use crate::figures::papers;
use crate::figures::plain::{BLUE, PALETTE, WATER, sheet};
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::render::plots::sheet::{Axis, Chart, Curve, Foot, Panel, Sheet};
use crate::shape::{RaindropModel, Shape};
use std::f64::consts::TAU;

pub(super) const FIG_7: Figure = Figure {
    name: "sadeghi-7",
    source: papers::RAINBOWS,
    caption: "Fig. 7: profiles of raindrops of 0.4, 1, 1.5, 2, 2.5 and 3 mm after Beard & Chuang 1987",
    compare: "A sphere at 0.4 mm; the larger the drop, the flatter it is, most of all below, which is hollow in none of them",
    scenes: &[],
    pictures: false,
    make: profiles,
};

pub(super) const TABLE_I: Figure = Figure {
    name: "sadeghi-table-1",
    source: papers::RAINBOWS,
    caption: "Table I: coefficients of r = a(1 + Σ cₙ cos nθ) by the radius of equal volume",
    compare: "All 48 coefficients as printed; between the rows they are linear in the radius",
    scenes: &[],
    pictures: false,
    make: coefficients,
};

/// Table I as printed: radius in mm, c₀ to c₇.
const PRINTED: [(f64, [f64; 8]); 6] = [
    (0.4, [0.0; 8]),
    (1.0, [-0.0131, -0.0120, -0.0376, -0.0096, -0.0004, 0.0015, 0.0005, 0.0]),
    (1.5, [-0.0282, -0.0230, -0.0779, -0.0175, 0.0021, 0.0046, 0.0011, -0.0006]),
    (2.0, [-0.0458, -0.0335, -0.1211, -0.0227, 0.0083, 0.0089, 0.0012, -0.0021]),
    (2.5, [-0.0644, -0.0416, -0.1629, -0.0246, 0.0176, 0.0131, 0.0002, -0.0044]),
    (3.0, [-0.0840, -0.0480, -0.2034, -0.0237, 0.0297, 0.0166, -0.0021, -0.0072]),
];
const MODEL: RaindropModel = RaindropModel::BeardChuang1987;

/// The outline of a drop in mm: horizontally and upwards.
fn outline(radius_mm: f64) -> Result<Vec<(f64, f64)>, FigureError> {
    let shape = Shape::raindrop(radius_mm * 1e-3, MODEL, 0.0)?;
    let down = shape.down;
    let place = |i: i32| {
        let (sin, cos) = (TAU * f64::from(i) / 360.0).sin_cos();
        let radius = shape.radius_towards(down.x * cos, down.y * cos + sin, down.z * cos);
        (radius_mm * radius * sin, -radius_mm * radius * cos)
    };
    Ok((0..=360).map(place).collect())
}

fn profiles(_: &Workshop) -> Result<Made, FigureError> {
    let (mut panels, mut numbers) = (Vec::new(), Vec::new());
    for (radius, printed) in PRINTED {
        let points = outline(radius)?;
        let extent = |of: fn(&(f64, f64)) -> f64| {
            let all = || points.iter().map(of);
            all().fold(f64::MIN, f64::max) - all().fold(f64::MAX, f64::min)
        };
        // Poles of the printed series; the width at its widest place.
        let series = |theta: f64| {
            1.0 + printed.iter().enumerate().map(|(n, c)| c * (n as f64 * theta).cos()).sum::<f64>()
        };
        let high = series(0.0) + series(TAU / 2.0);
        let wide = (0..=1800).map(|i| TAU / 3600.0 * f64::from(i));
        let wide = 2.0 * wide.map(|t| series(t) * t.sin()).fold(0.0, f64::max);
        let ours = extent(|p| p.1) / extent(|p| p.0);
        numbers.push(Number::beside(
            format!("height over width, {radius} mm"),
            "",
            high / wide,
            ours,
        ));
        panels.push(Panel::Chart(Chart {
            title: format!("a = {radius} mm"),
            x: Axis::linear("horizontally (mm)", -3.6, 3.6),
            y: Axis::linear("upwards (mm)", -3.0, 3.0),
            equal: true,
            curves: vec![Curve::new("", BLUE, points).filled(WATER)],
            ..Chart::default()
        }));
    }
    let notes = ["The paper's heights over widths follow from its printed coefficients."];
    let sheet = sheet("Falling raindrops (Beard & Chuang 1987)", 3, (380, 370), panels, &notes);
    Ok(Made::new(sheet, numbers))
}

fn coefficients(_: &Workshop) -> Result<Made, FigureError> {
    let mut numbers = Vec::new();
    let mut rows = vec![vec!["a (mm)".to_string(), String::new()]];
    rows[0].extend((0..8).map(|n| format!("c{}", ["₀", "₁", "₂", "₃", "₄", "₅", "₆", "₇"][n])));
    for (radius, printed) in PRINTED {
        let mut ours = MODEL.coefficients(radius * 1e-3)?;
        ours.resize(8, 0.0);
        for (n, (paper, ours)) in printed.iter().zip(&ours).enumerate() {
            numbers.push(Number::beside(format!("c{n}, {radius} mm"), "", *paper, *ours));
        }
        let row = |name: &str, values: &[f64]| -> Vec<String> {
            let first = if name == "paper" { radius.to_string() } else { String::new() };
            let cells = values.iter().map(|v| format!("{:.4}", if *v == 0.0 { 0.0 } else { *v }));
            [first, name.to_string()].into_iter().chain(cells).collect()
        };
        rows.push(row("paper", &printed));
        rows.push(row("ours", &ours));
    }
    let radii: Vec<f64> = (0..=130).map(|i| 0.4 + 0.02 * f64::from(i)).collect();
    let mut curves = Vec::new();
    for n in 0..7 {
        let mut points = Vec::new();
        for &radius in &radii {
            let all = MODEL.coefficients(radius * 1e-3)?;
            points.push((radius, all.get(n).copied().unwrap_or(0.0)));
        }
        curves.push(Curve::new(&format!("c{n}"), PALETTE[n], points));
        let printed = PRINTED.iter().map(|(radius, c)| (*radius, c[n]));
        curves.push(Curve::new("", PALETTE[n], printed).dots());
    }
    let chart = Chart {
        title: "lines: ours; dots: as printed".into(),
        x: Axis::linear("radius of equal volume (mm)", 0.4, 3.0),
        y: Axis::linear("coefficient", -0.22, 0.04),
        curves,
        ..Chart::default()
    };
    let sheet = Sheet {
        title: "Coefficients of raindrops (Table I)".into(),
        columns: 1,
        panel: (860, 420),
        panels: vec![Panel::Chart(chart)],
        foot: Foot { rows, notes: Vec::new() },
    };
    Ok(Made::new(sheet, numbers))
}
