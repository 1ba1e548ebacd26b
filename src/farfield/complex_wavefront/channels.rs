//! What the integrand needs of one ray, as numbers that are smooth in the launch point.

use crate::math::vec3::Vec3;
use crate::trace::Exit;
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

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

/// Natural logarithm of what the sum over a lattice may add to the integral.
const ALIASING: f64 = 8.0;

/// Steps in `(α, ψ)` with which a sum over this ray's surroundings is the integral: for a Gaussian
/// `exp -½ yᵀAy` the sum over a lattice of step `h` along an axis errs by `exp -2π² Re(A⁻¹)/h²`.
pub(super) fn steps(tangents: [[Vec3<f64>; 2]; 2], x: f64, place: Place) -> [f64; 2] {
    let ([aa, _, pp], determinant) = curvature(tangents, place);
    // A = -ix H
    let width = |other: Complex64| (Complex64::i() * other / (x * determinant)).re.max(0.0);
    [pp, aa].map(|other| PI * (2.0 * width(other) / ALIASING).sqrt())
}

/// Area in `(α, ψ)` that the wave of a ray stands for: the integral of that Gaussian.
pub(super) fn width(tangents: [[Vec3<f64>; 2]; 2], x: f64, place: Place) -> f64 {
    let (_, determinant) = curvature(tangents, place);
    TAU / (x * determinant.norm().sqrt())
}

/// Second derivatives `H` of the phase by `(α, ψ)`, and their determinant.
fn curvature(
    [[sa, ra], [sp, rp]]: [[Vec3<f64>; 2]; 2],
    place: Place,
) -> ([Complex64; 3], Complex64) {
    let tau = Complex64::new(place.real, place.imaginary);
    let entry = |s: Vec3<f64>, r: Vec3<f64>, other: Vec3<f64>| tau * s.dot(other) + r.dot(other);
    let (aa, ap, pp) = (entry(sa, ra, sa), entry(sa, ra, sp), entry(sp, rp, sp));
    ([aa, ap, pp], aa * pp - ap * ap)
}
