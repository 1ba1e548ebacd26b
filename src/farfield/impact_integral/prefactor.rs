//! What stands before an integral over impact parameters: amplitude and phase of the principle of stationary
//! phase, undone, with the focal lines passed on the way.

use crate::farfield::deflection::curve::DeflectionCurve;
use crate::farfield::deflection::scattering_plane::Node;
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

/// What stands before the integral, `-i √(x/2π) e^{-iπm/2 ∓ iπ/4}` for `m` focal lines, where one ray
/// leaves. Waves that pass the axis pass a focal line more or less there.
pub(crate) struct Prefactor {
    value: Complex64,
    /// Unwrapped angle of the ray.
    pub angle: f64,
    /// Sign of its impact.
    pub sense: f64,
}

impl Prefactor {
    /// For the rays from one launch point to another nearby, without a fold between.
    pub(crate) fn between(
        curve: &DeflectionCurve,
        [from, to]: [f64; 2],
        size_parameter: f64,
    ) -> Option<Self> {
        let (first, ahead) = (curve.ray_at(from)?, curve.ray_at(to)?);
        let impact = |node: &Node| node.exit.reference.dot(curve.plane().frame(node.angle).1);
        let turn = ((ahead.angle - first.angle) * (impact(&ahead) - impact(&first))).signum();
        let focal_lines = f64::from(first.exit.focal_lines);
        let phase = -FRAC_PI_2 * (1.0 + focal_lines) - FRAC_PI_4 * turn;
        let value = Complex64::from_polar((size_parameter / TAU).sqrt(), phase);
        Some(Self { value, angle: first.angle, sense: impact(&first).signum() })
    }

    /// The factor of waves that leave in another direction.
    pub(crate) fn towards(&self, angle: f64) -> Complex64 {
        self.after((angle / PI).floor() - (self.angle / PI).floor())
    }

    /// The factor at the axis `number · π`, half-way through its focal line.
    pub(crate) fn at_axis(&self, number: f64) -> Complex64 {
        self.after(number - 0.5 - (self.angle / PI).floor())
    }

    fn after(&self, crossings: f64) -> Complex64 {
        self.value * Complex64::cis(FRAC_PI_2 * crossings * self.sense)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quarter of a turn for each crossing of the axis, half of it upon the axis.
    #[test]
    fn prefactors_gain_a_focal_line_at_the_axis() {
        let prefactor = Prefactor { value: Complex64::new(0.3, 0.4), angle: 0.4, sense: 1.0 };
        assert_eq!(prefactor.towards(3.0), prefactor.value);
        let crossed = prefactor.towards(3.3);
        assert!((crossed - prefactor.value * Complex64::i()).norm() < 1e-15);
        assert!((prefactor.towards(-0.1) + prefactor.value * Complex64::i()).norm() < 1e-15);
        let upon = prefactor.at_axis(1.0);
        assert!((upon * Complex64::cis(FRAC_PI_4) - crossed).norm() < 1e-15);
    }
}
