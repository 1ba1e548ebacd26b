//! Writing one table, wavelength by wavelength: memory does not grow with their number.

use super::body::{Body, check_slab};
use crate::hdf5::file::created::{NewDataset, NewFile};
use crate::hdf5::format::faces::write_solid_angle;
use crate::hdf5::output::{Output, WriteOptions};
use crate::hdf5::space::estimate_bytes;
use crate::hdf5::{TableError, invalid};
use crate::phase_table::variables::Store;
use crate::phase_table::variables::circumstances::{write_numbers, write_scalars};
use crate::phase_table::variables::dimensions::Dimensions;
use crate::phase_table::variables::methods::write_methods;
use crate::phase_table::variables::record::{Record, write_records};
use crate::phase_table::variables::schema::{FORMAT, write_root};
use crate::phase_table::{PhaseTable, Slab, TableHeader};
use std::path::Path;

/// A table being written. Dropped before [`TableWriter::finish`] it leaves nothing behind.
pub struct TableWriter {
    // Closed before the pending file is removed: fields drop in this order.
    body: Body,
    dimensions: Dimensions<NewDataset>,
    file: NewFile,
    output: Output,
    header: TableHeader,
    records: Vec<Option<Record>>,
}

impl std::fmt::Debug for TableWriter {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("TableWriter").field("output", &self.output).finish_non_exhaustive()
    }
}

impl TableWriter {
    /// Start the file of a table beside `path`.
    ///
    /// # Errors
    /// When `path` exists (and is not to be overwritten) or cannot be written, when the disk is
    /// too full for the table, when the header or the options are wrong.
    pub fn create(
        path: &Path,
        header: &TableHeader,
        options: WriteOptions,
    ) -> Result<TableWriter, TableError> {
        header.validate()?;
        let output = Output::start(path, estimate_bytes(header), &options)?;
        let file = output.create()?;
        write_root(&file, header, &options.root(FORMAT))?;
        let dimensions = Dimensions::create(&file, &header.axes, header.quantity)?;
        write_solid_angle(&file, &dimensions, &header.axes)?;
        write_scalars(&file, header, |_| false)?;
        write_numbers(&file, &[Some(header.clone())], &[], &[])?;
        let body = Body::create(&file, header, &dimensions, &[], &options)?;
        let records = vec![None; header.axes.wavelength.len()];
        Ok(TableWriter { body, dimensions, file, output, header: header.clone(), records })
    }

    /// Write the slab of the wavelength number `index`, in any order, once each.
    ///
    /// # Errors
    /// When the slab does not belong there or has another shape; when the disk is full.
    pub fn write_slab(&mut self, index: usize, slab: &Slab) -> Result<(), TableError> {
        check_slab(&self.header, index, slab)?;
        if self.records[index].is_some() {
            return Err(invalid("slab", index, "each wavelength is written once"));
        }
        self.body.write(&self.file, &self.dimensions, &[], &[index as u64], slab)?;
        self.records[index] = Some(Record::from(slab));
        Ok(())
    }

    /// Complete the file and give it its name.
    ///
    /// # Errors
    /// When a slab is missing, the disk is full, or a file of that name has appeared meanwhile.
    pub fn finish(self) -> Result<(), TableError> {
        let TableWriter { body, dimensions, file, output, records, header } = self;
        if let Some(missing) = records.iter().position(Option::is_none) {
            return Err(invalid(
                "slab",
                missing,
                "every wavelength must be written before the end",
            ));
        }
        write_records(&file, &records, &[&dimensions.wavelength], &[records.len() as u64])?;
        write_methods(&file, &header.axes.wavelength, &records)?;
        file.attribute_integer("complete", 1)?;
        drop((body, dimensions));
        file.close()?;
        output.publish()
    }
}

/// Write a whole table.
///
/// # Errors
/// As [`TableWriter`]; a table with a different number of slabs than wavelengths is refused.
pub fn write(path: &Path, table: &PhaseTable, options: WriteOptions) -> Result<(), TableError> {
    let mut writer = TableWriter::create(path, &table.header, options)?;
    for (index, slab) in table.slabs.iter().enumerate() {
        writer.write_slab(index, slab)?;
    }
    writer.finish()
}
