//! Forward diffraction by the drop's silhouette (Fraunhofer, with the obliquity of a black screen):
//! `S = (x²/2π) ∬ exp(-i x s·(u, v)) du dv · (1 + cos θ)/2`, the same for S1 and S2.
//!
//! For a circle that is `x² J₁(z)/z`, `z = x sin θ` (van de Hulst 1957, §12.32). For other outlines:
//! near the axis a line integral along the outline; further out the two points of the outline whose
//! normals are parallel to the direction, each with a Hankel function that tends to its stationary
//! phase and reduces to the circle's exact result.

use crate::farfield::direction::Direction;
use crate::shape::Shape;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// The outline of a shape's shadow, prepared for diffraction.
#[derive(Clone, Debug)]
pub struct ForwardDiffraction {
    /// Points of the outline and its tangents by azimuth ψ.
    points: Vec<[f64; 2]>,
    tangents: Vec<[f64; 2]>,
    /// Support function (largest extent), its slope, and radius of curvature, by the azimuth of the
    /// normal.
    support: Vec<[f64; 3]>,
    circular: bool,
    area: f64,
}

/// Number of points on the outline (a power of 2); the line integral serves while `x sin θ` is below
/// `LINE_UP_TO`.
const POINTS: usize = 1024;
const LINE_UP_TO: f64 = 64.0;
/// Angle in units of `x^(-1/3)` at which edge waves fade.
const FADE: f64 = 2.0;

impl ForwardDiffraction {
    /// Measure the outline.
    pub fn new(shape: &Shape) -> Self {
        let silhouette = shape.silhouette();
        let step = TAU / POINTS as f64;
        let radii: Vec<f64> = (0..POINTS).map(|i| silhouette.radius(i as f64 * step)).collect();
        let slope = periodic_derivative(&radii);
        let mut points = Vec::with_capacity(POINTS);
        let mut tangents = Vec::with_capacity(POINTS);
        for i in 0..POINTS {
            let (sin, cos) = (i as f64 * step).sin_cos();
            points.push([radii[i] * cos, radii[i] * sin]);
            tangents.push([slope[i] * cos - radii[i] * sin, slope[i] * sin + radii[i] * cos]);
        }
        let area = radii.iter().map(|r| 0.5 * r * r * step).sum();
        let (low, high) = radii.iter().fold((f64::MAX, 0f64), |(l, h), r| (l.min(*r), h.max(*r)));
        let support = support(&points, &tangents);
        Self { points, tangents, support, circular: high - low < 1e-12, area }
    }

    /// Area of the shadow, in units of the squared radius.
    pub fn area(&self) -> f64 {
        self.area
    }

    /// The amplitude `S1 = S2` in a direction, for a size parameter.
    pub fn amplitude(&self, size_parameter: f64, direction: &Direction) -> Complex64 {
        let sin = direction.unit.x.hypot(direction.unit.y);
        let (qx, qy) = (size_parameter * direction.unit.x, size_parameter * direction.unit.y);
        let q = size_parameter * sin;
        let obliquity = 0.5 * (1.0 + direction.unit.z);
        let scale = size_parameter * size_parameter / TAU * obliquity;
        scale
            * if self.circular {
                Complex64::new(circle(q * self.points[0][0]) * self.area, 0.0)
            } else if q < LINE_UP_TO {
                self.line_integral(qx, qy)
            } else {
                self.two_points(q, direction.phi)
            }
    }

    /// The amplitude with the fading of its edge waves: beyond the penumbra, `θ x^(1/3)` of a few,
    /// grazing reflection and creeping waves take the place of the sharp edge. The fade follows
    /// exact Debye terms of spheres (x = 100, 1000).
    pub fn tail(&self, size_parameter: f64, direction: &Direction) -> Complex64 {
        let penumbra = direction.theta * size_parameter.cbrt() / FADE;
        self.amplitude(size_parameter, direction) / (1.0 + penumbra.powi(2)).powi(2)
    }

    /// The same at several scattering angles of one azimuth, beyond the peak itself.
    pub fn tails(&self, size_parameter: f64, theta: &[f64], phi: f64) -> Vec<Complex64> {
        let (near, far) = (self.support_at(phi), self.support_at(phi + PI));
        let tail = |&theta: &f64| {
            let (sin, cos) = theta.sin_cos();
            let q = size_parameter * sin;
            if self.circular || q < LINE_UP_TO {
                return self.tail(size_parameter, &Direction::new(theta, phi));
            }
            let penumbra = theta * size_parameter.cbrt() / FADE;
            let fade = 1.0 / (1.0 + penumbra.powi(2)).powi(2);
            let scale = size_parameter * size_parameter / TAU * 0.5 * (1.0 + cos);
            scale * fade * between(q, near, far)
        };
        theta.iter().map(tail).collect()
    }

    /// Scattering angle beyond which edge waves are so faint that the rays hide them.
    pub fn farthest(&self, size_parameter: f64) -> f64 {
        // amplitude of the edge wave with its fade against one of the rays, which is of the order x
        const FAINT: f64 = 1e-4;
        let envelope = |theta: f64| {
            let penumbra = theta * size_parameter.cbrt() / FADE;
            (size_parameter * theta.powi(3)).sqrt().recip() / (1.0 + penumbra.powi(2)).powi(2)
        };
        const STEPS: u32 = 180;
        let angles = (1..STEPS).map(|k| PI * f64::from(k) / f64::from(STEPS));
        angles.into_iter().find(|&theta| envelope(theta) < FAINT).unwrap_or(PI)
    }

    /// Difference between the largest and the smallest radius of the outline.
    pub fn deformation(&self) -> f64 {
        let radii = self.points.iter().map(|p| p[0].hypot(p[1]));
        let (low, high) = radii.fold((f64::MAX, 0f64), |(l, h), r| (l.min(r), h.max(r)));
        high - low
    }

    /// `∬ exp(-iq·r) dA` as an integral along the outline; the divergence theorem with a vector
    /// potential along `r` avoids any division by `q`.
    fn line_integral(&self, qx: f64, qy: f64) -> Complex64 {
        // on a smooth periodic curve the sum converges faster than any power past one point a radian
        let needed = (1.2 * qx.hypot(qy) + 64.0) as usize;
        let stride = (POINTS / needed.next_power_of_two()).max(1);
        let step = TAU / POINTS as f64 * stride as f64;
        let mut sum = Complex64::default();
        let outline = self.points.iter().zip(&self.tangents).step_by(stride);
        for (p, t) in outline {
            let phase = qx * p[0] + qy * p[1];
            // ∫₀¹ t exp(-i t φ) dt, times the flux r × dr of the ray from the centre
            sum += ramp(phase) * ((p[0] * t[1] - p[1] * t[0]) * step);
        }
        sum
    }

    /// The two points of stationary phase.
    fn two_points(&self, q: f64, azimuth: f64) -> Complex64 {
        between(q, self.support_at(azimuth), self.support_at(azimuth + PI))
    }

    /// Support, its slope, and radius of curvature where the outline's normal has this azimuth.
    pub fn support_at(&self, azimuth: f64) -> [f64; 3] {
        let place = azimuth.rem_euclid(TAU) / TAU * POINTS as f64;
        let i = place.floor();
        let f = place - i;
        let at = |k: isize| self.support[(i as isize + k).rem_euclid(POINTS as isize) as usize];
        // cubic through four neighbours
        let w = [
            -f * (f - 1.0) * (f - 2.0) / 6.0,
            (f + 1.0) * (f - 1.0) * (f - 2.0) / 2.0,
            -(f + 1.0) * f * (f - 2.0) / 2.0,
            (f + 1.0) * f * (f - 1.0) / 6.0,
        ];
        let mut out = [0.0; 3];
        for (k, weight) in w.iter().enumerate() {
            let value = at(k as isize - 1);
            out = std::array::from_fn(|c| out[c] + weight * value[c]);
        }
        out
    }
}

/// Waves of two points of the outline, each with its support and radius of curvature.
fn between(q: f64, [h1, _, r1]: [f64; 3], [h2, _, r2]: [f64; 3]) -> Complex64 {
    let near = hankel1(q * h1).conj() * (r1 * h1).sqrt();
    let far = hankel1(q * h2) * (r2 * h2).sqrt();
    (near + far) * (PI / q)
}

/// `2 J₁(z)/z`.
fn circle(z: f64) -> f64 {
    if z < 1e-4 { 1.0 - z * z / 8.0 } else { 2.0 * hankel1(z).re / z }
}

/// The Hankel function of an edge's wave over its leading term, `H₁⁽²⁾` for positive `z`, `H₁⁽¹⁾` of
/// `-z` for negative.
pub fn hankel_over_leading_term(z: f64) -> Complex64 {
    let size = z.abs();
    let leading = Complex64::from_polar((2.0 / (PI * size)).sqrt(), size - 0.75 * PI);
    let ratio = hankel1(size) / leading;
    if z > 0.0 { ratio.conj() } else { ratio }
}

/// `H₁⁽¹⁾(z) = J₁ + i Y₁`.
fn hankel1(z: f64) -> Complex64 {
    const LARGE: f64 = 30.0;
    if z < LARGE {
        return Complex64::new(libm::j1(z), libm::y1(z));
    }
    // Abramowitz & Stegun 9.2.7–10: the first terms left out are below 1e-8
    let w = 1.0 / z;
    let (p, q) =
        (1.0 + w * w * (0.1171875 - 0.144195557 * w * w), w * (0.375 - 0.1025390625 * w * w));
    Complex64::from_polar((2.0 * w / PI).sqrt(), z - 0.75 * PI) * Complex64::new(p, q)
}

/// `∫₀¹ t exp(-i t φ) dt`.
pub fn ramp(phase: f64) -> Complex64 {
    if phase.abs() < 1e-2 {
        let p = phase;
        return Complex64::new(
            0.5 - p * p / 8.0 + p.powi(4) / 144.0,
            -p / 3.0 + p.powi(3) / 30.0 - p.powi(5) / 840.0,
        );
    }
    let e = Complex64::cis(-phase);
    let i = Complex64::i();
    (e * (Complex64::new(1.0, 0.0) + i * phase) - 1.0) / (phase * phase)
}

/// Derivative of a smooth periodic function on an even grid of a turn, to tenth order.
fn periodic_derivative(values: &[f64]) -> Vec<f64> {
    const WEIGHTS: [f64; 5] = [5.0 / 6.0, -5.0 / 21.0, 5.0 / 84.0, -5.0 / 504.0, 1.0 / 1260.0];
    let n = values.len();
    let step = TAU / n as f64;
    (0..n)
        .map(|i| {
            WEIGHTS
                .iter()
                .enumerate()
                .map(|(k, w)| w * (values[(i + k + 1) % n] - values[(i + n - k - 1) % n]))
                .sum::<f64>()
                / step
        })
        .collect()
}

/// Support function and its radius of curvature on an even grid of normal azimuths.
fn support(points: &[[f64; 2]], tangents: &[[f64; 2]]) -> Vec<[f64; 3]> {
    // The support function is smooth: h(ν) at its maximum over the outline, by Newton from the grid.
    let n = points.len();
    let values: Vec<f64> = (0..n)
        .map(|k| {
            let (sin, cos) = (k as f64 * TAU / n as f64).sin_cos();
            let height = |i: usize| points[i][0] * cos + points[i][1] * sin;
            let best = (0..n).max_by(|&a, &b| height(a).total_cmp(&height(b))).unwrap_or(0);
            // Maximum of a smooth function from slope and its neighbours' slopes.
            let slope = |i: usize| tangents[i % n][0] * cos + tangents[i % n][1] * sin;
            let (s, bend) =
                (slope(best), (slope(best + 1) - slope(best + n - 1)) / (2.0 * TAU / n as f64));
            height(best) - 0.5 * s * s / bend
        })
        .collect();
    let slope = periodic_derivative(&values);
    let bend = periodic_derivative(&slope);
    values.iter().zip(slope).zip(bend).map(|((h, s), b)| [*h, s, (h + b).max(1e-6)]).collect()
}

#[cfg(test)]
mod tests;
