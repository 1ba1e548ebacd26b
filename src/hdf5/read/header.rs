//! Reading what all slabs share: version, axes, how the table was made.

use crate::hdf5::file::opened::{OpenDataset, OpenFile};
use crate::hdf5::format::circumstances::read_numbers;
use crate::hdf5::{TableError, damaged, foreign};
use crate::phase_table::variables::schema::FORMAT_VERSION;
use crate::phase_table::{Averaging, Axes, ForwardPeak, Quantity, TableHeader};

/// Version known, and written to the end.
pub fn check_version(file: &OpenFile) -> Result<(), TableError> {
    let path = &file.path;
    let version = file.number("format_version")?.unwrap_or(f64::NAN);
    if version != f64::from(FORMAT_VERSION) {
        let message = format!("its format version is {version}, known is {FORMAT_VERSION}");
        return Err(foreign(path, &message));
    }
    if file.number("complete")? != Some(1.0) {
        return Err(damaged(path, "it was not written to the end"));
    }
    Ok(())
}

/// All of a header; radius and sun are those of a single table, NaN where they are swept.
pub fn read_header(file: &OpenFile) -> Result<TableHeader, TableError> {
    let path = &file.path;
    let text = |name: &str| -> Result<String, TableError> {
        file.text(name)?.ok_or_else(|| damaged(path, &format!("attribute {name} is missing")))
    };
    let unknown =
        |name: &str, value: &str| damaged(path, &format!("{name} = {value:?} is unknown"));

    let quantity_text = text("quantity")?;
    let quantity = Quantity::WORDS
        .into_iter()
        .find_map(|(word, quantity)| (word == quantity_text).then_some(quantity))
        .ok_or_else(|| unknown("quantity", &quantity_text))?;
    let peak_text = text("forward_peak")?;
    let forward_peak = ForwardPeak::WORDS
        .into_iter()
        .find_map(|(word, peak)| (word == peak_text).then_some(peak))
        .ok_or_else(|| unknown("forward_peak", &peak_text))?;

    let axes = Axes {
        wavelength: coordinate(file, "wavelength_nm")?
            .read::<f64>()?
            .iter()
            .map(|nm| nm * 1e-9)
            .collect(),
        theta: read_angles(file, "theta")?,
        phi: read_angles(file, "phi")?,
    };
    // Those of the tables of a sweep are read with each table.
    let swept = file.text("sweep_axes")?.is_some();
    let (bodies, averaging, tolerance) =
        if swept { (None, Averaging::default(), f64::NAN) } else { read_numbers(file, &[])? };
    Ok(TableHeader {
        bodies,
        averaging,
        tolerance,
        axes,
        quantity,
        forward_peak,
        rotational_symmetry: file.number("rotational_symmetry")? == Some(1.0),
        method: text("method")?,
        shape: text("shape")?,
        radius: read_scalar(file, "radius_um")? * 1e-6,
        sun_elevation: read_scalar(file, "sun_elevation")?.to_radians(),
        scene_toml: text("scene")?,
        command_line: text("command_line")?,
    })
}

/// A coordinate variable, not read yet.
pub fn coordinate(file: &OpenFile, name: &str) -> Result<OpenDataset, TableError> {
    let data = file.required(name)?;
    if data.shape.len() != 1 {
        return Err(damaged(&file.path, &format!("{name} is not one-dimensional")));
    }
    Ok(data)
}

/// Degrees to radians; 180° and 360° become π and 2π exactly.
fn read_angles(file: &OpenFile, name: &str) -> Result<Vec<f64>, TableError> {
    use std::f64::consts::PI;
    Ok(coordinate(file, name)?.read::<f64>()?.iter().map(|degrees| degrees / 180.0 * PI).collect())
}

/// A scalar variable; NaN where it is an axis of a sweep.
fn read_scalar(file: &OpenFile, name: &str) -> Result<f64, TableError> {
    let data = file.required(name)?;
    if data.shape.is_empty() { Ok(data.read::<f64>()?[0]) } else { Ok(f64::NAN) }
}
