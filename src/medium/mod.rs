//! Media: the complex refractive index `n + ik` by wavelength in vacuum.
//!
//! [`MediumSpec`] is what a scene file says; [`MediumSpec::resolve`] makes a [`Medium`], which
//! answers [`Medium::index`]. Outside the data there is an error, never a guess, unless the user
//! asked for one. Water is relative to vacuum; glasses are as catalogues give them, relative to
//! air, which this program takes as index 1.
//!
//! ```
//! use gonio::medium::MediumSpec;
//! use std::path::Path;
//!
//! #[derive(serde::Deserialize)]
//! struct Keys {
//!     medium: MediumSpec,
//! }
//! let keys: Keys = toml::from_str("medium = { name = \"water\", temperature_c = 20 }")?;
//! let water = keys.medium.resolve(Path::new("."))?;
//! assert!((water.index(589.3e-9)?.re - 1.33336).abs() < 2e-5);
//! assert!(water.index(1.0).is_err());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod abbe;
mod agf;
mod band_model;
mod csv_cells;
mod csv_table;
mod daimon;
mod density;
mod extinction;
mod formula;
mod index_text;
pub mod kramers_kronig;
mod library;
mod material;
mod own;
mod refractive_index_info;
mod resolve;
mod samples;
mod sea_water;
mod solution;
mod spec;
mod spec_keys;
mod table;
mod text;
mod unit;
mod water;
mod water_absorption;

pub use abbe::{Abbe, AbbeLines, abbe_to_sellmeier, fit_cauchy};
pub use band_model::BandModel;
pub use csv_table::read as read_csv;
pub use daimon::Daimon;
pub use density::Density;
pub use extinction::Extinction;
pub use formula::Formula;
pub use index_text::parse_index;
pub use library::{LibraryEntry, list};
pub use material::{Material, RealIndex};
pub use own::OwnMedium;
pub use samples::{DataCurve, Samples};
pub use solution::{Dye, Solution};
pub use spec::{MediumSpec, NamedSpec};
pub use table::Table;
pub use unit::Unit;

use crate::math::digits::to_digits;
use num_complex::Complex64;
use std::path::PathBuf;
use std::sync::Arc;

/// What went wrong with a medium: the field or file, the value, and what is accepted.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum MediumError {
    /// Numbers are nanometres with as many digits as tell them apart.
    #[error("wavelength {wavelength} nm is outside the data of {name} ({range}){hint}")]
    OutOfRange { name: String, wavelength: String, range: String, hint: String },
    #[error("{field} = {value}: {accepted}")]
    Invalid { field: String, value: String, accepted: String },
    #[error("{}{}: {message}", path.display(), line.map(|l| format!(", line {l}")).unwrap_or_default())]
    File { path: PathBuf, line: Option<usize>, message: String },
    /// Data of the extinction coefficient alone make no medium.
    #[error("{}: the file holds no n (only k): give n by another file or a host medium", path.display())]
    OnlyExtinction { path: PathBuf },
    #[error(
        "unknown medium \"{name}\"{}; gonio material --list shows all names",
        nearest.as_ref().map(|n| format!(", did you mean \"{n}\"?")).unwrap_or_default()
    )]
    Unknown { name: String, nearest: Option<String> },
}

/// A medium, ready to be asked for its index. A closed set: one arm per kind, one file per kind.
#[derive(Clone, Debug, PartialEq)]
pub enum Medium {
    /// The same index at every wavelength.
    Constant(Complex64),
    /// Liquid water after IAPWS R9-97, temperature in kelvin, at 1 atm; k from measured tables.
    Water {
        /// Kelvin.
        temperature: f64,
    },
    /// Water or steam of any density (kg/m³), temperature in kelvin.
    WaterOfDensity {
        /// Kelvin.
        temperature: f64,
        /// kg/m³.
        density: f64,
    },
    /// Sea water, temperature in kelvin, salinity in g/kg.
    SeaWater {
        /// Kelvin.
        temperature: f64,
        /// g/kg.
        salinity: f64,
    },
    /// Distilled water after Daimon & Masumura.
    Daimon(Arc<Daimon>),
    /// A material by a formula or a table.
    Material(Arc<Material>),
    /// A dye in a host.
    Solution(Arc<Solution>),
    /// A function of the wavelength.
    Own(OwnMedium),
}

impl Medium {
    /// Complex index `n + ik` at a wavelength in vacuum (metres).
    pub fn index(&self, wavelength: f64) -> Result<Complex64, MediumError> {
        let index = self.index_of_data(wavelength)?;
        if is_plausible(index) {
            return Ok(index);
        }
        Err(invalid(
            &format!("index of {} at {} nm", self.name(), nanometres(wavelength)),
            format!("{:e} + {:e}i", index.re, index.im),
            PLAUSIBLE_INDEX,
        ))
    }

    fn index_of_data(&self, wavelength: f64) -> Result<Complex64, MediumError> {
        match self {
            Medium::Constant(index) => Ok(*index),
            Medium::Water { temperature } => water::index(wavelength, *temperature),
            Medium::WaterOfDensity { temperature, density } => {
                water::at_density(wavelength, *temperature, *density)
            }
            Medium::SeaWater { temperature, salinity } => {
                sea_water::index(wavelength, *temperature, *salinity)
            }
            Medium::Daimon(water) => water.index(wavelength),
            Medium::Material(material) => material.index(wavelength),
            Medium::Solution(solution) => solution.index(wavelength),
            Medium::Own(own) => own.index(wavelength),
        }
    }

    /// Wavelengths in metres that the data cover; a material that extrapolates answers beyond.
    pub fn valid_range(&self) -> (f64, f64) {
        match self {
            Medium::Constant(_) => (0.0, f64::INFINITY),
            Medium::Water { .. } | Medium::WaterOfDensity { .. } => water::RANGE,
            Medium::SeaWater { .. } => sea_water::RANGE,
            Medium::Daimon(water) => water.range(),
            Medium::Material(material) => material.range,
            Medium::Solution(solution) => solution.range(),
            Medium::Own(own) => own.range(),
        }
    }

    /// What it is called, with its conditions.
    pub fn name(&self) -> String {
        let celsius = |kelvin: f64| format!("{:.2} °C", kelvin - 273.15);
        match self {
            Medium::Constant(index) => format!("constant {} + {}i", index.re, index.im),
            Medium::Water { temperature } => format!("water at {}", celsius(*temperature)),
            Medium::WaterOfDensity { temperature, density } => {
                format!("water at {}, {density} kg/m³", celsius(*temperature))
            }
            Medium::SeaWater { temperature, salinity } => {
                format!("sea water at {}, {salinity} g/kg", celsius(*temperature))
            }
            Medium::Daimon(water) => format!("water-daimon at {}", celsius(water.temperature())),
            Medium::Material(material) => material.name.clone(),
            Medium::Solution(solution) => solution.name(),
            Medium::Own(own) => own.name().into(),
        }
    }

    /// Where the data are from; says so where a material extrapolates.
    pub fn source(&self) -> String {
        match self {
            Medium::Constant(_) => "given".into(),
            Medium::Water { .. } | Medium::WaterOfDensity { .. } => water::SOURCE.into(),
            Medium::SeaWater { .. } => sea_water::SOURCE.into(),
            Medium::Daimon(water) => water.source().into(),
            Medium::Material(m) if m.extrapolate => {
                let (from, to) = m.range;
                format!(
                    "{} | extrapolated beyond {} to {} nm",
                    m.source,
                    nanometres(from),
                    nanometres(to)
                )
            }
            Medium::Material(material) => material.source.clone(),
            Medium::Solution(solution) => solution.source(),
            Medium::Own(_) => "a function of its user".into(),
        }
    }

    /// What the readers of its files changed or left out, for the user to know.
    pub fn notes(&self) -> Vec<String> {
        match self {
            Medium::Material(material) => {
                material.notes.iter().map(|note| format!("{}: {note}", material.name)).collect()
            }
            Medium::Solution(solution) => solution.notes(),
            _ => Vec::new(),
        }
    }

    /// Refuses temperatures, densities and salinities outside the data.
    fn check_conditions(&self) -> Result<(), MediumError> {
        match self {
            Medium::Water { temperature } => water::check_temperature(*temperature, false),
            Medium::WaterOfDensity { temperature, density } => {
                water::check_temperature(*temperature, true)?;
                water::check_density(*density)
            }
            Medium::SeaWater { temperature, salinity } => {
                sea_water::check_conditions(*temperature, *salinity)
            }
            _ => Ok(()),
        }
    }
}

fn invalid(field: &str, value: impl ToString, accepted: &str) -> MediumError {
    MediumError::Invalid {
        field: field.into(),
        value: value.to_string(),
        accepted: accepted.into(),
    }
}

/// Refuses wavelengths (metres) outside a range, with a slack of a part in 10¹² for rounding.
fn check_range(name: &str, wavelength: f64, range: (f64, f64)) -> Result<(), MediumError> {
    if wavelength >= range.0 * (1.0 - 1e-12) && wavelength <= range.1 * (1.0 + 1e-12) {
        return Ok(());
    }
    Err(MediumError::OutOfRange {
        name: name.into(),
        wavelength: nanometres(wavelength),
        range: range_text(range),
        hint: String::new(),
    })
}

/// A range of wavelengths (metres) for messages; one row is a range of its own.
fn range_text((from, to): (f64, f64)) -> String {
    match from == to {
        true => format!("one row, at {} nm", nanometres(from)),
        false => format!("{} to {} nm", nanometres(from), nanometres(to)),
    }
}

/// What [`is_plausible`] accepts, in words.
pub const PLAUSIBLE_INDEX: &str = "n from 1e-4 to 1e4, k from 0 to 1e4";

/// True for an index that any material may have between X-rays and microwaves (metals reach some
/// hundreds in the far infrared). Beyond, squares and powers of it overflow.
pub fn is_plausible(index: Complex64) -> bool {
    (1e-4..=1e4).contains(&index.re) && (0.0..=1e4).contains(&index.im)
}

/// Metres as nanometres for messages: 400 reads better than 400.00000000000006.
fn nanometres(metres: f64) -> String {
    digits(metres * 1e9)
}

/// A number for messages, to 13 digits: rounding does not show, and values that differ do.
fn digits(value: f64) -> String {
    let rounded = to_digits(value, 13);
    match rounded.abs() {
        size if size == 0.0 || (1e-5..1e15).contains(&size) => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two numbers that differ enough to be refused never read alike.
    #[test]
    fn messages_show_the_digits_that_differ() {
        let message = check_range("x", 700.0000001e-9, (300e-9, 700e-9)).unwrap_err().to_string();
        assert_eq!(message, "wavelength 700.0000001 nm is outside the data of x (300 to 700 nm)");
        assert_eq!(nanometres(400e-9), "400");
        assert_eq!(digits(1.5e-9), "1.5e-9");
    }
}
