//! A table of optical data: columns by wavelength, and what may stand in them.
//!
//! Errors name the file and the line. n is positive, k and absorbance are not negative; see
//! [`Samples`] for what becomes of rows that are not so.

use crate::math::monotone::MonotoneCurve;
use crate::medium::data::samples::{Row, Samples};
use crate::medium::data::unit::Unit;
use crate::medium::error::{MediumError, invalid};
use std::path::Path;

/// Optical data by wavelength; a column that the file lacks is empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// What the file says about its source.
    pub source: String,
    pub n: Samples,
    pub k: Samples,
    /// Decadic absorbance `log10(I0/I)`.
    pub absorbance: Samples,
    /// The unit of the file's wavelengths.
    pub unit: Option<Unit>,
    /// What the reader changed or left out: notes for the user.
    pub notes: Vec<String>,
}

/// A column of values besides the wavelength.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::medium) enum Column {
    N,
    K,
    Absorbance,
}

impl Column {
    pub(in crate::medium) fn name(self) -> &'static str {
        match self {
            Self::N => "n",
            Self::K => "k",
            Self::Absorbance => "absorbance",
        }
    }

    /// Whether a value below zero may be noise about zero.
    pub(in crate::medium) fn is_absorption(self) -> bool {
        self != Self::N
    }

    /// Refuses a value that the column cannot hold.
    pub(in crate::medium) fn check(self, value: f64) -> Result<(), String> {
        if !value.is_finite() {
            return Err(format!("{value} is not a finite number"));
        }
        let (accepted, bound) = match self {
            Self::N => (
                (1e-4..=1e4).contains(&value),
                if value <= 0.0 { "positive" } else { "1e-4 to 1e4" },
            ),
            Self::K => (
                (0.0..=1e4).contains(&value),
                if value > 0.0 { "at most 1e4" } else { "0 or more" },
            ),
            Self::Absorbance => (value >= 0.0, "0 or more"),
        };
        if accepted {
            return Ok(());
        }
        // Three hundred digits would help nobody.
        let value = if value < 1e15 { value.to_string() } else { format!("{value:e}") };
        Err(format!("{} = {value} must be {bound}", self.name()))
    }
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

/// The curve through the rows of a column.
pub(in crate::medium) fn curve(x: &[f64], y: &[f64]) -> Result<MonotoneCurve, MediumError> {
    MonotoneCurve::new(x.to_vec(), y.to_vec()).ok_or_else(|| {
        invalid(
            "table",
            format!("{} wavelengths, {} values", x.len(), y.len()),
            "as many values as wavelengths, ascending, at least two",
        )
    })
}

/// An error about a file.
pub(in crate::medium) fn file_error(
    path: &Path,
    line: Option<usize>,
    message: impl Into<String>,
) -> MediumError {
    MediumError::File { path: path.to_path_buf(), line, message: message.into() }
}

/// What a medium of a file is called: the file's name without folder and ending.
pub(in crate::medium) fn name_of(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}
