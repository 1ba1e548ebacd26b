//! Spheres by the exact series: amplitudes, efficiencies, Legendre coefficients, Debye's terms; arrays of size
//! parameters and indices broadcast against each other.

use crate::arrays::{array, common_shape};
use crate::errors::{invalid, raised, too_large};
use crate::job::long;
use gonio::series::SeriesError;
use gonio::series::angular::AngleSet;
use gonio::series::debye::{DebyeSeries, Term};
use gonio::series::lorenz_mie::Sphere;
use ndarray::{ArrayD, IxDyn};
use num_complex::Complex64;
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyComplex, PyFloat, PyInt, PyString};
use rayon::prelude::*;

/// Seconds of one term of the coefficients and of one term at one angle, on one core, for deciding what a call
/// is worth; measured, to a factor of two.
const PER_TERM: f64 = 4e-8;
const PER_TERM_AND_ANGLE: f64 = 4e-10;
/// Below this many seconds the lock of the interpreter is kept, and below the other no threads are started.
const BRIEF: f64 = 2e-5;
const SHORT: f64 = 2e-3;

const SIZES: &str = "size parameters 2πr/λ, numbers above 0, are accepted: a number or an array";
const INDICES: &str =
    "indices n + ik relative to the outside, n > 0 and k ≥ 0, are accepted: a number or an array";
const ANGLES: &str = "scattering angles from 0 to 180 degrees are accepted: a number or an array";

/// Spheres to be computed: pairs of size parameter and index, and the shape that they fill.
struct Spheres {
    pairs: Vec<(f64, Complex64)>,
    shape: Vec<usize>,
}

impl Spheres {
    fn new(x: &Bound<'_, PyAny>, m: &Bound<'_, PyAny>) -> PyResult<Self> {
        let x: ArrayD<f64> = array(x, "x", SIZES)?;
        let m: ArrayD<Complex64> = array(m, "m", INDICES)?;
        let shape = common_shape(["x", "m"], x.shape(), m.shape())?;
        let count = shape.iter().try_fold(1usize, |product, &n| product.checked_mul(n));
        let count = count.ok_or_else(|| too_large(usize::MAX))?;
        let mut pairs = Vec::new();
        pairs.try_reserve_exact(count).map_err(|_| too_large(count))?;
        if let (Some(x), Some(m)) = (x.broadcast(IxDyn(&shape)), m.broadcast(IxDyn(&shape))) {
            pairs.extend(x.iter().copied().zip(m.iter().copied()));
        }
        Ok(Self { pairs, shape })
    }

    /// Seconds on one core, roughly; of what the series refuses anyway, nothing.
    fn seconds(&self, angles: usize) -> f64 {
        let of_one = |&(x, m): &(f64, Complex64)| {
            let terms = if x.is_finite() { x.max(0.0) + 7.0 * x.abs().cbrt() + 4.0 } else { 0.0 };
            PER_TERM * terms * (1.0 + m.norm().min(100.0))
                + PER_TERM_AND_ANGLE * terms * angles as f64
        };
        self.pairs.iter().map(of_one).sum()
    }

    /// `of_one` of every sphere into its part of `out`, `width` values each, on as many threads as it is worth.
    fn fill<T: Send>(
        &self,
        py: Python<'_>,
        threads: usize,
        seconds: f64,
        out: &mut [T],
        of_one: impl Fn((f64, Complex64), &mut [T], bool) -> Result<(), SeriesError> + Sync + Send,
    ) -> PyResult<()> {
        let width = out.len().checked_div(self.pairs.len()).unwrap_or(0);
        if width == 0 {
            return Ok(());
        }
        let serial = |out: &mut [T]| {
            let mut pairs = self.pairs.iter().zip(out.chunks_mut(width));
            pairs.try_for_each(|(&pair, out)| of_one(pair, out, false))
        };
        let done = if seconds < BRIEF {
            serial(out)
        } else if seconds < SHORT {
            py.detach(|| serial(out))
        } else {
            // Few large spheres share their angles among the threads, many are shared among them.
            let few = self.pairs.len() < 4 * threads;
            let work = |_: &std::sync::mpsc::Sender<()>| {
                let pairs = self.pairs.par_iter().zip(out.par_chunks_mut(width));
                pairs.try_for_each(|(&pair, out)| {
                    gonio::cancel::checkpoint();
                    of_one(pair, out, few)
                })
            };
            long(py, threads, work, |_, ()| Ok(()))?
        };
        done.map_err(|error| raised(&error))
    }
}

/// Values between two looks at Ctrl-C while room for them is made: a gigabyte takes a busy machine a second.
const LOOK: usize = 1 << 20;

/// Room for so many values per sphere.
fn room<T: Copy>(py: Python<'_>, spheres: &Spheres, width: usize, zero: T) -> PyResult<Vec<T>> {
    let count = spheres.pairs.len().checked_mul(width).ok_or_else(|| too_large(usize::MAX))?;
    let mut values = Vec::new();
    values.try_reserve_exact(count).map_err(|_| too_large(count))?;
    while count - values.len() > LOOK {
        values.resize(values.len() + LOOK, zero);
        py.check_signals()?;
    }
    values.resize(count, zero);
    Ok(values)
}

/// Values as an array of numpy.
fn shaped<'py, T: numpy::Element>(
    py: Python<'py>,
    values: Vec<T>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    Ok(values.into_pyarray(py).reshape(IxDyn(shape))?.into_any())
}

/// Scattering angles, radians, and the dimensions that they add.
fn angles(theta_deg: &Bound<'_, PyAny>) -> PyResult<(Vec<f64>, Vec<usize>)> {
    let theta: ArrayD<f64> = array(theta_deg, "theta_deg", ANGLES)?;
    if let Some(bad) = theta.iter().find(|t| !(0.0..=180.0).contains(*t)) {
        return Err(invalid("theta_deg", bad, ANGLES));
    }
    Ok((theta.iter().map(|t| t.to_radians()).collect(), theta.shape().to_vec()))
}

/// A plain number, which no array is.
fn number(value: &Bound<'_, PyAny>) -> Option<f64> {
    let plain = value.is_instance_of::<PyFloat>() || value.is_exact_instance_of::<PyInt>();
    plain.then(|| value.extract().ok()).flatten()
}

/// A plain complex number.
fn complex(value: &Bound<'_, PyAny>) -> Option<Complex64> {
    if value.is_instance_of::<PyComplex>() {
        return value.extract().ok();
    }
    number(value).map(Complex64::from)
}

/// One sphere at one angle, without arrays: where loops in Python call.
fn single(
    x: &Bound<'_, PyAny>,
    m: &Bound<'_, PyAny>,
    theta_deg: &Bound<'_, PyAny>,
) -> PyResult<Option<(f64, Complex64, f64)>> {
    let (Some(x), Some(m), Some(theta)) = (number(x), complex(m), number(theta_deg)) else {
        return Ok(None);
    };
    if !(0.0..=180.0).contains(&theta) {
        return Err(invalid("theta_deg", theta, ANGLES));
    }
    Ok(Some((x, m, theta.to_radians())))
}

type Pair = (Complex64, Complex64);

/// S1 and S2 as two arrays of the spheres' shape and the angles'.
fn amplitude_arrays<'py>(
    py: Python<'py>,
    spheres: &Spheres,
    angle_shape: &[usize],
    pairs: Vec<Pair>,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
    let shape: Vec<usize> = spheres.shape.iter().chain(angle_shape).copied().collect();
    let (first, second) = pairs.into_iter().unzip();
    let (first, second): (Vec<Complex64>, Vec<Complex64>) = (first, second);
    Ok((shaped(py, first, &shape)?, shaped(py, second, &shape)?))
}

/// See `gonio.mie.amplitudes`.
#[pyfunction]
#[pyo3(signature = (x, m, theta_deg, threads=None))]
pub fn mie_amplitudes<'py>(
    py: Python<'py>,
    x: &Bound<'py, PyAny>,
    m: &Bound<'py, PyAny>,
    theta_deg: &Bound<'py, PyAny>,
    threads: Option<usize>,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
    if let Some((x, m, theta)) = single(x, m, theta_deg)? {
        let one = || Sphere::new(x, m).map(|sphere| sphere.amplitudes(&[theta])[0]);
        let (s1, s2) = if x < 100.0 { one() } else { py.detach(one) }.map_err(|e| raised(&e))?;
        return Ok((s1.into_pyobject(py)?.into_any(), s2.into_pyobject(py)?.into_any()));
    }
    let count = crate::job::threads(threads)?;
    let spheres = Spheres::new(x, m)?;
    let (theta, angle_shape) = angles(theta_deg)?;
    let mut out = room(py, &spheres, theta.len(), (Complex64::ZERO, Complex64::ZERO))?;
    let set = AngleSet::new(&theta);
    spheres.fill(py, count, spheres.seconds(set.recurrences()), &mut out, |(x, m), out, few| {
        let sphere = Sphere::new(x, m)?;
        let found =
            if few { sphere.amplitudes_parallel(&theta) } else { sphere.amplitudes_at(&set) };
        out.copy_from_slice(&found);
        Ok(())
    })?;
    amplitude_arrays(py, &spheres, &angle_shape, out)
}

/// See `gonio.mie.efficiencies`.
#[pyfunction]
#[pyo3(signature = (x, m, threads=None))]
pub fn mie_efficiencies<'py>(
    py: Python<'py>,
    x: &Bound<'py, PyAny>,
    m: &Bound<'py, PyAny>,
    threads: Option<usize>,
) -> PyResult<[Bound<'py, PyAny>; 5]> {
    let numbers = |x: f64, m: Complex64| {
        let e = Sphere::new(x, m)?.efficiencies();
        Ok::<_, SeriesError>([e.q_ext, e.q_sca, e.q_abs, e.q_back, e.asymmetry])
    };
    if let (Some(x), Some(m)) = (number(x), complex(m)) {
        let found = if x < 100.0 { numbers(x, m) } else { py.detach(|| numbers(x, m)) };
        return Ok(found.map_err(|e| raised(&e))?.map(|q| PyFloat::new(py, q).into_any()));
    }
    let count = crate::job::threads(threads)?;
    let spheres = Spheres::new(x, m)?;
    let mut out = room(py, &spheres, 1, [0.0; 5])?;
    spheres.fill(py, count, spheres.seconds(0), &mut out, |(x, m), out, _| {
        out[0] = numbers(x, m)?;
        Ok(())
    })?;
    let column = |k: usize| shaped(py, out.iter().map(|row| row[k]).collect(), &spheres.shape);
    Ok([column(0)?, column(1)?, column(2)?, column(3)?, column(4)?])
}

/// See `gonio.mie.legendre`.
#[pyfunction]
#[pyo3(signature = (x, m, count=None, threads=None))]
pub fn mie_legendre<'py>(
    py: Python<'py>,
    x: &Bound<'py, PyAny>,
    m: &Bound<'py, PyAny>,
    count: Option<usize>,
    threads: Option<usize>,
) -> PyResult<Bound<'py, PyAny>> {
    let threads = crate::job::threads(threads)?;
    let spheres = Spheres::new(x, m)?;
    if count == Some(0) {
        return Err(invalid("count", 0, "a whole number above 0 is accepted"));
    }
    let largest = spheres.pairs.iter().fold(0.0_f64, |most, (x, _)| most.max(*x));
    let all = || 2 * (largest + 7.0 * largest.cbrt() + 4.0).ceil() as usize + 1;
    let width = count.unwrap_or_else(all);
    let mut out = room(py, &spheres, width, 0.0)?;
    // nodes are half as many as coefficients and more
    let seconds = spheres.seconds(2 * width);
    spheres.fill(py, threads, seconds, &mut out, |(x, m), out, _| {
        out.copy_from_slice(&Sphere::new(x, m)?.legendre(width));
        Ok(())
    })?;
    let shape: Vec<usize> = spheres.shape.iter().copied().chain([width]).collect();
    shaped(py, out, &shape)
}

/// See `gonio.debye.amplitudes`.
#[pyfunction]
#[pyo3(signature = (x, m, theta_deg, order, threads=None))]
pub fn debye_amplitudes<'py>(
    py: Python<'py>,
    x: &Bound<'py, PyAny>,
    m: &Bound<'py, PyAny>,
    theta_deg: &Bound<'py, PyAny>,
    order: &Bound<'py, PyAny>,
    threads: Option<usize>,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
    let terms = terms(order)?;
    let count = crate::job::threads(threads)?;
    let spheres = Spheres::new(x, m)?;
    let (theta, angle_shape) = angles(theta_deg)?;
    let mut out = room(py, &spheres, theta.len(), (Complex64::ZERO, Complex64::ZERO))?;
    spheres.fill(py, count, 4.0 * spheres.seconds(theta.len()), &mut out, |(x, m), out, few| {
        let series = DebyeSeries::new(x, m)?;
        let found =
            if few { series.sum_parallel(&terms, &theta) } else { series.sum(&terms, &theta) };
        out.copy_from_slice(&found);
        Ok(())
    })?;
    let (first, second) = amplitude_arrays(py, &spheres, &angle_shape, out)?;
    let plain = [x, theta_deg].iter().all(|value| number(value).is_some()) && complex(m).is_some();
    if plain { Ok((first.get_item(())?, second.get_item(())?)) } else { Ok((first, second)) }
}

/// One term, or several that are added.
fn terms(order: &Bound<'_, PyAny>) -> PyResult<Vec<Term>> {
    let accepted = "an order from 0 to 1000, \"diffraction\", \"all\", or a list of orders and \"diffraction\" \
                    is accepted";
    let one = |value: &Bound<'_, PyAny>| -> PyResult<Term> {
        let refused = || {
            let shown = value.repr().map_or_else(|_| "?".into(), |text| text.to_string());
            invalid("order", shown, accepted)
        };
        if let Ok(word) = value.cast::<PyString>() {
            return match word.to_str()? {
                "diffraction" => Ok(Term::Diffraction),
                "all" => Ok(Term::All),
                _ => Err(refused()),
            };
        }
        match value.extract::<u32>() {
            Ok(order) if order <= 1000 => Ok(Term::Order(order)),
            _ => Err(refused()),
        }
    };
    if order.is_instance_of::<PyString>() || order.extract::<u32>().is_ok() {
        return Ok(vec![one(order)?]);
    }
    let Ok(list) = order.try_iter() else { return Ok(vec![one(order)?]) };
    let terms = list.map(|value| one(&value?)).collect::<PyResult<Vec<_>>>()?;
    if terms.is_empty() || terms.len() > 1 && terms.contains(&Term::All) {
        return Err(invalid("order", order.repr()?, accepted));
    }
    Ok(terms)
}
