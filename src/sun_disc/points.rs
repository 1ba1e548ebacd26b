//! The disc as points, for what depends on the azimuth: every point sees its own direction.

use std::f64::consts::TAU;

/// The disc as a set of directions around its centre, in rings of equal area.
#[derive(Clone, Debug, PartialEq)]
pub struct DiscPoints {
    /// Angular radius of each ring, radians.
    pub ring: Vec<f64>,
    /// Heliocentric cosine of each ring.
    pub mu: Vec<f64>,
    /// Position angles of a ring's points, radians.
    pub turn: Vec<f64>,
}

impl DiscPoints {
    /// `rings` rings of `points` points each; a disc of angular radius `radius`.
    pub fn new(radius: f64, rings: usize, points: usize) -> Self {
        let middle = |i: usize| ((i as f64 + 0.5) / rings as f64).sqrt();
        Self {
            ring: (0..rings).map(|i| radius * middle(i)).collect(),
            mu: (0..rings).map(|i| (1.0 - middle(i).powi(2)).sqrt()).collect(),
            turn: (0..points).map(|j| TAU * j as f64 / points as f64).collect(),
        }
    }

    /// Directions (θ, φ) of one ring around a centre given in the same spherical coordinates.
    pub fn around(
        &self,
        ring: usize,
        theta: f64,
        phi: f64,
    ) -> impl Iterator<Item = (f64, f64)> + '_ {
        let (sr, cr) = self.ring[ring].sin_cos();
        let (st, ct) = theta.sin_cos();
        // Neighbouring rings are turned against each other, so that spokes do not line up.
        let twist = 2.399_963 * ring as f64;
        self.turn.iter().map(move |turn| {
            let (s, c) = (turn + twist).sin_cos();
            // Components along the axis, away from it, and sideways.
            let z = ct * cr - st * sr * c;
            let x = st * cr + ct * sr * c;
            let y = sr * s;
            (x.hypot(y).atan2(z), phi + y.atan2(x))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::SUN_ANGULAR_RADIUS;

    /// Every point lies on its ring about the centre, at the poles too, and the points' mean is the centre.
    #[test]
    fn points_lie_on_their_rings() {
        let disc = DiscPoints::new(SUN_ANGULAR_RADIUS, 4, 12);
        let vector = |theta: f64, phi: f64| {
            let ((s, c), (sp, cp)) = (theta.sin_cos(), phi.sin_cos());
            [s * cp, s * sp, c]
        };
        for (theta, phi) in [(0.0, 0.0), (2.4, 1.0), (std::f64::consts::PI, 0.3)] {
            let centre = vector(theta, phi);
            for (k, ring) in disc.ring.iter().enumerate() {
                for (t, p) in disc.around(k, theta, phi) {
                    let point = vector(t, p);
                    let chord: f64 =
                        centre.iter().zip(point).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
                    assert!((2.0 * (0.5 * chord).asin() - ring).abs() < 1e-12, "{theta} {k}");
                }
            }
        }
    }
}
