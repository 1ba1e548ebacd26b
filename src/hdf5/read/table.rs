//! Reading a table, whole or wavelength by wavelength.

use super::header::{check_version, read_header};
use super::records::read_records;
use crate::hdf5::file::opened::OpenFile;
use crate::hdf5::format::SWEEP_FORMAT;
use crate::hdf5::{TableError, damaged, foreign, invalid};
use crate::phase_table::variables::record::Record;
use crate::phase_table::variables::schema::{ELEMENTS, FORMAT, values_name};
use crate::phase_table::{PhaseTable, Quantity, Slab, TableHeader};
use ndarray::{Array2, Array3};
use std::path::Path;

/// Read a whole table into memory.
///
/// # Errors
/// When the file is missing, foreign, incomplete or damaged.
pub fn read(path: &Path) -> Result<PhaseTable, TableError> {
    let reader = TableReader::open(path)?;
    let slabs = (0..reader.header().axes.wavelength.len()).map(|index| reader.slab(index));
    let slabs = slabs.collect::<Result<_, _>>()?;
    Ok(PhaseTable { header: reader.header, slabs })
}

/// A table on disk, read slab by slab.
#[derive(Debug)]
pub struct TableReader {
    file: OpenFile,
    header: TableHeader,
    records: Vec<Record>,
    has_caustic: bool,
}

impl TableReader {
    /// Open a table: header and the few numbers per wavelength are read, no values yet.
    ///
    /// # Errors
    /// When the file is missing, foreign, incomplete or damaged.
    pub fn open(path: &Path) -> Result<TableReader, TableError> {
        let file = OpenFile::open(path)?;
        check_format(&file)?;
        let header = read_header(&file)?;
        header.validate().map_err(|error| damaged(path, &error.to_string()))?;
        let records = read_records(&file, &[], header.axes.wavelength.len())?;
        let has_caustic = check_shapes(&file, &header)?;
        Ok(TableReader { file, header, records, has_caustic })
    }

    /// What does not change from wavelength to wavelength.
    pub fn header(&self) -> &TableHeader {
        &self.header
    }

    /// A text attribute of the file, such as `git_hash` or `date_created`.
    ///
    /// # Errors
    /// When the attribute is there but damaged.
    pub fn attribute(&self, name: &str) -> Result<Option<String>, TableError> {
        self.file.text(name)
    }

    /// Bits of the mantissa that were kept, where values were rounded.
    ///
    /// # Errors
    /// When the attribute is there but damaged.
    pub fn bit_round(&self) -> Result<Option<u8>, TableError> {
        Ok(self.file.number("bit_round")?.map(|bits| bits as u8))
    }

    /// Largest relative error with which values were stored: half a bit of the mantissa kept.
    ///
    /// # Errors
    /// When the attribute is there but damaged.
    pub fn rounding(&self) -> Result<f64, TableError> {
        Ok(self.bit_round()?.map_or(0.0, |bits| 0.5f64.powi(i32::from(bits))))
    }

    /// Read one wavelength.
    ///
    /// # Errors
    /// When there is no such wavelength or its values are damaged.
    pub fn slab(&self, index: usize) -> Result<Slab, TableError> {
        let axes = &self.header.axes;
        let Some(record) = self.records.get(index) else {
            let accepted = format!("the table has {} wavelengths", axes.wavelength.len());
            return Err(invalid("slab", index, &accepted));
        };
        slab_at(&self.file, &self.header, record, &[], index, self.has_caustic)
    }
}

/// Read the slab at a place of a table (no leading indices) or a sweep.
pub fn slab_at(
    file: &OpenFile,
    header: &TableHeader,
    record: &Record,
    leading: &[u64],
    index: usize,
    has_caustic: bool,
) -> Result<Slab, TableError> {
    let axes = &header.axes;
    let (elements, theta, phi) = (header.quantity.elements(), axes.theta.len(), axes.phi.len());
    let mut start = leading.to_vec();
    start.push(index as u64);
    let mut count = vec![1; start.len()];

    let face = (start.clone(), count.clone());
    if header.quantity == Quantity::Mueller {
        start.push(0);
        count.push(elements as u64);
    }
    start.extend([0, 0]);
    count.extend([theta as u64, phi as u64]);
    let values = file.required(values_name(header.quantity))?.read_block::<f32>(&start, &count)?;
    let wrong_shape = |_| damaged(&file.path, "the values do not have the shape of the axes");
    let values = Array3::from_shape_vec((elements, theta, phi), values).map_err(wrong_shape)?;

    let caustic_order = if has_caustic {
        let (mut start, mut count) = face;
        start.extend([0, 0]);
        count.extend([theta as u64, phi as u64]);
        let mask = file.required("caustic_order")?.read_block::<u8>(&start, &count)?;
        Some(Array2::from_shape_vec((theta, phi), mask).map_err(wrong_shape)?)
    } else {
        None
    };
    Ok(Slab {
        wavelength: axes.wavelength[index],
        index: record.index,
        outside_index: record.outside_index,
        values,
        caustic_order,
        scattering_cross_section: record.scattering_cross_section,
        extinction_cross_section: record.extinction_cross_section,
        absorption_cross_section: record.absorption_cross_section,
        forward_extinction: (!record.forward_extinction.is_nan())
            .then_some(record.forward_extinction),
        tolerance_met: (!record.tolerance_met.is_nan()).then_some(record.tolerance_met == 1.0),
        asymmetry: record.asymmetry,
        energy: record.energy.clone(),
        sum_before_peak: record.sum_before_peak,
        peak_share: record.peak_share,
        error_estimate: record.error_estimate,
        error_by_band: record.error_by_band,
        error_by_direction: record.error_by_direction,
        left_out: record.left_out,
        methods: record.methods.clone(),
    })
}

fn check_format(file: &OpenFile) -> Result<(), TableError> {
    let path = &file.path;
    match file.text("format")?.as_deref() {
        Some(FORMAT) => {}
        Some(SWEEP_FORMAT) => {
            return Err(foreign(path, "it is a sweep of many tables, not one table"));
        }
        Some(other) => return Err(foreign(path, &format!("its format is {other:?}"))),
        None => return Err(foreign(path, &format!("it has no attribute format = {FORMAT:?}"))),
    }
    check_version(file)
}

/// True if there is a caustic mask; fails where a variable has not the shape of the axes.
fn check_shapes(file: &OpenFile, header: &TableHeader) -> Result<bool, TableError> {
    let axes = &header.axes;
    let lengths = [axes.wavelength.len(), axes.theta.len(), axes.phi.len()];
    let [wavelength, theta, phi] = lengths.map(|length| length as u64);
    let name = values_name(header.quantity);
    let expected = match header.quantity {
        Quantity::PhaseFunction => vec![wavelength, theta, phi],
        Quantity::Mueller => vec![wavelength, 16, theta, phi],
    };
    let found = file.required(name)?.shape;
    if found != expected {
        let message = format!("{name} has shape {found:?}, the axes say {expected:?}");
        return Err(damaged(&file.path, &message));
    }
    if header.quantity == Quantity::Mueller {
        let elements = file.required("mueller_element")?.read_texts()?;
        if elements != ELEMENTS {
            let message = format!("mueller_element is {elements:?}, expected 11, 12, … 44");
            return Err(damaged(&file.path, &message));
        }
    }
    Ok(file.dataset("caustic_order")?.is_some())
}
