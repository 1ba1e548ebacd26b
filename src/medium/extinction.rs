//! Files that hold the extinction coefficient k and no n: no medium, but data to be looked at.

use super::samples::DataCurve;
use super::spec::has_ending;
use super::table::name_of;
use super::{Material, MediumError, check_range, csv_table, refractive_index_info};
use std::path::Path;

/// k by wavelength, from a file without n.
#[derive(Clone, Debug, PartialEq)]
pub struct Extinction {
    /// What it is called.
    pub name: String,
    /// Where the data are from.
    pub source: String,
    /// What the reader of the file changed or left out.
    pub notes: Vec<String>,
    curve: DataCurve,
}

/// What a file of optical data holds.
pub(super) enum Data {
    Material(Box<Material>),
    Extinction(Extinction),
}

impl Extinction {
    pub(super) fn new(name: String, source: String, notes: Vec<String>, curve: DataCurve) -> Self {
        Self { name, source, notes, curve }
    }

    /// Reads a file that resolving refused with [`MediumError::OnlyExtinction`]; `None` for one that
    /// has n.
    pub fn read(path: &Path) -> Result<Option<Self>, MediumError> {
        if has_ending(path, &["csv", "txt", "tsv"]) {
            let table = csv_table::read(path)?;
            let only = table.n.is_empty() && !table.k.is_empty();
            let extinction =
                || Self::new(name_of(path), table.source, table.notes, table.k.curve());
            return Ok(only.then(extinction));
        }
        match refractive_index_info::read_data(path)? {
            Data::Extinction(extinction) => Ok(Some(extinction)),
            Data::Material(_) => Ok(None),
        }
    }

    /// Wavelengths in metres that the data cover.
    pub fn range(&self) -> (f64, f64) {
        self.curve.range()
    }

    /// k at a wavelength in metres.
    pub fn value(&self, wavelength: f64) -> Result<f64, MediumError> {
        match self.curve.value(wavelength) {
            Some(value) => value,
            None => {
                check_range(&self.name, wavelength, self.range())?;
                self.curve.held(wavelength)
            }
        }
    }
}
