//! The rays of the vertical symmetry plane, and the rainbows among them: rays of stationary deviation.
//!
//! ```
//! use gonio::shape::Shape;
//! use gonio::trace::{SymmetryPlane, Tracer};
//!
//! let sphere = Shape::sphere();
//! let tracer = Tracer::new(&sphere, 1.333.into(), 1.0, 2);
//! let bows = SymmetryPlane::new(&sphere, &tracer, 2).rainbows();
//! // The primary bow of both halves of a sphere, 42° from the antisolar point
//! assert_eq!(bows.len(), 2);
//! assert!((bows[1].deviation.to_degrees() - 137.92).abs() < 0.01);
//! ```

use super::{Exit, Tracer};
use crate::shape::Shape;
use std::f64::consts::PI;

/// The rays of one order in the vertical plane.
#[derive(Clone, Copy, Debug)]
pub struct SymmetryPlane<'a> {
    tracer: &'a Tracer<'a>,
    order: u32,
    /// Distances of the silhouette's edges from the middle.
    lower: f64,
    upper: f64,
}

/// One ray of the plane.
#[derive(Clone, Debug)]
pub struct PlaneRay {
    /// Impact parameter, positive above the middle.
    pub impact: f64,
    /// Where and how it leaves.
    pub exit: Exit<f64>,
    /// Points where the ray meets the surface, in the frame of the light (upper side x, along z).
    pub points: Vec<[f64; 2]>,
}

/// A ray of stationary deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rainbow {
    /// Impact parameter, positive above the middle.
    pub impact: f64,
    /// Scattering angle, radians.
    pub deviation: f64,
}

impl Rainbow {
    /// Which half of the particle it is made in.
    pub fn branch(&self) -> &'static str {
        if self.impact >= 0.0 { "upper" } else { "lower" }
    }
}

/// Intervals of the search: so close that two rainbows of one drop never share one.
const SCAN: usize = 4000;
/// Halvings of an interval: beyond the last digit of an impact.
const HALVINGS: usize = 60;
/// The outermost rays miss the rim by this share.
const RIM: f64 = 1e-6;

impl<'a> SymmetryPlane<'a> {
    /// The plane of a shape, for a tracer of it that goes to this order at least.
    pub fn new(shape: &Shape, tracer: &'a Tracer<'a>, order: u32) -> Self {
        let rim = |azimuth: f64| shape.silhouette().radius(azimuth);
        Self { tracer, order, lower: rim(PI), upper: rim(0.0) }
    }

    /// The ray at an impact parameter, if it leaves in this order.
    pub fn ray(&self, impact: f64) -> Option<PlaneRay> {
        let mut points = Vec::new();
        let exit = self.tracer.trace_with_points(impact, 0.0, self.order, &mut points)?;
        Some(PlaneRay { impact, exit, points })
    }

    /// Those of `count` rays (2 or more), evenly spaced from the lower to the upper rim, that leave in
    /// this order.
    pub fn fan(&self, count: usize) -> Vec<PlaneRay> {
        let impact = |i: usize| {
            let share = i as f64 / (count - 1) as f64;
            (1.0 - RIM) * (-self.lower + share * (self.upper + self.lower))
        };
        (0..count).filter_map(|i| self.ray(impact(i))).collect()
    }

    /// Rainbows from the lower to the upper rim: zeros of the derivative of the exit's direction.
    pub fn rainbows(&self) -> Vec<Rainbow> {
        let impact =
            |i: usize| -self.lower + (i as f64 + 0.5) / SCAN as f64 * (self.upper + self.lower);
        (1..SCAN).filter_map(|i| self.rainbow_between(impact(i - 1), impact(i))).collect()
    }

    /// The rainbow between two impact parameters, if the deviation turns there.
    fn rainbow_between(&self, mut a: f64, mut b: f64) -> Option<Rainbow> {
        let ((mut fa, _), (fb, _)) = (self.turn(a)?, self.turn(b)?);
        if fa * fb > 0.0 {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (a + b);
            let Some((f, _)) = self.turn(middle) else { break };
            if f * fa > 0.0 { (a, fa) = (middle, f) } else { b = middle }
        }
        let impact = 0.5 * (a + b);
        self.turn(impact).map(|(_, deviation)| Rainbow { impact, deviation })
    }

    /// Turn of the exit's direction within the plane per impact, and the scattering angle.
    fn turn(&self, impact: f64) -> Option<(f64, f64)> {
        let ray = self.ray(impact)?;
        let (s, ds) = (ray.exit.direction, ray.exit.ds[0]);
        Some((s.z * ds.x - s.x * ds.z, ray.exit.scattering_angle()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optics::rainbow_angle;

    /// The bows of a sphere stand where Descartes' formula has them, once per half.
    #[test]
    fn bows_of_a_sphere_as_descartes() {
        let sphere = Shape::sphere();
        let tracer = Tracer::new(&sphere, 1.333.into(), 1.0, 4);
        for order in [2, 3, 4] {
            let bows = SymmetryPlane::new(&sphere, &tracer, order).rainbows();
            let expected = rainbow_angle(1.333, order).unwrap();
            assert_eq!(bows.len(), 2, "order {order}");
            assert!((bows[0].impact + bows[1].impact).abs() < 1e-9);
            for bow in bows {
                assert!((bow.deviation - expected).abs() < 1e-9, "order {order}: {bow:?}");
            }
        }
    }

    #[test]
    fn a_fan_reaches_from_rim_to_rim() {
        let sphere = Shape::sphere();
        let tracer = Tracer::new(&sphere, 1.333.into(), 1.0, 1);
        let fan = SymmetryPlane::new(&sphere, &tracer, 1).fan(5);
        let impacts: Vec<f64> = fan.iter().map(|ray| ray.impact).collect();
        assert_eq!(fan.len(), 5);
        assert!((impacts[0] + 1.0).abs() < 2e-6 && (impacts[4] - 1.0).abs() < 2e-6);
        assert!(fan.iter().all(|ray| ray.points.len() == 2));
    }
}
