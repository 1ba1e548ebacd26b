//! The spheroid of equal volume: `F = ½ [(q - ζ²)/h² + ζ²/v² - 1]`, half axes h (horizontal, twice)
//! and v (vertical) with `h² v = 1`.

use super::{Level, ShapeError, Slope};
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
