//! How raindrops are shaped, by their size.
//!
//! Real shapes of [`crate::shape`], or spheroids whose axis ratio follows a published law of the diameter of
//! the sphere of equal volume.

use crate::shape::{RaindropModel, Shape, ShapeError};

/// Shape by size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DropShape {
    /// Spheres.
    Sphere,
    /// Spheroids of one vertical over horizontal axis ratio.
    Spheroid(f64),
    /// Spheroids of an axis ratio that depends on the size.
    SpheroidBy(AxisRatioLaw),
    /// Falling drops, spheres below where the model begins.
    Raindrop(RaindropModel),
}

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

impl AxisRatioLaw {
    /// All of them, with their names.
    pub const NAMES: [(&'static str, Self); 4] = [
        ("thurai-2007", Self::Thurai2007),
        ("beard-chuang-1987", Self::BeardChuang1987),
        ("brandes-2002", Self::Brandes2002),
        ("pruppacher-beard-1970", Self::PruppacherBeard1970),
    ];

    /// The axis ratio of a diameter (metres), at most 1.
    pub fn axis_ratio(self, diameter: f64) -> f64 {
        let d = diameter * 1e3;
        let polynomial = |c: &[f64]| c.iter().rev().fold(0.0, |sum, c| sum * d + c);
        let ratio = match self {
            Self::Thurai2007 if d < 0.7 => 1.0,
            Self::Thurai2007 if d < 1.5 => polynomial(&[1.173, -0.5165, 0.4698, -0.1317, -8.5e-3]),
            Self::Thurai2007 => polynomial(&[1.065, -6.25e-2, -3.99e-3, 7.66e-4, -4.095e-5]),
            Self::BeardChuang1987 => polynomial(&[1.0048, 5.7e-4, -2.628e-2, 3.682e-3, -1.677e-4]),
            Self::Brandes2002 => polynomial(&[0.9951, 0.0251, -0.03644, 0.005303, -0.0002492]),
            Self::PruppacherBeard1970 => polynomial(&[1.03, -0.062]),
        };
        ratio.min(1.0)
    }

    /// Diameters (metres) at which the law has a kink.
    fn kinks(self) -> &'static [f64] {
        match self {
            Self::Thurai2007 => &[0.7e-3, 1.5e-3],
            _ => &[],
        }
    }
}

impl DropShape {
    /// The shape of a drop of a diameter (metres) of equal volume, its axis vertical.
    ///
    /// # Errors
    /// A diameter outside the model, or an axis ratio outside what is accepted.
    pub fn at(self, diameter: f64) -> Result<Shape, ShapeError> {
        match self {
            Self::Sphere => Ok(Shape::sphere()),
            Self::Spheroid(ratio) => Shape::spheroid(ratio, 0.0),
            Self::SpheroidBy(law) => Shape::spheroid(law.axis_ratio(diameter), 0.0),
            Self::Raindrop(model) if 0.5 * diameter < model.radius_range().0 => Ok(Shape::sphere()),
            Self::Raindrop(model) => Shape::raindrop(0.5 * diameter, model, 0.0),
        }
    }

    /// The largest diameter (metres) that there is.
    pub fn largest(self) -> f64 {
        match self {
            Self::Raindrop(model) => 2.0 * model.radius_range().1,
            _ => 8e-3,
        }
    }

    /// Diameters (metres) between which the shape changes smoothly.
    pub(super) fn kinks(self) -> Vec<f64> {
        match self {
            Self::SpheroidBy(law) => law.kinks().to_vec(),
            // tables of coefficients, every millimetre or half of one
            Self::Raindrop(_) => (1..=18).map(|k| f64::from(k) * 0.5e-3).chain([0.8e-3]).collect(),
            _ => Vec::new(),
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
            (AxisRatioLaw::Thurai2007, 3.0, 0.8591),
            (AxisRatioLaw::BeardChuang1987, 4.0, 0.7793),
            (AxisRatioLaw::BeardChuang1987, 6.0, 0.6401),
            (AxisRatioLaw::PruppacherBeard1970, 5.0, 0.72),
            (AxisRatioLaw::Brandes2002, 2.0, 0.938),
        ] {
            let found = law.axis_ratio(millimetres * 1e-3);
            assert!((found - known).abs() < 1e-3, "{law:?} {millimetres} mm: {found} {known}");
        }
        // where the pieces meet they do so as printed: within 0.006 of each other
        for d in AxisRatioLaw::Thurai2007.kinks() {
            let step = |d: f64| AxisRatioLaw::Thurai2007.axis_ratio(d);
            assert!((step(d * (1.0 + 1e-9)) - step(d * (1.0 - 1e-9))).abs() < 6e-3);
        }
    }

    #[test]
    fn small_drops_are_spheres_and_large_ones_are_refused() {
        let shape = DropShape::Raindrop(RaindropModel::BeardChuang1987);
        assert!(shape.at(0.3e-3).unwrap().is_sphere() && !shape.at(3e-3).unwrap().is_sphere());
        assert!(shape.at(9e-3).is_err());
    }
}
