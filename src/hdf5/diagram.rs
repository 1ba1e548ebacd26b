//! Diagrams that are no phase tables: named axes and values over them, with the same dimension
//! scales, so that the same readers open them.

use super::TableError;
use super::output::{Output, WriteOptions};
use crate::phase_table::variables::dimensions::scale;
use crate::phase_table::variables::{Kind, Store, Variable};
use std::path::Path;

/// One axis.
pub struct DiagramAxis<'a> {
    /// Name of the dimension.
    pub name: &'a str,
    /// In the words of UDUNITS.
    pub units: &'a str,
    /// For people.
    pub long_name: &'a str,
    /// Coordinates.
    pub values: &'a [f64],
}

/// Values over some of the axes (by index), last axis fastest.
pub struct DiagramValues<'a> {
    /// Name of the variable.
    pub name: &'a str,
    /// In the words of UDUNITS.
    pub units: &'a str,
    /// For people.
    pub long_name: &'a str,
    /// Which axes it runs along, by their place in the list.
    pub axes: &'a [usize],
    /// Values, the last axis fastest.
    pub values: &'a [f32],
}

/// Write a diagram; the file appears only when it is complete.
///
/// # Errors
/// [`TableError`] as for tables: the file exists, the disk is full, the folder is missing.
pub fn write_diagram(
    path: &Path,
    overwrite: bool,
    attributes: &[(&str, &str)],
    axes: &[DiagramAxis<'_>],
    values: &[DiagramValues<'_>],
) -> Result<(), TableError> {
    let bytes = values.iter().map(|v| 4 * v.values.len() as u64).sum();
    let options = WriteOptions { overwrite, ..WriteOptions::default() };
    let output = Output::start(path, bytes, &options)?;
    let file = output.create()?;
    for (name, text) in attributes {
        file.attribute(name, text)?;
    }
    let mut scales = Vec::new();
    for axis in axes {
        let data = scale(&file, axis.name, axis.values, axis.units)?;
        data.attribute("long_name", axis.long_name)?;
        scales.push(data);
    }
    for value in values {
        let shape: Vec<u64> = value.axes.iter().map(|&a| axes[a].values.len() as u64).collect();
        let data = file.dataset(value.name, Kind::F32, &shape, None)?;
        data.write(value.values)?;
        data.attribute("units", value.units)?;
        data.attribute("long_name", value.long_name)?;
        let attached: Vec<_> = value.axes.iter().map(|&a| &scales[a]).collect();
        data.attach(&attached)?;
    }
    drop(scales);
    file.close()?;
    output.publish()
}
