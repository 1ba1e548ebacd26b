//! By which methods a table was computed: JSON in one attribute of a table, in one text per table of a
//! sweep.

use super::record::Record;
use crate::hdf5::file::created::{Kind, NewDataset, NewFile};
use crate::hdf5::file::opened::OpenFile;
use crate::hdf5::{TableError, damaged};
use crate::phase_table::MethodRange;

/// The attribute, and the variable of a sweep.
pub const METHODS: &str = "methods";

/// Of one table; nothing where no method is known.
pub fn write_methods(
    file: &NewFile,
    wavelengths: &[f64],
    records: &[Option<Record>],
) -> Result<(), TableError> {
    match text(wavelengths, records) {
        text if text.is_empty() => Ok(()),
        text => file.attribute(METHODS, &text),
    }
}

/// Of all tables of a sweep; nothing where none is known.
pub fn write_swept_methods(
    file: &NewFile,
    wavelengths: &[f64],
    records: &[Option<Record>],
    dimensions: &[&NewDataset],
    shape: &[u64],
) -> Result<(), TableError> {
    let tables = records.chunks(wavelengths.len());
    let texts: Vec<String> = tables.map(|records| text(wavelengths, records)).collect();
    if texts.iter().all(String::is_empty) {
        return Ok(());
    }
    let data = file.dataset(METHODS, Kind::Texts, shape, None)?;
    data.write_texts(&texts)?;
    data.attribute("long_name", "JSON: what computed each order, why, its expected error")?;
    data.attach(dimensions)
}

/// JSON of the ranges of one table; empty where nothing is known.
fn text(wavelengths: &[f64], records: &[Option<Record>]) -> String {
    let known: Vec<&Record> = records.iter().flatten().collect();
    if known.len() < records.len() || known.iter().all(|record| record.methods.is_empty()) {
        return String::new();
    }
    let methods = known.iter().map(|record| &record.methods);
    let ranges = MethodRange::collect(wavelengths.iter().copied().zip(methods));
    serde_json::to_string(&ranges).unwrap_or_default()
}

/// Of the table at `leading`, its place in a sweep (empty: a table). Tables of older versions have none.
pub fn read_methods(file: &OpenFile, leading: &[u64]) -> Result<Vec<MethodRange>, TableError> {
    let text = if leading.is_empty() {
        file.text(METHODS)?.unwrap_or_default()
    } else {
        match file.dataset(METHODS)? {
            Some(data) if data.shape.len() == leading.len() => {
                let place = leading.iter().zip(&data.shape).fold(0, |at, (i, n)| at * n + i);
                data.read_texts()?.into_iter().nth(place as usize).unwrap_or_default()
            }
            Some(_) => return Err(damaged(&file.path, "methods has another shape than the sweep")),
            None => String::new(),
        }
    };
    if text.is_empty() {
        return Ok(Vec::new());
    }
    serde_json::from_str(&text)
        .map_err(|error| damaged(&file.path, &format!("methods is not what it should be: {error}")))
}
