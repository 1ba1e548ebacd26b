//! A scattered direction with its unit vectors, continuous through θ = 0 and π.

use crate::math::vec3::Vec3;
use std::f64::consts::PI;

/// Spherical coordinates about the light, and the frame that goes with them.
#[derive(Clone, Copy, Debug)]
pub struct Direction {
    pub theta: f64,
    pub phi: f64,
    pub unit: Vec3<f64>,
    pub theta_hat: Vec3<f64>,
    pub phi_hat: Vec3<f64>,
    pub cos_phi: f64,
    pub sin_phi: f64,
}

impl Direction {
    /// From scattering angle and azimuth, radians.
    pub fn new(theta: f64, phi: f64) -> Self {
        let (sin, cos) = sin_cos_theta(theta);
        let (sin_phi, cos_phi) = phi.sin_cos();
        Self {
            theta,
            phi,
            unit: Vec3 { x: sin * cos_phi, y: sin * sin_phi, z: cos },
            theta_hat: Vec3 { x: cos * cos_phi, y: cos * sin_phi, z: -sin },
            phi_hat: Vec3 { x: -sin_phi, y: cos_phi, z: 0.0 },
            cos_phi,
            sin_phi,
        }
    }
}

/// `sin θ` and `cos θ` with `sin π = 0`.
fn sin_cos_theta(theta: f64) -> (f64, f64) {
    if theta > 0.75 * PI { ((PI - theta).sin(), -(PI - theta).cos()) } else { theta.sin_cos() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `θ̂ × φ̂ = n`, all of length 1, at the axis too; the frame is that of growing angles.
    #[test]
    fn frames_are_right_handed_and_follow_the_angles() {
        const H: f64 = 1e-6;
        for theta in [0.0, 0.3, 1.9, 0.75 * PI, 3.0, PI] {
            for phi in [0.0, 1.2, -2.5] {
                let d = Direction::new(theta, phi);
                let off = d.theta_hat.cross(d.phi_hat) - d.unit;
                assert!(off.dot(off) < 1e-30 && (d.unit.dot(d.unit) - 1.0).abs() < 1e-15);
                let step =
                    Direction::new(theta + H, phi).unit - Direction::new(theta - H, phi).unit;
                let off = step * (0.5 / H) - d.theta_hat;
                assert!(off.dot(off) < 1e-18, "{theta} {phi}: {off:?}");
            }
        }
    }

    /// `sin π` is zero and not 1e-16: straight backward is exactly on the axis.
    #[test]
    fn backward_is_on_the_axis() {
        let d = Direction::new(PI, 0.7);
        assert_eq!((d.unit.x, d.unit.y, d.unit.z), (0.0, 0.0, -1.0));
    }
}
