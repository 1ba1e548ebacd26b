//! How raindrops are shaped, by their size.
//!
//! Real shapes of [`crate::shape`], or spheroids whose axis ratio follows a published law of the diameter of
//! the sphere of equal volume.

use crate::shape::{AxisRatioLaw, RaindropModel, Shape, ShapeError};

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

    #[test]
    fn small_drops_are_spheres_and_large_ones_are_refused() {
        let shape = DropShape::Raindrop(RaindropModel::BeardChuang1987);
        assert!(shape.at(0.3e-3).unwrap().is_sphere() && !shape.at(3e-3).unwrap().is_sphere());
        assert!(shape.at(9e-3).is_err());
    }
}
