//! Axis ratios of falling drops by their size, as published.
//!
//! ```
//! use gonio::shape::AxisRatioLaw;
//! assert!((AxisRatioLaw::Thurai2007.axis_ratio(3e-3) - 0.8591f64).abs() < 1e-3);
//! assert_eq!(AxisRatioLaw::Thurai2007.axis_ratio(0.4e-3), 1.0);
//! ```

/// Vertical over horizontal axis by diameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisRatioLaw {
    /// Thurai, Huang, Bringi, Randeu & Schönhuber, J. Atmos. Ocean. Technol. 24, 1019 (2007).
    Thurai2007,
    /// The polynomial fitted to Beard & Chuang, J. Atmos. Sci. 44, 1509 (1987).
    BeardChuang1987,
    /// Brandes, Zhang & Vivekanandan, J. Appl. Meteorol. 41, 674 (2002).
    Brandes2002,
    /// Pruppacher & Beard, Q. J. R. Meteorol. Soc. 96, 247 (1970): `1.03 - 0.062 D`.
    PruppacherBeard1970,
}

/// Thurai's law begins at 0.7 mm with 0.9944, and its second piece at 1.5 mm 0.003 below the first. Between
/// these diameters (mm) the ratio goes from 1 to the first piece, and from the first to the second.
const TO_SPHERES: (f64, f64) = (0.5, 0.7);
const TO_SECOND: (f64, f64) = (1.4, 1.6);

/// What the law says at 0.7 mm.
const AT_FIRST: f64 = 0.994_438;

/// From 0 to 1 between two places, smoothly.
fn rise(d: f64, (from, to): (f64, f64)) -> f64 {
    let t = ((d - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

impl AxisRatioLaw {
    /// All of them, with their names.
    pub const NAMES: [(&'static str, Self); 4] = [
        ("thurai-2007", Self::Thurai2007),
        ("beard-chuang-1987", Self::BeardChuang1987),
        ("brandes-2002", Self::Brandes2002),
        ("pruppacher-beard-1970", Self::PruppacherBeard1970),
    ];

    /// The axis ratio of a diameter (metres), at most 1; continuous.
    pub fn axis_ratio(self, diameter: f64) -> f64 {
        let d = diameter * 1e3;
        let polynomial = |c: &[f64]| c.iter().rev().fold(0.0, |sum, c| sum * d + c);
        let ratio = match self {
            Self::Thurai2007 => {
                let first = polynomial(&[1.173, -0.5165, 0.4698, -0.1317, -8.5e-3]);
                let second = polynomial(&[1.065, -6.25e-2, -3.99e-3, 7.66e-4, -4.095e-5]);
                let law = first + rise(d, TO_SECOND) * (second - first);
                // at and below 0.7 mm what its first piece says at 0.7 mm
                let held = if d < TO_SPHERES.1 { AT_FIRST } else { law };
                1.0 + rise(d, TO_SPHERES) * (held - 1.0)
            }
            Self::BeardChuang1987 => polynomial(&[1.0048, 5.7e-4, -2.628e-2, 3.682e-3, -1.677e-4]),
            Self::Brandes2002 => polynomial(&[0.9951, 0.0251, -0.03644, 0.005303, -0.0002492]),
            Self::PruppacherBeard1970 => polynomial(&[1.03, -0.062]),
        };
        ratio.min(1.0)
    }

    /// Radius up to which the law has spheres, metres; `None`: that is not said.
    pub fn sphere_up_to(self) -> Option<f64> {
        match self {
            Self::Thurai2007 => Some(0.5e-3 * TO_SPHERES.0),
            _ => None,
        }
    }

    /// Diameters (metres) at which the law has a kink.
    pub fn kinks(self) -> &'static [f64] {
        match self {
            Self::Thurai2007 => &[0.5e-3, 0.7e-3, 1.4e-3, 1.6e-3],
            _ => &[],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Axis ratios as printed beside the laws.
    #[test]
    fn laws_as_published() {
        for (law, millimetres, known) in [
            (AxisRatioLaw::Thurai2007, 0.5, 1.0),
            (AxisRatioLaw::Thurai2007, 0.7, 0.9944),
            (AxisRatioLaw::Thurai2007, 1.0, 0.9861),
            (AxisRatioLaw::Thurai2007, 3.0, 0.8591),
            (AxisRatioLaw::BeardChuang1987, 4.0, 0.7793),
            (AxisRatioLaw::BeardChuang1987, 6.0, 0.6401),
            (AxisRatioLaw::PruppacherBeard1970, 5.0, 0.72),
            (AxisRatioLaw::Brandes2002, 2.0, 0.938),
        ] {
            let found = law.axis_ratio(millimetres * 1e-3);
            assert!((found - known).abs() < 1e-3, "{law:?} {millimetres} mm: {found} {known}");
        }
    }

    /// No law jumps, and none is above 1.
    #[test]
    fn laws_are_continuous() {
        for (name, law) in AxisRatioLaw::NAMES {
            let mut before = law.axis_ratio(0.0);
            for i in 1..8000 {
                let ratio = law.axis_ratio(1e-6 * f64::from(i));
                assert!(
                    (ratio - before).abs() < 2e-4 && ratio <= 1.0,
                    "{name} {i} µm: {before} {ratio}"
                );
                before = ratio;
            }
        }
    }
}
