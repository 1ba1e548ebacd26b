//! What the integrand needs of one ray, as numbers that are smooth in the launch point.

use crate::math::vec3::Vec3;
use crate::trace::Exit;
use num_complex::Complex64;
use std::f64::consts::FRAC_PI_2;

/// The complex place of the wavefront along its rays, in radii from the plane through the centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Real part, between the focal lines of most rays that have been reflected inside.
    pub real: f64,
    /// Imaginary part, which makes the width of the window `1/√(xβ)`.
    pub imaginary: f64,
}

/// Where the wavefront stands. Error and cost change little about it (`τ_r` -0.3 to 0.1, `β` 0.3 to 1).
pub const PLACE: Place = Place { real: -0.3, imaginary: 0.7 };

/// Channels of a ray, one of them spare.
pub(super) const CHANNELS: usize = 20;
pub(super) type Channels = [f64; CHANNELS];

/// Numbers of the channels: direction, reference point, path, then real and imaginary parts of both
/// fields times `F` and the squared radius of the rim.
pub(super) const DIRECTION: usize = 0;
pub(super) const REFERENCE: usize = 3;
pub(super) const PATH: usize = 6;
pub(super) const FIELDS: usize = 7;

/// What the integrand needs of a ray.
pub(super) fn channels(exit: &Exit<f64>, place: Place, rim_squared: f64) -> Option<Channels> {
    let factor = spreading(exit, place) * rim_squared;
    let Exit { direction: s, reference: r, .. } = exit;
    let mut found = [0.0; CHANNELS];
    found[..FIELDS].copy_from_slice(&[s.x, s.y, s.z, r.x, r.y, r.z, exit.path]);
    let parts = exit.field.iter().flat_map(|e| [e.x, e.y, e.z]);
    for (k, part) in parts.enumerate() {
        let value = part * factor;
        (found[FIELDS + 2 * k], found[FIELDS + 2 * k + 1]) = (value.re, value.im);
    }
    found.iter().all(|v| v.is_finite()).then_some(found)
}

/// `F`: root of the cross-section of the ray's tube at the complex place, with the phase of the focal lines
/// that lie beyond.
fn spreading(exit: &Exit<f64>, place: Place) -> Complex64 {
    let tau = Complex64::new(place.real, place.imaginary);
    let ([xu, xv], [su, sv], s) = (exit.dx, exit.ds, exit.direction);
    let c0 = s.dot(xu.cross(xv));
    let c1 = s.dot(xu.cross(sv)) + s.dot(su.cross(xv));
    let c2 = exit.spread();
    let discriminant = (c1 * c1 - 4.0 * c0 * c2).max(0.0);
    let q = -0.5 * (c1 + discriminant.sqrt().copysign(c1));
    // √|c2| √(τ - t1) with t1 = q/c2, finite where the focal line goes to infinity
    let far = ((tau * c2 - q) * c2.signum()).sqrt();
    let near = if q == 0.0 { tau.sqrt() } else { (tau - c0 / q).sqrt() };
    far * near * Complex64::cis(-FRAC_PI_2 * f64::from(exit.focal_lines))
}

/// Derivatives of direction and reference point by launch coordinates `(α, ψ)`, for a rim radius and its
/// slope at ψ.
pub(super) fn by_launch(
    exit: &Exit<f64>,
    [alpha, psi]: [f64; 2],
    (rim, slope): (f64, f64),
) -> [[Vec3<f64>; 2]; 2] {
    let ((sin, cos), (sp, cp)) = (alpha.sin_cos(), psi.sin_cos());
    let by_alpha = [rim * cos * cp, rim * cos * sp];
    let by_psi = [sin * (slope * cp - rim * sp), sin * (slope * sp + rim * cp)];
    [by_alpha, by_psi]
        .map(|[a, b]| [exit.ds[0] * a + exit.ds[1] * b, exit.dx[0] * a + exit.dx[1] * b])
}
