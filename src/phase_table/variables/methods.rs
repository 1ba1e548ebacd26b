//! By which methods a table was computed: JSON in one attribute of a table, in one text per table of a
//! sweep.

use super::Store;
use super::record::Record;
use crate::phase_table::MethodRange;

/// The attribute, and the variable of a sweep.
pub const METHODS: &str = "methods";

/// Of one table; nothing where no method is known.
pub fn write_methods<S: Store>(
    file: &S,
    wavelengths: &[f64],
    records: &[Option<Record>],
) -> Result<(), S::Error> {
    match text(wavelengths, records) {
        text if text.is_empty() => Ok(()),
        text => file.attribute(METHODS, &text),
    }
}

/// JSON of the ranges of one table; empty where nothing is known.
pub fn text(wavelengths: &[f64], records: &[Option<Record>]) -> String {
    let known: Vec<&Record> = records.iter().flatten().collect();
    if known.len() < records.len() || known.iter().all(|record| record.methods.is_empty()) {
        return String::new();
    }
    let methods = known.iter().map(|record| &record.methods);
    let ranges = MethodRange::collect(wavelengths.iter().copied().zip(methods));
    serde_json::to_string(&ranges).unwrap_or_default()
}
