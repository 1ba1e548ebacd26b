//! Lee diagrams, and colours of spectra.

use crate::errors::{invalid, raised};
use crate::job::in_parts;
use crate::media::spec;
use gonio::color::{ColorWeights, to_srgb};
use gonio::lee::{Bodies, PEAK, Polarisation, Raindrops, Request, column_exposures, columns, srgb};
use numpy::{IntoPyArray, PyArray1, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use std::path::Path;

type Three<'py> = (Bound<'py, PyAny>, Bound<'py, PyAny>, Bound<'py, PyAny>);

/// See `gonio.lee`: XYZ along and across the scattering plane, and sRGB, by radius and angle.
#[pyfunction]
#[pyo3(signature = (*, radius_mm, theta_deg, shape, medium_name, medium_json, sun_elevation_deg, azimuth_deg,
    polarisation, sun_disc, size_spread, illuminant, observer, fineness, threads, progress))]
#[expect(clippy::too_many_arguments, reason = "they are named where Python calls")]
pub fn lee<'py>(
    py: Python<'py>,
    radius_mm: Vec<f64>,
    theta_deg: Vec<f64>,
    shape: &str,
    medium_name: Option<&str>,
    medium_json: Option<&str>,
    sun_elevation_deg: f64,
    azimuth_deg: f64,
    polarisation: &str,
    sun_disc: bool,
    size_spread: f64,
    illuminant: &str,
    observer: &str,
    fineness: f64,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Three<'py>> {
    let threads = crate::job::threads(threads)?;
    let medium = spec(medium_name, medium_json)?;
    let polarisation = match polarisation {
        "total" => Polarisation::Total,
        "parallel" => Polarisation::Parallel,
        "perpendicular" => Polarisation::Perpendicular,
        other => {
            let accepted = "total, parallel and perpendicular are accepted";
            return Err(invalid("polarisation", format!("{other:?}"), accepted));
        }
    };
    let request = Request {
        radii: radius_mm.iter().map(|mm| mm * 1e-3).collect(),
        theta: theta_deg.iter().map(|t| t.to_radians()).collect(),
        medium: medium.resolve(Path::new(".")).map_err(|error| raised(&error))?,
        sun_disc,
        size_spread,
        illuminant: illuminant
            .parse()
            .map_err(|error| raised::<gonio::color::ColorError>(&error))?,
        observer: observer.parse().map_err(|error| raised::<gonio::color::ColorError>(&error))?,
        fineness,
    };
    let bodies = match shape {
        "sphere" => Bodies::Spheres,
        "raindrop" => {
            let drops = Raindrops::new(medium, sun_elevation_deg, azimuth_deg.to_radians());
            Bodies::Raindrops(drops.map_err(|error| raised(&error))?)
        }
        other => {
            let accepted = "sphere and raindrop are accepted";
            return Err(invalid("shape", format!("{other:?}"), accepted));
        }
    };
    let diagram =
        in_parts(py, threads, progress.as_ref(), |done| columns(&request, &bodies, done))?
            .map_err(|error| raised(&error))?;
    let seen = diagram.seen(polarisation);
    let colours = srgb(&seen, &column_exposures(&seen, PEAK));
    let shape = [radius_mm.len(), theta_deg.len(), 3];
    let part = |k: usize| -> PyResult<Bound<'py, PyAny>> {
        let cells = diagram.xyz.iter().flatten();
        let flat: Vec<f32> = cells.flat_map(|cell| cell[k].map(|v| v as f32)).collect();
        Ok(flat.into_pyarray(py).reshape(shape)?.into_any())
    };
    let colours: Vec<u8> = colours.into_iter().flatten().flatten().collect();
    Ok((part(0)?, part(1)?, colours.into_pyarray(py).reshape(shape)?.into_any()))
}

/// Weights of wavelengths for X, Y and Z of a spectrum seen under a light, shape (wavelength, 3).
#[pyfunction]
pub fn colour_weights<'py>(
    py: Python<'py>,
    wavelength_nm: Vec<f64>,
    illuminant: &str,
    observer: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let metres: Vec<f64> = wavelength_nm.iter().map(|nm| nm * 1e-9).collect();
    let illuminant = illuminant.parse().map_err(|e| raised::<gonio::color::ColorError>(&e))?;
    let observer = observer.parse().map_err(|e| raised::<gonio::color::ColorError>(&e))?;
    let weights = ColorWeights::new(&metres, illuminant, observer).map_err(|e| raised(&e))?;
    let flat: Vec<f64> = weights.weights.iter().flatten().copied().collect();
    Ok(flat.into_pyarray(py).reshape([metres.len(), 3])?.into_any())
}

/// XYZ, shape (n, 3), times an exposure as 8-bit sRGB.
#[pyfunction]
pub fn srgb_of<'py>(
    py: Python<'py>,
    xyz: PyReadonlyArray2<'py, f64>,
    exposure: f64,
) -> Bound<'py, PyArray1<u8>> {
    let rows = xyz.as_array();
    let colours: Vec<u8> =
        (rows.outer_iter()).flat_map(|row| to_srgb([row[0], row[1], row[2]], exposure)).collect();
    colours.into_pyarray(py)
}
