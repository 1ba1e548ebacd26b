//! Where the planes of an order stand over azimuth, how many rays each is scanned with, and how near the axis.

use crate::farfield::assignment::Thresholds;
use crate::shape::Shape;
use std::f64::consts::PI;

/// Azimuth steps per half-turn, before refinement by the tolerance: for orders of plain rays and
/// pairs, and for those with rim waves, whose phases change faster.
const HALF_TURN_STEPS: usize = 44;
const HALF_TURN_STEPS_RIM: usize = 60;

/// Where the planes stand.
#[derive(Clone, Debug)]
pub(crate) enum Azimuths {
    /// One serves all: nothing depends on azimuth.
    Any,
    /// Even steps over a half-turn, both ends in.
    Even,
    /// There as well, to be cut alike; any other is traced when it is asked for.
    Single,
}

impl Azimuths {
    /// Those of a particle, to begin with.
    pub(super) fn of(shape: &Shape) -> Self {
        if shape.rotational_symmetry() { Self::Any } else { Self::Even }
    }

    /// Azimuths from 0 to π, in so many steps, more or fewer as a tolerance asks for.
    pub(super) fn places(&self, tolerance: f64, half_turn_steps: usize) -> Vec<f64> {
        match self {
            Self::Any => vec![0.0],
            Self::Even | Self::Single => {
                let finer = (0.01 / tolerance).powf(0.125).clamp(0.8, 2.0);
                let steps = (half_turn_steps as f64 * finer).ceil() as usize;
                (0..=steps).map(|j| j as f64 * PI / steps as f64).collect()
            }
        }
    }
}

/// Steps over a half-turn before refinement by the tolerance.
pub(super) fn steps(by: &Thresholds, order: u32) -> usize {
    if by.is_high(order) { HALF_TURN_STEPS_RIM } else { HALF_TURN_STEPS }
}

/// Rays of the scan of a plane.
pub(super) fn scanned_rays(order: u32) -> usize {
    64 + 16 * order as usize
}

/// Gaps tried about crossings of the axis, radians: the tangle of rays there grows with the order
/// and with the deformation of the outline.
pub(super) fn axis_gaps(narrowest: f64, caustic_disorder: f64) -> Vec<f64> {
    const WIDEST: f64 = 0.35;
    let mut gaps = [3.0, 6.0].map(|f| (f * caustic_disorder).clamp(narrowest, WIDEST)).to_vec();
    gaps.dedup();
    gaps
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Even steps with both ends, closer for a smaller tolerance; nothing depends on azimuth where the light goes along
    /// the axis.
    #[test]
    fn planes_stand_evenly_over_a_half_turn() {
        let even = Azimuths::of(&Shape::spheroid(0.9, 0.3).unwrap());
        let (some, more) = (even.places(0.01, 44), even.places(1e-4, 44));
        assert!(some.len() == 45 && more.len() > 70);
        assert!(some[0] == 0.0 && (some[44] - PI).abs() + (some[11] - PI / 4.0).abs() < 1e-14);
        assert_eq!(Azimuths::of(&Shape::sphere()).places(0.01, 44), [0.0]);
    }

    #[test]
    fn gaps_about_the_axis_grow_with_the_disorder() {
        assert_eq!(axis_gaps(0.02, 0.0), [0.02]);
        assert_eq!(axis_gaps(0.02, 0.05), [0.05 * 3.0, 0.05 * 6.0]);
        assert_eq!(axis_gaps(0.02, 1.0), [0.35]);
    }
}
