//! CSV files of optical data: columns wavelength, n, k or absorbance, the unit in the header.
//!
//! ```text
//! # source: who measured it (comment lines are free; this one is kept as the source)
//! wavelength_nm,n,k
//! 400,1.33,1e-9
//! ```
//! The wavelength's name is `wavelength`, `lambda` or `wl`, its unit `nm`, `um` or `m` after an
//! underscore or in brackets. Commas, semicolons, tabs or blanks separate.

use super::MediumError;
use super::table::{Column, Table, TableBuilder, Unit, file_error};
use std::path::Path;

/// Reads a table from a file.
pub fn read(path: &Path) -> Result<Table, MediumError> {
    parse(&super::read_text(path)?, path)
}

/// Reads a table from text; `path` is for messages.
pub(super) fn parse(text: &str, path: &Path) -> Result<Table, MediumError> {
    let mut source = String::new();
    let mut builder = None;
    for (i, line) in text.lines().enumerate() {
        let line = line.trim().trim_start_matches('\u{feff}');
        let number = i + 1;
        if let Some(comment) = line.strip_prefix('#') {
            if let Some(named) = comment.trim().strip_prefix("source:") {
                source = named.trim().to_string();
            }
            continue;
        }
        if line.is_empty() {
            continue;
        }
        match &mut builder {
            None => builder = Some(header(line, number, path)?),
            Some(rows) => rows.push(number, &numbers(line, number, path)?)?,
        }
    }
    match builder {
        Some(rows) => rows.finish(if source.is_empty() { file_name(path) } else { source }),
        None => Err(file_error(path, None, "no header: expected a line like wavelength_nm,n,k")),
    }
}

fn file_name(path: &Path) -> String {
    path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default()
}

fn header<'a>(line: &str, number: usize, path: &'a Path) -> Result<TableBuilder<'a>, MediumError> {
    let fail = |message: String| Err(file_error(path, Some(number), message));
    // Blanks separate only where nothing else does: "wavelength (nm), n" has one inside a name.
    let names: Vec<String> = fields(line).map(normalise).collect();
    let Some(unit) = names.first().and_then(|name| wavelength_unit(name)) else {
        let found = names.first().map_or("", String::as_str);
        return fail(format!(
            "first column \"{found}\": expected wavelength_nm, wavelength_um or wavelength_m"
        ));
    };
    let mut columns = Vec::new();
    for name in &names[1..] {
        let column = match name.as_str() {
            "n" => Column::N,
            "k" => Column::K,
            "absorbance" | "abs" => Column::Absorbance,
            _ => return fail(format!("column \"{name}\": expected n, k or absorbance")),
        };
        if columns.contains(&column) {
            return fail(format!("column \"{name}\" twice"));
        }
        columns.push(column);
    }
    if columns.is_empty() {
        return fail("no column besides the wavelength: expected n, k or absorbance".into());
    }
    Ok(TableBuilder::new(path, unit, columns))
}

fn numbers(line: &str, number: usize, path: &Path) -> Result<Vec<f64>, MediumError> {
    let parse = |field: &str| {
        field
            .parse()
            .map_err(|_| file_error(path, Some(number), format!("\"{field}\" is not a number")))
    };
    fields(line).map(parse).collect()
}

/// The fields of a line, cut at whichever separator it has.
fn fields(line: &str) -> Box<dyn Iterator<Item = &str> + '_> {
    match [',', ';', '\t'].into_iter().find(|c| line.contains(*c)) {
        Some(separator) => Box::new(line.split(separator).map(str::trim)),
        None => Box::new(line.split_whitespace()),
    }
}

/// Lower case, quotes off, brackets and blanks as underscores: `Wavelength (µm)` → `wavelength_µm`.
fn normalise(name: &str) -> String {
    let lower = name.trim().trim_matches('"').to_lowercase();
    let parts = lower.split(|c: char| "()[]_/ ".contains(c)).filter(|part| !part.is_empty());
    parts.collect::<Vec<_>>().join("_")
}

fn wavelength_unit(name: &str) -> Option<Unit> {
    let (quantity, unit) = name.rsplit_once('_')?;
    let known = ["wavelength", "lambda", "wl", "λ", "vacuum_wavelength", "wavelength_in"];
    if known.contains(&quantity) { Unit::parse(unit) } else { None }
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
            "\"wl [µm]\"\tn\tk\r\n0.4\t1.5\t0\r\n0.5\t1.4\t0.001\r\n",
            "wavelength_m,k,n\n4e-7,0,1.5\n5e-7,1e-3,1.4\n",
        ] {
            let table = parse(text, Path::new("data.csv")).unwrap();
            assert_eq!((table.n, table.k), (vec![1.5, 1.4], vec![0.0, 1e-3]), "{text}");
            assert!((table.wavelength[1] - 5e-7).abs() < 1e-20);
        }
    }

    #[test]
    fn errors_name_file_line_and_remedy() {
        let cases = [
            ("wavelength_nm,n\n400,1.5\n400,1.5\n", "data.csv, line 3: wavelength 400 nm again"),
            ("wavelength_nm,n\n400,1.5\n390,1.5\n", "line 3: wavelength 390 nm after 400 nm"),
            ("wavelength_nm,k\n400,0\n410,-1e-9\n", "line 3: k = -0.000000001 must be 0 or more"),
            ("wavelength_um,n\n400,1.5\n700,1.4\n", "they look like nm"),
            ("wavelength_nm,n\n0.4,1.5\n0.7,1.4\n", "they look like µm"),
            ("wavelength,n\n0.4,1.5\n", "line 1: first column \"wavelength\": expected"),
            ("wavelength_nm,n\n400,1.5,3\n", "line 2: 3 numbers, expected 2"),
            ("wavelength_nm,n\n400,abc\n", "line 2: \"abc\" is not a number"),
            ("wavelength_nm,n\n400,NaN\n", "line 2: NaN is not a finite number"),
            ("wavelength_nm,n\n400,1.5\n", "1 rows of data"),
            ("wavelength_nm,q\n400,1.5\n", "column \"q\""),
            ("", "no header"),
        ];
        for (text, expected) in cases {
            let found = message(text);
            assert!(found.contains(expected), "{found:?} lacks {expected:?}");
        }
    }
}
