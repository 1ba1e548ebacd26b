//! Standard observers: the CIE 2° colour-matching functions.

use super::ColorError;
use super::tabulated::Tabulated;
use std::str::FromStr;
use std::sync::LazyLock;

static CIE_1931: LazyLock<Tabulated<3>> =
    LazyLock::new(|| Tabulated::parse(include_str!("../../data/color/cie1931_2deg_1nm.csv")));
static CIE_2015: LazyLock<Tabulated<3>> =
    LazyLock::new(|| Tabulated::parse(include_str!("../../data/color/cie2015_2deg_1nm.csv")));

/// Whose eyes look.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Observer {
    /// CIE 1931 2° standard observer, 360–830 nm.
    #[default]
    Cie1931,
    /// CIE 170-2:2015 2° observer from cone fundamentals, 390–830 nm.
    Cie2015,
}

impl Observer {
    fn table(self) -> &'static Tabulated<3> {
        match self {
            Observer::Cie1931 => &CIE_1931,
            Observer::Cie2015 => &CIE_2015,
        }
    }

    /// `x̄ ȳ z̄` at a wavelength (metres); zero outside the tabulated range.
    pub fn matching(self, wavelength: f64) -> [f64; 3] {
        let (from, to) = self.range();
        if wavelength < from - 1e-15 || wavelength > to + 1e-15 {
            return [0.0; 3];
        }
        self.table().at(wavelength)
    }

    /// First and last tabulated wavelength, metres.
    pub fn range(self) -> (f64, f64) {
        self.table().range()
    }
}

impl FromStr for Observer {
    type Err = ColorError;
    fn from_str(text: &str) -> Result<Self, ColorError> {
        match text {
            "1931" => Ok(Observer::Cie1931),
            "2015" => Ok(Observer::Cie2015),
            _ => Err(ColorError::UnknownObserver(text.to_owned())),
        }
    }
}
