//! A scattered direction with its unit vectors, continuous through θ = 0 and π.

use crate::math::vec3::Vec3;
use std::f64::consts::PI;

/// Spherical coordinates about the light, and the frame that goes with them.
#[derive(Clone, Copy, Debug)]
pub struct Direction {
    /// Scattering angle, radians.
    pub theta: f64,
    /// Azimuth, radians.
    pub phi: f64,
    /// Unit vector in this direction.
    pub unit: Vec3<f64>,
    /// Unit vector of growing θ.
    pub theta_hat: Vec3<f64>,
    /// Unit vector of growing φ.
    pub phi_hat: Vec3<f64>,
    /// Cosine of the azimuth.
    pub cos_phi: f64,
    /// Sine of the azimuth.
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
