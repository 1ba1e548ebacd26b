//! Rows of what a radar sees, as CSV and as JSON.

use super::args::RadarArgs;
use gonio::medium::wavelength_of_ghz;
use gonio::radar::{RadarQuantities, Row};
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Names and values of a row's quantities; dBZ beside the reflectivities.
fn columns(q: &RadarQuantities) -> [(&'static str, f64); 10] {
    [
        ("z_h_mm6_m3", q.z_h),
        ("z_v_mm6_m3", q.z_v),
        ("z_h_dbz", 10.0 * q.z_h.log10()),
        ("z_dr_db", q.z_dr_db),
        ("ldr_db", q.ldr_db),
        ("rho_hv", q.rho_hv),
        ("delta_hv_deg", q.delta_hv_deg),
        ("k_dp_deg_km", q.k_dp_deg_km),
        ("a_h_db_km", q.a_h_db_km),
        ("a_dp_db_km", q.a_dp_db_km),
    ]
}

fn frequency_ghz(row: &Row) -> f64 {
    wavelength_of_ghz(1.0) / row.wavelength
}

/// As it was asked for: without what the way by metres adds to its last digits.
fn diameter_mm(row: &Row) -> Option<f64> {
    row.diameter.map(|d| (d * 1e15).round() / 1e12)
}

pub(super) fn as_csv(rows: &[Row]) -> String {
    let mut text = String::from("frequency_ghz,temperature_c,n,k,diameter_mm");
    if let Some(row) = rows.first() {
        columns(&row.seen).iter().for_each(|(name, _)| {
            let _ = write!(text, ",{name}");
        });
    }
    text.push('\n');
    let number = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value}"));
    for row in rows {
        let Row { index, seen, .. } = row;
        let (celsius, diameter) = (number(row.celsius), number(diameter_mm(row)));
        let ghz = frequency_ghz(row);
        let _ = write!(text, "{ghz:.6},{celsius},{:.6},{:.6},{diameter}", index.re, index.im);
        for (_, value) in columns(seen) {
            let _ = write!(text, ",{value:.6e}");
        }
        text.push('\n');
    }
    text
}

pub(super) fn as_json(args: &RadarArgs, rows: &[Row], seconds: f64) -> String {
    let row = |row: &Row| {
        let mut entry = json!({
            "frequency_ghz": frequency_ghz(row),
            "temperature_c": row.celsius,
            "index": [row.index.re, row.index.im],
            "diameter_mm": diameter_mm(row),
        });
        for (name, value) in columns(&row.seen) {
            // no depolarisation has no decibels
            entry[name] = if value.is_finite() { json!(value) } else { Value::Null };
        }
        entry
    };
    let report = json!({
        "method": "tmatrix",
        "elevation_deg": args.elevation_deg,
        "canting_deg": args.canting_deg,
        "rows": rows.iter().map(row).collect::<Vec<Value>>(),
        "seconds": seconds,
    });
    format!("{report}\n")
}
