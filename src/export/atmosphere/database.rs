//! What the netCDF databases of radiative transfer programs have in common.

use crate::export::average::{Averaged, Curve};
use crate::export::bulk::Coefficients;
use crate::export::notes::{density_note, notes, shape_note};
use crate::hdf5::{NetcdfValues, NetcdfVariable};
use crate::phase_table::PhaseTable;

/// A variable with text attributes.
pub(in crate::export) fn variable(
    name: &str,
    dimensions: &[&str],
    values: NetcdfValues,
    attributes: &[(&str, &str)],
) -> NetcdfVariable {
    NetcdfVariable {
        name: name.into(),
        dimensions: dimensions.iter().map(|name| name.to_string()).collect(),
        values,
        attributes: attributes.iter().map(|(a, b)| (a.to_string(), b.to_string())).collect(),
    }
}

/// One value per wavelength.
pub(in crate::export) fn per_curve(
    averaged: &[&Averaged],
    value: impl Fn(&Curve) -> f64,
) -> NetcdfValues {
    NetcdfValues::F64(averaged.iter().flat_map(|a| &a.curves).map(value).collect())
}

/// Single-scattering albedo.
pub(in crate::export) fn albedo(curve: &Curve) -> f64 {
    curve.scattering_cross_section / curve.extinction_cross_section
}

/// The coefficients as variables of a netCDF file along some dimensions: those that all curves have.
pub(in crate::export) fn coefficients(
    dimensions: &[&str],
    curves: &[(&PhaseTable, &Curve)],
) -> Vec<NetcdfVariable> {
    let all: Vec<Coefficients> =
        curves.iter().map(|(table, curve)| Coefficients::of(table, curve)).collect();
    let column =
        |of: fn(&Coefficients) -> Option<[f64; 2]>, name: &str, words: &str, units: &str| {
            let values: Option<Vec<f64>> = all.iter().map(|c| of(c).map(|pair| pair[0])).collect();
            let attributes = [("units", units), ("long_name", words)];
            values.map(|values| variable(name, dimensions, NetcdfValues::F64(values), &attributes))
        };
    let per_length = column(
        |c| c.per_length,
        "extinction_per_length",
        "extinction coefficient of the volume that the scene tells",
        "m-1",
    );
    let per_mass = column(
        |c| c.per_mass,
        "extinction_per_mass",
        "extinction by mass of the particles",
        "m2 kg-1",
    );
    per_length.into_iter().chain(per_mass).collect()
}

/// Attributes of the file: where it is from, what was done to the table, and `more`.
pub(in crate::export) fn attributes(
    table: &PhaseTable,
    averaged: &Averaged,
    more: &[(&str, &str)],
) -> Vec<(String, String)> {
    let mut attributes = vec![
        ("source".to_string(), format!("gonio {}", env!("CARGO_PKG_VERSION"))),
        ("scene".to_string(), table.header.scene_toml.clone()),
        ("forward_peak".to_string(), peak_words(averaged)),
        ("polarised".to_string(), if averaged.polarised { "yes" } else { "no" }.to_string()),
    ];
    let bodies = table.header.bodies.as_ref();
    if let Some(density) = bodies.and_then(|bodies| bodies.density) {
        attributes.push(("density_kg_m3".to_string(), density.to_string()));
    }
    let told: Vec<String> = notes(table)
        .into_iter()
        .chain(density_note(table))
        .chain(shape_note(table, averaged))
        .collect();
    if !told.is_empty() {
        attributes.push(("notes".to_string(), told.join(". ")));
    }
    attributes.extend(more.iter().map(|(name, text)| (name.to_string(), text.to_string())));
    attributes
}

/// What was done to the forward peak, in words.
fn peak_words(averaged: &Averaged) -> String {
    format!(
        "Below {:.4} degree the phase function keeps its value there; the power cut off \
         (peak_share of the scattered power) counts as unscattered and is not in the cross-sections.",
        averaged.cap.to_degrees()
    )
}
