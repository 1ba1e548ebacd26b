//! Water whose temperature or salinity changes from centre to surface.
//!
//! Between given values at the centre and at the surface lies the slowest mode of diffusion in a
//! sphere with a fixed surface, `T(r) = T_s + (T_c - T_s) sin(πr)/(πr)`, which a drop that is warmed or
//! cooled from outside reaches after about a²/(π²D) (Carslaw & Jaeger 1959, sec. 9.3). The index at
//! each value is that of the library's water or sea water.

use super::profile::Smooth;
use crate::math::chebyshev::{self, Chebyshev};
use crate::medium::error::MediumError;
use crate::medium::water::{self, sea};
use num_complex::Complex64;

/// What varies.
#[derive(Clone, Debug, PartialEq)]
pub enum Gradient {
    /// Temperature of water.
    Temperature {
        /// Kelvin.
        centre: f64,
        /// Kelvin.
        surface: f64,
    },
    /// Salinity of sea water of one temperature.
    Salinity {
        /// g/kg.
        centre: f64,
        /// g/kg.
        surface: f64,
        /// Kelvin.
        temperature: f64,
    },
}

/// Points of the polynomial for the index by temperature or salinity, which are smooth.
const POINTS: usize = 12;

impl Gradient {
    /// The index where the temperature or the salinity has a value.
    fn index(&self, wavelength: f64, value: f64) -> Result<Complex64, MediumError> {
        match *self {
            Self::Temperature { .. } => water::liquid(wavelength, value),
            Self::Salinity { temperature, .. } => sea::index(wavelength, temperature, value),
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
        for value in [centre, surface] {
            match self {
                Self::Temperature { .. } => water::check_temperature(value, false)?,
                Self::Salinity { temperature, .. } => sea::check_conditions(temperature, value)?,
            }
        }
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
            let index = self.index(wavelength, surface + (centre - surface) * share)? / outside;
            values.push([index.re, index.im]);
        }
        Ok(Smooth::Diffused(Chebyshev::fit(&values, 0.0, 1.0)))
    }

    /// Wavelengths in metres that the data cover.
    pub fn valid_range(&self) -> (f64, f64) {
        match self {
            Self::Temperature { .. } => water::RANGE,
            Self::Salinity { .. } => sea::RANGE,
        }
    }

    /// What it is called.
    pub fn name(&self) -> String {
        let celsius = |kelvin: f64| format!("{:.2} °C", kelvin - 273.15);
        match *self {
            Self::Temperature { centre, surface } => format!(
                "water of {} at the centre, {} at the surface",
                celsius(centre),
                celsius(surface)
            ),
            Self::Salinity { centre, surface, temperature } => format!(
                "sea water at {}, {centre} g/kg at the centre, {surface} g/kg at the surface",
                celsius(temperature)
            ),
        }
    }

    /// Where the data are from.
    pub fn source(&self) -> String {
        let water = match self {
            Self::Temperature { .. } => water::SOURCE,
            Self::Salinity { .. } => sea::SOURCE,
        };
        format!("{water}; slowest mode of diffusion in between")
    }
}

#[cfg(test)]
mod tests {
    use super::super::profile::diffused;
    use super::*;

    /// Centre and surface have the index of their water; in between the mode of diffusion.
    #[test]
    fn the_index_is_that_of_the_water_there() {
        let gradient = Gradient::Temperature { centre: 278.15, surface: 293.15 }.checked().unwrap();
        let smooth = gradient.at(550e-9, 1.0).unwrap();
        for r in [0.0, 0.3, 0.71, 1.0] {
            let there = water::liquid(550e-9, 293.15 - 15.0 * diffused(r)).unwrap();
            assert!((smooth.index(r) - there).norm() < 1e-9, "{r}");
        }
        assert!(Gradient::Temperature { centre: 700.0, surface: 293.15 }.checked().is_err());
    }
}
