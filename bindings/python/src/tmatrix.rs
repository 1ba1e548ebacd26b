//! T-matrices of spheroids and raindrops: found once, looked at from all sides.

use crate::arrays::{array, common_shape};
use crate::errors::{invalid, raised};
use crate::job::long;
use crate::radar::{checked_index, drop_shape};
use gonio::radar::number;
use gonio::series::tmatrix::{self, RandomOrientation, Scattered, Sections, Solver};
use gonio::series::{Efficiencies, tmatrix::NoMean};
use ndarray::{ArrayD, IxDyn};
use num_complex::Complex64;
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::prelude::*;
use std::sync::mpsc::Sender;

/// A T-matrix.
#[pyclass(frozen, module = "gonio._gonio")]
pub struct TMatrix(tmatrix::TMatrix);

/// The mean over all orientations.
#[pyclass(frozen, module = "gonio._gonio")]
pub struct RandomMean {
    mean: RandomOrientation,
    efficiencies: [f64; 5],
}

const ANGLES: &str = "scattering angles from 0 to 180 degrees are accepted: a number or an array";
const AZIMUTHS: &str = "azimuths from -360 to 360 degrees are accepted: a number or an array";

fn within(
    value: &Bound<'_, PyAny>,
    name: &str,
    (low, high): (f64, f64),
    accepted: &str,
) -> PyResult<ArrayD<f64>> {
    let degrees: ArrayD<f64> = array(value, name, accepted)?;
    match degrees.iter().find(|d| !(low..=high).contains(*d)) {
        Some(bad) => Err(invalid(name, bad, accepted)),
        None => Ok(degrees.mapv(f64::to_radians)),
    }
}

fn five(q: &Efficiencies) -> [f64; 5] {
    [q.q_ext, q.q_sca, q.q_abs, q.q_back, q.asymmetry]
}

impl TMatrix {
    fn scattered(&self, elevation_deg: f64) -> PyResult<Scattered> {
        let elevation = number("elevation_deg", elevation_deg).map_err(|error| raised(&error))?;
        Ok(Scattered::new(&self.0, elevation.to_radians()))
    }
}

#[pymethods]
impl TMatrix {
    #[new]
    #[pyo3(signature = (x, m, *, shape, axis_ratio, diameter_mm, model, tolerance, threads))]
    #[expect(clippy::too_many_arguments, reason = "they are named where Python calls")]
    fn new(
        py: Python<'_>,
        x: f64,
        m: Complex64,
        shape: &str,
        axis_ratio: Option<&str>,
        diameter_mm: f64,
        model: Option<&str>,
        tolerance: f64,
        threads: Option<usize>,
    ) -> PyResult<Self> {
        let threads = crate::job::threads(threads)?;
        let index = checked_index(m)?;
        let tolerance = number("tolerance", tolerance).map_err(|error| raised(&error))?;
        let body = drop_shape(shape, model, axis_ratio)?.at(diameter_mm * 1e-3);
        let body = body.map_err(|error| raised(&error))?;
        let work = |_: &Sender<()>| tmatrix::TMatrix::new(&body, x, index, tolerance);
        long(py, threads, work, |_, ()| Ok(()))?.map(Self).map_err(|error| raised(&error))
    }

    /// Relative error of amplitudes, root mean square over all directions.
    #[getter]
    fn error(&self) -> f64 {
        self.0.error()
    }

    /// Who found it, and with how many degrees.
    #[getter]
    fn solver(&self) -> (&'static str, usize) {
        let (solver, degrees) = self.0.solver();
        let name = match solver {
            Solver::NullField => "null field",
            Solver::LeastSquares => "least squares",
        };
        (name, degrees)
    }

    /// Amplitudes S1 … S4 in directions: angle and azimuth broadcast.
    fn amplitudes<'py>(
        &self,
        py: Python<'py>,
        theta_deg: &Bound<'py, PyAny>,
        azimuth_deg: &Bound<'py, PyAny>,
        elevation_deg: f64,
    ) -> PyResult<[Bound<'py, PyAny>; 4]> {
        let theta = within(theta_deg, "theta_deg", (0.0, 180.0), ANGLES)?;
        let azimuth = within(azimuth_deg, "azimuth_deg", (-360.0, 360.0), AZIMUTHS)?;
        let shape = common_shape(["theta_deg", "azimuth_deg"], theta.shape(), azimuth.shape())?;
        let mut directions = Vec::new();
        if let (Some(theta), Some(azimuth)) =
            (theta.broadcast(IxDyn(&shape)), azimuth.broadcast(IxDyn(&shape)))
        {
            directions.extend(theta.iter().copied().zip(azimuth.iter().copied()));
        }
        let scattered = self.scattered(elevation_deg)?;
        let found = py.detach(|| scattered.directions(&directions));
        let element = |of: fn(&gonio::optics::AmplitudeMatrix) -> Complex64| {
            let values: Vec<Complex64> = found.iter().map(of).collect();
            PyResult::Ok(values.into_pyarray(py).reshape(IxDyn(&shape))?.into_any())
        };
        Ok([element(|s| s.s1)?, element(|s| s.s2)?, element(|s| s.s3)?, element(|s| s.s4)?])
    }

    /// q_ext, q_sca, q_abs, q_back, asymmetry for light from an elevation.
    fn efficiencies(&self, py: Python<'_>, elevation_deg: f64) -> PyResult<[f64; 5]> {
        let scattered = self.scattered(elevation_deg)?;
        let q = py.detach(|| scattered.efficiencies());
        Ok(five(&Sections::new(&q, &self.0).efficiencies(&q)))
    }

    /// The mean over all orientations.
    #[pyo3(signature = (tolerance, threads))]
    fn random(
        &self,
        py: Python<'_>,
        tolerance: f64,
        threads: Option<usize>,
    ) -> PyResult<RandomMean> {
        let threads = crate::job::threads(threads)?;
        let tolerance = number("tolerance", tolerance).map_err(|error| raised(&error))?;
        let work = |_: &Sender<()>| RandomOrientation::new(&self.0, tolerance);
        let mean = long(py, threads, work, |_, ()| Ok(()))?
            .map_err(|error: NoMean| raised(&tmatrix::TMatrixError::from(error)))?;
        let q = mean.efficiencies();
        let efficiencies = five(&Sections::new(&q, &self.0).efficiencies(&q));
        Ok(RandomMean { mean, efficiencies })
    }
}

#[pymethods]
impl RandomMean {
    /// q_ext, q_sca, q_abs, q_back, asymmetry.
    #[getter]
    fn efficiencies(&self) -> [f64; 5] {
        self.efficiencies
    }

    /// Expansion coefficients, shape (degree, 6).
    fn coefficients<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let flat: Vec<f64> = self.mean.coefficients.iter().flatten().copied().collect();
        let rows = self.mean.coefficients.len();
        Ok(flat.into_pyarray(py).reshape([rows, 6])?.into_any())
    }

    /// a1, a2, a3, a4, b1, b2 at scattering angles: one more dimension at the end.
    fn elements<'py>(
        &self,
        py: Python<'py>,
        theta_deg: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let theta = within(theta_deg, "theta_deg", (0.0, 180.0), ANGLES)?;
        let values: Vec<f64> =
            py.detach(|| theta.iter().flat_map(|t| self.mean.at(t.cos())).collect());
        let shape: Vec<usize> = theta.shape().iter().copied().chain([6]).collect();
        Ok(values.into_pyarray(py).reshape(IxDyn(&shape))?.into_any())
    }
}
