//! Text tables of optical data: columns of wavelength, n, k, permittivity or absorbance.
//!
//! ```text
//! # source: who measured it (comment lines are free; this one is kept as the source)
//! wavelength_nm,n,k
//! 400,1.33,1e-9
//! ```
//! The first column is a wavelength, wavenumber, photon energy or frequency with its unit after an
//! underscore or in brackets; `wl` alone is that of refractiveindex.info's own downloads, in µm,
//! whose second block (`wl,k`) may follow. Columns: `n`, `k` (or `kappa`), `absorbance`, and the
//! permittivity `eps1`, `eps2`, which becomes `n + ik = √(ε₁ + iε₂)`. Rows may stand in any order;
//! an empty cell is no row of its column. Dialects: see `csv_cells`.

use crate::medium::data::column::Column;
use crate::medium::data::samples::Row;
use crate::medium::data::table::{Table, TableBuilder};
use crate::medium::data::unit::Unit;
use crate::medium::error::{MediumError, file_error};
use crate::medium::read::csv_cells::{Separator, comment, number};
use crate::medium::read::text;
use num_complex::Complex64;
use std::path::Path;

/// Reads a table from a file.
pub fn read(path: &Path) -> Result<Table, MediumError> {
    let text = text::read(path)?;
    let mut table = parse(&text.text, path)?;
    table.notes.splice(0..0, text.note);
    Ok(table)
}

/// What a column after the first holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Field {
    Value(Column),
    Permittivity,
    Loss,
}

/// A header with what follows from it for the rows below.
struct Header {
    unit: Unit,
    fields: Vec<Field>,
    separator: Separator,
}

/// Reads a table from text; `path` is for messages.
pub(in crate::medium) fn parse(text: &str, path: &Path) -> Result<Table, MediumError> {
    let mut source = String::new();
    let mut builder = TableBuilder::new(path);
    let mut seen: Vec<Field> = Vec::new();
    let mut header: Option<Header> = None;
    for (i, line) in text.lines().enumerate() {
        let (line, number) = (line.trim(), i + 1);
        if let Some(comment) = comment(line) {
            if let Some(named) = comment.trim().strip_prefix("source:") {
                source = named.trim().to_string();
            }
            continue;
        }
        if line.is_empty() {
            continue;
        }
        match &header {
            Some(above) if !begins_block(line, above) => above.row(line, number, &mut builder),
            _ => {
                let block = Header::new(line, number, path, &mut builder)?;
                if let Some(twice) = block.fields.iter().find(|f| seen.contains(f)) {
                    let message = format!("column \"{}\" twice", twice.name());
                    return Err(file_error(path, Some(number), message));
                }
                seen.extend(&block.fields);
                header = Some(block);
            }
        }
    }
    check_columns(&seen, path)?;
    match header {
        Some(header) => {
            let source = if source.is_empty() { file_name(path) } else { source };
            builder.finish(source, header.unit)
        }
        None => Err(file_error(path, None, "no header: expected a line like wavelength_nm,n,k")),
    }
}

fn file_name(path: &Path) -> String {
    path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default()
}

/// Whether a line below a header is a header itself.
fn begins_block(line: &str, above: &Header) -> bool {
    let cells = above.separator.cells(line);
    cells.first().is_some_and(|first| number(first).is_err() && Unit::of_column(first).is_some())
}

fn check_columns(seen: &[Field], path: &Path) -> Result<(), MediumError> {
    let has = |field| seen.contains(&field);
    let index = [Field::Value(Column::N), Field::Value(Column::K)].into_iter().find(|f| has(*f));
    match index {
        Some(column) if has(Field::Permittivity) || has(Field::Loss) => {
            let message = format!("columns {} and eps: expected one or the other", column.name());
            Err(file_error(path, None, message))
        }
        _ if has(Field::Loss) && !has(Field::Permittivity) => {
            Err(file_error(path, None, "column eps2 without eps1"))
        }
        _ => Ok(()),
    }
}

impl Field {
    fn parse(name: &str) -> Option<Self> {
        let lower = name.trim().to_lowercase();
        let parts = lower.split(|c: char| "()[]_ ".contains(c)).filter(|part| !part.is_empty());
        Some(match parts.collect::<Vec<_>>().join("_").as_str() {
            "n" | "index" | "refractive_index" => Self::Value(Column::N),
            "k" | "kappa" | "κ" | "extinction" | "extinction_coefficient" => {
                Self::Value(Column::K)
            }
            "absorbance" | "abs" => Self::Value(Column::Absorbance),
            "eps1" | "eps_1" | "epsilon1" | "epsilon_1" | "e1" | "ε1" | "ε_1" | "ε₁"
            | "eps_real" | "eps_re" | "eps'" | "ε'" => Self::Permittivity,
            "eps2" | "eps_2" | "epsilon2" | "epsilon_2" | "e2" | "ε2" | "ε_2" | "ε₂"
            | "eps_imag" | "eps_im" | "eps''" | "ε''" => Self::Loss,
            _ => return None,
        })
    }

    fn name(self) -> &'static str {
        match self {
            Self::Value(column) => column.name(),
            Self::Permittivity => "eps1",
            Self::Loss => "eps2",
        }
    }
}

impl Header {
    fn new(
        line: &str,
        number: usize,
        path: &Path,
        builder: &mut TableBuilder,
    ) -> Result<Self, MediumError> {
        let fail = |message: String| Err(file_error(path, Some(number), message));
        let separator = Separator::of_header(line);
        let names = joined_units(separator.cells(line));
        let first = names.first().map_or("", String::as_str);
        let Some(unit) = Unit::of_column(first) else {
            let shown: String = first.chars().take(60).collect();
            return fail(format!(
                "first column \"{shown}\": expected wavelength_nm, wavelength_um, wavelength_m, \
                 wavelength_angstrom, wavenumber_cm-1, energy_eV or frequency_THz"
            ));
        };
        let mut fields = Vec::new();
        for name in &names[1..] {
            let Some(field) = Field::parse(name) else {
                let shown: String = name.chars().take(60).collect();
                return fail(format!(
                    "column \"{shown}\": expected n, k, eps1, eps2 or absorbance"
                ));
            };
            if fields.contains(&field) {
                return fail(format!("column \"{name}\" twice"));
            }
            if ["kappa", "κ"].contains(&name.to_lowercase().as_str()) {
                builder.note(format!("column {name} is taken for k of n + ik"));
            }
            fields.push(field);
        }
        if fields.is_empty() {
            return fail(
                "no column besides the wavelength: expected n, k, eps1 or absorbance".into(),
            );
        }
        Ok(Self { unit, fields, separator })
    }

    /// The cells of a row; where they are cut otherwise than the header's, by whatever cuts them.
    fn cells(&self, line: &str) -> Vec<String> {
        let cells = self.separator.cells(line);
        if cells.len() == 1 && !self.fields.is_empty() {
            return Separator::of_header(line).cells(line);
        }
        cells
    }

    fn row(&self, line: &str, number: usize, builder: &mut TableBuilder) {
        let cells = self.cells(line);
        let expected = self.fields.len() + 1;
        let wavelength = self.wavelength(cells.first().map_or("", String::as_str));
        let count = match cells.len() > expected {
            true => Err(format!("{} numbers, expected {expected}", cells.len())),
            false => Ok(()),
        };
        let fault = count.and(wavelength.clone().map(|_| ())).err();
        let value = |index: usize| -> Option<Result<f64, String>> {
            if let Some(fault) = &fault {
                return Some(Err(fault.clone()));
            }
            match cells.get(index + 1) {
                None => Some(Err(format!("{} numbers, expected {expected}", cells.len()))),
                // An empty cell is no row of its column.
                Some(cell) if cell.is_empty() => None,
                Some(cell) => Some(self::number(cell)),
            }
        };
        let wavelength = wavelength.ok();
        let mut push = |column, value| {
            builder.push(column, Row { line: number, wavelength, value });
        };
        for (index, field) in self.fields.iter().enumerate() {
            if let (Field::Value(column), Some(value)) = (field, value(index)) {
                push(*column, value);
            }
        }
        let place = |field| self.fields.iter().position(|f| *f == field);
        if let Some(real) = place(Field::Permittivity).and_then(value) {
            let loss = place(Field::Loss).and_then(value).unwrap_or(Ok(0.0));
            let index = real.and_then(|re| Ok(Complex64::new(re, loss?).sqrt()));
            push(Column::N, index.clone().map(|m| m.re));
            push(Column::K, index.map(|m| m.im));
        }
    }

    /// Wavelength in metres of a row's first cell.
    fn wavelength(&self, cell: &str) -> Result<f64, String> {
        let value = number(cell)?;
        let metres = self.unit.to_metres(value);
        if value > 0.0 && metres > 0.0 && metres.is_finite() {
            return Ok(metres);
        }
        Err(format!("{value} {} must be positive", self.unit.symbol()))
    }
}

/// Joins a unit in brackets to the name before it, where blanks have cut between them.
fn joined_units(cells: Vec<String>) -> Vec<String> {
    let mut joined: Vec<String> = Vec::new();
    for cell in cells {
        match joined.last_mut() {
            Some(before) if cell.starts_with(['(', '[']) => {
                before.push(' ');
                before.push_str(&cell);
            }
            _ => joined.push(cell),
        }
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> String {
        parse(text, Path::new("data.csv")).unwrap_err().to_string()
    }

    #[test]
    fn headers_of_several_hands_are_read() {
        for text in [
            "wavelength_nm,n,k\n400,1.5,0\n500,1.4,1e-3\n",
            "# source: me\n\nWavelength (nm); n; k\n400; 1.5; 0\n500; 1.4; 1E-3\n",
            "lambda_um n k\n0.4 1.5 0\n0.5 1.4 0.001\n",
            "Wavelength (nm) n k\n400 1.5 0\n500 1.4 0.001\n",
            "\"wl [µm]\"\tn\tk\r\n0.4\t1.5\t0\r\n0.5\t1.4\t0.001\r\n",
            "wavelength_m,k,n\n4e-7,0,1.5\n5e-7,1e-3,1.4\n",
            "wl,n\n0.4,1.5\n0.5,1.4\n\nwl,k\n0.4,0\n0.5,0.001\n",
            "wavelength_um;n;k\n0,5;1,4;0,001\n0,4;1,5;0\n",
            "wavelength_um\tn\tkappa\n0,5\t1,4\t0,001\n0,4\t1,5\t0\n",
            "\"wavelength_nm\",\"n\",\"k\"\n\"400\",\"1.5\",\"0\"\n\"500\",\"1.4\",\"0.001\"\n",
            "! Fortran\nwavelength_nm n k\n 4.0D+02 1.5D0 0.0D0\n 5.0D2 1.4D0 1.0D-3\n",
            "wavelength_nm,n,k,\n400,1.5,0,\n500,1.4,1e-3,\n",
            "wavelength_nm,n,k\n400,1.5,0\n450,,\n500,1.4,1e-3 # last\n",
            "wavelength_angstrom,n,k\n4000,1.5,0\n5000,1.4,1e-3\n",
            "wavelength_um,eps1,eps2\n0.4,2.25,0\n0.5,1.959999,0.0028\n",
        ] {
            let table = parse(text, Path::new("data.csv")).unwrap();
            let close = |found: &[f64], expected: [f64; 2]| {
                assert!(found.iter().zip(expected).all(|(f, e)| (f - e).abs() < 1e-15), "{text}");
            };
            close(&table.n.value, [1.5, 1.4]);
            close(&table.k.value, [0.0, 1e-3]);
            assert!((table.n.wavelength[1] - 5e-7).abs() < 1e-20);
        }
    }

    #[test]
    fn errors_name_file_line_and_remedy() {
        let cases = [
            ("wavelength_nm,k\n400,0\n410,-1e-9\n", ""),
            ("wavelength,n\n0.4,1.5\n", "line 1: first column \"wavelength\": expected"),
            ("wavelength_nm,n\n400,1.5,3\n", "line 2: 3 numbers, expected 2"),
            ("wavelength_nm,n\n400,abc\n", "line 2: \"abc\" is not a number"),
            ("wavelength_nm,n\n400,NaN\n", "line 2: NaN is not a finite number"),
            ("wavelength_nm,n\n0,1.5\n", "line 2: 0 nm must be positive"),
            ("wavelength_nm,n\n", "no rows of data"),
            ("wavelength_nm,q\n400,1.5\n", "column \"q\""),
            ("wl,n\n0.4,1.5\n\nwl,n\n0.5,1.5\n", "line 4: column \"n\" twice"),
            ("wl,n,eps1\n0.4,1.5,2.25\n", "columns n and eps"),
            ("wl,eps2\n0.4,1.5\n", "eps2 without eps1"),
            ("", "no header"),
        ];
        for (text, expected) in cases {
            if expected.is_empty() {
                let fault = parse(text, Path::new("data.csv")).unwrap().k.complete().unwrap_err();
                let fault = fault.to_string();
                assert!(fault.contains("line 3: k = -0.000000001 must be 0 or more"), "{fault}");
                continue;
            }
            let found = message(text);
            assert!(found.contains(expected), "{found:?} lacks {expected:?}");
        }
    }
}
