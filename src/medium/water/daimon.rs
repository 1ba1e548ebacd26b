//! Distilled water after Daimon & Masumura, Appl. Opt. 46, 3811 (2007): four-term Sellmeier
//! formulas at 19.0, 20.0, 21.5 and 24.0 °C, 0.182 to 1.129 µm, relative to vacuum.
//!
//! Between the four temperatures n is interpolated by the parabola through the nearest three.

use crate::medium::data::material::Material;
use crate::medium::error::{MediumError, invalid};
use crate::medium::shipped::catalogue::daimon_materials;
use num_complex::Complex64;

/// Water after Daimon & Masumura at one temperature.
#[derive(Clone, Debug, PartialEq)]
pub struct Daimon {
    temperature: f64,
    /// Three temperatures with their formulas.
    nearest: Vec<(f64, Material)>,
}

impl Daimon {
    /// Temperature in kelvin, from 19 to 24 °C.
    pub fn new(temperature: f64) -> Result<Self, MediumError> {
        let mut nearest = daimon_materials()?;
        let (from, to) = (292.15, 297.15);
        // Degrees Celsius in, kelvin here: the sum may be off in the last bit.
        if !(from - 1e-9..=to + 1e-9).contains(&temperature) {
            return Err(invalid(
                "temperature_c",
                format!("{:.6}", temperature - 273.15),
                "19 to 24 for water-daimon",
            ));
        }
        nearest.sort_by(|a, b| (a.0 - temperature).abs().total_cmp(&(b.0 - temperature).abs()));
        nearest.truncate(3);
        Ok(Self { temperature, nearest })
    }

    /// Index at a wavelength in metres; k is not part of the data and is zero.
    pub fn index(&self, wavelength: f64) -> Result<Complex64, MediumError> {
        let mut sum = Complex64::ZERO;
        for (i, (at, material)) in self.nearest.iter().enumerate() {
            let others = self.nearest.iter().enumerate().filter(|(j, _)| *j != i);
            let weight: f64 =
                others.map(|(_, (other, _))| (self.temperature - other) / (at - other)).product();
            sum += material.index(wavelength)? * weight;
        }
        Ok(sum)
    }

    /// Wavelengths in metres that the formulas cover.
    pub fn range(&self) -> (f64, f64) {
        self.nearest[0].1.range
    }

    /// Temperature in kelvin.
    pub fn temperature(&self) -> f64 {
        self.temperature
    }

    /// Publication.
    pub fn source(&self) -> &str {
        &self.nearest[0].1.source
    }
}
