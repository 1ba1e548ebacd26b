//! Many tables in one file: a sweep, with one more leading dimension per swept value.

use super::body::{Body, check_slab};
use crate::hdf5::file::created::{NewDataset, NewFile};
use crate::hdf5::format::SWEEP_FORMAT;
use crate::hdf5::format::faces::write_solid_angle;
use crate::hdf5::format::methods::write_swept_methods;
use crate::hdf5::output::{Output, WriteOptions};
use crate::hdf5::space::estimate_bytes;
use crate::hdf5::sweep_axis::{AxisValues, SweepAxis};
use crate::hdf5::{TableError, invalid};
use crate::phase_table::variables::circumstances::{write_numbers, write_scalars};
use crate::phase_table::variables::dimensions::Dimensions;
use crate::phase_table::variables::record::{Record, write_records};
use crate::phase_table::variables::schema::write_root;
use crate::phase_table::variables::{Kind, Store, Variable};
use crate::phase_table::{Slab, TableHeader};
use std::path::Path;

/// A sweep being written. Dropped before [`SweepWriter::finish`] it leaves nothing behind.
pub struct SweepWriter {
    body: Body,
    dimensions: Dimensions<NewDataset>,
    scales: Vec<NewDataset>,
    shape: Vec<u64>,
    file: NewFile,
    output: Output,
    header: TableHeader,
    /// Of every table, once it was described.
    headers: Vec<Option<TableHeader>>,
    records: Vec<Option<Record>>,
}

impl SweepWriter {
    /// Start the file of a sweep over `axes`; `header` is what its tables have in common.
    ///
    /// # Errors
    /// As [`crate::hdf5::TableWriter::create`].
    pub fn create(
        path: &Path,
        header: &TableHeader,
        axes: &[SweepAxis],
        options: &WriteOptions,
    ) -> Result<SweepWriter, TableError> {
        header.validate()?;
        let shape: Vec<u64> = axes.iter().map(|axis| axis.len() as u64).collect();
        let tables = shape.iter().fold(1u64, |product, &n| product.saturating_mul(n));
        let bytes = estimate_bytes(header).saturating_mul(tables);
        let output = Output::start(path, bytes, options)?;
        let file = output.create()?;
        write_root(&file, header, &options.root(SWEEP_FORMAT))?;
        let names: Vec<&str> = axes.iter().map(SweepAxis::name).collect();
        file.attribute("sweep_axes", &names.join(" "))?;
        let scales =
            axes.iter().map(|axis| write_axis(&file, axis)).collect::<Result<Vec<_>, _>>()?;
        let dimensions = Dimensions::create(&file, &header.axes, header.quantity)?;
        write_solid_angle(&file, &dimensions, &header.axes)?;
        let swept = |name: &str| axes.iter().flat_map(|a| &a.coordinates).any(|c| c.name == name);
        write_scalars(&file, header, swept)?;
        let leading: Vec<(&NewDataset, u64)> = scales.iter().zip(shape.iter().copied()).collect();
        let body = Body::create(&file, header, &dimensions, &leading, options)?;
        let records = vec![None; tables as usize * header.axes.wavelength.len()];
        let headers = vec![None; tables as usize];
        let header = header.clone();
        Ok(SweepWriter { body, dimensions, scales, shape, file, output, header, headers, records })
    }

    /// Say what the table at `position` (an index per axis) has of its own: its particles as bodies,
    /// what was averaged over, the error asked for. What all tables have in common is not looked at.
    ///
    /// # Errors
    /// When there is no such place.
    pub fn describe(&mut self, position: &[usize], header: &TableHeader) -> Result<(), TableError> {
        let table = self.number(position)?;
        self.headers[table] = Some(header.clone());
        Ok(())
    }

    /// Number of the table at a position.
    fn number(&self, position: &[usize]) -> Result<usize, TableError> {
        let inside = position.len() == self.shape.len()
            && position.iter().zip(&self.shape).all(|(&i, &n)| (i as u64) < n);
        if !inside {
            let accepted = format!("one index per axis of {:?}", self.shape);
            return Err(invalid("position", format!("{position:?}"), &accepted));
        }
        let places = position.iter().zip(&self.shape);
        Ok(places.fold(0, |at, (&i, n)| at * n + i as u64) as usize)
    }

    /// Write one wavelength of the table at `position` (an index per axis).
    ///
    /// # Errors
    /// When the slab does not fit or the disk is full.
    pub fn write_slab(
        &mut self,
        position: &[usize],
        index: usize,
        slab: &Slab,
    ) -> Result<(), TableError> {
        check_slab(&self.header, index, slab)?;
        let table = self.number(position)?;
        let mut place: Vec<u64> = position.iter().map(|&i| i as u64).collect();
        place.push(index as u64);
        let scales: Vec<&NewDataset> = self.scales.iter().collect();
        self.body.write(&self.file, &self.dimensions, &scales, &place, slab)?;
        self.records[table * self.header.axes.wavelength.len() + index] = Some(Record::from(slab));
        Ok(())
    }

    /// Complete the file and give it its name. Tables that were not written stay NaN and 0 in
    /// `present`.
    ///
    /// # Errors
    /// When the disk is full, or a file of that name has appeared meanwhile.
    pub fn finish(self) -> Result<(), TableError> {
        let SweepWriter { body, dimensions, scales, shape, file, output, header, headers, records } =
            self;
        let wavelengths = header.axes.wavelength.len();
        let leading: Vec<&NewDataset> = scales.iter().collect();

        let whole = |table: &[Option<Record>]| u8::from(table.iter().all(Option::is_some));
        let present: Vec<u8> = records.chunks(wavelengths).map(whole).collect();
        let data = file.dataset("present", Kind::U8, &shape, None)?;
        data.write(&present)?;
        data.attribute("long_name", "1 where a table is present")?;
        data.attach(&leading)?;
        write_numbers(&file, &headers, &leading, &shape)?;

        let mut along = leading.clone();
        along.push(&dimensions.wavelength);
        let mut lengths = shape.clone();
        lengths.push(wavelengths as u64);
        write_records(&file, &records, &along, &lengths)?;
        write_swept_methods(&file, &header.axes.wavelength, &records, &leading, &shape)?;
        file.attribute_integer("complete", 1)?;
        drop(data);
        drop((body, dimensions, scales));
        file.close()?;
        output.publish()
    }
}

fn write_axis(file: &NewFile, axis: &SweepAxis) -> Result<NewDataset, TableError> {
    let length = [axis.len() as u64];
    let mut written = Vec::new();
    for coordinate in &axis.coordinates {
        let data = match &coordinate.values {
            AxisValues::Numbers(values) => {
                let data = file.dataset(&coordinate.name, Kind::F64, &length, None)?;
                data.write(values)?;
                data
            }
            AxisValues::Texts(values) => {
                let data = file.dataset(&coordinate.name, Kind::Texts, &length, None)?;
                data.write_texts(values)?;
                data
            }
        };
        if !coordinate.units.is_empty() {
            data.attribute("units", &coordinate.units)?;
        }
        written.push(data);
    }
    let empty = || invalid("sweep axis", "no coordinate", "at least one coordinate per axis");
    let mut written = written.into_iter();
    let scale = written.next().ok_or_else(empty)?;
    scale.make_scale(axis.name())?;
    written.try_for_each(|data| data.attach(&[&scale]))?;
    Ok(scale)
}
