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

#[cfg(test)]
mod tests {
    use super::*;

    /// Lines within a length, for a bundle with foci at these distances (negative: behind).
    fn lines(foci: [f64; 2], length: f64) -> u32 {
        // neither axes of the bundle nor its direction along the frame's
        let direction = Vec3::new(0.6, 0.0, 0.8);
        let axes = [Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.8, 0.0, -0.6)];
        let (sin, cos) = 0.4f64.sin_cos();
        let mixed = |scale: [f64; 2]| {
            let [a, b] = [axes[0] * scale[0], axes[1] * scale[1]];
            [a * cos + b * sin, b * cos - a * sin]
        };
        let bent = mixed(foci.map(|f| -1.0 / f));
        count(direction, &mixed([1.0, 1.0]), &bent, length)
    }

    #[test]
    fn an_astigmatic_bundle_passes_two_lines() {
        assert_eq!(lines([1.0, 2.5], 0.9), 0);
        assert_eq!(lines([1.0, 2.5], 1.1), 1);
        assert_eq!(lines([1.0, 2.5], 2.6), 2);
        assert_eq!(lines([1.0, 2.5], f64::INFINITY), 2);
    }

    #[test]
    fn a_point_focus_counts_twice_and_rays_apart_never() {
        assert_eq!(lines([1.5, 1.5], 1.6), 2);
        assert_eq!(lines([-1.0, -3.0], f64::INFINITY), 0);
        assert_eq!(lines([-1.0, 2.0], f64::INFINITY), 1);
        assert_eq!(lines([f64::INFINITY, 2.0], f64::INFINITY), 1);
    }
}
