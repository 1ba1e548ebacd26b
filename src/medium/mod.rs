//! Media: the complex refractive index `n + ik` by wavelength in vacuum.

mod water;

use num_complex::Complex64;
use std::path::PathBuf;

/// What went wrong with a medium: the field or file, the value, and what is accepted.
#[derive(Debug, thiserror::Error)]
pub enum MediumError {
    #[error(
        "wavelength {wavelength_nm} nm is outside the data of {name} ({from_nm} to {to_nm} nm)"
    )]
    OutOfRange { name: String, wavelength_nm: f64, from_nm: f64, to_nm: f64 },
    #[error("{field} = {value}: {accepted}")]
    Invalid { field: String, value: String, accepted: String },
    #[error("{}{}: {message}", path.display(), line.map(|l| format!(", line {l}")).unwrap_or_default())]
    File { path: PathBuf, line: Option<usize>, message: String },
}

/// A medium, ready to be asked for its index. A closed set: one arm per kind, one file per kind.
#[derive(Clone, Debug, PartialEq)]
pub enum Medium {
    /// The same index at every wavelength.
    Constant(Complex64),
    /// Liquid water after IAPWS R9-97, temperature in kelvin, at 1 atm.
    Water { temperature: f64 },
}

impl Medium {
    /// Complex index `n + ik` at a wavelength in vacuum (metres).
    pub fn index(&self, wavelength: f64) -> Result<Complex64, MediumError> {
        match self {
            Medium::Constant(index) => Ok(*index),
            Medium::Water { temperature } => water::index(wavelength, *temperature),
        }
    }
}

/// A medium as written in a scene.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(untagged)]
pub enum MediumSpec {
    /// A name in the library.
    Name(String),
    /// `{ index = [n, k] }`.
    Index { index: [f64; 2] },
}

impl Default for MediumSpec {
    fn default() -> Self {
        MediumSpec::Name("water".into())
    }
}

impl MediumSpec {
    /// The medium that is meant; `temperature_c` where its index depends on it.
    pub fn resolve(&self, temperature_c: Option<f64>) -> Result<Medium, MediumError> {
        match self {
            MediumSpec::Name(name) if name == "water" => {
                Ok(Medium::Water { temperature: temperature_c.unwrap_or(20.0) + 273.15 })
            }
            MediumSpec::Name(name) => Err(MediumError::Invalid {
                field: "medium".into(),
                value: name.clone(),
                accepted: "water".into(),
            }),
            MediumSpec::Index { index: [n, k] } => Ok(Medium::Constant(Complex64::new(*n, *k))),
        }
    }
}
