//! The spheroid of equal volume: `F = ½ [(q - ζ²)/h² + ζ²/v² - 1]`, half axes h (horizontal, twice)
//! and v (vertical) with `h² v = 1`.

use super::error::ShapeError;
use super::level::{Level, Slope};
use crate::math::scalar::Scalar;

/// Inverse squares of the half axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spheroid {
    horizontal: f64,
    vertical: f64,
}

impl Spheroid {
    /// `axis_ratio` is vertical over horizontal diameter, 0.1 to 10.
    pub fn new(axis_ratio: f64) -> Result<Self, ShapeError> {
        if !(0.1..=10.0).contains(&axis_ratio) {
            return Err(ShapeError::AxisRatio(axis_ratio));
        }
        let half_horizontal = axis_ratio.powf(-1.0 / 3.0);
        let half_vertical = half_horizontal * axis_ratio;
        Ok(Self { horizontal: half_horizontal.powi(-2), vertical: half_vertical.powi(-2) })
    }

    pub(super) fn is_sphere(&self) -> bool {
        self.horizontal == 1.0 && self.vertical == 1.0
    }

    pub(super) fn bounding_radius(&self) -> f64 {
        self.horizontal.min(self.vertical).powf(-0.5)
    }

    /// Outline of the shadow in one direction, and where along the light the body is touched: for the
    /// components of the axis along that direction and along the light.
    pub(super) fn outline(&self, along: f64, light: f64) -> (f64, f64) {
        let excess = self.vertical - self.horizontal;
        let bend = self.horizontal + excess * light * light;
        let radius = (self.horizontal * (1.0 + excess * along * along / bend)).powf(-0.5);
        (radius, -excess * light * along * radius / bend)
    }

    pub(super) fn slope<T: Scalar>(&self, q: T, z: T) -> Slope<T> {
        let excess = self.vertical - self.horizontal;
        Slope {
            f: (q * self.horizontal + z * z * excess - 1.0) * 0.5,
            q: T::real(0.5 * self.horizontal),
            z: z * excess,
        }
    }

    pub(super) fn level<T: Scalar>(&self, _q: T, z: T) -> Level<T> {
        let excess = self.vertical - self.horizontal;
        let zero = T::default();
        Level {
            q: T::real(0.5 * self.horizontal),
            z: z * excess,
            qq: zero,
            qz: zero,
            zz: T::real(excess),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::math::vec3::Vec3;
    use crate::shape::Shape;

    /// Half axes, and the radii of curvature at pole and equator: h²/v; v²/h along the meridian, h
    /// around.
    #[test]
    fn half_axes_and_curvatures_are_those_of_the_ellipse() {
        let ratio: f64 = 0.8;
        let (h, v) = (ratio.powf(-1.0 / 3.0), ratio.powf(2.0 / 3.0));
        let shape = Shape::spheroid(ratio, 0.0).unwrap();
        let [pole, equator] = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)];
        let around = Vec3::new(0.0, 0.0, 1.0);
        assert!((shape.radius_towards(1.0, 0.0, 0.0) - v).abs() < 1e-14);
        assert!((shape.radius_towards(0.0, 0.6, 0.8) - h).abs() < 1e-14);
        let radius = |at: Vec3<f64>, along: Vec3<f64>| shape.tangent(at).radius_along(along);
        assert!((radius(pole * v, equator) - h * h / v).abs() < 1e-13);
        assert!((radius(equator * h, pole) - v * v / h).abs() < 1e-13);
        assert!((radius(equator * h, around) - h).abs() < 1e-13);
        assert!((shape.bounding_radius() - h).abs() < 1e-15);
    }
}
