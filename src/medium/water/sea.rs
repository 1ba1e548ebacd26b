//! Sea water: Quan & Fry, Appl. Opt. 34, 3477 (1995), for 0 to 30 °C, 0 to 35 g/kg, 400 to 700 nm.
//!
//! The formula's index and wavelength are relative to air; both are brought to vacuum with Ciddor's
//! air at 15 °C, so that it can be compared with pure water. Its k is that of pure water: salts
//! hardly absorb in the visible, dissolved matter and algae are not part of it.

use crate::medium::dispersion::formula::Formula;
use crate::medium::error::{MediumError, check_range, invalid};
use crate::medium::water::absorption;
use num_complex::Complex64;

/// Wavelengths of the formula, metres.
pub(in crate::medium) const RANGE: (f64, f64) = (400e-9, 700e-9);

/// Source of the data, for the record.
pub(in crate::medium) const SOURCE: &str = "n: X. Quan & E. S. Fry, Appl. Opt. 34, 3477 (1995), brought from \
    air to vacuum with P. E. Ciddor, Appl. Opt. 35, 1566 (1996); k: that of pure water (Pope & Fry, \
    Appl. Opt. 36, 8710, 1997)";

/// Index relative to vacuum; wavelength in metres, temperature in kelvin, salinity in g/kg.
pub(in crate::medium) fn index(
    wavelength: f64,
    temperature: f64,
    salinity: f64,
) -> Result<Complex64, MediumError> {
    check_conditions(temperature, salinity)?;
    check_range("sea water", wavelength, RANGE)?;
    let air = air(wavelength * 1e6)?;
    let n = air * relative_to_air(wavelength * 1e9 / air, temperature - 273.15, salinity);
    Ok(Complex64::new(n, absorption::extinction(wavelength)))
}

/// Refuses temperatures (kelvin) and salinities (g/kg) outside the formula.
pub(in crate::medium) fn check_conditions(
    temperature: f64,
    salinity: f64,
) -> Result<(), MediumError> {
    let celsius = temperature - 273.15;
    let slack = 1e-9;
    if !(-slack..=30.0 + slack).contains(&celsius) {
        let value = format!("{celsius:.6}");
        return Err(invalid("temperature_c", value, "0 to 30 for sea water"));
    }
    if !(0.0..=35.0).contains(&salinity) {
        return Err(invalid("salinity_g_kg", salinity, "0 to 35"));
    }
    Ok(())
}

/// The formula: wavelength in nm, temperature in °C, salinity in g/kg.
fn relative_to_air(nm: f64, t: f64, s: f64) -> f64 {
    const N: [f64; 10] = [
        1.31405, 1.779e-4, -1.05e-6, 1.6e-8, -2.02e-6, 15.868, 0.01155, -0.00423, -4382.0, 1.1455e6,
    ];
    N[0] + (N[1] + N[2] * t + N[3] * t * t) * s
        + N[4] * t * t
        + (N[5] + N[6] * s + N[7] * t) / nm
        + N[8] / (nm * nm)
        + N[9] / (nm * nm * nm)
}

/// Index of air at 15 °C and 1 atm, wavelength in µm (Ciddor 1996).
fn air(um: f64) -> Result<f64, MediumError> {
    let formula = Formula::new(6, vec![0.0, 0.05792105, 238.0185, 0.00167917, 57.362])?;
    Ok(formula.index(um))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of the formula by an independent evaluation.
    #[test]
    fn formula_as_published() {
        for (nm, t, s, n) in [
            (589.3, 20.0, 0.0, 1.3330044342769518),
            (589.3, 20.0, 35.0, 1.3394059176470519),
            (400.0, 20.0, 35.0, 1.3499375625),
            (700.0, 20.0, 35.0, 1.3364795072886297),
        ] {
            assert!((relative_to_air(nm, t, s) - n).abs() < 1e-14);
        }
    }
}
