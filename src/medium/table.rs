//! A table of optical data, and the checks that every row of every file passes.
//!
//! Errors name the file and the line. Wavelengths must ascend strictly; k and absorbance are not
//! negative; a file whose numbers only make sense in another unit than the declared one is refused
//! rather than read a thousand times wrong.

use super::{MediumError, invalid};
use crate::math::monotone::MonotoneCurve;
use std::path::Path;

/// Optical data by wavelength in metres; a column that the file lacks is empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// What the file says about its source.
    pub source: String,
    pub wavelength: Vec<f64>,
    pub n: Vec<f64>,
    pub k: Vec<f64>,
    /// Decadic absorbance `log10(I0/I)`.
    pub absorbance: Vec<f64>,
}

/// The unit of a file's wavelengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    Nanometre,
    Micrometre,
    Metre,
}

impl Unit {
    /// The unit of a name such as `nm`, `um`, `µm`, `m`.
    pub(super) fn parse(text: &str) -> Option<Self> {
        match text {
            "nm" | "nanometre" | "nanometer" | "nanometres" | "nanometers" => Some(Self::Nanometre),
            "um" | "µm" | "μm" | "micron" | "microns" | "micrometre" | "micrometer"
            | "micrometres" | "micrometers" => Some(Self::Micrometre),
            "m" | "metre" | "meter" | "metres" | "meters" => Some(Self::Metre),
            _ => None,
        }
    }

    fn metres(self) -> f64 {
        match self {
            Self::Nanometre => 1e-9,
            Self::Micrometre => 1e-6,
            Self::Metre => 1.0,
        }
    }

    fn symbol(self) -> &'static str {
        match self {
            Self::Nanometre => "nm",
            Self::Micrometre => "µm",
            Self::Metre => "m",
        }
    }

    /// Wavelength in metres. Division keeps round numbers round (589.3 / 1e9).
    pub(super) fn to_metres(self, value: f64) -> f64 {
        match self {
            Self::Nanometre => value / 1e9,
            Self::Micrometre => value / 1e6,
            Self::Metre => value,
        }
    }
}

/// A column of values besides the wavelength.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Column {
    N,
    K,
    Absorbance,
}

/// Collects rows into a [`Table`] and refuses unsound ones.
pub(super) struct TableBuilder<'a> {
    path: &'a Path,
    unit: Unit,
    columns: Vec<Column>,
    previous: Option<(usize, f64)>,
    table: Table,
}

/// Longest wavelength, in metres, of a file that can be in the declared unit, and shortest: a
/// table that lies wholly beyond is in another unit. Light from 1 nm to 100 µm passes.
const PLAUSIBLE: (f64, f64) = (1e-9, 100e-6);

impl<'a> TableBuilder<'a> {
    pub(super) fn new(path: &'a Path, unit: Unit, columns: Vec<Column>) -> Self {
        Self { path, unit, columns, previous: None, table: Table::default() }
    }

    /// Adds the row of numbers (wavelength first) that stands in line `line`.
    pub(super) fn push(&mut self, line: usize, numbers: &[f64]) -> Result<(), MediumError> {
        let fail = |message: String| Err(file_error(self.path, Some(line), message));
        if numbers.len() != self.columns.len() + 1 {
            let expected = self.columns.len() + 1;
            return fail(format!("{} numbers, expected {expected}", numbers.len()));
        }
        if let Some(bad) = numbers.iter().find(|v| !v.is_finite()) {
            return fail(format!("{bad} is not a finite number"));
        }
        let wavelength = numbers[0];
        let symbol = self.unit.symbol();
        if wavelength <= 0.0 {
            return fail(format!("wavelength {wavelength} {symbol} must be positive"));
        }
        if let Some((before, last)) = self.previous {
            if wavelength == last {
                return fail(format!("wavelength {wavelength} {symbol} again (line {before})"));
            }
            if wavelength < last {
                return fail(format!(
                    "wavelength {wavelength} {symbol} after {last} {symbol} (line {before}): rows \
                     must ascend"
                ));
            }
        }
        self.previous = Some((line, wavelength));
        self.table.wavelength.push(self.unit.to_metres(wavelength));
        for (&column, &value) in self.columns.iter().zip(&numbers[1..]) {
            let (name, values, accepted) = match column {
                Column::N => ("n", &mut self.table.n, (1e-4..=1e4).contains(&value)),
                Column::K => ("k", &mut self.table.k, (0.0..=1e4).contains(&value)),
                Column::Absorbance => ("absorbance", &mut self.table.absorbance, value >= 0.0),
            };
            if !accepted {
                let bound = match column {
                    Column::N if value <= 0.0 => "positive",
                    Column::N => "1e-4 to 1e4",
                    Column::K if value > 0.0 => "at most 1e4",
                    Column::K | Column::Absorbance => "0 or more",
                };
                // Three hundred digits would help nobody.
                let value = if value < 1e15 { value.to_string() } else { format!("{value:e}") };
                let message = format!("{name} = {value} must be {bound}");
                return Err(file_error(self.path, Some(line), message));
            }
            values.push(value);
        }
        Ok(())
    }

    /// The table, if it has rows enough and its unit can be right.
    pub(super) fn finish(mut self, source: String) -> Result<Table, MediumError> {
        let rows = &self.table.wavelength;
        let last_line = self.previous.map(|(line, _)| line);
        if rows.len() < 2 {
            let message = format!("{} rows of data, expected at least 2", rows.len());
            return Err(file_error(self.path, last_line, message));
        }
        let (first, last) = (rows[0], rows[rows.len() - 1]);
        if last < PLAUSIBLE.0 || first > PLAUSIBLE.1 {
            let (unit, symbol) = (self.unit.metres(), self.unit.symbol());
            let guess = guess_unit(first / unit, last / unit);
            let message = format!(
                "wavelengths from {:.6} to {:.6} {symbol}: the declared unit {symbol} cannot be \
                 right{guess}",
                first / unit,
                last / unit,
            );
            return Err(file_error(self.path, None, message));
        }
        self.table.source = source;
        Ok(self.table)
    }
}

fn guess_unit(first: f64, last: f64) -> String {
    let fits = |unit: Unit| first * unit.metres() <= 20e-6 && last * unit.metres() >= 100e-9;
    let guess = [Unit::Nanometre, Unit::Micrometre].into_iter().find(|u| fits(*u));
    guess.map_or(String::new(), |u| format!(" (they look like {})", u.symbol()))
}

/// The curve through the rows of a column.
pub(super) fn curve(x: &[f64], y: &[f64]) -> Result<MonotoneCurve, MediumError> {
    MonotoneCurve::new(x.to_vec(), y.to_vec()).ok_or_else(|| {
        invalid(
            "table",
            format!("{} wavelengths, {} values", x.len(), y.len()),
            "as many values as wavelengths, ascending, at least two",
        )
    })
}

/// An error about a file.
pub(super) fn file_error(
    path: &Path,
    line: Option<usize>,
    message: impl Into<String>,
) -> MediumError {
    MediumError::File { path: path.to_path_buf(), line, message: message.into() }
}

/// What a medium of a file is called: the file's name without folder and ending.
pub(super) fn name_of(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}
