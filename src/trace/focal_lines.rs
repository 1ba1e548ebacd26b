//! Focal lines passed by a ray: each takes a quarter period off the phase.
//!
//! With the ray's differentials, the area of an infinitesimal tube of rays after a length `t` is
//! `s·((∂ᵤx + t ∂ᵤs) × (∂ᵥx + t ∂ᵥs))`, a quadratic in `t`; its roots are the focal lines. They are
//! always real (the wavefront's curvature is a symmetric matrix), so a discriminant that rounding
//! made negative is a double root: a point focus.

use crate::math::vec3::Vec3;

/// Number of focal lines within `0 < t ≤ length` of a straight segment.
pub(super) fn count(
    direction: Vec3<f64>,
    dx: &[Vec3<f64>; 2],
    ds: &[Vec3<f64>; 2],
    length: f64,
) -> u32 {
    let c0 = direction.dot(dx[0].cross(dx[1]));
    let c1 = direction.dot(dx[0].cross(ds[1])) + direction.dot(ds[0].cross(dx[1]));
    let c2 = direction.dot(ds[0].cross(ds[1]));
    let discriminant = (c1 * c1 - 4.0 * c0 * c2).max(0.0);
    let q = -0.5 * (c1 + discriminant.sqrt().copysign(c1));
    let inside = |t: f64| u32::from(t > 0.0 && t <= length);
    inside(q / c2) + inside(c0 / q)
}
