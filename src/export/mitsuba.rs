//! Mitsuba 3: a folder with the spectral table, a Python plugin that renders it, and `tabphase`
//! strings for those who have no plugin; beside them albedo and coefficients by wavelength (`medium.csv`).
//!
//! `tabphase` takes one curve on a grid uniform in cos θ from −1 to +1 (+1 forward); its first
//! cells are degrees wide, so the forward peak must be cut. The plugin takes the mean over azimuth
//! too (drops in air turn with the sun, but a medium's phase function in Mitsuba knows only the
//! angle between two directions), at every wavelength: colours come out.

use super::average::Averaged;
use super::bulk;
use super::notes::{notes, shape_note};
use crate::hdf5::TableError;
use crate::pending_file::write_whole;
use crate::phase_table::PhaseTable;
use std::path::Path;

/// Samples that a cell's mean is taken over.
const PER_CELL: usize = 32;

/// The plugin.
const PLUGIN: &str = include_str!("mitsuba_plugin.py");
/// A scene that renders the bow.
const SCENE: &str = include_str!("mitsuba_scene.py");

/// The whole folder, its files in place of those of the same names; `samples` per curve of a `tabphase`.
///
/// # Errors
/// A folder or a file that cannot be written.
pub fn write(
    table: &PhaseTable,
    averaged: &Averaged,
    folder: &Path,
    samples: usize,
) -> Result<(), TableError> {
    let named = |path: &Path| {
        let path = path.to_path_buf();
        move |source| TableError::Io { path, source }
    };
    std::fs::create_dir_all(folder).map_err(named(folder))?;
    let save = |name: &str, text: &str| {
        let path = folder.join(name);
        write_whole(&path, text.as_bytes()).map_err(named(&path))
    };
    save("phase.csv", &spectral_table(averaged))?;
    save("medium.csv", &bulk::csv(table, averaged))?;
    save("tabphase.txt", &tabphase(table, averaged, samples))?;
    save("gonio_phase.py", PLUGIN)?;
    save("scene.py", SCENE)
}

/// `phase.csv`: first line the wavelengths (nm), then per line cos θ (ascending, uniform in θ) and
/// P11 in sr⁻¹ per wavelength.
fn spectral_table(averaged: &Averaged) -> String {
    let mut text = String::from("cos_theta");
    for curve in &averaged.curves {
        text.push_str(&format!(",{}", curve.wavelength * 1e9));
    }
    text.push('\n');
    for (i, theta) in averaged.theta.iter().enumerate().rev() {
        text.push_str(&format!("{:.17}", theta.cos()));
        for curve in &averaged.curves {
            text.push_str(&format!(",{:e}", curve.elements[0][i]));
        }
        text.push('\n');
    }
    text
}

/// `tabphase.txt`: per wavelength a line `wavelength_nm: v1, v2, …` with `count` values uniform in
/// cos θ from −1 to +1, each the mean over its cell, so that the sum keeps its power where the curve
/// is narrower than the grid.
pub fn tabphase(table: &PhaseTable, averaged: &Averaged, count: usize) -> String {
    let count = count.max(2);
    let mut text = format!(
        "# forward peak cut below {} degree; grid uniform in cos(theta) from -1 to 1\n",
        averaged.cap.to_degrees()
    );
    for note in notes(table).into_iter().chain(shape_note(table, averaged)) {
        text.push_str(&format!("# {note}\n"));
    }
    for curve in &averaged.curves {
        let step = 2.0 / (count - 1) as f64;
        let values: Vec<String> = (0..count)
            .map(|i| {
                let middle = -1.0 + step * i as f64;
                let (low, high) = ((middle - 0.5 * step).max(-1.0), (middle + 0.5 * step).min(1.0));
                let at = |k: usize| low + (high - low) * (k as f64 + 0.5) / PER_CELL as f64;
                let sum: f64 = (0..PER_CELL).map(|k| averaged.p11(curve, at(k).acos())).sum();
                format!("{:.7e}", sum / PER_CELL as f64)
            })
            .collect();
        text.push_str(&format!("{}: {}\n", curve.wavelength * 1e9, values.join(", ")));
    }
    text
}
