//! Tables of a sweep ordered by effective radius and effective variance, for formats that hold many sizes.

use crate::export::{ExportError, invalid};
use crate::phase_table::PhaseTable;

/// Relative difference of two radii, and difference of two variances, that count as equal: what is left
/// of the sums over a distribution.
const EQUAL: f64 = 1e-4;

/// Tables for every pair of an effective radius and an effective variance.
#[derive(Debug)]
pub struct SizeGrid {
    /// Effective radii, metres, ascending.
    pub radii: Vec<f64>,
    /// Effective variances, ascending.
    pub variances: Vec<f64>,
    /// By radius, then by variance.
    pub tables: Vec<PhaseTable>,
}

impl SizeGrid {
    /// Order the tables of a sweep; a single table makes a grid of one.
    ///
    /// # Errors
    /// When a table does not tell its sizes, or the pairs are not all there once.
    pub fn new(tables: Vec<PhaseTable>) -> Result<SizeGrid, ExportError> {
        let sizes: Vec<(f64, f64)> = tables.iter().map(sizes_of).collect::<Result<_, _>>()?;
        let radii = distinct(sizes.iter().map(|size| size.0), |a, b| b - a <= EQUAL * b);
        let variances = distinct(sizes.iter().map(|size| size.1), |a, b| b - a <= EQUAL);
        let nearest = |line: &[f64], value: f64| {
            let off = |i: &usize| (line[*i] - value).abs();
            (0..line.len()).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(0)
        };
        let mut slots: Vec<Option<PhaseTable>> = Vec::new();
        slots.resize_with(radii.len() * variances.len(), || None);
        let count = tables.len();
        for (table, (radius, variance)) in tables.into_iter().zip(sizes) {
            let place = nearest(&radii, radius) * variances.len() + nearest(&variances, variance);
            slots[place] = Some(table);
        }
        let tables: Vec<PhaseTable> = slots.into_iter().flatten().collect();
        if tables.len() != radii.len() * variances.len() || tables.len() != count {
            let value = format!(
                "{count} tables of {} effective radii and {} variances",
                radii.len(),
                variances.len()
            );
            let accepted =
                "one table for every pair of an effective radius and an effective variance";
            return Err(invalid("sweep", value, accepted));
        }
        Ok(SizeGrid { radii, variances, tables })
    }
}

/// Effective radius (metres) and variance of a table.
fn sizes_of(table: &PhaseTable) -> Result<(f64, f64), ExportError> {
    match &table.header.bodies {
        Some(bodies) => Ok((bodies.effective_radius, bodies.effective_variance)),
        // Older tables do not tell; a sphere is its own effective sphere.
        None if table.header.shape == "sphere" => Ok((table.header.radius, 0.0)),
        None => Err(untold(table)),
    }
}

/// A table of an older version.
pub(in crate::export) fn untold(table: &PhaseTable) -> ExportError {
    let accepted = "a table that tells volume and shadow of its particles; compute it again";
    invalid("table", format!("of a {}, made by an older version", table.header.shape), accepted)
}

fn distinct(values: impl Iterator<Item = f64>, same: impl Fn(f64, f64) -> bool) -> Vec<f64> {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup_by(|b, a| same(*a, *b));
    sorted
}
