//! By which methods tables were computed: those of a sweep written, and all of them read.

use crate::hdf5::file::created::{NewDataset, NewFile};
use crate::hdf5::file::opened::OpenFile;
use crate::hdf5::{TableError, damaged};
use crate::phase_table::MethodRange;
use crate::phase_table::variables::methods::{METHODS, text};
use crate::phase_table::variables::record::Record;
use crate::phase_table::variables::{Kind, Store, Variable};

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
    let data = file.variable(METHODS, Kind::Texts, shape)?;
    data.write_texts(&texts)?;
    data.attribute("long_name", "JSON: what computed each order, why, its expected error")?;
    data.attach(dimensions)
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
