//! Arrays from Python: broadcast against each other as numpy does.

use crate::errors::invalid;
use numpy::ndarray::ArrayD;
use numpy::{AllowTypeChange, Element, PyArrayLikeDyn};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// The array of an argument; numbers are arrays without dimensions.
pub fn array<T>(value: &Bound<'_, PyAny>, name: &str, accepted: &str) -> PyResult<ArrayD<T>>
where
    T: Element + Clone + 'static,
    for<'a, 'py> PyArrayLikeDyn<'py, T, AllowTypeChange>: FromPyObject<'a, 'py>,
{
    let read = value.extract::<PyArrayLikeDyn<'_, T, AllowTypeChange>>();
    match read {
        Ok(array) => Ok(array.as_array().to_owned()),
        Err(_) => {
            let shown = value.repr().map_or_else(|_| "?".into(), |text| text.to_string());
            let shown: String = shown.chars().take(60).collect();
            Err(invalid(name, shown, accepted))
        }
    }
}

/// The shape that those of two arguments broadcast to.
pub fn common_shape(names: [&str; 2], a: &[usize], b: &[usize]) -> PyResult<Vec<usize>> {
    let count = a.len().max(b.len());
    let length =
        |shape: &[usize], k: usize| (k + shape.len()).checked_sub(count).map_or(1, |i| shape[i]);
    (0..count)
        .map(|k| match (length(a, k), length(b, k)) {
            (n, m) if n == m => Ok(n),
            (1, n) | (n, 1) => Ok(n),
            _ => Err(PyValueError::new_err(format!(
                "{} and {} do not broadcast: their shapes are {a:?} and {b:?}; accepted are equal lengths, or 1, \
                 along each dimension from the last",
                names[0], names[1]
            ))),
        })
        .collect()
}
