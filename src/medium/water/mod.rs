//! Water: the IAPWS R9-97 formulation of the refractive index (Harvey, Gallagher & Levelt Sengers,
//! J. Phys. Chem. Ref. Data 27, 761, 1998), and the density of the liquid at 1 atm.
//!
//! The index is relative to vacuum. The formulation holds for -12 to 500 °C, up to 1060 kg/m³ and
//! 0.2 to 1.1 µm; its authors allow its use up to 1.9 µm.

mod absorption;
pub(super) mod daimon;
pub(super) mod microwave;
pub(super) mod sea;

use crate::medium::error::{MediumError, check_range, invalid};
use microwave::{MICROWAVES, MicrowaveWater};
use num_complex::Complex64;

/// Wavelengths the formulation may be used at, metres.
pub(in crate::medium) const RANGE: (f64, f64) = (0.2e-6, 1.9e-6);
/// Temperatures of the liquid at 1 atm, kelvin.
const LIQUID: (f64, f64) = (261.15, 373.15);
/// Temperatures of the formulation, kelvin.
const TEMPERATURES: (f64, f64) = (261.15, 773.15);

/// Source of the data, for the record.
pub(in crate::medium) const SOURCE: &str = "n: IAPWS R9-97 (Harvey, Gallagher & Levelt Sengers, J. Phys. \
    Chem. Ref. Data 27, 761, 1998), density: IAPWS SR6-08; k: Pope & Fry, Appl. Opt. 36, 8710 \
    (1997) from 380 to 700 nm, Segelstein (1981) below 350 and above 720 nm, joined smoothly; below 1 THz: \
    Liebe, Hufford & Manabe (1991)";

/// Index of liquid water at 1 atm; wavelength in metres, temperature in kelvin.
pub(in crate::medium) fn index(
    wavelength: f64,
    temperature: f64,
) -> Result<Complex64, MediumError> {
    check_temperature(temperature, false)?;
    at_density(wavelength, temperature, liquid_density(temperature))
}

/// Index of liquid water at 1 atm by the formula of its wavelength (metres), in the microwave too; temperature
/// in kelvin.
pub(in crate::medium) fn liquid(
    wavelength: f64,
    temperature: f64,
) -> Result<Complex64, MediumError> {
    if wavelength >= MICROWAVES {
        return MicrowaveWater::Liebe1991.index(wavelength, temperature);
    }
    index(wavelength, temperature)
}

/// Index of water or steam of any density in kg/m³. k is that of the liquid, scaled by density.
pub(in crate::medium) fn at_density(
    wavelength: f64,
    temperature: f64,
    density: f64,
) -> Result<Complex64, MediumError> {
    check_temperature(temperature, true)?;
    check_density(density)?;
    check_range("water", wavelength, RANGE)?;
    let n = iapws97(wavelength * 1e6, temperature, density);
    // The k data are for the liquid near 22 °C.
    let k = absorption::extinction(wavelength) * density / liquid_density(295.15);
    Ok(Complex64::new(n, k))
}

/// Refuses temperatures at which there is no data: of the liquid at 1 atm, or of the formulation.
pub(in crate::medium) fn check_temperature(
    temperature: f64,
    any_density: bool,
) -> Result<(), MediumError> {
    let (from, to) = if any_density { TEMPERATURES } else { LIQUID };
    if (from..=to).contains(&temperature) {
        return Ok(());
    }
    let range = format!("{:.0} to {:.0}", from - 273.15, to - 273.15);
    let accepted = if any_density { range } else { format!("{range} (the liquid at 1 atm)") };
    let value = format!("{:.6}", temperature - 273.15);
    Err(invalid("temperature_c", value, &accepted))
}

/// Refuses densities (kg/m³) outside the formulation.
pub(in crate::medium) fn check_density(density: f64) -> Result<(), MediumError> {
    if (0.0..=1060.0).contains(&density) {
        return Ok(());
    }
    Err(invalid("density_kg_m3", density, "0 to 1060"))
}

/// Density of liquid water at 1 atm in kg/m³, temperature in kelvin (253 to 383 K).
///
/// IAPWS SR6-08(2011), properties of liquid water at 0.1 MPa, eqs. 2 and 4: the volume there, and
/// its slope with pressure for the step to 1 atm.
pub(in crate::medium) fn liquid_density(temperature: f64) -> f64 {
    const GAS_CONSTANT: f64 = 461.51805;
    const REFERENCE: f64 = 10.0;
    const PRESSURE: f64 = 1e5;
    const ATMOSPHERE: f64 = 101_325.0;
    const VOLUME_A: [(f64, i32); 6] = [
        (1.93763157e-2, 0),
        (6.74458446e3, 4),
        (-2.22521604e5, 5),
        (1.00231247e8, 7),
        (-1.63552118e9, 8),
        (8.32299658e9, 9),
    ];
    const VOLUME_B: [(f64, i32); 6] = [
        (5.78545292e-3, 1),
        (-1.53195665e-2, 2),
        (3.11337859e-2, 3),
        (-4.23546241e-2, 4),
        (3.38713507e-2, 5),
        (-1.19946761e-2, 6),
    ];
    const SLOPE_A: [(f64, i32); 5] = [
        (-7.5245878e-6, 1),
        (-1.3767418e-2, 3),
        (1.0627293e1, 5),
        (-2.0457795e2, 6),
        (1.2037414e3, 7),
    ];
    const SLOPE_B: [(f64, i32); 7] = [
        (-3.1091470e-6, 1),
        (2.8964919e-5, 3),
        (-1.3112763e-4, 4),
        (3.0410453e-4, 5),
        (-3.9034594e-4, 6),
        (2.3403117e-4, 7),
        (-4.8510101e-5, 9),
    ];
    let alpha = REFERENCE / (593.0 - temperature);
    let beta = REFERENCE / (temperature - 232.0);
    let sum = |terms: &[(f64, i32)], x: f64| -> f64 {
        terms.iter().map(|&(c, power)| c * x.powi(power)).sum()
    };
    let scale = GAS_CONSTANT * REFERENCE / PRESSURE;
    let volume = scale * (sum(&VOLUME_A, alpha) + sum(&VOLUME_B, beta));
    let slope = scale / PRESSURE * (sum(&SLOPE_A, alpha) + sum(&SLOPE_B, beta));
    1.0 / (volume + slope * (ATMOSPHERE - PRESSURE))
}

/// The formula itself: wavelength in µm, temperature in K, density in kg/m³.
fn iapws97(um: f64, temperature: f64, density: f64) -> f64 {
    const A: [f64; 8] = [
        0.244257733,
        9.74634476e-3,
        -3.73234996e-3,
        2.68678472e-4,
        1.58920570e-3,
        2.45934259e-3,
        0.900704920,
        -1.66626219e-2,
    ];
    const ULTRAVIOLET: f64 = 0.2292020;
    const INFRARED: f64 = 5.432937;
    let (r, t, l2) = (density / 1000.0, temperature / 273.15, (um / 0.589).powi(2));
    let polarisability = A[0]
        + A[1] * r
        + A[2] * t
        + A[3] * l2 * t
        + A[4] / l2
        + A[5] / (l2 - ULTRAVIOLET * ULTRAVIOLET)
        + A[6] / (l2 - INFRARED * INFRARED)
        + A[7] * r * r;
    let q = polarisability * r;
    ((1.0 + 2.0 * q) / (1.0 - q)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Densities of liquid water at 1 atm by IAPWS-95 (0, 10, 20, 25, 30 °C).
    #[test]
    fn density_agrees_with_iapws95() {
        let table = [
            (273.15, 999.84309),
            (283.15, 999.70247),
            (293.15, 998.20715),
            (298.15, 997.04764),
            (303.15, 995.64945),
        ];
        for (temperature, density) in table {
            let found = liquid_density(temperature);
            assert!((found - density).abs() < 1e-4, "{temperature} K: {found}, not {density}");
        }
    }
}
