//! Water whose temperature or salinity changes from centre to surface.
//!
//! Between given values at the centre and at the surface lies the slowest mode of diffusion in a
//! sphere with a fixed surface, `T(r) = T_s + (T_c - T_s) sin(πr)/(πr)`, which a drop that is warmed or
//! cooled from outside reaches after about a²/(π²D) (Carslaw & Jaeger 1959, sec. 9.3). The index at
//! each value is that of the library's water or sea water.

use super::super::{Medium, MediumError};
use super::profile::Smooth;
use crate::math::chebyshev::{self, Chebyshev};

/// What varies.
#[derive(Clone, Debug, PartialEq)]
pub enum Gradient {
    /// Water, kelvin.
    Temperature { centre: f64, surface: f64 },
    /// Sea water, g/kg, at one temperature (kelvin).
    Salinity { centre: f64, surface: f64, temperature: f64 },
}

/// Points of the polynomial for the index by temperature or salinity, which are smooth.
const POINTS: usize = 12;

impl Gradient {
    /// The medium with one value everywhere.
    fn medium(&self, value: f64) -> Medium {
        match self {
            Self::Temperature { .. } => Medium::Water { temperature: value },
            Self::Salinity { temperature, .. } => {
                Medium::SeaWater { temperature: *temperature, salinity: value }
            }
        }
    }

    /// Values at the centre and the surface.
    fn ends(&self) -> (f64, f64) {
        match *self {
            Self::Temperature { centre, surface } | Self::Salinity { centre, surface, .. } => {
                (centre, surface)
            }
        }
    }

    /// Refuses values outside the formulas.
    ///
    /// # Errors
    /// The water's.
    pub fn checked(self) -> Result<Self, MediumError> {
        let (centre, surface) = self.ends();
        self.medium(centre).check_conditions()?;
        self.medium(surface).check_conditions()?;
        Ok(self)
    }

    /// The index along the radius at a wavelength in vacuum, relative to an index outside.
    ///
    /// # Errors
    /// A wavelength outside the data.
    pub fn at(&self, wavelength: f64, outside: f64) -> Result<Smooth, MediumError> {
        let (centre, surface) = self.ends();
        let mut values = Vec::with_capacity(POINTS);
        for share in chebyshev::points(POINTS, 0.0, 1.0) {
            let medium = self.medium(surface + (centre - surface) * share);
            let index = medium.index(wavelength)? / outside;
            values.push([index.re, index.im]);
        }
        Ok(Smooth::Diffused(Chebyshev::fit(&values, 0.0, 1.0)))
    }

    /// Wavelengths in metres that the data cover.
    pub fn valid_range(&self) -> (f64, f64) {
        self.medium(self.ends().1).valid_range()
    }

    /// What it is called.
    pub fn name(&self) -> String {
        let (centre, surface) = self.ends();
        format!(
            "{} at the centre, {} at the surface",
            self.medium(centre).name(),
            self.medium(surface).name()
        )
    }

    /// Where the data are from.
    pub fn source(&self) -> String {
        format!("{}; slowest mode of diffusion in between", self.medium(self.ends().1).source())
    }
}
