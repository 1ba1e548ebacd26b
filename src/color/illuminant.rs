//! Light sources: relative spectral power by wavelength.

use super::ColorError;
use super::tabulated::Tabulated;
use std::fmt;
use std::str::FromStr;
use std::sync::LazyLock;

static D65: LazyLock<Tabulated<1>> =
    LazyLock::new(|| Tabulated::parse(include_str!("../../data/color/cie_illuminant_D65.csv")));
static A: LazyLock<Tabulated<1>> =
    LazyLock::new(|| Tabulated::parse(include_str!("../../data/color/cie_illuminant_A.csv")));
static DAYLIGHT: LazyLock<Tabulated<3>> = LazyLock::new(|| {
    Tabulated::parse(include_str!("../../data/color/cie_daylight_basis_S0S1S2.csv"))
});
static G173: LazyLock<Tabulated<2>> = LazyLock::new(|| {
    Tabulated::parse(include_str!("../../data/color/astm_g173_03_280_1100nm.csv"))
});

/// A light source. Only the shape of the spectrum matters for colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Illuminant {
    /// The same power per wavelength everywhere.
    EqualEnergy,
    /// CIE standard illuminant D65: noon daylight, sky and sun.
    D65,
    /// CIE standard illuminant A: a tungsten lamp.
    A,
    /// CIE daylight of a correlated colour temperature in kelvin (4000 to 25000).
    Daylight {
        /// Kelvin.
        temperature: f64,
    },
    /// A black body, kelvin.
    BlackBody {
        /// Kelvin.
        temperature: f64,
    },
    /// The sun above the air (ASTM G173, Gueymard 2004).
    Sun,
    /// The sun's direct light on the ground at air mass 1.5 (ASTM G173).
    SunGround,
    /// The sun above the air, dimmed by Rayleigh scattering in clean air; elevation in radians.
    SunThroughAir {
        /// Above the horizon, radians.
        elevation: f64,
    },
}

impl Illuminant {
    /// Relative spectral power at a wavelength in vacuum (metres).
    pub fn power(&self, wavelength: f64) -> f64 {
        match *self {
            Illuminant::EqualEnergy => 1.0,
            Illuminant::D65 => D65.at(wavelength)[0],
            Illuminant::A => A.at(wavelength)[0],
            Illuminant::Daylight { temperature } => daylight(wavelength, temperature),
            Illuminant::BlackBody { temperature } => black_body(wavelength, temperature),
            Illuminant::Sun => G173.at(wavelength)[0],
            Illuminant::SunGround => G173.at(wavelength)[1],
            Illuminant::SunThroughAir { elevation } => {
                G173.at(wavelength)[0] * (-rayleigh_depth(wavelength) * air_mass(elevation)).exp()
            }
        }
    }

    /// Range of the data, metres.
    pub fn range(&self) -> (f64, f64) {
        match self {
            Illuminant::EqualEnergy | Illuminant::BlackBody { .. } => (0.0, f64::INFINITY),
            Illuminant::D65 => D65.range(),
            Illuminant::A => A.range(),
            Illuminant::Daylight { .. } => DAYLIGHT.range(),
            Illuminant::Sun | Illuminant::SunGround | Illuminant::SunThroughAir { .. } => {
                G173.range()
            }
        }
    }
}

/// CIE daylight from its chromaticity on the daylight locus (CIE 015:2018, eqs. 4.10 to 4.14).
fn daylight(wavelength: f64, temperature: f64) -> f64 {
    let t = 1e3 / temperature;
    let x = if temperature <= 7000.0 {
        0.244063 + t * (0.09911 + t * (2.9678 - t * 4.6070))
    } else {
        0.237040 + t * (0.24748 + t * (1.9018 - t * 2.0064))
    };
    let y = -3.000 * x * x + 2.870 * x - 0.275;
    let denominator = 0.0241 + 0.2562 * x - 0.7341 * y;
    let m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / denominator;
    let m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / denominator;
    let [s0, s1, s2] = DAYLIGHT.at(wavelength);
    s0 + m1 * s1 + m2 * s2
}

/// Planck's law, scaled to 1 at 560 nm; c₂ = hc/k = 1.438776877e-2 m K (exact SI).
fn black_body(wavelength: f64, temperature: f64) -> f64 {
    const C2: f64 = 1.438_776_877e-2;
    const REFERENCE: f64 = 560e-9;
    let exponent = |w: f64| (C2 / (w * temperature)).exp_m1();
    (REFERENCE / wavelength).powi(5) * exponent(REFERENCE) / exponent(wavelength)
}

/// Rayleigh optical depth of the whole air, vertically, at sea level (Bodhaine et al. 1999,
/// J. Atmos. Oceanic Technol. 16, 1854, eq. 30); wavelength in metres.
fn rayleigh_depth(wavelength: f64) -> f64 {
    let l2 = (wavelength * 1e6).powi(2);
    0.0021520 * (1.0455996 - 341.29061 / l2 - 0.90230850 * l2)
        / (1.0 + 0.0027059889 / l2 - 85.968563 * l2)
}

/// Relative air mass (Kasten & Young 1989, Appl. Opt. 28, 4735); elevation in radians, 0 and up.
fn air_mass(elevation: f64) -> f64 {
    let degrees = elevation.to_degrees();
    1.0 / (elevation.sin() + 0.50572 * (degrees + 6.07995).powf(-1.6364))
}

impl FromStr for Illuminant {
    type Err = ColorError;

    /// `D65`, `A`, `E`, `D50` (any daylight), `5778K`, `sun`, `sun-ground`, `sun@10`.
    fn from_str(text: &str) -> Result<Self, ColorError> {
        let unknown = || ColorError::UnknownIlluminant(text.to_owned());
        let number = |text: &str| text.parse::<f64>().ok().filter(|n| n.is_finite());
        match text {
            "D65" | "d65" => return Ok(Illuminant::D65),
            "A" | "a" => return Ok(Illuminant::A),
            "E" | "e" => return Ok(Illuminant::EqualEnergy),
            "sun" => return Ok(Illuminant::Sun),
            "sun-ground" => return Ok(Illuminant::SunGround),
            _ => {}
        }
        if let Some(degrees) = text.strip_prefix("sun@").and_then(number) {
            return (0.0..=90.0)
                .contains(&degrees)
                .then(|| Illuminant::SunThroughAir { elevation: degrees.to_radians() })
                .ok_or_else(unknown);
        }
        if let Some(kelvin) = text.strip_suffix(['K', 'k']).and_then(number) {
            return (500.0..=1e5)
                .contains(&kelvin)
                .then_some(Illuminant::BlackBody { temperature: kelvin })
                .ok_or_else(unknown);
        }
        if let Some(hundreds) = text.strip_prefix(['D', 'd']).and_then(number) {
            // The nominal temperature times 1.4388/1.4380, as CIE 015:2018 defines D50, D55, D75.
            let temperature = 100.0 * hundreds * 1.4388 / 1.4380;
            return (4000.0..=25000.0)
                .contains(&temperature)
                .then_some(Illuminant::Daylight { temperature })
                .ok_or_else(unknown);
        }
        Err(unknown())
    }
}

impl fmt::Display for Illuminant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Illuminant::EqualEnergy => write!(f, "E"),
            Illuminant::D65 => write!(f, "D65"),
            Illuminant::A => write!(f, "A"),
            Illuminant::Daylight { temperature } => {
                write!(f, "D{:.0}", temperature / 100.0 * 1.4380 / 1.4388)
            }
            Illuminant::BlackBody { temperature } => write!(f, "{temperature:.0}K"),
            Illuminant::Sun => write!(f, "sun"),
            Illuminant::SunGround => write!(f, "sun-ground"),
            Illuminant::SunThroughAir { elevation } => {
                write!(f, "sun@{:.2}", elevation.to_degrees())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bodhaine et al. 1999: optical depths at sea level.
    #[test]
    fn rayleigh_depth_is_the_published_one() {
        for (um, depth) in
            [(0.4, 0.36021341583806155), (0.55, 0.09706523794391267), (0.7, 0.03642090759130128)]
        {
            approx::assert_relative_eq!(rayleigh_depth(um * 1e-6), depth, max_relative = 1e-12);
        }
    }

    /// Kasten & Young 1989, table: 1 at the zenith (0.9997 in their fit), about 38 at the horizon.
    #[test]
    fn air_mass_runs_from_one_to_thirty_eight() {
        assert!((air_mass(90f64.to_radians()) - 0.9997).abs() < 1e-4);
        assert!((air_mass(0.0) - 37.92).abs() < 0.01);
    }

    /// The shipped D65 is the daylight formula at 6504 K rounded; it must come out of the basis.
    #[test]
    fn daylight_formula_gives_the_tabulated_d65() {
        let d65 = Illuminant::Daylight { temperature: 6500.0 * 1.4388 / 1.4380 };
        let scale = 100.0 / d65.power(560e-9);
        for nm in (380..=780).step_by(5) {
            let w = nm as f64 * 1e-9;
            assert!((d65.power(w) * scale - Illuminant::D65.power(w)).abs() < 0.05, "{nm} nm");
        }
    }
}
