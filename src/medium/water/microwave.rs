//! Water's permittivity in the microwave, by temperature.
//!
//! Two published models: a double Debye formula of Liebe, Hufford & Manabe, Int. J. Infrared Millim.
//! Waves 12, 659 (1991), to 1 THz; and Turner, Kneifel & Cadeddu, J. Atmos. Ocean. Technol. 33, 33
//! (2016), fitted to supercooled water too, 0.5 to 500 GHz. `exp(-iωt)`: `ε = ε' + iε''`.

use crate::medium::error::{MediumError, check_range, invalid};
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Wavelengths in metres from which on water is that of the microwave: 1 THz.
pub(in crate::medium) const MICROWAVES: f64 = 2.99e-4;
/// Speed of light, m/s.
const LIGHT: f64 = 299_792_458.0;

/// Wavelength in vacuum (metres) of a frequency in GHz.
pub fn wavelength_of_ghz(ghz: f64) -> f64 {
    LIGHT / (ghz * 1e9)
}

/// A model of the permittivity of liquid water.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MicrowaveWater {
    /// A double Debye formula, -20 to 60 °C, to 1 THz.
    Liebe1991,
    /// Fitted to supercooled water too, -40 to 50 °C, to 500 GHz.
    Turner2016,
}

impl MicrowaveWater {
    /// Both, with their names in the library.
    pub(in crate::medium) const NAMES: [(&'static str, Self); 2] =
        [("water-liebe-1991", Self::Liebe1991), ("water-turner-2016", Self::Turner2016)];

    /// The model of a name in the library.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|entry| entry.0 == name).map(|entry| entry.1)
    }

    /// Its name in the library.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize].0
    }

    /// Publication.
    pub(in crate::medium) fn source(self) -> &'static str {
        match self {
            Self::Liebe1991 => {
                "Liebe, Hufford & Manabe, Int. J. Infrared Millim. Waves 12, 659 (1991)"
            }
            Self::Turner2016 => {
                "Turner, Kneifel & Cadeddu, J. Atmos. Ocean. Technol. 33, 33 (2016)"
            }
        }
    }

    /// Wavelengths in metres: 0.3 GHz (0.5 for the second model) to 1000 and 500 GHz.
    pub(in crate::medium) fn range(self) -> (f64, f64) {
        let (low, high) = match self {
            Self::Liebe1991 => (0.3, 1000.0),
            Self::Turner2016 => (0.5, 500.0),
        };
        (wavelength_of_ghz(high), wavelength_of_ghz(low))
    }

    /// Refuses temperatures (kelvin) beyond the data: -20 to 60 °C, -40 to 50 °C.
    pub(in crate::medium) fn check_temperature(self, kelvin: f64) -> Result<(), MediumError> {
        let (low, high) = match self {
            Self::Liebe1991 => (-20.0, 60.0),
            Self::Turner2016 => (-40.0, 50.0),
        };
        let celsius = kelvin - 273.15;
        if (low - 1e-9..=high + 1e-9).contains(&celsius) {
            return Ok(());
        }
        let accepted = format!("{low} to {high} for {}", self.name());
        Err(invalid("temperature_c", format!("{celsius:.6}"), &accepted))
    }

    /// Index at a wavelength in vacuum (metres) and a temperature (kelvin).
    pub fn index(self, wavelength: f64, kelvin: f64) -> Result<Complex64, MediumError> {
        self.check_temperature(kelvin)?;
        check_range(self.name(), wavelength, self.range())?;
        let hertz = LIGHT / wavelength;
        Ok(match self {
            Self::Liebe1991 => liebe(hertz * 1e-9, kelvin),
            Self::Turner2016 => turner(hertz, kelvin - 273.15),
        }
        .sqrt())
    }
}

/// Two Debye terms with relaxation frequencies in GHz.
fn liebe(ghz: f64, kelvin: f64) -> Complex64 {
    let theta = 1.0 - 300.0 / kelvin;
    let rest = 77.66 - 103.3 * theta;
    let middle = 0.0671 * rest;
    let high = 3.52 + 7.52 * theta;
    let first = 20.2 + 146.4 * theta + 316.0 * theta * theta;
    let second = 39.8 * first;
    let debye = |relaxation: f64| Complex64::new(1.0, -ghz / relaxation).inv();
    high + (middle - high) * debye(second) + (rest - middle) * debye(first)
}

/// Two Debye terms with relaxation times in seconds; degrees Celsius.
fn turner(hertz: f64, celsius: f64) -> Complex64 {
    const TERMS: [[f64; 4]; 2] =
        [[8.111e1, 4.434e-3, 1.302e-13, 6.627e2], [2.025, 1.073e-2, 1.012e-14, 6.089e2]];
    const OFFSET: f64 = 1.342e2;
    let rest = 8.7914e1 + celsius * (-4.0440e-1 + celsius * (9.5873e-4 - celsius * 1.3280e-6));
    TERMS.iter().fold(Complex64::from(rest), |sum, [a, b, c, d]| {
        let strength = a * (-b * celsius).exp();
        let phase = TAU * hertz * c * (d / (celsius + OFFSET)).exp();
        // ε(0) less the part that has not relaxed: -φ²Δ/(1+φ²) + iφΔ/(1+φ²)
        sum + Complex64::new(-phase, 1.0) * (phase * strength / (1.0 + phase * phase))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As computed by epswater.m of C. Mätzler: 60.788633865925306 + 32.7208017094769i.
    #[test]
    fn liebe_at_ten_gigahertz() {
        let index = MicrowaveWater::Liebe1991.index(wavelength_of_ghz(10.0), 293.15).unwrap();
        let known = Complex64::new(8.056804460712645, 2.030631490998273);
        assert!((index - known).norm() < 1e-12, "{index}");
    }

    /// Two fits to the same measurements agree to a few percent, at 0 °C and above.
    #[test]
    fn models_agree_at_radar_bands() {
        for ghz in [2.8, 5.6, 10.0, 13.6, 35.5, 94.0] {
            for kelvin in [273.15, 283.15, 293.15] {
                let wavelength = wavelength_of_ghz(ghz);
                let a = MicrowaveWater::Liebe1991.index(wavelength, kelvin).unwrap();
                let b = MicrowaveWater::Turner2016.index(wavelength, kelvin).unwrap();
                assert!((a - b).norm() < 0.03 * a.norm(), "{ghz} GHz {kelvin} K: {a} {b}");
            }
        }
    }

    #[test]
    fn beyond_the_data_is_an_error() {
        let water = MicrowaveWater::Turner2016;
        assert!(water.index(wavelength_of_ghz(600.0), 293.15).is_err());
        assert!(water.index(wavelength_of_ghz(10.0), 330.0).is_err());
    }
}
