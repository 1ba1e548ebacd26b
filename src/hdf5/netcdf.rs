//! Plain netCDF-4 files for other programs: dimensions, variables, attributes as they are given.

use super::file::created::{NewDataset, NewFile};
use super::output::{Output, WriteOptions};
use super::{TableError, invalid};
use crate::phase_table::variables::{Kind, Store, Variable};
use std::path::Path;

/// Values of a variable, last dimension fastest.
#[derive(Clone, Debug, PartialEq)]
pub enum NetcdfValues {
    /// Double precision.
    F64(Vec<f64>),
    /// Single precision.
    F32(Vec<f32>),
    /// Integers.
    I32(Vec<i32>),
    /// Strings.
    Texts(Vec<String>),
}

/// A variable: its name, dimensions by name, values and text attributes.
#[derive(Clone, Debug, PartialEq)]
pub struct NetcdfVariable {
    /// Its name.
    pub name: String,
    /// Names of its dimensions, the last fastest.
    pub dimensions: Vec<String>,
    /// Its values.
    pub values: NetcdfValues,
    /// Names and texts.
    pub attributes: Vec<(String, String)>,
}

/// A whole file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NetcdfFile {
    /// Names and lengths.
    pub dimensions: Vec<(String, usize)>,
    /// All that it holds.
    pub variables: Vec<NetcdfVariable>,
    /// Names and texts, of the file.
    pub attributes: Vec<(String, String)>,
}

/// Write a netCDF-4 file.
///
/// # Errors
/// When a variable does not fill its dimensions, the file exists (without `overwrite`) or cannot be
/// written.
pub fn write_netcdf(path: &Path, content: &NetcdfFile, overwrite: bool) -> Result<(), TableError> {
    let options = WriteOptions { overwrite, ..WriteOptions::default() };
    let output = Output::start(path, 0, &options)?;
    let file = output.create()?;
    content.attributes.iter().try_for_each(|(name, text)| file.attribute(name, text))?;

    // Dimensions first, with their coordinate variable where there is one.
    let mut scales: Vec<(&str, NewDataset)> = Vec::new();
    for (name, length) in &content.dimensions {
        let is_coordinate = |v: &&NetcdfVariable| v.name == *name && v.dimensions == [name.clone()];
        let scale = match content.variables.iter().find(is_coordinate) {
            Some(variable) => {
                let scale = write_variable(&file, variable, &[*length as u64])?;
                scale.make_scale(name)?;
                scale
            }
            None => {
                let scale = file.dataset(name, Kind::F32, &[*length as u64], None)?;
                // What netCDF-C calls a dimension that has no variable.
                let label = "This is a netCDF dimension but not a netCDF variable.";
                scale.make_scale(&format!("{label}{length:10}"))?;
                scale
            }
        };
        scales.push((name, scale));
    }
    for variable in &content.variables {
        if variable.dimensions == [variable.name.clone()] {
            continue;
        }
        let along = variable.dimensions.iter().map(|dimension| {
            let found = scales.iter().find(|(name, _)| name == dimension);
            found.ok_or_else(|| invalid("dimension", dimension, "a dimension of the file"))
        });
        let along = along.collect::<Result<Vec<_>, _>>()?;
        let shape: Vec<u64> = along.iter().map(|(_, scale)| scale.length()).collect();
        let data = write_variable(&file, variable, &shape)?;
        if !along.is_empty() {
            data.attach(&along.iter().map(|(_, scale)| scale).collect::<Vec<_>>())?;
        }
    }
    drop(scales);
    file.close()?;
    output.publish()
}

fn write_variable(
    file: &NewFile,
    variable: &NetcdfVariable,
    shape: &[u64],
) -> Result<NewDataset, TableError> {
    let (kind, length) = match &variable.values {
        NetcdfValues::F64(values) => (Kind::F64, values.len()),
        NetcdfValues::F32(values) => (Kind::F32, values.len()),
        NetcdfValues::I32(values) => (Kind::I32, values.len()),
        NetcdfValues::Texts(values) => (Kind::Texts, values.len()),
    };
    if length as u64 != shape.iter().product::<u64>() {
        let accepted = format!("as many as its dimensions {shape:?}");
        return Err(invalid(&variable.name, format!("{length} values"), &accepted));
    }
    let data = file.dataset(&variable.name, kind, shape, None)?;
    match &variable.values {
        NetcdfValues::F64(values) => data.write(values)?,
        NetcdfValues::F32(values) => data.write(values)?,
        NetcdfValues::I32(values) => data.write(values)?,
        NetcdfValues::Texts(values) => data.write_texts(values)?,
    }
    variable.attributes.iter().try_for_each(|(name, text)| data.attribute(name, text))?;
    Ok(data)
}
