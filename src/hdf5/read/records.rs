//! Reading what each wavelength has beside its values.

use crate::hdf5::TableError;
use crate::hdf5::file::opened::OpenFile;
use crate::hdf5::format::methods::read_methods;
use crate::phase_table::variables::record::{BY_DIRECTION, ENERGY, LATER, PLAIN, Record, TELLING};
use crate::phase_table::{ERROR_BANDS, EnergyBudget, MethodRange};
use num_complex::Complex64;

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
pub fn read_records(
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
    let telling = TELLING.map(|(name, _, nothing, _)| match file.dataset(name)? {
        Some(_) => read_field(file, name, leading, wavelengths, None),
        None => Ok(vec![nothing; wavelengths]),
    });
    let [left_out, outside] = telling;
    let (left_out, outside) = (left_out?, outside?);
    let methods = read_methods(file, leading)?;
    let record = |(i, energy)| Record {
        index: Complex64::new(real[i], imag[i]),
        outside_index: outside[i],
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
