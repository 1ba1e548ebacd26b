//! What is asked with: drops, water, bands and numbers, and words for what is not accepted.
//!
//! The program and the Python package both read what users give by this, so that both refuse the same, in the same words.

use super::drop_shape::DropShape;
use super::rain::RadarError;
use super::spectrum::DropSpectrum;
use crate::fault::{Blame, Fault};
use crate::medium::{MediumError, MicrowaveWater, wavelength_of_ghz};
use crate::shape::AxisRatioLaw;
use num_complex::Complex64;

/// A radar band: its letters and the frequency that stands for it, GHz.
pub const BANDS: [(&str, f64); 6] =
    [("S", 2.8), ("C", 5.6), ("X", 9.4), ("Ku", 13.6), ("Ka", 35.5), ("W", 94.0)];

/// What drops are made of.
#[derive(Clone, Debug, PartialEq)]
pub enum Water {
    /// One index at all wavelengths.
    Index(Complex64),
    /// Water after a model at temperatures in °C.
    Celsius(MicrowaveWater, Vec<f64>),
}

/// What drops there are; diameters in metres, of spheres of equal volume.
#[derive(Clone, Debug, PartialEq)]
pub enum Drops {
    /// Of each diameter by itself, a row each.
    Each {
        /// Diameters.
        diameters: Vec<f64>,
        /// Drops per m³ of each.
        number_per_m3: f64,
    },
    /// Diameters and drops per m³ that are seen together.
    Together(Vec<(f64, f64)>),
    /// A spectrum between two diameters.
    Spectrum(DropSpectrum, (f64, f64)),
}

/// Why nothing is seen.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum ObservationError {
    #[error("{field} = {value}: {accepted}")]
    Value { field: &'static str, value: String, accepted: String },
    #[error(transparent)]
    Medium(#[from] MediumError),
    #[error(transparent)]
    Rain(#[from] RadarError),
}

impl Blame for ObservationError {
    fn fault(&self) -> Fault {
        match self {
            ObservationError::Value { .. } | ObservationError::Medium(_) => Fault::Input,
            ObservationError::Rain(error) => error.fault(),
        }
    }
}

/// Numbers that are asked with, in the units of their names, and what is accepted.
const NUMBERS: [(&str, (f64, f64), &str); 8] = [
    ("wavelength_mm", (1e-3, 1e4), "1e-3 to 1e4 is accepted"),
    ("canting_deg", (0.0, 90.0), "0 to 90 is accepted"),
    ("elevation_deg", (-90.0, 90.0), "-90 to 90 is accepted"),
    ("k_squared", (1e-3, 1.0), "1e-3 to 1 is accepted"),
    ("tolerance", (1e-8, 0.5), "1e-8 to 0.5 is accepted"),
    ("number_per_m3", (1e-12, 1e12), "1e-12 to 1e12 is accepted"),
    ("marshall_palmer_mm_h", (1e-3, 1e3), "1e-3 to 1000 mm/h is accepted"),
    ("mu", (-3.0, 30.0), "a shape μ of -3 to 30 is accepted"),
];

/// Where spectra begin, diameter in mm.
const SMALLEST_MM: f64 = 0.05;

pub(super) fn refused(
    field: &'static str,
    value: impl ToString,
    accepted: &str,
) -> ObservationError {
    ObservationError::Value { field, value: value.to_string(), accepted: accepted.into() }
}

/// A number that is asked with, by its name with unit: `canting_deg`, `elevation_deg`, `k_squared`, `tolerance`,
/// `number_per_m3`, `marshall_palmer_mm_h`, `mu`, `wavelength_mm`.
///
/// # Errors
/// One outside what is accepted.
pub fn number(name: &'static str, value: f64) -> Result<f64, ObservationError> {
    match NUMBERS.iter().find(|(known, _, _)| *known == name) {
        Some((_, (low, high), accepted)) if !(*low..=*high).contains(&value) => {
            Err(refused(name, value, accepted))
        }
        _ => Ok(value),
    }
}

/// The wavelength (metres) of a band by its letters.
///
/// # Errors
/// Letters of no band.
pub fn band(letters: &str) -> Result<f64, ObservationError> {
    let known = BANDS.iter().find(|(name, _)| name.eq_ignore_ascii_case(letters.trim()));
    known.map(|(_, ghz)| wavelength_of_ghz(*ghz)).ok_or_else(|| {
        let names: Vec<&str> = BANDS.iter().map(|(name, _)| *name).collect();
        refused("band", letters, &format!("{} are accepted", names.join(", ")))
    })
}

impl DropShape {
    /// Spheroids of an axis ratio (a number), or of a law of raindrops by its name.
    ///
    /// # Errors
    /// A ratio that no spheroid has, or no known law.
    pub fn spheroid(ratio_or_law: &str) -> Result<Self, ObservationError> {
        let law = AxisRatioLaw::NAMES.iter().find(|(name, _)| *name == ratio_or_law);
        match (ratio_or_law.parse::<f64>(), law) {
            (Ok(ratio), _) => {
                let shape = Self::Spheroid(ratio);
                shape.at(1e-3).map_err(RadarError::from)?;
                Ok(shape)
            }
            (_, Some((_, law))) => Ok(Self::SpheroidBy(*law)),
            _ => {
                let names: Vec<&str> = AxisRatioLaw::NAMES.iter().map(|(name, _)| *name).collect();
                let accepted = format!("a number, {} are accepted", names.join(", "));
                Err(refused("axis_ratio", ratio_or_law, &accepted))
            }
        }
    }
}

impl Drops {
    /// A spectrum between two diameters in mm: 0.05 and the largest that the shape has, unless said.
    ///
    /// # Errors
    /// Diameters that do not ascend, or are no drops'.
    pub fn spectrum(
        spectrum: DropSpectrum,
        from_mm: Option<f64>,
        to_mm: Option<f64>,
        shape: DropShape,
    ) -> Result<Self, ObservationError> {
        let from = from_mm.unwrap_or(SMALLEST_MM);
        let to = to_mm.unwrap_or(shape.largest() * 1e3);
        if !(from >= 0.0 && to > from && to <= 20.0) {
            let both = format!("{from}, to_diameter_mm = {to}");
            let accepted = "two ascending diameters of 0 to 20 mm are accepted";
            return Err(refused("from_diameter_mm", both, accepted));
        }
        Ok(Self::Spectrum(spectrum, (from * 1e-3, to * 1e-3)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_name_what_is_accepted() {
        assert!(band("Q").unwrap_err().to_string().contains("S, C, X, Ku, Ka, W"));
        assert!(number("canting_deg", 91.0).unwrap_err().to_string().contains("0 to 90"));
        assert!(DropShape::spheroid("flat").unwrap_err().to_string().contains("thurai-2007"));
        let rain = DropSpectrum::marshall_palmer(1.0);
        let wrong = Drops::spectrum(rain, Some(3.0), Some(2.0), DropShape::Sphere).unwrap_err();
        assert!(wrong.to_string().starts_with("from_diameter_mm = 3, to_diameter_mm = 2: two"));
    }
}
