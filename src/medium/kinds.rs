//! The kinds of media: a closed set, one arm and one file each.

use super::data::material::Material;
use super::dispersion::abbe::{Abbe, AbbeLines};
use super::error::{
    MediumError, PLAUSIBLE_INDEX, invalid, is_plausible, nanometres, without_trace,
};
use super::own::OwnMedium;
use super::radial::{Immersed, Radial};
use super::solution::{Host, Solution};
use super::water::daimon::Daimon;
use super::water::microwave::MicrowaveWater;
use super::water::{self, sea};
use num_complex::Complex64;
use std::sync::Arc;

/// A medium, ready to be asked for its index. A closed set: one arm per kind, one file per kind.
#[derive(Clone, Debug, PartialEq)]
pub enum Medium {
    /// The same index at every wavelength.
    Constant(Complex64),
    /// Liquid water after IAPWS R9-97, temperature in kelvin, at 1 atm; k from measured tables; in the
    /// microwave after Liebe, Hufford & Manabe 1991.
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
    /// Liquid water in the microwave.
    MicrowaveWater {
        /// By which formula.
        model: MicrowaveWater,
        /// Kelvin.
        temperature: f64,
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
    Solution(Arc<Solution<Medium>>),
    /// A function of the wavelength.
    Own(OwnMedium),
    /// It varies along the radius of a sphere, and has no one index.
    Radial(Arc<Radial<Medium>>),
    /// Inside another medium: wavelengths are those in it, indices relative to it.
    Immersed(Arc<Immersed<Medium>>),
}

/// What is said where one index is needed of what varies.
const ONE_INDEX: &str = "a medium with one index; this one varies along the radius of a sphere, and serves \
                         where the exact series does (gonio scatter, scenes of spheres, gonio rays)";

impl Medium {
    /// Complex index `n + ik` at a wavelength in vacuum (metres); of what is immersed, the relative index
    /// at a wavelength in the surroundings ([`Self::light`]).
    ///
    /// # Errors
    /// A wavelength outside the data, or a medium that varies along the radius.
    pub fn index(&self, wavelength: f64) -> Result<Complex64, MediumError> {
        let index = self.index_of_data(wavelength)?;
        if is_plausible(index) {
            return Ok(without_trace(index));
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
            Medium::Water { temperature } => water::liquid(wavelength, *temperature),
            Medium::MicrowaveWater { model, temperature } => model.index(wavelength, *temperature),
            Medium::WaterOfDensity { temperature, density } => {
                water::at_density(wavelength, *temperature, *density)
            }
            Medium::SeaWater { temperature, salinity } => {
                sea::index(wavelength, *temperature, *salinity)
            }
            Medium::Daimon(water) => water.index(wavelength),
            Medium::Material(material) => material.index(wavelength),
            Medium::Solution(solution) => solution.index(wavelength),
            Medium::Own(own) => own.index(wavelength),
            Medium::Radial(radial) => Err(invalid("medium", radial.name(), ONE_INDEX)),
            Medium::Immersed(immersed) => immersed.index(wavelength),
        }
    }

    /// Wavelengths in metres that the data cover; a material that extrapolates answers beyond.
    pub fn valid_range(&self) -> (f64, f64) {
        match self {
            Medium::Constant(_) => (0.0, f64::INFINITY),
            Medium::Water { .. } | Medium::WaterOfDensity { .. } => water::RANGE,
            Medium::MicrowaveWater { model, .. } => model.range(),
            Medium::SeaWater { .. } => sea::RANGE,
            Medium::Daimon(water) => water.range(),
            Medium::Material(material) => material.range,
            Medium::Solution(solution) => solution.range(),
            Medium::Own(own) => own.range(),
            Medium::Radial(radial) => radial.valid_range(),
            Medium::Immersed(immersed) => immersed.range(),
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
            Medium::MicrowaveWater { model, temperature } => {
                format!("{} at {}", model.name(), celsius(*temperature))
            }
            Medium::SeaWater { temperature, salinity } => {
                format!("sea water at {}, {salinity} g/kg", celsius(*temperature))
            }
            Medium::Daimon(water) => format!("water-daimon at {}", celsius(water.temperature())),
            Medium::Material(material) => material.name.clone(),
            Medium::Solution(solution) => solution.name(),
            Medium::Own(own) => own.name().into(),
            Medium::Radial(radial) => radial.name(),
            Medium::Immersed(immersed) => immersed.name(),
        }
    }

    /// Where the data are from; says so where a material extrapolates.
    pub fn source(&self) -> String {
        match self {
            Medium::Constant(_) => "given".into(),
            Medium::Water { .. } | Medium::WaterOfDensity { .. } => water::SOURCE.into(),
            Medium::MicrowaveWater { model, .. } => model.source().into(),
            Medium::SeaWater { .. } => sea::SOURCE.into(),
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
            Medium::Radial(radial) => radial.source(),
            Medium::Immersed(immersed) => immersed.source(),
        }
    }

    /// Index and Abbe number, where the data cover the three lines.
    pub fn abbe(&self, lines: AbbeLines) -> Option<Abbe> {
        let mut n = [0.0; 3];
        for (n, um) in n.iter_mut().zip(lines.micrometres()) {
            *n = self.index(um / 1e6).ok()?.re;
        }
        let number = (n[0] - 1.0) / (n[1] - n[2]);
        number.is_finite().then_some(Abbe { index: n[0], number })
    }

    /// What the readers of its files changed or left out, for the user to know.
    pub fn notes(&self) -> Vec<String> {
        match self {
            Medium::Material(material) => {
                material.notes.iter().map(|note| format!("{}: {note}", material.name)).collect()
            }
            Medium::Solution(solution) => solution.notes(),
            Medium::Radial(radial) => radial.notes(),
            Medium::Immersed(immersed) => immersed.notes(),
            _ => Vec::new(),
        }
    }

    /// Refuses temperatures, densities and salinities outside the data.
    pub(super) fn check_conditions(&self) -> Result<(), MediumError> {
        match self {
            Medium::Water { temperature } => water::check_temperature(*temperature, false),
            Medium::WaterOfDensity { temperature, density } => {
                water::check_temperature(*temperature, true)?;
                water::check_density(*density)
            }
            Medium::MicrowaveWater { model, temperature } => model.check_temperature(*temperature),
            Medium::SeaWater { temperature, salinity } => {
                sea::check_conditions(*temperature, *salinity)
            }
            _ => Ok(()),
        }
    }
}

impl Host for Medium {
    fn index(&self, wavelength: f64) -> Result<Complex64, MediumError> {
        self.index(wavelength)
    }

    fn valid_range(&self) -> (f64, f64) {
        self.valid_range()
    }

    fn name(&self) -> String {
        self.name()
    }

    fn source(&self) -> String {
        self.source()
    }

    fn notes(&self) -> Vec<String> {
        self.notes()
    }
}
