//! What a radar sees of rain.

use crate::errors::{invalid, raised};
use crate::job::in_parts;
use gonio::medium::{MicrowaveWater, wavelength_of_ghz};
use gonio::radar::{
    DropShape, DropSpectrum, Drops, Observation, ObservationError, RadarQuantities, Water,
    band as wavelength_of_band, number,
};
use gonio::scene::Named;
use gonio::shape::RaindropModel;
use num_complex::Complex64;
use numpy::IntoPyArray;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Drops of one shape as `gonio.radar` and `gonio.tmatrix` name them; `axis_ratio` is a number or a law.
pub fn drop_shape(
    shape: &str,
    model: Option<&str>,
    axis_ratio: Option<&str>,
) -> PyResult<DropShape> {
    match (shape, model, axis_ratio) {
        ("spheroid", Some(model), _) | ("sphere", Some(model), _) => {
            Err(invalid("model", model, "only shape = \"raindrop\" has a shape model"))
        }
        ("raindrop", _, Some(ratio)) | ("sphere", _, Some(ratio)) => {
            Err(invalid("axis_ratio", ratio, "only shape = \"spheroid\" has an axis ratio"))
        }
        ("sphere", ..) => Ok(DropShape::Sphere),
        ("spheroid", _, ratio) => {
            DropShape::spheroid(ratio.unwrap_or("thurai-2007")).map_err(|e| raised(&e))
        }
        ("raindrop", model, _) => {
            let name = model.unwrap_or("beard-chuang-1987");
            let model = RaindropModel::from_name(name);
            model
                .map(DropShape::Raindrop)
                .map_err(|error| PyValueError::new_err(format!("model: {error}")))
        }
        (other, ..) => {
            let accepted = "raindrop, spheroid and sphere are accepted";
            Err(invalid("shape", format!("{other:?}"), accepted))
        }
    }
}

/// Frequencies, wavelengths, indices and quantities by name; arrays run over wavelength, temperature, diameter.
#[pyfunction]
#[pyo3(signature = (*, band, frequency_ghz, wavelength_mm, temperature_c, water, index, diameter_mm, number_per_m3,
    together, marshall_palmer_mm_h, exponential, normalised_gamma, from_diameter_mm, to_diameter_mm, shape, model,
    axis_ratio, canting_deg, elevation_deg, k_squared, tolerance, threads, progress))]
#[expect(clippy::too_many_arguments, reason = "they are named where Python calls")]
pub fn radar<'py>(
    py: Python<'py>,
    band: Option<Vec<String>>,
    frequency_ghz: Option<Vec<f64>>,
    wavelength_mm: Option<Vec<f64>>,
    temperature_c: Vec<f64>,
    water: &str,
    index: Option<Complex64>,
    diameter_mm: Option<Vec<f64>>,
    number_per_m3: Vec<f64>,
    together: bool,
    marshall_palmer_mm_h: Option<f64>,
    exponential: Option<(f64, f64)>,
    normalised_gamma: Option<(f64, f64, f64)>,
    from_diameter_mm: Option<f64>,
    to_diameter_mm: Option<f64>,
    shape: &str,
    model: Option<&str>,
    axis_ratio: Option<&str>,
    canting_deg: f64,
    elevation_deg: f64,
    k_squared: f64,
    tolerance: f64,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let threads = crate::job::threads(threads)?;
    let asked = |name, value| number(name, value).map_err(|error| raised(&error));
    let shape = drop_shape(shape, model, axis_ratio)?;
    let spectrum = match (marshall_palmer_mm_h, exponential, normalised_gamma) {
        (Some(rate), ..) => {
            Some(DropSpectrum::marshall_palmer(asked("marshall_palmer_mm_h", rate)?))
        }
        (_, Some((intercept, slope)), _) => Some(DropSpectrum::Exponential {
            intercept: positive("exponential", intercept)? * 1e3,
            slope: positive("exponential", slope)? * 1e3,
        }),
        (.., Some((intercept, median, mu))) => Some(DropSpectrum::NormalisedGamma {
            intercept: positive("normalised_gamma", intercept)? * 1e3,
            median_volume_diameter: positive("normalised_gamma", median)? * 1e-3,
            shape: asked("mu", mu)?,
        }),
        _ => None,
    };
    let metres: Vec<f64> = diameter_mm.iter().flatten().map(|mm| mm * 1e-3).collect();
    let drops = match (spectrum, together) {
        (Some(spectrum), _) => Drops::spectrum(spectrum, from_diameter_mm, to_diameter_mm, shape)
            .map_err(|error| raised(&error))?,
        (None, true) => Drops::Together(metres.into_iter().zip(number_per_m3).collect()),
        (None, false) => Drops::Each {
            diameters: metres,
            number_per_m3: number_per_m3.first().copied().unwrap_or(1.0),
        },
    };
    let observation = Observation {
        wavelengths: wavelengths(band, frequency_ghz, wavelength_mm)?,
        water: match index {
            Some(index) => Water::Index(checked_index(index)?),
            None => Water::Celsius(water_model(water)?, temperature_c),
        },
        drops,
        shape,
        canting: asked("canting_deg", canting_deg)?.to_radians(),
        elevation: asked("elevation_deg", elevation_deg)?.to_radians(),
        dielectric_factor: asked("k_squared", k_squared)?,
        tolerance: asked("tolerance", tolerance)?,
    };
    let rows = in_parts(py, threads, progress.as_ref(), |done| observation.rows(done))?
        .map_err(|error| raised(&error))?;
    let found = PyDict::new(py);
    let metres = &observation.wavelengths;
    let ghz: Vec<f64> = metres.iter().map(|m| wavelength_of_ghz(1.0) / m).collect();
    let mm: Vec<f64> = metres.iter().map(|m| m * 1e3).collect();
    found.set_item("frequency_ghz", ghz.into_pyarray(py))?;
    found.set_item("wavelength_mm", mm.into_pyarray(py))?;
    let indices: Vec<Complex64> = rows.iter().map(|row| row.index).collect();
    found.set_item("index", indices.into_pyarray(py))?;
    type Quantity = fn(&RadarQuantities) -> f64;
    let quantities: [(&str, Quantity); 9] = [
        ("z_h", |q| q.z_h),
        ("z_v", |q| q.z_v),
        ("z_dr", |q| q.z_dr_db),
        ("ldr", |q| q.ldr_db),
        ("rho_hv", |q| q.rho_hv),
        ("delta_hv", |q| q.delta_hv_deg),
        ("k_dp", |q| q.k_dp_deg_km),
        ("a_h", |q| q.a_h_db_km),
        ("a_dp", |q| q.a_dp_db_km),
    ];
    for (name, of) in quantities {
        let values: Vec<f64> = rows.iter().map(|row| of(&row.seen)).collect();
        found.set_item(name, values.into_pyarray(py))?;
    }
    Ok(found)
}

/// An index that a body can have.
pub fn checked_index(index: Complex64) -> PyResult<Complex64> {
    if index.is_finite() && index.re > 0.0 && index.im >= 0.0 {
        return Ok(index);
    }
    Err(invalid("index", index, "n + ik with n > 0 and k ≥ 0 is accepted"))
}

fn positive(field: &str, value: f64) -> PyResult<f64> {
    if value > 0.0 && value.is_finite() {
        return Ok(value);
    }
    Err(invalid(field, value, "numbers above 0 are accepted"))
}

fn water_model(name: &str) -> PyResult<MicrowaveWater> {
    let accepted = "liebe-1991 and turner-2016 are accepted";
    MicrowaveWater::by_name(&format!("water-{name}"))
        .ok_or_else(|| invalid("water", format!("{name:?}"), accepted))
}

/// In metres, of that which is given.
fn wavelengths(
    band: Option<Vec<String>>,
    frequency_ghz: Option<Vec<f64>>,
    wavelength_mm: Option<Vec<f64>>,
) -> PyResult<Vec<f64>> {
    if let Some(letters) = band {
        let found: Result<_, ObservationError> =
            letters.iter().map(|letters| wavelength_of_band(letters)).collect();
        return found.map_err(|error| raised(&error));
    }
    if let Some(all) = frequency_ghz {
        let metres = |ghz: f64| Ok(wavelength_of_ghz(positive("frequency_ghz", ghz)?));
        return all.into_iter().map(metres).collect();
    }
    Ok(wavelength_mm.into_iter().flatten().map(|mm| mm * 1e-3).collect())
}
