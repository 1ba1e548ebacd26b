//! Liquid water: the IAPWS R9-97 formulation of the refractive index (Harvey, Gallagher &
//! Levelt Sengers, J. Phys. Chem. Ref. Data 27, 761, 1998).

use super::MediumError;
use num_complex::Complex64;

/// Index of liquid water at 1 atm; wavelength in metres, temperature in kelvin.
pub(super) fn index(wavelength: f64, temperature: f64) -> Result<Complex64, MediumError> {
    let um = wavelength * 1e6;
    if !(0.2..=1.9).contains(&um) {
        return Err(MediumError::OutOfRange {
            name: "water".into(),
            wavelength_nm: um * 1e3,
            from_nm: 200.0,
            to_nm: 1900.0,
        });
    }
    let n = iapws97(um, temperature, density(temperature));
    Ok(Complex64::new(n, 0.0))
}

/// Density of liquid water at 1 atm in kg/m³ (Kell 1975), temperature in kelvin.
fn density(temperature: f64) -> f64 {
    let t = temperature - 273.15;
    let numerator = 999.83952
        + t * (16.945176
            + t * (-7.9870401e-3 + t * (-46.170461e-6 + t * (105.56302e-9 - t * 280.54253e-12))));
    numerator / (1.0 + 16.897850e-3 * t)
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
