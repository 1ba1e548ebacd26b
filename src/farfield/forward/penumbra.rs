//! The edge wave: diffraction and grazing reflection (order 0) joined into one.
//!
//! Near the shadow's edge neither holds alone: the edge is soft over a wave zone `x^{-2/3}`, which
//! is 2 to 5 % of the forward amplitude at x = 1000 to 100, and from `θ ≈ x^{-1/3}` on diffraction
//! fades while reflection sets in. Each point of the outline contributes its sharp edge (the shadow
//! itself, [`ForwardDiffraction`]) and `E` of its `edge_profile`: near the axis as an
//! integral along the outline, farther out as the waves of the two points whose normals lie in the
//! scattering plane. Rays well inside the edge stay with the plane's plain segments.

use super::diffraction::{ForwardDiffraction, hankel_over_leading_term, ramp};
use super::penumbra_layout::Layout;
use super::penumbra_profile::{Edge, PenumbraProfile, Values};
use crate::farfield::branch::knots::{Kind, Knot, Segment, SingleKnot};
use crate::farfield::branch::window::Window;
use crate::farfield::deflection::scattering_plane::ScatteringPlane;
use crate::farfield::direction::Direction;
use crate::math::gauss_legendre;
use crate::math::half_turn::shares;
use crate::math::parallel::*;
use crate::optics::{AmplitudeMatrix, Grazing, fresnel};
use crate::trace::Tracer;
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_4, PI, TAU};

/// A point of the outline in the integral near the axis.
#[derive(Clone, Debug)]
struct OutlinePoint {
    normal: [f64; 2],
    edge: Edge,
    /// Slope of the support by the normal's azimuth, length of outline.
    slope: f64,
    length: f64,
    /// Perpendicular and parallel E at the knots, and their slopes.
    knots: Vec<[Complex64; 4]>,
}

/// The edge wave of one particle and wavelength.
#[derive(Clone, Debug)]
pub struct Penumbra {
    layout: Layout,
    /// By azimuth of the normal, even over a half-turn, both ends in; one where all are equal.
    profiles: Vec<PenumbraProfile>,
    outline: Vec<OutlinePoint>,
}

/// Profiles per half-turn, and neighbours in the interpolation between them.
const HALF_TURN_STEPS: usize = 20;
const STENCIL: usize = 6;
/// Points of the outline in the integral near the axis: enough for 20 lobes.
const OUTLINE_POINTS: usize = 160;

impl Penumbra {
    /// `None` where a reflected ray near the edge is missing.
    pub fn new(tracer: &Tracer, shadow: &ForwardDiffraction, size_parameter: f64) -> Option<Self> {
        let layout = Layout::new(size_parameter);
        let silhouette = tracer.shape().silhouette().tabulated();
        let last = if tracer.shape().rotational_symmetry() { 0 } else { HALF_TURN_STEPS };
        let profile = |j: usize| {
            let azimuth = PI * j as f64 / last.max(1) as f64;
            let plane = ScatteringPlane::new(tracer, 0, azimuth, [0.0; 2]);
            let [_, _, outline_radius] = shadow.support_at(azimuth);
            PenumbraProfile::new(&plane, &silhouette, &layout, outline_radius)
        };
        let profiles = (0..=last).into_par_iter().map(profile).collect::<Option<Vec<_>>>()?;
        let mut wave = Self { layout, profiles, outline: Vec::new() };
        wave.outline = (0..OUTLINE_POINTS).map(|k| wave.outline_point(shadow, k)).collect();
        Some(wave)
    }

    /// The weight with which the integral stands for the ray of an exit angle.
    pub fn taper(&self) -> Window {
        self.layout.taper
    }

    fn outline_point(&self, shadow: &ForwardDiffraction, k: usize) -> OutlinePoint {
        let azimuth = TAU * k as f64 / OUTLINE_POINTS as f64;
        let [support, slope, radius] = shadow.support_at(azimuth);
        let profile = self.profile(azimuth);
        let ends = |[v, s]: &[Values; 2]| [v[2], v[3], s[2], s[3]];
        OutlinePoint {
            normal: [azimuth.cos(), azimuth.sin()],
            edge: Edge { support, ..profile.edge },
            slope,
            length: radius * TAU / OUTLINE_POINTS as f64,
            knots: profile.knots[..self.layout.about_axis].iter().map(ends).collect(),
        }
    }

    /// The profile of any azimuth of the normal.
    fn profile(&self, azimuth: f64) -> PenumbraProfile {
        if self.profiles.len() == 1 {
            return self.profiles[0].clone();
        }
        let knots = vec![[[Complex64::default(); 4]; 2]; self.layout.angles.len()];
        let mut sum = PenumbraProfile { edge: Edge::default(), outline_radius: 0.0, knots };
        for share in shares::<STENCIL>(azimuth, self.profiles.len()) {
            let (weight, from) = (share.weight, &self.profiles[share.index]);
            sum.edge.support += weight * from.edge.support;
            sum.edge.depth += weight * from.edge.depth;
            sum.edge.radius += weight * from.edge.radius;
            sum.outline_radius += weight * from.outline_radius;
            for (to, from) in
                sum.knots.iter_mut().flatten().flatten().zip(from.knots.iter().flatten().flatten())
            {
                *to += from * weight;
            }
        }
        sum
    }

    /// The whole wave near the axis, sharp shadow and soft edge, as an integral along the outline.
    pub fn near_axis(&self, direction: &Direction) -> AmplitudeMatrix {
        let (theta, phi) = (direction.theta, direction.phi);
        let x = self.layout.size_parameter;
        let ((sin_phi, cos_phi), (sin_theta, cos_theta)) = (phi.sin_cos(), theta.sin_cos());
        let mut shadow = Complex64::default();
        let mut sum = AmplitudeMatrix::default();
        for point in &self.outline {
            let [nx, ny] = point.normal;
            let (cos, sin) = (nx * cos_phi + ny * sin_phi, ny * cos_phi - nx * sin_phi);
            let [perpendicular, parallel] = self.edge_at(point, theta * cos);
            let edge = &point.edge;
            let aside = (edge.support - edge.radius) * cos - point.slope * sin;
            let path =
                -edge.radius * theta * cos - aside * sin_theta + edge.depth * (1.0 - cos_theta);
            shadow += ramp(-x * path) * (edge.support * point.length);
            let wave = Complex64::cis(x * path) * point.length;
            let (a, b) = (perpendicular * wave, parallel * wave);
            sum.s1 += a * (cos * cos) + b * (sin * sin);
            sum.s2 += b * (cos * cos) + a * (sin * sin);
            let cross = (a - b) * (sin * cos);
            sum.s3 += cross;
            sum.s4 += cross;
        }
        sum.s1 += shadow;
        sum.s2 += shadow;
        sum * Complex64::from(x * x / TAU * widening(theta))
    }

    /// E of a point of the outline, perpendicular and parallel, at an angle along its normal.
    fn edge_at(&self, point: &OutlinePoint, angle: f64) -> [Complex64; 2] {
        let layout = &self.layout;
        let (from, h) = (layout.angles[0], layout.angles[1] - layout.angles[0]);
        let place = ((angle - from) / h).clamp(0.0, (layout.about_axis - 1) as f64);
        let k = (place as usize).min(layout.about_axis - 2);
        let t = place - k as f64;
        let (a, b) = (&point.knots[k], &point.knots[k + 1]);
        let u = 1.0 - t;
        let w = [(1.0 + 2.0 * t) * u * u, t * u * u * h, t * t * (3.0 - 2.0 * t), -t * t * u * h];
        let carrier = Complex64::cis(-layout.size_parameter * layout.shift * angle);
        [0, 1].map(|e| (a[e] * w[0] + a[e + 2] * w[1] + b[e] * w[2] + b[e + 2] * w[3]) * carrier)
    }

    /// What a medium of this index absorbs more than rays tell, in units of the squared radius:
    /// waves beyond the edge tunnel in and stay for many rounds, those just inside enter otherwise
    /// than at a flat interface. Rounds on the circle along the light; powers added, as they are on
    /// average over resonances.
    pub fn absorption(&self, index: Complex64) -> f64 {
        const ZONES_INSIDE: f64 = 30.0;
        const ZONES_BEYOND: f64 = 6.0;
        const NODES: usize = 48;
        /// Points of the outline skipped: what is summed varies slowly along it.
        const STRIDE: usize = 8;
        let nodes = gauss_legendre::nodes(NODES);
        let x = self.layout.size_parameter;
        let at = |edge: &Edge| {
            let size = x * edge.radius;
            let zone = 0.5 * (2.0 / size).powf(2.0 / 3.0);
            let share = |cos: f64| {
                let square = 1.0 - cos * cos;
                let chord = 2.0 * edge.radius * (1.0 - (cos / index.re).powi(2)).max(0.0).sqrt();
                let lost = -(-2.0 * x * index.im * chord).exp_m1();
                let absorbed = |reflected: f64| {
                    let entering = (1.0 - reflected).max(0.0);
                    // all rounds: 1 - reflected (1 - lost) below; nothing enters under total reflection
                    if lost == 0.0 {
                        0.0
                    } else {
                        entering * lost / (lost + entering * (1.0 - lost))
                    }
                };
                let wave = Grazing::reflection(square, size, index).map(|r| absorbed(r.norm_sqr()));
                let rays = if cos < 1.0 {
                    let flat = fresnel(square.sqrt(), index);
                    [flat.r_perpendicular, flat.r_parallel].map(|r| absorbed(r.norm_sqr()))
                } else {
                    [0.0; 2]
                };
                0.5 * (wave[0] + wave[1] - rays[0] - rays[1])
            };
            let inside = (1.0 - ZONES_INSIDE * zone).max(0.0);
            let beyond = (1.0 + ZONES_BEYOND * zone).min(index.re.max(1.0));
            let integral = |from: f64, to: f64| -> f64 {
                let half = 0.5 * (to - from);
                // closer to the edge, where the square root of the grazing angle's square begins
                nodes.iter().fold(0.0, |sum, (node, weight)| {
                    let t = 0.5 * (1.0 + node);
                    let near = if from < 1.0 { 1.0 - (1.0 - t).powi(2) } else { t * t };
                    let rate = if from < 1.0 { 2.0 * (1.0 - t) } else { 2.0 * t };
                    sum + weight * half * rate * share(from + 2.0 * half * near)
                })
            };
            edge.radius * (integral(inside, 1.0) + integral(1.0, beyond))
        };
        let points = self.outline.iter().step_by(STRIDE);
        points.map(|point| STRIDE as f64 * point.length * at(&point.edge)).sum()
    }

    /// The whole edge wave beyond the axis, sharp shadow included, on the plane of an azimuth:
    /// a segment on the side of its edge, and one across the axis. Knots are the same for all.
    pub fn segments(&self, azimuth: f64) -> Vec<Segment> {
        let profile = self.profile(azimuth);
        let (begin, middle) =
            (self.layout.about_axis, self.layout.about_axis + self.layout.near_side);
        let sides = [begin..middle, middle..self.layout.angles.len()];
        let segment = |knots: std::ops::Range<usize>| Segment {
            kind: Kind::Wave,
            knots: knots.map(|k| self.knot(&profile, k)).collect(),
        };
        sides.into_iter().filter(|side| !side.is_empty()).map(segment).collect()
    }

    /// The wave of a point of the outline at knot `k`, against that of the ray reflected there (on
    /// the dark side, of a ray along the edge).
    fn knot(&self, profile: &PenumbraProfile, k: usize) -> Knot {
        let x = self.layout.size_parameter;
        let angle = self.layout.angles[k];
        let (edge, shift) = (&profile.edge, self.layout.shift);
        let i = Complex64::i();
        // the sharp shadow: ∫ exp(-ixdϑ) dd up to the edge
        let sharp = i / (x * angle) * hankel_over_leading_term(x * angle * edge.support);
        let carrier = Complex64::cis(-x * shift * angle);
        let [value, slope] = &profile.knots[k];
        let (sin, cos) = angle.sin_cos();
        let scale = x / TAU * (TAU * profile.outline_radius / (x * sin.abs())).sqrt();
        let factor = Complex64::cis(FRAC_PI_4 * angle.signum()) * scale;
        let ([path, path_slope], [reference, reference_slope]) =
            (edge.path(angle), edge.reflected_path(angle));
        let turned = Complex64::cis(x * (path - reference));
        let mut knot = SingleKnot {
            angle,
            path: reference,
            path_slope: reference_slope,
            ..SingleKnot::default()
        };
        for e in 0..2 {
            let rate = slope[e] - i * x * shift * value[e];
            let value = value[e] * carrier + sharp;
            let rate = rate * carrier - sharp / angle
                + value * (i * x * (path_slope - reference_slope) - 0.5 * cos / sin);
            knot.amplitudes[e] = value * factor * turned;
            knot.rates[e] = rate * factor * turned;
        }
        knot.into()
    }
}

/// `√(θ/sin θ)`: waves that leave a ring on a sphere of directions instead of a plane (Hilb's
/// formula for Legendre functions); bounded towards θ = π, where the edge wave has died away.
fn widening(theta: f64) -> f64 {
    if theta < 1e-6 { 1.0 } else { (theta / theta.sin().max(0.2 * theta)).sqrt() }
}

#[cfg(test)]
mod tests {
    use super::super::penumbra_layout::near_axis;
    use super::*;
    use crate::farfield::branch::accumulate::add_segment;
    use crate::farfield::branch::samples::{Samples, Side, Sums};
    use crate::series::debye::{DebyeSeries, Term};
    use crate::shape::Shape;

    /// The wave about the axis is the Debye series' shadow and external reflection; of a
    /// sphere it has no S3 and S4, in any plane.
    #[test]
    fn near_the_axis_it_is_shadow_and_reflection_of_the_series() {
        let (x, index) = (500.0, Complex64::new(1.333, 0.0));
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, index, x, 0);
        let wave = Penumbra::new(&tracer, &ForwardDiffraction::new(&shape), x).unwrap();
        let theta = [0.0, 0.002, 0.01, 0.05];
        let exact =
            DebyeSeries::new(x, index).unwrap().sum(&[Term::Diffraction, Term::Order(0)], &theta);
        for (theta, (s1, s2)) in theta.into_iter().zip(exact) {
            let found = wave.near_axis(&Direction::new(theta, 0.8));
            // the peak falls off like a disc's
            let size = 0.5 * x * x / (1.0 + x * theta).powf(1.5);
            assert!((found.s1 - s1).norm() < 2e-3 * size, "{theta}: {} {s1}", found.s1);
            assert!((found.s2 - s2).norm() < 2e-3 * size, "{theta}: {} {s2}", found.s2);
            assert!(found.s3.norm() + found.s4.norm() < 1e-6 * size, "{theta}");
        }
    }

    /// Where the segments of a plane begin they are the integral along the outline: the waves of the near edge
    /// and of the far one.
    #[test]
    fn segments_go_on_from_the_axis() {
        let x = 2000.0;
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, 1.333.into(), x, 0);
        let wave = Penumbra::new(&tracer, &ForwardDiffraction::new(&shape), x).unwrap();
        // the first is the end of the integral along the outline, the others span a fringe
        let edge = near_axis(x);
        let theta: Vec<f64> = (0..20).map(|k| edge * (1.0 + 1e-6 + 0.003 * f64::from(k))).collect();
        let samples = Samples::new(&theta);
        let mut sums = Sums::new(&samples);
        for segment in wave.segments(0.0) {
            for side in [Side::Near, Side::Far] {
                add_segment(&mut sums, &samples, &segment, side, x);
            }
        }
        let found = sums.amplitudes();
        let size = found.iter().map(|s| s.s1.norm()).fold(0.0, f64::max);
        let whole = wave.near_axis(&Direction::new(theta[0], 0.0));
        assert!((found[0].s1 - whole.s1).norm() < 2e-3 * size, "{} {}", found[0].s1, whole.s1);
        assert!((found[0].s2 - whole.s2).norm() < 2e-3 * size, "{} {}", found[0].s2, whole.s2);
    }

    /// Rings on a sphere of directions are wider than on a plane.
    #[test]
    fn waves_widen_towards_the_equator() {
        assert_eq!(widening(0.0), 1.0);
        assert!((widening(1.0) - (1.0 / 1.0f64.sin()).sqrt()).abs() < 1e-15);
        assert!((widening(PI) - 5f64.sqrt()).abs() < 1e-12);
    }

    /// A clear medium absorbs nothing; a dyed one more than its rays tell, less and less so for large
    /// particles.
    #[test]
    fn waves_beyond_the_edge_are_absorbed_too() {
        let more = |x: f64, k: f64| {
            let index = Complex64::new(1.333, k);
            let shape = Shape::sphere();
            let tracer = Tracer::new(&shape, index, x, 0);
            let shadow = ForwardDiffraction::new(&shape);
            Penumbra::new(&tracer, &shadow, x).unwrap().absorption(index)
        };
        assert_eq!(more(500.0, 0.0), 0.0);
        let (small, large) = (more(500.0, 1e-3), more(5000.0, 1e-4));
        assert!(small > large && large > 0.0 && small < 0.1 * PI, "{small} {large}");
    }
}
