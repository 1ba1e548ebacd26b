//! One ray at one surface point: where it goes on, how its neighbours diverge, what its field becomes.
//!
//! Ray differentials after Igehy 1999, with the surface's curvature entering through the turn of its
//! normal. Fields are vectors in space; the plane of incidence is spanned afresh at every event, and
//! where it is undefined (normal incidence) any plane serves, since both coefficients agree there.

use super::ray::Ray;
use crate::math::scalar::Scalar;
use crate::math::vec3::{Field, Vec3};
use crate::optics::{Fresnel, Grazing, curved_from_inside, curved_from_outside, fresnel};
use crate::shape::Tangent;
use num_complex::Complex64;

/// The interface between a particle of complex index and the vacuum outside.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interface {
    pub index: Complex64,
    /// Size parameter for the curvature of the surface near grazing; `None`: Fresnel's flat one.
    pub curved: Option<f64>,
}

impl Interface {
    /// Coefficients for a ray that meets the surface from outside (`entering`) or inside.
    fn coefficients<T: Scalar>(
        &self,
        direction: Vec3<T>,
        cos: T,
        tangent: &Tangent<T>,
        entering: bool,
    ) -> Fresnel {
        let m = self.index;
        let relative = if entering { m } else { m.inv() };
        let Some(size_parameter) = self.curved else {
            return fresnel(cos, relative);
        };
        let square = cos * cos;
        let outside = if entering { square } else { -(((-square + 1.0) * (m.re * m.re)) - 1.0) };
        if outside.re() > FAR_FROM_GRAZING {
            return fresnel(cos, relative);
        }
        let curvature = size_parameter * tangent.radius_along(direction);
        let grazing = Grazing::new(outside, curvature);
        if entering {
            curved_from_outside(cos, m, &grazing)
        } else {
            curved_from_inside(cos, m, &grazing)
        }
    }
}

/// Squared cosine beyond which curvature never matters for size parameters that rays serve.
const FAR_FROM_GRAZING: f64 = 0.6;

/// Geometry of an event: normal turned against the ray, cosines, relative index.
pub(super) struct Event<T> {
    normal: Vec3<T>,
    normal_turn: [Vec3<T>; 2],
    cos_incidence: T,
    cos_turn: [T; 2],
    coefficients: Fresnel,
    perpendicular: Vec3<T>,
    parallel_in: Vec3<T>,
}

impl<T: Scalar> Event<T> {
    /// Bring a ray's differentials onto the surface and set up the event.
    ///
    /// `ray.position` is the surface point; `ray.dx` are displacements at that same length of path.
    pub(super) fn new(ray: &mut Ray<T>, tangent: &Tangent<T>, interface: &Interface) -> Self {
        let s = ray.direction;
        let outward = tangent.normal;
        let entering = s.dot(outward).re() < 0.0;
        let normal = if entering { outward } else { -outward };
        let cos_incidence = -normal.dot(s);
        for k in 0..2 {
            let along = normal.dot(ray.dx[k]) / cos_incidence;
            ray.dx[k] = ray.dx[k] + s * along;
        }
        let turn = |k: usize| {
            let dn = tangent.turn(ray.dx[k]);
            if entering { dn } else { -dn }
        };
        let normal_turn = [turn(0), turn(1)];
        let cos_turn = [0, 1].map(|k| -(normal.dot(ray.ds[k]) + s.dot(normal_turn[k])));
        let perpendicular = plane_of_incidence(s, normal);
        Self {
            normal,
            normal_turn,
            cos_incidence,
            cos_turn,
            coefficients: interface.coefficients(s, cos_incidence, tangent, entering),
            perpendicular,
            parallel_in: perpendicular.cross(s),
        }
    }

    /// The reflected ray.
    pub(super) fn reflect(&self, ray: &Ray<T>) -> Ray<T> {
        let twice = self.cos_incidence * 2.0;
        let direction = ray.direction + self.normal * twice;
        let ds = [0, 1].map(|k| {
            ray.ds[k] + self.normal * (self.cos_turn[k] * 2.0) + self.normal_turn[k] * twice
        });
        let c = &self.coefficients;
        let field = self.field(ray, direction, c.r_perpendicular, c.r_parallel);
        Ray { direction, ds, field, ..*ray }
    }

    /// The refracted ray; `None` under total reflection. `ratio` is the index before over behind.
    pub(super) fn refract(&self, ray: &Ray<T>, ratio: f64) -> Option<Ray<T>> {
        let ci = self.cos_incidence;
        let square = -(((-(ci * ci) + 1.0) * (ratio * ratio)) - 1.0);
        if T::REAL && square.re() <= 0.0 {
            return None;
        }
        let ct = square.root();
        let mu = ci * ratio - ct;
        let mu_per_cos = -(ci * (ratio * ratio) / ct) + ratio;
        let direction = ray.direction * T::real(ratio) + self.normal * mu;
        let ds = [0, 1].map(|k| {
            ray.ds[k] * T::real(ratio)
                + self.normal * (mu_per_cos * self.cos_turn[k])
                + self.normal_turn[k] * mu
        });
        let c = &self.coefficients;
        let field = self.field(ray, direction, c.t_perpendicular, c.t_parallel);
        Some(Ray { direction, ds, field, ..*ray })
    }

    /// Both fields after the event, for given coefficients.
    fn field(&self, ray: &Ray<T>, s: Vec3<T>, perp: Complex64, par: Complex64) -> [Field; 2] {
        let parallel_out = self.perpendicular.cross(s);
        ray.field.map(|e| {
            let a = self.perpendicular.project(e) * perp;
            let b = self.parallel_in.project(e) * par;
            self.perpendicular.carry(a) + parallel_out.carry(b)
        })
    }
}

/// Unit normal of the plane of incidence.
pub(super) fn plane_of_incidence<T: Scalar>(direction: Vec3<T>, normal: Vec3<T>) -> Vec3<T> {
    let q = direction.cross(normal);
    let square = q.dot(q);
    if square.size() > 1e-24 {
        return q * (T::real(1.0) / square.root());
    }
    // Any direction across the normal will do.
    let helper = if normal.x.size() < 0.9 { (1.0, 0.0) } else { (0.0, 1.0) };
    let helper = Vec3::new(T::real(helper.0), T::real(helper.1), T::default());
    helper.cross(normal).normalized()
}

#[cfg(test)]
mod tests;
