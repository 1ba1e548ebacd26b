//! Scenes, and what they make: tables, plans, amplitudes in chosen directions.

use crate::errors::{invalid, raised};
use crate::job::long;
use gonio::math::digits::round_mantissa;
use gonio::medium::MediumError;
use gonio::phase_table::variables::{Attribute, Describer, Description, Kind, Values};
use gonio::phase_table::{Slab, TableHeader};
use gonio::plan::{Engine, Plan, Symmetry, available_memory};
use gonio::scatter::{ScatterError, Scattering, of_scene};
use gonio::scene::{self, SceneError, SceneFile, SceneText, human_bytes};
use gonio::simulate::{self, SimulateError};
use num_complex::Complex64;
use numpy::ndarray::IxDyn;
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::exceptions::{PyMemoryError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::mpsc::Sender;

/// A checked scene.
#[pyclass(frozen, module = "gonio._gonio")]
pub struct Scene(scene::Scene);

/// What a scene is called in messages where no file has it.
const NAME: &str = "scene";

#[pymethods]
impl Scene {
    /// Of a file (`path`), of the text of one (`toml`), or of keys as JSON (`json`).
    #[new]
    #[pyo3(signature = (*, path=None, toml=None, json=None))]
    fn new(path: Option<PathBuf>, toml: Option<String>, json: Option<&str>) -> PyResult<Self> {
        let none = SceneFile::default();
        let scene = match (path, toml, json) {
            (Some(path), None, None) => scene::Scene::load(&path, &none),
            (None, Some(text), None) => {
                SceneText::parse(NAME, text).and_then(|text| scene::Scene::from_text(text, &none))
            }
            (None, None, Some(json)) => {
                let keys = table_of(json)?;
                SceneText::of_keys(NAME, &keys)
                    .and_then(|text| scene::Scene::from_text(text, &none))
            }
            _ => return Err(PyValueError::new_err("one of path, toml and json is to be given")),
        };
        scene.map(Self).map_err(|error: SceneError| raised(&error))
    }

    /// The scene with all its values, as TOML.
    #[getter]
    fn toml(&self) -> &str {
        &self.0.toml
    }

    /// Files that the scene names: a result belongs to what they hold.
    #[getter]
    fn files(&self) -> Vec<PathBuf> {
        scene::named_files(&self.0.toml)
    }

    /// What the user is to know of the medium.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.0.medium.notes()
    }

    /// Number of wavelengths.
    #[getter]
    fn wavelengths(&self) -> usize {
        self.0.wavelengths.len()
    }

    /// What would be computed, as JSON.
    fn plan(&self, py: Python<'_>, threads: Option<usize>) -> PyResult<String> {
        let threads = crate::job::threads(threads)?;
        let work = |_: &Sender<()>| planned(&self.0, threads);
        long(py, threads, work, |_, ()| Ok(()))?.map_err(|error| raised(&error))
    }

    /// All of a table: attributes, variables, and the large arrays by their names.
    #[pyo3(signature = (*, command_line, threads=None, progress=None))]
    fn table<'py>(
        &self,
        py: Python<'py>,
        command_line: &str,
        threads: Option<usize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let threads = crate::job::threads(threads)?;
        let scene = &self.0;
        let header = simulate::header(scene, command_line.into()).map_err(|e| raised(&e))?;
        let mut large = Large::new(scene, &header, threads)?;
        let mut describer = Describer::new(&header);
        let (into, describing) = (&mut large, &mut describer);
        let work = |done: &Sender<usize>| {
            simulate::in_turn::<SimulateError>(scene, |index, slab| {
                into.add(index, &slab);
                describing.add(index, &slab);
                // Where nobody listens any more the work is being stopped.
                let _ = done.send(index + 1);
                Ok(())
            })
        };
        let hear = |py: Python<'_>, done: usize| match &progress {
            Some(progress) => progress.call1(py, (done,)).map(|_| ()),
            None => Ok(()),
        };
        long(py, threads, work, hear)?.map_err(|error| raised(&error))?;
        large.described(py, describer.finish(scene.bit_round, true), &header)
    }

    /// Amplitudes S1 … S4 by wavelength, azimuth and scattering angle, efficiencies by wavelength (and azimuth),
    /// the error by wavelength, azimuth and angle (NaN: not known), and who computed them.
    #[pyo3(signature = (wavelength_nm, theta_deg, azimuth_deg, threads=None))]
    fn scatter<'py>(
        &self,
        py: Python<'py>,
        wavelength_nm: Vec<f64>,
        theta_deg: Vec<f64>,
        azimuth_deg: Vec<f64>,
        threads: Option<usize>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let threads = crate::job::threads(threads)?;
        let scene = &self.0;
        let theta: Vec<f64> = theta_deg.iter().map(|t| t.to_radians()).collect();
        let work = |_: &Sender<()>| {
            let mut all = Vec::new();
            for nm in &wavelength_nm {
                for azimuth in &azimuth_deg {
                    gonio::cancel::checkpoint();
                    all.push(of_scene(scene, nm * 1e-9, &theta, azimuth.to_radians())?);
                }
            }
            Ok::<_, ScatterError>(all)
        };
        let all = long(py, threads, work, |_, ()| Ok(()))?.map_err(|error| raised(&error))?;
        let shape = [wavelength_nm.len(), azimuth_deg.len(), theta.len()];
        let index = wavelength_nm.iter().map(|nm| scene.medium.index(nm * 1e-9));
        let index = index.collect::<Result<Vec<_>, MediumError>>().map_err(|e| raised(&e))?;
        seen(py, &all, &theta, shape, index)
    }
}

/// Keys as TOML has them.
pub fn table_of(json: &str) -> PyResult<toml::Table> {
    let wrong = |error: String| {
        invalid(NAME, json, &format!("keys and values as in a scene file: {error}"))
    };
    let value: serde_json::Value = serde_json::from_str(json).map_err(|e| wrong(e.to_string()))?;
    match toml_of(&value).map_err(&wrong)? {
        toml::Value::Table(table) => Ok(table),
        _ => Err(wrong("a dictionary is accepted".into())),
    }
}

fn toml_of(value: &serde_json::Value) -> Result<toml::Value, String> {
    use serde_json::Value;
    Ok(match value {
        Value::Null => return Err("None stands for no value of TOML".into()),
        Value::Bool(flag) => toml::Value::Boolean(*flag),
        Value::String(text) => toml::Value::String(text.clone()),
        Value::Number(number) => match (number.as_i64(), number.as_f64()) {
            (Some(whole), _) => toml::Value::Integer(whole),
            (None, Some(real)) => toml::Value::Float(real),
            _ => return Err(format!("{number} is no number of TOML")),
        },
        Value::Array(list) => {
            toml::Value::Array(list.iter().map(toml_of).collect::<Result<_, _>>()?)
        }
        Value::Object(table) => {
            let pairs = table.iter().map(|(key, value)| Ok((key.clone(), toml_of(value)?)));
            toml::Value::Table(pairs.collect::<Result<_, String>>()?)
        }
    })
}

fn planned(scene: &scene::Scene, threads: usize) -> Result<String, SimulateError> {
    let plan = Plan::new(scene)?;
    let azimuths = plan.table_azimuths(&scene.phi);
    let (computed, _) = plan.computed_azimuths(&azimuths);
    let parts = scene.parts();
    let plans = if plan.parts.is_empty() { std::slice::from_ref(&plan) } else { &plan.parts };
    let mut ranges = Vec::new();
    for (part, plan) in parts.iter().zip(plans) {
        ranges.extend(plan.methods(part)?);
    }
    let skipped = ranges.iter().flat_map(|planned| &planned.skipped);
    let skipped: BTreeSet<&String> = skipped.chain(&plan.reasons).collect();
    let ranges: Vec<_> = ranges
        .iter()
        .map(|planned| {
            let mut json = serde_json::json!(planned.range);
            json["skipped"] = serde_json::json!(planned.skipped);
            json
        })
        .collect();
    let report = serde_json::json!({
        "engine": format!("{:?}", plan.engine),
        "orders": plan.orders,
        "ranges": ranges,
        "skipped": skipped,
        "forward_diffraction": plan.forward_diffraction,
        "rotational_symmetry": plan.symmetry == Symmetry::Rotational,
        "wavelengths": scene.wavelengths.len(),
        "theta": scene.theta.len(),
        "azimuths_stored": azimuths.len(),
        "azimuths_computed": computed.len(),
        "memory_bytes": plan.cost(scene, threads).memory,
    });
    Ok(report.to_string())
}

/// The large arrays of a table.
struct Large {
    values: Vec<f32>,
    mask: Vec<u8>,
    per_slab: usize,
    per_mask: usize,
    slabs: usize,
    bit_round: Option<u8>,
}

impl Large {
    /// Room for a table; refused where it would not fit into the memory that is free.
    fn new(scene: &scene::Scene, header: &TableHeader, threads: usize) -> PyResult<Self> {
        let plan = Plan::new(scene).map_err(|error| raised(&error))?;
        let per_mask = header.axes.theta.len() * header.axes.phi.len();
        let per_slab = per_mask * header.quantity.elements();
        let slabs = header.axes.wavelength.len();
        let array = 4 * (per_slab * slabs) as u64;
        let needed = plan.cost(scene, threads).memory + array;
        if let Some(free) = available_memory().filter(|free| needed > *free) {
            return Err(PyMemoryError::new_err(format!(
                "table.theta_deg × table.azimuth_deg × light.wavelengths_nm = {} × {} × {slabs}: the table needs \
                 about {} of memory, {} is free; take fewer angles or wavelengths",
                header.axes.theta.len(),
                header.axes.phi.len(),
                human_bytes(needed),
                human_bytes(free)
            )));
        }
        let mut values = Vec::new();
        let room = values.try_reserve_exact(per_slab * slabs);
        room.map_err(|error| PyMemoryError::new_err(error.to_string()))?;
        Ok(Self { values, mask: Vec::new(), per_slab, per_mask, slabs, bit_round: scene.bit_round })
    }

    fn add(&mut self, index: usize, slab: &Slab) {
        debug_assert_eq!(self.values.len(), index * self.per_slab);
        match self.bit_round {
            None => self.values.extend(slab.values.iter()),
            Some(bits) => self.values.extend(slab.values.iter().map(|&v| round_mantissa(v, bits))),
        }
        if let Some(mask) = &slab.caustic_order {
            self.mask.resize(self.per_mask * self.slabs, 0);
            let own = &mut self.mask[index * self.per_mask..][..self.per_mask];
            own.iter_mut().zip(mask).for_each(|(to, from)| *to = *from);
        }
    }

    /// The attributes, and by name of each variable its dimensions, values and attributes.
    fn described<'py>(
        self,
        py: Python<'py>,
        description: Description,
        header: &TableHeader,
    ) -> PyResult<Bound<'py, PyDict>> {
        let Self { values, mask, .. } = self;
        let (mut values, mut mask) = (Some(values), Some(mask));
        let variables = PyList::empty(py);
        for variable in description.variables {
            let shape: Vec<usize> = variable.shape.iter().map(|&n| n as usize).collect();
            let shape = IxDyn(&shape);
            let array = match variable.values {
                Values::F64(values) => values.into_pyarray(py).reshape(shape)?.into_any(),
                Values::I32(values) => values.into_pyarray(py).reshape(shape)?.into_any(),
                Values::Texts(texts) => PyList::new(py, texts)?.into_any(),
                Values::Elsewhere(Kind::U8) => {
                    mask.take().unwrap_or_default().into_pyarray(py).reshape(shape)?.into_any()
                }
                Values::Elsewhere(_) if variable.shape.len() == 2 => {
                    let (theta, phi) = header.axes.solid_angle_factors();
                    let all = theta.iter().flat_map(|t| phi.iter().map(move |p| (t * p) as f32));
                    all.collect::<Vec<_>>().into_pyarray(py).reshape(shape)?.into_any()
                }
                Values::Elsewhere(_) => {
                    values.take().unwrap_or_default().into_pyarray(py).reshape(shape)?.into_any()
                }
            };
            let attributes = attributes(py, &variable.attributes)?;
            variables.append((variable.name, variable.dimensions, array, attributes))?;
        }
        let whole = PyDict::new(py);
        whole.set_item("attributes", attributes(py, &description.attributes)?)?;
        whole.set_item("variables", variables)?;
        Ok(whole)
    }
}

fn attributes<'py>(py: Python<'py>, all: &[(String, Attribute)]) -> PyResult<Bound<'py, PyDict>> {
    let dictionary = PyDict::new(py);
    for (name, attribute) in all {
        match attribute {
            Attribute::Text(text) => dictionary.set_item(name, text)?,
            Attribute::Integer(number) => dictionary.set_item(name, number)?,
        }
    }
    Ok(dictionary)
}

fn seen<'py>(
    py: Python<'py>,
    all: &[(Scattering, Engine)],
    theta: &[f64],
    shape: [usize; 3],
    index: Vec<Complex64>,
) -> PyResult<Bound<'py, PyDict>> {
    let results = PyDict::new(py);
    type Amplitude = fn(&gonio::optics::AmplitudeMatrix) -> Complex64;
    let amplitudes: [(&str, Amplitude); 4] =
        [("s1", |s| s.s1), ("s2", |s| s.s2), ("s3", |s| s.s3), ("s4", |s| s.s4)];
    for (name, of) in amplitudes {
        let values: Vec<Complex64> =
            all.iter().flat_map(|(seen, _)| seen.amplitudes.iter().map(of)).collect();
        results.set_item(name, values.into_pyarray(py).reshape(shape)?)?;
    }
    type Efficiency = fn(&Scattering) -> f64;
    let efficiencies: [(&str, Efficiency); 5] = [
        ("q_ext", |s| s.efficiencies.q_ext),
        ("q_sca", |s| s.efficiencies.q_sca),
        ("q_abs", |s| s.efficiencies.q_abs),
        ("q_back", |s| s.efficiencies.q_back),
        ("asymmetry", |s| s.efficiencies.asymmetry),
    ];
    for (name, of) in efficiencies {
        let values: Vec<f64> = all.iter().map(|(seen, _)| of(seen)).collect();
        results.set_item(name, values.into_pyarray(py).reshape([shape[0], shape[1]])?)?;
    }
    let errors: Vec<f64> = (all.iter())
        .flat_map(|(seen, _)| {
            theta.iter().map(|&theta| seen.worth.map_or(f64::NAN, |worth| worth.at(theta)))
        })
        .collect();
    results.set_item("error_estimate", errors.into_pyarray(py).reshape(shape)?)?;
    results.set_item("index", index.into_pyarray(py))?;
    let engines: BTreeSet<String> = all.iter().map(|(_, engine)| format!("{engine:?}")).collect();
    results.set_item("engine", engines.into_iter().collect::<Vec<_>>().join(" + "))?;
    let included = all.iter().all(|(seen, _)| seen.diffraction_included);
    results.set_item("diffraction_included", included)?;
    Ok(results)
}
