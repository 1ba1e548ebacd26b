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

    /// The exit of a ray launched next to this one, for small changes of `(u, v)`: direction, place and path to first
    /// order (`dW = -x·ds`, Legendre), all else as here.
    pub(crate) fn moved(&self, [du, dv]: [T; 2]) -> Self {
        let turn = self.ds[0] * du + self.ds[1] * dv;
        let along = self.reference.dot(turn);
        Self {
            direction: self.direction + turn,
            reference: self.reference + self.dx[0] * du + self.dx[1] * dv - self.direction * along,
            path: self.path - along,
            ..*self
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

#[cfg(test)]
mod tests {
    use super::*;

    fn ray(along: f64) -> Ray<f64> {
        let direction = Vec3::new(0.48, 0.64, 0.6);
        let ds = [Vec3::new(0.8, -0.6, 0.0) * 0.3, Vec3::new(0.36, 0.48, -0.8) * -0.7];
        let dx = [Vec3::new(0.5, 0.1, -0.2), Vec3::new(-0.3, 0.9, 0.4)];
        let unit = |x: f64, y: f64| Vec3 {
            x: Complex64::from(x),
            y: Complex64::from(y),
            z: Complex64::default(),
        };
        Ray {
            position: Vec3::new(0.3, -0.5, 0.8) + direction * along,
            direction,
            dx: [0, 1].map(|k| dx[k] + ds[k] * along),
            ds,
            path: 2.0 + along,
            field: [unit(1.0, 0.0), unit(0.0, 1.0)],
            focal_lines: 0,
        }
    }

    /// Outside nothing depends on where along the ray it is taken.
    #[test]
    fn an_exit_does_not_depend_on_the_place_along_the_ray() {
        let (near, far) = (Exit::new(2, ray(0.0)), Exit::new(2, ray(3.7)));
        let apart = |a: Vec3<f64>, b: Vec3<f64>| (a - b).dot(a - b).sqrt();
        assert!(apart(near.reference, far.reference) < 1e-14);
        assert!(near.reference.dot(near.direction).abs() < 1e-15);
        assert!((near.path - far.path).abs() < 1e-14);
        for k in 0..2 {
            assert!(apart(near.dx[k], far.dx[k]) < 1e-14);
            assert!(near.dx[k].dot(near.direction).abs() < 1e-14);
        }
        assert_eq!(near.power(), 1.0);
    }

    /// The spread is the solid angle per area, by a small triangle of directions.
    #[test]
    fn the_spread_is_the_solid_angle_between_neighbours() {
        const H: f64 = 1e-4;
        let exit = Exit::new(1, ray(0.0));
        let [a, b, c] = [[0.0, 0.0], [H, 0.0], [0.0, H]]
            .map(|[u, v]| (exit.direction + exit.ds[0] * u + exit.ds[1] * v).normalized());
        let solid_angle = a.dot(b.cross(c)) / (H * H);
        assert!((exit.spread() - solid_angle).abs() < 1e-4 * solid_angle.abs());
        assert!((exit.scattering_angle() - 0.6f64.acos()).abs() < 1e-15);
    }

    /// A field that goes straight on is the unit matrix in the plane of every azimuth.
    #[test]
    fn what_goes_straight_on_is_unchanged_in_every_plane() {
        let field = ray(0.0).field;
        for azimuth in [0.0f64, 0.7, 2.9, -1.2] {
            let (sin, cos) = azimuth.sin_cos();
            let (theta_hat, phi_hat) = (Vec3::new(cos, sin, 0.0), Vec3::new(-sin, cos, 0.0));
            let t = transfer(&field, theta_hat, phi_hat, cos, sin);
            assert!((t.s1 - 1.0).norm() + (t.s2 - 1.0).norm() < 1e-14, "{t:?}");
            assert!(t.s3.norm() + t.s4.norm() < 1e-14, "{t:?}");
        }
        // a mirror across the axis turns both fields about, parallel and perpendicular alike
        let mirrored = field.map(|e| Vec3 { x: e.x, y: -e.y, z: e.z });
        let t = transfer(&mirrored, Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), 1.0, 0.0);
        assert_eq!((t.s2.re, t.s1.re), (1.0, -1.0));
    }
}
