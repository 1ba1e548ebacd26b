//! Reading a table, whole or wavelength by wavelength.

use super::circumstances::read_numbers;
use super::methods::read_methods;
use super::raw_read::{OpenDataset, OpenFile};
use super::record::{BY_DIRECTION, ENERGY, LATER, LEFT_OUT, PLAIN, Record};
use super::schema::{
    ELEMENTS, FORMAT, FORMAT_VERSION, SWEEP_FORMAT, forward_peak_name, values_name,
};
use super::{TableError, damaged, foreign, invalid};
use crate::phase_table::{
    Averaging, Axes, ERROR_BANDS, EnergyBudget, ForwardPeak, MethodRange, PhaseTable, Quantity,
    Slab, TableHeader,
};
use ndarray::{Array2, Array3};
use num_complex::Complex64;
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
pub(super) fn slab_at(
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

/// Version known, and written to the end.
pub(super) fn check_version(file: &OpenFile) -> Result<(), TableError> {
    let path = &file.path;
    let version = file.number("format_version")?.unwrap_or(f64::NAN);
    if version != f64::from(FORMAT_VERSION) {
        let message = format!("its format version is {version}, known is {FORMAT_VERSION}");
        return Err(foreign(path, &message));
    }
    if file.number("complete")? != Some(1.0) {
        return Err(damaged(path, "it was not written to the end"));
    }
    Ok(())
}

/// All of a header; radius and sun are those of a single table, NaN where they are swept.
pub(super) fn read_header(file: &OpenFile) -> Result<TableHeader, TableError> {
    let path = &file.path;
    let text = |name: &str| -> Result<String, TableError> {
        file.text(name)?.ok_or_else(|| damaged(path, &format!("attribute {name} is missing")))
    };
    let unknown =
        |name: &str, value: &str| damaged(path, &format!("{name} = {value:?} is unknown"));

    let quantity_text = text("quantity")?;
    let quantity = [Quantity::PhaseFunction, Quantity::Mueller]
        .into_iter()
        .find(|quantity| values_name(*quantity) == quantity_text)
        .ok_or_else(|| unknown("quantity", &quantity_text))?;
    let peak_text = text("forward_peak")?;
    let forward_peak = [ForwardPeak::CellAverage, ForwardPeak::Point, ForwardPeak::Separate]
        .into_iter()
        .find(|peak| forward_peak_name(*peak) == peak_text)
        .ok_or_else(|| unknown("forward_peak", &peak_text))?;

    let axes = Axes {
        wavelength: coordinate(file, "wavelength_nm")?
            .read::<f64>()?
            .iter()
            .map(|nm| nm * 1e-9)
            .collect(),
        theta: read_angles(file, "theta")?,
        phi: read_angles(file, "phi")?,
    };
    // Those of the tables of a sweep are read with each table.
    let swept = file.text("sweep_axes")?.is_some();
    let (bodies, averaging, tolerance) =
        if swept { (None, Averaging::default(), f64::NAN) } else { read_numbers(file, &[])? };
    Ok(TableHeader {
        bodies,
        averaging,
        tolerance,
        axes,
        quantity,
        forward_peak,
        rotational_symmetry: file.number("rotational_symmetry")? == Some(1.0),
        method: text("method")?,
        shape: text("shape")?,
        radius: read_scalar(file, "radius_um")? * 1e-6,
        sun_elevation: read_scalar(file, "sun_elevation")?.to_radians(),
        scene_toml: text("scene")?,
        command_line: text("command_line")?,
    })
}

/// A coordinate variable, not read yet.
pub(super) fn coordinate(file: &OpenFile, name: &str) -> Result<OpenDataset, TableError> {
    let data = file.required(name)?;
    if data.shape.len() != 1 {
        return Err(damaged(&file.path, &format!("{name} is not one-dimensional")));
    }
    Ok(data)
}

/// Degrees to radians; 180° and 360° become π and 2π exactly.
fn read_angles(file: &OpenFile, name: &str) -> Result<Vec<f64>, TableError> {
    use std::f64::consts::PI;
    Ok(coordinate(file, name)?.read::<f64>()?.iter().map(|degrees| degrees / 180.0 * PI).collect())
}

/// A scalar variable; NaN where it is an axis of a sweep.
fn read_scalar(file: &OpenFile, name: &str) -> Result<f64, TableError> {
    let data = file.required(name)?;
    if data.shape.is_empty() { Ok(data.read::<f64>()?[0]) } else { Ok(f64::NAN) }
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

/// One number per wavelength of the table at `leading`, its place in a sweep; per wavelength and
/// order where `orders` are given.
fn read_field(
    file: &OpenFile,
    name: &str,
    leading: &[u64],
    wavelengths: usize,
    orders: Option<u64>,
) -> Result<Vec<f64>, TableError> {
    let (mut start, mut count) = (leading.to_vec(), vec![1; leading.len()]);
    start.push(0);
    count.push(wavelengths as u64);
    start.extend(orders.map(|_| 0));
    count.extend(orders);
    file.required(name)?.read_block::<f64>(&start, &count)
}

/// The records of the table at `leading`, its place in a sweep.
pub(super) fn read_records(
    file: &OpenFile,
    leading: &[u64],
    wavelengths: usize,
) -> Result<Vec<Record>, TableError> {
    let plain = PLAIN.map(|(name, ..)| read_field(file, name, leading, wavelengths, None));
    let [scattering, extinction, asymmetry, real, imag, sum, share, error] = plain;
    let (scattering, extinction, asymmetry) = (scattering?, extinction?, asymmetry?);
    let (real, imag, sum, share, error) = (real?, imag?, sum?, share?, error?);
    let later = LATER.map(|(name, ..)| match file.dataset(name)? {
        Some(_) => read_field(file, name, leading, wavelengths, None),
        None => Ok(vec![f64::NAN; wavelengths]),
    });
    let [by_band, absorption, forward, met] = later;
    let (by_band, absorption, forward, met) = (by_band?, absorption?, forward?, met?);
    // Tables of older versions leave absorption to the reader.
    let absorbed = |i: usize| {
        if absorption[i].is_nan() { extinction[i] - scattering[i] } else { absorption[i] }
    };
    let bands = ERROR_BANDS as u64;
    let by_direction = match file.dataset(BY_DIRECTION)? {
        Some(_) => read_field(file, BY_DIRECTION, leading, wavelengths, Some(bands))?,
        None => vec![f64::NAN; wavelengths * ERROR_BANDS],
    };
    let left_out = match file.dataset(LEFT_OUT)? {
        Some(_) => read_field(file, LEFT_OUT, leading, wavelengths, None)?,
        None => vec![0.0; wavelengths],
    };
    let methods = read_methods(file, leading)?;
    let record = |(i, energy)| Record {
        index: Complex64::new(real[i], imag[i]),
        scattering_cross_section: scattering[i],
        extinction_cross_section: extinction[i],
        absorption_cross_section: absorbed(i),
        forward_extinction: forward[i],
        tolerance_met: met[i],
        asymmetry: asymmetry[i],
        sum_before_peak: sum[i],
        peak_share: share[i],
        error_estimate: error[i],
        error_by_band: by_band[i],
        error_by_direction: std::array::from_fn(|k| by_direction[i * ERROR_BANDS + k]),
        left_out: left_out[i],
        energy,
        methods: MethodRange::at(&methods, i),
    };
    let budgets = read_budgets(file, leading, wavelengths)?;
    Ok(budgets.into_iter().enumerate().map(record).collect())
}

/// The energy budgets of the table at `leading`; none for wavelengths that are NaN there, or where
/// the file has no budgets.
fn read_budgets(
    file: &OpenFile,
    leading: &[u64],
    wavelengths: usize,
) -> Result<Vec<Option<EnergyBudget>>, TableError> {
    if file.dataset("energy_absorbed")?.is_none() {
        return Ok(vec![None; wavelengths]);
    }
    let fields = ENERGY.map(|(name, ..)| read_field(file, name, leading, wavelengths, None));
    let [absorbed, reflected, truncated, residual] = fields;
    let (absorbed, reflected) = (absorbed?, reflected?);
    let (truncated, residual) = (truncated?, residual?);
    let orders = match file.dataset("order")? {
        Some(order) => order.shape.first().copied().unwrap_or(0),
        None => 0,
    };
    let left = match orders {
        0 => Vec::new(),
        _ => read_field(file, "energy_left_by_order", leading, wavelengths, Some(orders))?,
    };
    let orders = orders as usize;
    let budget = |i: usize| {
        (!absorbed[i].is_nan()).then(|| EnergyBudget {
            left_by_order: left[i * orders..(i + 1) * orders].to_vec(),
            absorbed: absorbed[i],
            totally_reflected: reflected[i],
            truncated: truncated[i],
            residual: residual[i],
        })
    };
    Ok((0..wavelengths).map(budget).collect())
}
