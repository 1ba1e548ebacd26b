//! Comma-separated values: the mean over azimuth, or every sample.

use super::average::{Averaged, ELEMENTS};
use super::bulk;
use super::notes::{notes, shape_note};
use crate::math::digits::to_digits;
use crate::phase_table::{PhaseTable, Quantity};
use std::fmt::Write;

/// One line per wavelength and scattering angle, mean over azimuth.
pub fn averaged(table: &PhaseTable, averaged: &Averaged) -> String {
    let mut text = format!(
        "# mean over azimuth; below {} degree the value there; peak_share: power cut off\n",
        averaged.cap.to_degrees()
    );
    for note in notes(table).into_iter().chain(shape_note(table, averaged)) {
        let _ = writeln!(text, "# {note}");
    }
    for line in bulk::lines(table, averaged) {
        let _ = writeln!(text, "# {line}");
    }
    text.push_str("wavelength_nm,theta_deg,peak_share");
    let used = if averaged.polarised { ELEMENTS.len() } else { 1 };
    for (name, _) in &ELEMENTS[..used] {
        let _ = write!(text, ",p{name}_per_sr");
    }
    text.push('\n');
    for curve in &averaged.curves {
        for (i, theta) in averaged.theta.iter().enumerate() {
            let (nm, degrees) = (tidy(curve.wavelength * 1e9), tidy(theta.to_degrees()));
            let _ = write!(text, "{nm},{degrees},{}", curve.peak_share);
            for values in &curve.elements[..used] {
                let _ = write!(text, ",{:e}", values[i]);
            }
            text.push('\n');
        }
    }
    text
}

/// One line per wavelength, scattering angle and azimuth.
pub fn every_sample(table: &PhaseTable) -> String {
    let axes = &table.header.axes;
    let mut text = String::new();
    for note in notes(table) {
        let _ = writeln!(text, "# {note}");
    }
    text.push_str("wavelength_nm,theta_deg,azimuth_deg");
    match table.header.quantity {
        Quantity::PhaseFunction => text.push_str(",p11_per_sr"),
        Quantity::Mueller => (0..16).for_each(|e| {
            let _ = write!(text, ",p{}{}_per_sr", e / 4 + 1, e % 4 + 1);
        }),
    }
    text.push('\n');
    for slab in &table.slabs {
        for (i, theta) in axes.theta.iter().enumerate() {
            for (j, phi) in axes.phi.iter().enumerate() {
                let nm = tidy(slab.wavelength * 1e9);
                let (theta, phi) = (tidy(theta.to_degrees()), tidy(phi.to_degrees()));
                let _ = write!(text, "{nm},{theta},{phi}");
                for element in 0..table.header.quantity.elements() {
                    let _ = write!(text, ",{:e}", slab.values[(element, i, j)]);
                }
                text.push('\n');
            }
        }
    }
    text
}

/// Free of what the conversion of units leaves in the last digits.
fn tidy(value: f64) -> f64 {
    to_digits(value, 10)
}
