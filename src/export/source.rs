//! What is exported: one table, or those of a sweep of sizes with its axes.

use crate::export::atmosphere::sasktran2::SizeDimension;
use crate::export::{ExportError, invalid};
use crate::hdf5::{self, AxisValues, SweepReader, TableError, position_of};
use crate::phase_table::PhaseTable;
use std::path::Path;

/// Tables with the sizes they were made for.
#[derive(Clone, Debug)]
pub struct Source {
    /// At least one.
    pub tables: Vec<PhaseTable>,
    /// As sasktran2 names them; empty for one table.
    pub sizes: Vec<SizeDimension>,
}

impl Source {
    /// The table of a file; where the format holds `many_sizes`, all tables of a sweep of sizes.
    ///
    /// # Errors
    /// A file that is neither, or a sweep that the format cannot hold.
    pub fn read(path: &Path, many_sizes: bool) -> Result<Self, ExportError> {
        match hdf5::read(path) {
            Ok(table) => Ok(Self { tables: vec![table], sizes: Vec::new() }),
            Err(TableError::Foreign { .. }) if SweepReader::open(path).is_ok() => {
                Self::read_sweep(path, many_sizes)
            }
            Err(error) => Err(error.into()),
        }
    }

    fn read_sweep(path: &Path, many_sizes: bool) -> Result<Self, ExportError> {
        let reader = SweepReader::open(path)?;
        let refuse = |why: String| ExportError::Sweep { path: path.to_path_buf(), why };
        if !many_sizes {
            let why =
                "it can be exported to eradiate, sasktran2 or libradtran, which hold many sizes";
            return Err(refuse(why.into()));
        }
        let mut sizes = Vec::new();
        for axis in reader.axes() {
            let numbers = axis.coordinates.iter().find_map(|coordinate| match &coordinate.values {
                AxisValues::Numbers(values) if is_size(&coordinate.name) => {
                    Some(SizeDimension::of_coordinate(&coordinate.name, &coordinate.units, values))
                }
                _ => None,
            });
            let name = axis.coordinates.first().map_or("", |coordinate| &coordinate.name);
            let why =
                format!("its axis {name} is no size of particles, and the format has only those");
            sizes.push(numbers.ok_or_else(|| refuse(why))?);
        }
        let shape: Vec<usize> = reader.axes().iter().map(|axis| axis.len()).collect();
        let present = reader.present()?;
        if present.iter().any(|present| !present) {
            return Err(refuse("tables of it are missing".into()));
        }
        let tables = (0..present.len()).map(|i| reader.table(&position_of(i, &shape)));
        Ok(Self { tables: tables.collect::<Result<_, _>>()?, sizes })
    }

    /// The same with another density of the particles' medium, kg/m³.
    ///
    /// # Errors
    /// A density that no medium has.
    pub fn with_density(mut self, density: f64) -> Result<Self, ExportError> {
        if !(density.is_finite() && (1e-3..=3e4).contains(&density)) {
            return Err(invalid("density", density, ACCEPTED_DENSITY));
        }
        for table in &mut self.tables {
            if let Some(bodies) = table.header.bodies.take() {
                table.header.bodies =
                    Some(bodies.with_density(Some(density), "given to the export"));
            }
        }
        Ok(self)
    }
}

/// Densities that [`Source::with_density`] takes.
pub const ACCEPTED_DENSITY: &str = "0.001 to 30000 kg/m³ is accepted";

/// Names of swept keys that are sizes of particles or parameters of their distribution.
fn is_size(name: &str) -> bool {
    const PARAMETERS: [&str; 4] =
        ["spread", "effective_variance", "deviation_um", "rain_rate_mm_h"];
    name.ends_with("radius_um") || PARAMETERS.contains(&name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_told_from_other_keys() {
        assert!(is_size("radius_um") && is_size("effective_radius_um") && is_size("spread"));
        assert!(!is_size("sun_elevation_deg") && !is_size("temperature_c"));
    }
}
