//! A table of optical data: columns by wavelength, and what may stand in them.
//!
//! Errors name the file and the line; see [`Samples`] for what becomes of rows that hold what their column
//! cannot.

use crate::medium::data::column::Column;
use crate::medium::data::samples::{Row, Samples};
use crate::medium::data::unit::Unit;
use crate::medium::error::{MediumError, file_error};
use std::path::Path;

/// Optical data by wavelength; a column that the file lacks is empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// What the file says about its source.
    pub source: String,
    /// Real part.
    pub n: Samples,
    /// Imaginary part.
    pub k: Samples,
    /// Decadic absorbance `log10(I0/I)`.
    pub absorbance: Samples,
    /// The unit of the file's wavelengths.
    pub unit: Option<Unit>,
    /// What the reader changed or left out: notes for the user.
    pub notes: Vec<String>,
}

/// Collects rows of several columns.
pub(in crate::medium) struct TableBuilder<'a> {
    path: &'a Path,
    rows: [Vec<Row>; 3],
    table: Table,
}

impl<'a> TableBuilder<'a> {
    pub(in crate::medium) fn new(path: &'a Path) -> Self {
        Self { path, rows: Default::default(), table: Table::default() }
    }

    /// Adds a row to one column: the wavelength in metres where it could be read.
    pub(in crate::medium) fn push(&mut self, column: Column, row: Row) {
        self.rows[column as usize].push(row);
    }

    pub(in crate::medium) fn note(&mut self, note: String) {
        self.table.notes.push(note);
    }

    /// The table, if it has rows.
    pub(in crate::medium) fn finish(
        mut self,
        source: String,
        unit: Unit,
    ) -> Result<Table, MediumError> {
        let last_line = self.rows.iter().flatten().map(|r| r.line).max();
        let [n, k, absorbance] = self.rows;
        let table = &mut self.table;
        table.n = Samples::new(self.path, Column::N, n, &mut table.notes)?;
        table.k = Samples::new(self.path, Column::K, k, &mut table.notes)?;
        table.absorbance =
            Samples::new(self.path, Column::Absorbance, absorbance, &mut table.notes)?;
        if table.n.is_empty() && table.k.is_empty() && table.absorbance.is_empty() {
            return Err(file_error(self.path, last_line, "no rows of data"));
        }
        table.source = source;
        table.unit = Some(unit);
        table.notes.dedup();
        Ok(self.table)
    }
}

/// What a medium of a file is called: the file's name without folder and ending.
pub(in crate::medium) fn name_of(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}
