//! The curves of the page: data for uPlot, and the polar view as SVG.

use super::curve::Curve;
use super::{Case, CaseReport};
use crate::math::digits::to_digits;
use crate::phase_table::PhaseTable;
use maud::{Markup, html};
use serde_json::{Value, json};

/// Curves of a case on the angles of the reference: all methods and polarisations; then, if there
/// are any, the single orders.
pub(super) fn charts(case: &Case, report: &CaseReport) -> Vec<Value> {
    let wavelength = report.wavelength_nm * 1e-9;
    let scaled = |table: &PhaseTable| Curve::relative_to(table, &case.reference.table, wavelength);
    let theta = scaled(&case.reference.table).theta;
    let mut methods = Vec::new();
    for (k, entry) in std::iter::once(&case.reference).chain(&case.tests).enumerate() {
        let curve = scaled(&entry.table);
        for (which, (polarisation, _)) in curve.intensity.iter().enumerate() {
            let name = format!("{}, {polarisation}", entry.name);
            methods.push(series(&name, &curve, which, &theta, which == 0 && k < 2, k == 0));
        }
    }
    let mut all = vec![json!({ "theta": theta, "series": methods })];
    let mut orders = Vec::new();
    for pair in &case.orders {
        for (entry, exact) in [(&pair.test, false), (&pair.exact, true)] {
            let curve = scaled(&entry.table);
            orders.push(series(&entry.name, &curve, 0, &theta, !exact && pair.order < 4, exact));
        }
    }
    if !orders.is_empty() {
        all.push(json!({ "theta": theta, "series": orders }));
    }
    all
}

fn series(
    name: &str,
    curve: &Curve,
    which: usize,
    theta: &[f64],
    show: bool,
    reference: bool,
) -> Value {
    let values: Vec<Option<f64>> =
        theta.iter().map(|&t| curve.at(which, t).filter(|v| *v > SMALLEST).map(rounded)).collect();
    json!({ "name": name, "values": values, "show": show, "reference": reference })
}

/// Darker than this (sr⁻¹) nothing is drawn, so that shadows do not stretch the scale.
const SMALLEST: f64 = 1e-8;

/// Five digits are more than a screen shows.
fn rounded(value: f64) -> f64 {
    to_digits(value, 5)
}

/// Polar view on a log scale: the reference above the axis, the first test below.
pub(super) fn polar(case: &Case, report: &CaseReport) -> Markup {
    const SIZE: f64 = 460.0;
    const DECADES: f64 = 6.0;
    let wavelength = report.wavelength_nm * 1e-9;
    let curve = |table| Curve::relative_to(table, &case.reference.table, wavelength);
    let reference = curve(&case.reference.table);
    let radius = |value: f64| {
        let decades = (value.max(1e-12).log10() + 4.0).clamp(0.0, DECADES);
        0.42 * SIZE * decades / DECADES
    };
    let path = |curve: &Curve, sign: f64| -> String {
        let Some((_, values)) = curve.intensity.first() else { return String::new() };
        curve
            .theta
            .iter()
            .zip(values)
            .enumerate()
            .map(|(i, (t, v))| {
                let (s, c) = t.to_radians().sin_cos();
                let (x, y) = (0.5 * SIZE + radius(*v) * c, 0.5 * SIZE - sign * radius(*v) * s);
                format!("{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' })
            })
            .collect()
    };
    html! {
        svg viewBox=(format!("0 0 {SIZE} {SIZE}")) width=(SIZE) height=(SIZE) role="img"
            aria-label="phase function in polar coordinates, log scale" {
            @for decade in 0..=(DECADES as i32) {
                @let r = 0.42 * SIZE * f64::from(decade) / DECADES;
                circle cx=(0.5 * SIZE) cy=(0.5 * SIZE) r=(format!("{r:.1}")) fill="none" stroke="#ddd" {}
                text x=(0.5 * SIZE + 2.0) y=(format!("{:.1}", 0.5 * SIZE - r - 2.0)) font-size="10" fill="#777" {
                    "1e" (decade - 4)
                }
            }
            line x1="0" x2=(SIZE) y1=(0.5 * SIZE) y2=(0.5 * SIZE) stroke="#ddd" {}
            path d=(path(&reference, 1.0)) fill="none" stroke="#000" stroke-width="0.8" {}
            @if let Some(test) = case.tests.first() {
                path d=(path(&curve(&test.table), -1.0)) fill="none" stroke="#0072b2" stroke-width="0.8" {}
                text x="8" y=(SIZE - 8.0) font-size="12" fill="#0072b2" { "below: " (test.name) }
            }
            text x="8" y="16" font-size="12" { "above: " (report.reference) ", P in sr⁻¹, log scale" }
            text x=(SIZE - 60.0) y=(0.5 * SIZE - 4.0) font-size="11" fill="#555" { "forward" }
            text x="4" y=(0.5 * SIZE - 4.0) font-size="11" fill="#555" { "back" }
        }
    }
}
