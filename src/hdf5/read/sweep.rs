//! Reading one table of a sweep.

use super::header::{check_version, coordinate, read_header};
use super::records::read_records;
use super::table::slab_at;
use crate::hdf5::file::opened::OpenFile;
use crate::hdf5::format::SWEEP_FORMAT;
use crate::hdf5::format::circumstances::read_numbers;
use crate::hdf5::sweep_axis::{AxisValues, SweepAxis, SweepCoordinate};
use crate::hdf5::{TableError, damaged, foreign};
use crate::phase_table::variables::record::Record;
use crate::phase_table::variables::schema::values_name;
use crate::phase_table::{PhaseTable, TableHeader};
use std::path::Path;

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
