//! A ray that has left the particle: everything the far field needs of it.

use super::ray::{Ray, power};
use crate::math::scalar::Scalar;
use crate::math::vec3::{Field, Vec3};
use crate::optics::AmplitudeMatrix;
use num_complex::Complex64;

/// A ray on its way to infinity, after `order` chords.
#[derive(Clone, Copy, Debug)]
pub struct Exit<T> {
    /// Number of chords.
    pub order: u32,
    /// Unit direction.
    pub direction: Vec3<T>,
    /// Its derivatives with respect to `(u, v)`.
    pub ds: [Vec3<T>; 2],
    /// Derivatives of the position with respect to `(u, v)`, on the plane through the centre
    /// normal to the exit direction.
    pub dx: [Vec3<T>; 2],
    /// Where the ray, extended, crosses the plane through the centre normal to its direction.
    pub reference: Vec3<T>,
    /// Path `W = ℓ - x·s` relative to a ray through the centre, in units of the radius.
    pub path: T,
    /// Fields for incident light along the frame's x and y, power-normalised, without phase of path.
    pub field: [Field; 2],
    /// Focal lines passed on the way to infinity (real rays only).
    pub focal_lines: u32,
}

impl<T: Scalar> Exit<T> {
    /// The exit of a ray that has just left the surface.
    pub(super) fn new(order: u32, ray: Ray<T>) -> Self {
        let ahead = if T::REAL { ray.focal_lines_within(f64::INFINITY) } else { 0 };
        let s = ray.direction;
        let along = s.dot(ray.position);
        // Slide position and differentials along the ray to the plane through the centre.
        let reference = ray.position - s * along;
        let dx = [0, 1].map(|k| {
            let moved = ray.dx[k] - ray.ds[k] * along;
            moved - s * s.dot(moved)
        });
        Self {
            order,
            direction: s,
            ds: ray.ds,
            dx,
            reference,
            path: ray.path - along,
            field: ray.field,
            focal_lines: ray.focal_lines + ahead,
        }
    }

    /// Power for unpolarised light, as a fraction of what the ray began with.
    pub(super) fn power(&self) -> f64 {
        power(&self.field)
    }

    /// `s·(∂ᵤs × ∂ᵥs)`: signed solid angle per area of the wavefront; zero on a caustic.
    pub fn spread(&self) -> T {
        self.direction.dot(self.ds[0].cross(self.ds[1]))
    }
}

impl Exit<f64> {
    /// Scattering angle of the exit direction, radians.
    pub fn scattering_angle(&self) -> f64 {
        let s = self.direction;
        s.x.hypot(s.y).atan2(s.z)
    }
}

/// Field transfer `T` in the frames of the scattering plane, arranged as an amplitude matrix
/// (without `-ik √(dA/dΩ) exp(ikW - iπm/2)`).
///
/// `field` are the outgoing fields for incident light along x and y; `theta_hat` and `phi_hat` the
/// unit vectors of the direction's spherical coordinates, `(cos, sin)` the azimuth's direction.
pub fn transfer<T: Scalar>(
    field: &[Field; 2],
    theta_hat: Vec3<T>,
    phi_hat: Vec3<T>,
    cos: T,
    sin: T,
) -> AmplitudeMatrix {
    let [ex, ey] = *field;
    let along = |axis: Vec3<T>| (axis.project(ex), axis.project(ey));
    let (tx, ty) = along(theta_hat);
    let (fx, fy) = along(phi_hat);
    let parallel = |x: Complex64, y: Complex64| cos.scale(x) + sin.scale(y);
    let perpendicular = |x: Complex64, y: Complex64| sin.scale(x) - cos.scale(y);
    AmplitudeMatrix {
        s2: parallel(tx, ty),
        s3: perpendicular(tx, ty),
        s4: -parallel(fx, fy),
        s1: -perpendicular(fx, fy),
    }
}
