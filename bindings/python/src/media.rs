//! Refractive indices by name, formula or file.

use crate::errors::{invalid, raised};
use crate::scenes::table_of;
use gonio::medium::{self, AbbeLines, MediumSpec};
use num_complex::Complex64;
use numpy::ndarray::ArrayD;
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::path::Path;

/// A material.
#[pyclass(frozen, module = "gonio._gonio")]
pub struct Medium(pub medium::Medium);

/// What a medium is by its name or, as JSON, by its table in a scene.
pub fn spec(name: Option<&str>, json: Option<&str>) -> PyResult<MediumSpec> {
    match (name, json) {
        (Some(name), None) => MediumSpec::parse(name).map_err(|error| raised(&error)),
        (None, Some(json)) => {
            let table = toml::Value::Table(table_of(json)?);
            table
                .try_into()
                .map_err(|error: toml::de::Error| invalid("medium", json, error.message().trim()))
        }
        _ => Err(PyValueError::new_err("one of name and json is to be given")),
    }
}

#[pymethods]
impl Medium {
    #[new]
    #[pyo3(signature = (*, name=None, json=None))]
    fn new(name: Option<&str>, json: Option<&str>) -> PyResult<Self> {
        spec(name, json)?.resolve(Path::new(".")).map(Self).map_err(|error| raised(&error))
    }

    #[getter]
    fn name(&self) -> String {
        self.0.name()
    }

    #[getter]
    fn source(&self) -> String {
        self.0.source()
    }

    #[getter]
    fn notes(&self) -> Vec<String> {
        self.0.notes()
    }

    /// Wavelengths that the data cover.
    #[getter]
    fn range_nm(&self) -> (f64, f64) {
        let (from, to) = self.0.valid_range();
        (from * 1e9, to * 1e9)
    }

    /// n_d and V_d, where the data reach the lines.
    #[getter]
    fn abbe(&self) -> Option<(f64, f64)> {
        self.0.abbe(AbbeLines::HeliumD).map(|abbe| (abbe.index, abbe.number))
    }

    /// n + ik at wavelengths in vacuum.
    fn index<'py>(
        &self,
        py: Python<'py>,
        wavelength_nm: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let accepted = "wavelengths in vacuum, nanometres, are accepted: a number or an array";
        let nm: ArrayD<f64> = crate::arrays::array(wavelength_nm, "wavelength_nm", accepted)?;
        let found: Vec<Complex64> = (nm.iter())
            .map(|nm| self.0.index(nm * 1e-9))
            .collect::<Result<_, _>>()
            .map_err(|error| raised(&error))?;
        if nm.ndim() == 0 {
            let value = found.first().copied().unwrap_or_default();
            return Ok(value.into_pyobject(py)?.into_any());
        }
        Ok(found.into_pyarray(py).reshape(nm.raw_dim())?.into_any())
    }
}

/// Names and sources of the library's media.
#[pyfunction]
pub fn media() -> PyResult<Vec<(String, String, String)>> {
    let list = medium::list().map_err(|error| raised(&error))?;
    Ok(list.into_iter().map(|entry| (entry.name, entry.kind, entry.source)).collect())
}
