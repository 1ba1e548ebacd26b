//! Errors of the library as exceptions with the same words: wrong input is a `ValueError`, what fails while
//! running a `RuntimeError`.

use gonio::fault::{Blame, Fault, in_words};
use pyo3::PyErr;
use pyo3::exceptions::{PyMemoryError, PyRuntimeError, PyValueError};
use std::fmt::Display;

/// The exception of an error.
pub fn raised<E: Blame>(error: &E) -> PyErr {
    let words = in_words(error);
    match error.fault() {
        Fault::Input => PyValueError::new_err(words),
        Fault::Run => PyRuntimeError::new_err(words),
    }
}

/// A `ValueError` that names field, value and what is accepted.
pub fn invalid(field: &str, value: impl Display, accepted: &str) -> PyErr {
    PyValueError::new_err(format!("{field} = {value}: {accepted}"))
}

/// A `MemoryError` for results that do not fit.
pub fn too_large(values: usize) -> PyErr {
    PyMemoryError::new_err(format!(
        "no memory for {values} complex values: take fewer angles or fewer particles at once"
    ))
}
