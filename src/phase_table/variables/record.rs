//! What each wavelength has beside its values: cross-sections, index, energy budget, errors.
//!
//! A few numbers per wavelength, kept until the file is finished because the number of orders is
//! known only then.

use super::dimensions::scale;
use super::{Kind, Store, Variable};
use crate::math::digits::degree;
use crate::phase_table::{ERROR_BANDS, EnergyBudget, MethodPart, Slab, error_theta};
use num_complex::Complex64;

/// The numbers of one slab.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    pub index: Complex64,
    pub outside_index: f64,
    pub scattering_cross_section: f64,
    pub extinction_cross_section: f64,
    pub absorption_cross_section: f64,
    /// NaN where there is none, as in the file.
    pub forward_extinction: f64,
    pub tolerance_met: f64,
    pub asymmetry: f64,
    pub sum_before_peak: f64,
    pub peak_share: f64,
    pub error_estimate: f64,
    pub error_by_band: f64,
    pub error_by_direction: [f64; ERROR_BANDS],
    pub left_out: f64,
    pub energy: Option<EnergyBudget>,
    pub methods: Vec<MethodPart>,
}

impl From<&Slab> for Record {
    fn from(slab: &Slab) -> Record {
        Record {
            index: slab.index,
            outside_index: slab.outside_index,
            scattering_cross_section: slab.scattering_cross_section,
            extinction_cross_section: slab.extinction_cross_section,
            absorption_cross_section: slab.absorption_cross_section,
            forward_extinction: slab.forward_extinction.unwrap_or(f64::NAN),
            tolerance_met: slab.tolerance_met.map_or(f64::NAN, |met| f64::from(u8::from(met))),
            asymmetry: slab.asymmetry,
            sum_before_peak: slab.sum_before_peak,
            peak_share: slab.peak_share,
            error_estimate: slab.error_estimate,
            error_by_band: slab.error_by_band,
            error_by_direction: slab.error_by_direction,
            left_out: slab.left_out,
            energy: slab.energy.clone(),
            methods: slab.methods.clone(),
        }
    }
}

type Getter<T> = fn(&T) -> f64;

/// Variables that every slab has: name, units, words, value.
pub const PLAIN: [(&str, &str, &str, Getter<Record>); 8] = [
    ("scattering_cross_section", "m2", "scattering cross-section", |r| r.scattering_cross_section),
    ("extinction_cross_section", "m2", "extinction cross-section", |r| r.extinction_cross_section),
    ("asymmetry", "1", "mean cosine of the scattering angle", |r| r.asymmetry),
    (
        "refractive_index_real",
        "1",
        "real part of the refractive index, relative to the outside, at the surface",
        |r| r.index.re,
    ),
    ("refractive_index_imag", "1", "imaginary part of the index, positive absorbs", |r| r.index.im),
    (
        "sum_before_peak",
        "1",
        "sum of phase_function times solid_angle before the forward peak was treated",
        |r| r.sum_before_peak,
    ),
    ("peak_share", "1", "share of the scattered power in the separated forward peak", |r| {
        r.peak_share
    }),
    (
        "error_estimate",
        "1",
        "estimated relative error of the intensity, weighted by intensity, 10 to 170 degrees",
        |r| r.error_estimate,
    ),
];

/// The same, absent in tables of older versions.
pub const LATER: [(&str, &str, &str, Getter<Record>); 4] = [
    (
        "error_estimate_by_band",
        "1",
        "the same, root mean square over bands of 4 degrees relative to their own intensity",
        |r| r.error_by_band,
    ),
    ("absorption_cross_section", "m2", "absorption cross-section", |r| r.absorption_cross_section),
    (
        "extinction_straight_ahead",
        "m2",
        "extinction by the optical theorem on the amplitude at theta = 0, NaN without diffraction",
        |r| r.forward_extinction,
    ),
    ("tolerance_met", "1", "1 where the error asked for is met, 0 where not, NaN not known", |r| {
        r.tolerance_met
    }),
];

/// The same, written only where they tell something: name, words, the value that tells nothing, value.
pub const TELLING: [(&str, &str, f64, Getter<Record>); 2] = [
    (
        "left_out_share",
        "share of the scattered power in orders that the scene's list leaves out",
        0.0,
        |r| r.left_out,
    ),
    ("outside_index", "refractive index of the surroundings", 1.0, |r| r.outside_index),
];

/// Variables of the energy budget beside the orders.
pub const ENERGY: [(&str, &str, Getter<EnergyBudget>); 4] = [
    ("energy_absorbed", "power absorbed", |e| e.absorbed),
    ("energy_totally_reflected", "power still inside by total reflection", |e| e.totally_reflected),
    ("energy_truncated", "power still inside after the last order", |e| e.truncated),
    ("energy_residual", "power unaccounted for", |e| e.residual),
];

/// Write all records; `dimensions` are those that run over them (leading ones and wavelength),
/// `shape` their lengths. Absent records and budgets become NaN.
pub fn write_records<S: Store>(
    file: &S,
    records: &[Option<Record>],
    dimensions: &[&S::Variable],
    shape: &[u64],
) -> Result<(), S::Error> {
    for (name, units, words, value) in PLAIN.into_iter().chain(LATER) {
        let values: Vec<f64> = records.iter().map(|r| r.as_ref().map_or(f64::NAN, value)).collect();
        write_field(file, (name, units, words), &values, dimensions, shape)?;
    }
    for (name, words, nothing, value) in TELLING {
        let values: Vec<f64> = records.iter().map(|r| r.as_ref().map_or(nothing, value)).collect();
        if values.iter().any(|&value| value != nothing) {
            write_field(file, (name, "1", words), &values, dimensions, shape)?;
        }
    }
    write_errors(file, records, dimensions, shape)?;

    let budgets: Vec<Option<&EnergyBudget>> =
        records.iter().map(|r| r.as_ref().and_then(|r| r.energy.as_ref())).collect();
    if budgets.iter().all(Option::is_none) {
        return Ok(());
    }
    for (name, words, value) in ENERGY {
        let values: Vec<f64> = budgets.iter().map(|e| e.map_or(f64::NAN, value)).collect();
        let words = format!("{words}, per power on the silhouette");
        write_field(file, (name, "1", &words), &values, dimensions, shape)?;
    }
    write_orders(file, &budgets, dimensions, shape)
}

/// The variable with the stated error by scattering angle.
pub const BY_DIRECTION: &str = "error_estimate_by_direction";

fn write_errors<S: Store>(
    file: &S,
    records: &[Option<Record>],
    dimensions: &[&S::Variable],
    shape: &[u64],
) -> Result<(), S::Error> {
    let middles: Vec<f64> = (0..ERROR_BANDS).map(|band| degree(error_theta(band))).collect();
    let theta = scale(file, "error_theta", &middles, "degree")?;
    theta.attribute("long_name", "middle of a band of scattering angles")?;
    let errors =
        |r: &Option<Record>| r.as_ref().map_or([f64::NAN; ERROR_BANDS], |r| r.error_by_direction);
    let values: Vec<f64> = records.iter().flat_map(errors).collect();
    let words = "estimated relative error of the intensity within 2 degrees of each angle";
    let (mut dimensions, mut shape) = (dimensions.to_vec(), shape.to_vec());
    dimensions.push(&theta);
    shape.push(ERROR_BANDS as u64);
    write_field(file, (BY_DIRECTION, "1", words), &values, &dimensions, &shape)
}

fn write_orders<S: Store>(
    file: &S,
    budgets: &[Option<&EnergyBudget>],
    dimensions: &[&S::Variable],
    shape: &[u64],
) -> Result<(), S::Error> {
    let most = budgets.iter().flatten().map(|e| e.left_by_order.len()).max().unwrap_or(0);
    if most == 0 {
        return Ok(());
    }
    let order = file.variable("order", Kind::I32, &[most as u64])?;
    order.write_integers(&(0..most as i32).collect::<Vec<_>>())?;
    order.attribute("units", "1")?;
    order.attribute("long_name", "order: number of chords inside the particle")?;
    order.make_scale("order")?;

    // Orders that a wavelength did not trace left nothing; a wavelength without budget has NaN.
    let values: Vec<f64> = budgets
        .iter()
        .flat_map(|budget| {
            (0..most).map(move |p| match budget {
                Some(budget) => budget.left_by_order.get(p).copied().unwrap_or(0.0),
                None => f64::NAN,
            })
        })
        .collect();
    let words = "power that left after this many chords, per power on the silhouette";
    let (mut dimensions, mut shape) = (dimensions.to_vec(), shape.to_vec());
    dimensions.push(&order);
    shape.push(most as u64);
    write_field(file, ("energy_left_by_order", "1", words), &values, &dimensions, &shape)
}

fn write_field<S: Store>(
    file: &S,
    (name, units, words): (&str, &str, &str),
    values: &[f64],
    dimensions: &[&S::Variable],
    shape: &[u64],
) -> Result<(), S::Error> {
    let data = file.variable(name, Kind::F64, shape)?;
    data.write_numbers(values)?;
    data.attribute("units", units)?;
    data.attribute("long_name", words)?;
    data.attach(dimensions)
}
