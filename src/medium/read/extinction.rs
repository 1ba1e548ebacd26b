//! Files that hold the extinction coefficient k and no n: no medium, but data to be looked at.

use crate::medium::data::material::Material;
use crate::medium::data::samples::DataCurve;
use crate::medium::data::table::name_of;
use crate::medium::error::{MediumError, check_range};
use crate::medium::read::{csv_table, refractive_index_info};
use crate::medium::spec::has_ending;
use std::path::Path;

/// k by wavelength, from a file without n.
#[derive(Clone, Debug, PartialEq)]
pub struct Extinction {
    pub name: String,
    pub source: String,
    /// What the reader of the file changed or left out.
    pub notes: Vec<String>,
    curve: DataCurve,
}

/// What a file of optical data holds.
pub(in crate::medium) enum Data {
    Material(Box<Material>),
    Extinction(Extinction),
}

impl Extinction {
    pub(in crate::medium) fn new(
        name: String,
        source: String,
        notes: Vec<String>,
        curve: DataCurve,
    ) -> Self {
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
