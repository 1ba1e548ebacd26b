//! Many tables in one file: a sweep, with one more leading dimension per swept value.

use super::body::Body;
use super::circumstances::{read_numbers, write_numbers, write_scalars};
use super::methods::write_swept_methods;
use super::output::{Output, WriteOptions};
use super::raw_read::OpenFile;
use super::raw_write::{Kind, NewDataset, NewFile};
use super::reader::{check_version, coordinate, read_header, read_records, slab_at};
use super::record::{Record, write_records};
use super::schema::{Dimensions, SWEEP_FORMAT, values_name, write_root};
use super::writer::check_slab;
use super::{TableError, damaged, estimate_bytes, foreign, invalid};
use crate::phase_table::{PhaseTable, Slab, TableHeader};
use std::path::Path;

/// Values along a swept dimension.
#[derive(Clone, Debug, PartialEq)]
pub enum AxisValues {
    /// Numbers, ascending or not.
    Numbers(Vec<f64>),
    /// Words, such as names of media.
    Texts(Vec<String>),
}

/// A coordinate of a swept dimension.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepCoordinate {
    /// Name of the variable, such as `radius_um`.
    pub name: String,
    /// Units after UDUNITS; empty for text.
    pub units: String,
    /// One per table along the dimension.
    pub values: AxisValues,
}

/// A swept dimension: it bears the name of its first coordinate, paired values follow.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepAxis {
    /// Further values along the same dimension.
    pub coordinates: Vec<SweepCoordinate>,
}

impl SweepAxis {
    /// Number of values.
    pub fn len(&self) -> usize {
        self.coordinates.first().map_or(0, |coordinate| match &coordinate.values {
            AxisValues::Numbers(values) => values.len(),
            AxisValues::Texts(values) => values.len(),
        })
    }

    /// True where the dimension has no value.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    fn name(&self) -> &str {
        self.coordinates.first().map_or("", |coordinate| &coordinate.name)
    }
}

/// Index per axis of a table by its number, in a sweep of this shape; the last axis is the fastest.
pub fn position_of(number: usize, shape: &[usize]) -> Vec<usize> {
    let mut rest = number;
    let mut position = vec![0; shape.len()];
    for (index, length) in position.iter_mut().zip(shape).rev() {
        *index = rest % length;
        rest /= length;
    }
    position
}

/// A sweep being written. Dropped before [`SweepWriter::finish`] it leaves nothing behind.
pub struct SweepWriter {
    body: Body,
    dimensions: Dimensions,
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
    /// As [`super::TableWriter::create`].
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
        write_root(&file, header, SWEEP_FORMAT, options)?;
        let names: Vec<&str> = axes.iter().map(SweepAxis::name).collect();
        file.attribute("sweep_axes", &names.join(" "))?;
        let scales =
            axes.iter().map(|axis| write_axis(&file, axis)).collect::<Result<Vec<_>, _>>()?;
        let dimensions = Dimensions::create(&file, &header.axes, header.quantity)?;
        dimensions.write_solid_angle(&file, &header.axes)?;
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

/// A sweep on disk.
#[derive(Debug)]
pub struct SweepReader {
    file: OpenFile,
    header: TableHeader,
    axes: Vec<SweepAxis>,
    has_caustic: bool,
}

impl SweepReader {
    /// Open a sweep.
    ///
    /// # Errors
    /// When the file is missing, foreign, incomplete or damaged.
    pub fn open(path: &Path) -> Result<SweepReader, TableError> {
        let file = OpenFile::open(path)?;
        match file.text("format")?.as_deref() {
            Some(SWEEP_FORMAT) => {}
            other => {
                let found = other.unwrap_or("none");
                return Err(foreign(path, &format!("its format is {found:?}, not a sweep")));
            }
        }
        check_version(&file)?;
        let header = read_header(&file)?;
        header.validate().map_err(|error| damaged(path, &error.to_string()))?;
        let names = file.text("sweep_axes")?.unwrap_or_default();
        let axes: Vec<SweepAxis> = names
            .split_whitespace()
            .map(|name| read_axis(&file, name))
            .collect::<Result<_, _>>()?;
        let mut expected: Vec<u64> = axes.iter().map(|axis| axis.len() as u64).collect();
        expected.push(header.axes.wavelength.len() as u64);
        let found = file.required(values_name(header.quantity))?.shape;
        if !found.starts_with(&expected) {
            let message = format!("the values have shape {found:?}, the axes say {expected:?}");
            return Err(damaged(path, &message));
        }
        let has_caustic = file.dataset("caustic_order")?.is_some();
        Ok(SweepReader { file, header, axes, has_caustic })
    }

    /// What all tables share.
    pub fn header(&self) -> &TableHeader {
        &self.header
    }

    /// Largest relative error with which values were stored: half a bit of the mantissa kept.
    ///
    /// # Errors
    /// When the attribute is there but damaged.
    pub fn rounding(&self) -> Result<f64, TableError> {
        Ok(self.file.number("bit_round")?.map_or(0.0, |bits| 0.5f64.powf(bits)))
    }

    /// The swept dimensions, in the order of the file.
    pub fn axes(&self) -> &[SweepAxis] {
        &self.axes
    }

    /// Which tables are there, in the order of the axes (last one fastest).
    ///
    /// # Errors
    /// When the file is damaged.
    pub fn present(&self) -> Result<Vec<bool>, TableError> {
        let present = self.file.required("present")?.read::<u8>()?;
        Ok(present.into_iter().map(|value| value == 1).collect())
    }

    /// Read the table at `position` (an index per axis).
    ///
    /// # Errors
    /// When the position is outside or the file is damaged.
    pub fn table(&self, position: &[usize]) -> Result<PhaseTable, TableError> {
        let place: Vec<u64> = position.iter().map(|&i| i as u64).collect();
        let wavelengths = self.header.axes.wavelength.len();
        let records = read_records(&self.file, &place, wavelengths)?;
        let mut header = self.header.clone();
        (header.bodies, header.averaging, header.tolerance) = read_numbers(&self.file, &place)?;
        for (axis, &i) in self.axes.iter().zip(position) {
            for coordinate in &axis.coordinates {
                if let AxisValues::Numbers(values) = &coordinate.values {
                    match coordinate.name.as_str() {
                        "radius_um" => header.radius = values[i] * 1e-6,
                        "sun_elevation" => header.sun_elevation = values[i].to_radians(),
                        _ => {}
                    }
                }
            }
        }
        if let (true, Some(bodies)) = (header.averaging.sizes, &header.bodies) {
            header.radius = bodies.effective_radius;
        }
        let slab = |(index, record): (usize, &Record)| {
            slab_at(&self.file, &header, record, &place, index, self.has_caustic)
        };
        let slabs = records.iter().enumerate().map(slab).collect::<Result<_, _>>()?;
        Ok(PhaseTable { header, slabs })
    }
}

fn read_axis(file: &OpenFile, name: &str) -> Result<SweepAxis, TableError> {
    let data = coordinate(file, name)?;
    let values = match data.read_texts() {
        Ok(texts) => AxisValues::Texts(texts),
        Err(_) => AxisValues::Numbers(data.read::<f64>()?),
    };
    let units = data.text("units")?.unwrap_or_default();
    Ok(SweepAxis { coordinates: vec![SweepCoordinate { name: name.into(), units, values }] })
}
