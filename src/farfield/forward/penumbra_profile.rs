//! How the edge of the shadow scatters at one azimuth of its normal: what a wave loses of itself by
//! distance from the edge, and the transform of that over scattering angles.
//!
//! Of a wave that passes at impact `β` the particle takes `1 - R(β)` out of the forward direction:
//! inside the edge `β = h` the whole wave, of which external reflection (order 0) returns `R`;
//! beyond it what tunnels in. The sharp shadow takes 1 inside and 0 beyond. The difference,
//! `E(ϑ) = ∫ [1 - R e^{ixL} - sharp] exp(-ix(β - h)ϑ) dβ`, is what joins diffraction and grazing
//! reflection. `R` is that of the curved surface ([`Grazing::reflection`]), analytic through the
//! edge; `L` (zero for a sphere) and the spreading are polynomials through real rays. In the Debye
//! series this is the sum of the terms "diffraction" and "p = 0" (Nussenzveig 1969, sec. 4).

use super::penumbra_layout::Layout;
use crate::farfield::branch::window::Window;
use crate::farfield::deflection::scattering_plane::ScatteringPlane;
use crate::farfield::impact_integral::integrand::Integrand;
use crate::math::chebyshev::{self, Chebyshev};
use crate::math::interpolate::lagrange;
use crate::optics::Grazing;
use crate::shape::Silhouette;
use crate::trace::Exit;
use num_complex::Complex64;

/// Values of `E` (or its slopes by angle): perpendicular and parallel to the plane of the normal,
/// for the wave of one point of the outline (√ of the spreading), then for a line of points.
pub(crate) type Values = [Complex64; 4];

/// Where the edge lies at one normal.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Edge {
    /// Distance from the centre along the normal (support of the outline).
    pub support: f64,
    /// Depth along the light.
    pub depth: f64,
    /// Radius of curvature of the surface along the light.
    pub radius: f64,
}

impl Edge {
    /// Path of the edge's wave at an angle in the plane of the normal, and its slope: around the
    /// circle that touches the edge along the light, from where that circle lies.
    pub(crate) fn path(&self, angle: f64) -> [f64; 2] {
        let (sin, cos) = angle.sin_cos();
        let aside = self.support - self.radius;
        let path = -self.radius * angle - aside * sin + self.depth * (1.0 - cos);
        [path, -self.radius - aside * cos + self.depth * sin]
    }

    /// The same for the ray that the circle reflects by a positive angle.
    pub(crate) fn reflected_path(&self, angle: f64) -> [f64; 2] {
        let [path, slope] = self.path(angle);
        if angle < 0.0 {
            return [path, slope];
        }
        let half = 0.5 * angle;
        let (chord, rate) = (2.0 * half.sin(), half.cos());
        [path + self.radius * (angle - chord), slope + self.radius * (1.0 - rate)]
    }
}

/// `E` of one normal, at the angles of the layout, against the carrier `exp(-ix shift ϑ)`.
#[derive(Clone, Debug)]
pub(crate) struct PenumbraProfile {
    pub edge: Edge,
    /// Radius of curvature of the outline, as the light sees it.
    pub outline_radius: f64,
    pub knots: Vec<[Values; 2]>,
}

/// Grazing sine over `√v`, path L over `v²`, spreading over the cosine: by `√v`.
type Channels = Chebyshev<3>;

/// Real rays through which the polynomials pass, and the polynomials' degree.
const RAYS: usize = 16;
const DEGREE: usize = 7;
/// Share of the grazing sines that is left out next to the edge.
const SPARE: f64 = 0.14;
/// Wave zones from the edge over which ray data come to hold.
const RAYS_HOLD: Window = Window { start: 0.0, full: 4.0 };

impl PenumbraProfile {
    /// For an outline of this radius of curvature there, as the light sees it. `None` where a
    /// reflected ray is missing, or nothing finite comes out.
    pub(crate) fn new(
        plane: &ScatteringPlane,
        silhouette: &Silhouette,
        layout: &Layout,
        outline_radius: f64,
    ) -> Option<Self> {
        let x = layout.size_parameter;
        let edge = edge_of(plane, silhouette)?;
        let channels = channels(plane, silhouette, layout, &edge)?;
        let integrand =
            integrand(&channels, [edge.radius, outline_radius], plane.tracer.index(), layout)?;
        let knot = |&angle: &f64| {
            let sums = integrand.sum(angle, -layout.shift * angle, x);
            let slope = |e: usize| -Complex64::i() * x * (sums[1][e] - layout.shift * sums[0][e]);
            [sums[0], std::array::from_fn(slope)]
        };
        let knots: Vec<[Values; 2]> = layout.angles.iter().map(knot).collect();
        let finite = knots.iter().flatten().flatten().all(|v| v.is_finite());
        finite.then_some(Self { edge, outline_radius, knots })
    }
}

/// Rays reflected in one plane, found one after the other from large angles to small.
struct Reflections<'m, 'a> {
    plane: &'m ScatteringPlane<'a>,
    silhouette: &'m Silhouette<'m>,
    /// Launch azimuth of the ray before, and its share of the way to the rim over that of a sphere.
    azimuth: f64,
    share: f64,
}

impl<'m, 'a> Reflections<'m, 'a> {
    fn new(plane: &'m ScatteringPlane<'a>, silhouette: &'m Silhouette<'m>) -> Self {
        Self { plane, silhouette, azimuth: plane.azimuth, share: 1.0 }
    }

    /// The launch point and the ray reflected by an angle.
    fn at(&mut self, angle: f64) -> Option<([f64; 2], Exit<f64>)> {
        let cos = (0.5 * angle).cos();
        let rim = |azimuth: f64| self.silhouette.radius(azimuth);
        let reach = rim(self.azimuth) * (self.share * cos).min(0.5 + 0.5 * cos);
        let (sin_a, cos_a) = self.azimuth.sin_cos();
        let ([u, v], exit) = self.plane.aim(angle, [reach * cos_a, reach * sin_a])?;
        self.azimuth = v.atan2(u);
        self.share = u.hypot(v) / rim(self.azimuth) / cos;
        Some(([u, v], exit))
    }
}

/// Where the edge lies: no ray touches it, so that those close by must tell.
fn edge_of(plane: &ScatteringPlane, silhouette: &Silhouette) -> Option<Edge> {
    const STEP: f64 = 0.08;
    let mut rays = Reflections::new(plane, silhouette);
    let mut meetings = Vec::new();
    let mut points = [const { Vec::new() }; 3];
    for k in (1..=6).rev() {
        let angle = STEP * f64::from(k);
        let ([u, v], exit) = rays.at(angle)?;
        plane.tracer.trace_with_meetings(u, v, 0, &mut meetings)?;
        let impact = exit.reference.dot(plane.frame(angle).1);
        let depth = plane.tracer.shape().entry(u, v)?;
        for (points, value) in points.iter_mut().zip([impact, depth, meetings.first()?.radius]) {
            points.push((angle, value));
        }
    }
    let [support, depth, radius] = points.map(|points| lagrange(&points, 0.0));
    Some(Edge { support, depth, radius })
}

/// A reflected ray seen from the centre of the circle that touches the edge along the light.
struct Seen {
    /// Impact over the circle's radius.
    cos: f64,
    /// Path `W + βϑ` over that of the circle.
    path: f64,
    spreading: f64,
}

impl Seen {
    fn new(plane: &ScatteringPlane, edge: &Edge, angle: f64, exit: &Exit<f64>) -> Self {
        let aside = edge.support - edge.radius;
        let (_, growing) = plane.frame(angle);
        let (sin, cos) = angle.sin_cos();
        let impact = exit.reference.dot(growing) - aside * cos + edge.depth * sin;
        let path = exit.path + aside * sin + edge.depth * (cos - 1.0) + impact * angle;
        let cos_equal = impact / edge.radius;
        let sin_equal = (1.0 - cos_equal * cos_equal).max(0.0).sqrt();
        let turned = aside * sin + edge.depth * cos;
        let moved = |k: usize| exit.dx[k].dot(growing) + turned * exit.ds[k].dot(growing);
        let across = |k: usize| exit.ds[k].dot(plane.across());
        let minor = moved(0) * across(1) - moved(1) * across(0);
        let outside = 2.0 * edge.radius * Grazing::path_outside(sin_equal);
        Self { cos: cos_equal, path: path + outside, spreading: sin / minor.abs() }
    }
}

/// Real rays by `√v`, the grazing sine on the circle at the same impact.
fn channels(
    plane: &ScatteringPlane,
    silhouette: &Silhouette,
    layout: &Layout,
    edge: &Edge,
) -> Option<Channels> {
    let mut rays = Reflections::new(plane, silhouette);
    let mut seen = |angle: f64| Some(Seen::new(plane, edge, angle, &rays.at(angle)?.1));
    let sine_on_circle = |ray: &Seen| (1.0 - ray.cos * ray.cos).sqrt();
    let deepest = sine_on_circle(&seen(2.0 * layout.taper.start.acos())?);
    let (from, to) = (SPARE * deepest, deepest);
    let mut values = Vec::with_capacity(RAYS);
    for wanted in chebyshev::points(RAYS, from, to).into_iter().rev() {
        // the angle whose ray has this sine: a few steps from that on a sphere
        let mut sine = wanted;
        let mut ray = seen(2.0 * sine.min(1.0).asin())?;
        for _ in 0..2 {
            sine *= wanted / sine_on_circle(&ray);
            ray = seen(2.0 * sine.min(1.0).asin())?;
        }
        values.push([sine / wanted, ray.path / wanted.powi(4), ray.spreading / ray.cos]);
    }
    values.reverse();
    Some(Chebyshev::fit(&values, from, to).truncated(DEGREE))
}

/// The integrand on Gauss–Legendre nodes of both sides of the edge.
fn integrand(
    channels: &Channels,
    [radius, outline_radius]: [f64; 2],
    index: Complex64,
    layout: &Layout,
) -> Option<Integrand> {
    let x = layout.size_parameter;
    let mut integrand = Integrand::with_capacity(256);
    for &(cos, width) in &layout.nodes {
        let v = 1.0 - cos * cos;
        let ([ratio, path, spreading], _) = channels.at(v.max(0.0).sqrt());
        let square = if v > 0.0 { (v * ratio * ratio).min(1.0) } else { v };
        let weight = layout.taper.weight((1.0 - square).sqrt()) * width * radius;
        // within a wave zone of the edge ray data do not hold, nor would they be the same for
        // the reversed path; there the circle and the outline are all that counts
        let real = RAYS_HOLD.weight(v * (0.5 * x * radius).powf(2.0 / 3.0));
        let spread = cos * (1.0 + real * (spreading / outline_radius - 1.0)).max(0.0);
        let elements = |[a, b]: [Complex64; 2], spread: f64| {
            [a * spread.sqrt(), b * spread.sqrt(), a * spread, b * spread]
        };
        let wave = Complex64::cis(x * v * v * path * real) * -weight;
        let kept = elements(Grazing::reflection(v, x * radius, index).map(|r| r * wave), spread);
        if !kept.iter().all(|v| v.is_finite()) {
            return None;
        }
        let impact = radius * (cos - 1.0);
        integrand.push(impact, 0.0, kept);
        if cos > 1.0 {
            integrand.push(impact, 0.0, elements([weight.into(); 2], cos));
        }
    }
    integrand.fill_lanes();
    Some(integrand)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;
    use crate::trace::Tracer;

    /// Where the edge of a spheroid lies, seen from the side: half axes and radii of curvature of its
    /// ellipses.
    #[test]
    fn edges_of_spheroids_are_known() {
        let ratio: f64 = 0.85;
        let (h, v) = (ratio.powf(-1.0 / 3.0), ratio.powf(2.0 / 3.0));
        let (sphere, flat) = (Shape::sphere(), Shape::spheroid(ratio, 0.0).unwrap());
        for (shape, azimuth, support, radius) in [
            (&sphere, 0.4, 1.0, 1.0),
            (&flat, 0.0, v, h * h / v),
            (&flat, std::f64::consts::FRAC_PI_2, h, h),
        ] {
            let tracer = Tracer::new(shape, 1.333.into(), 100.0, 0);
            let plane = ScatteringPlane::new(&tracer, 0, azimuth, [0.0; 2]);
            let edge = edge_of(&plane, &shape.silhouette()).unwrap();
            assert!((edge.support - support).abs() < 1e-6, "{edge:?} {support}");
            assert!((edge.radius - radius).abs() < 1e-6, "{edge:?} {radius}");
            assert!(edge.depth.abs() < 1e-6, "{edge:?}");
        }
    }

    #[test]
    fn paths_have_their_slopes_and_a_sphere_s_are_known() {
        const H: f64 = 1e-6;
        let edge = Edge { support: 1.1, depth: -0.2, radius: 0.9 };
        for angle in [-0.5, 0.3, 1.2] {
            for path in [Edge::path, Edge::reflected_path] {
                let ([before, _], [after, _]) = (path(&edge, angle - H), path(&edge, angle + H));
                assert!(((after - before) / (2.0 * H) - path(&edge, angle)[1]).abs() < 1e-9);
            }
        }
        let sphere = Edge { support: 1.0, depth: 0.0, radius: 1.0 };
        assert!((sphere.path(0.4)[0] + 0.4).abs() < 1e-15);
        assert!((sphere.reflected_path(0.4)[0] + 2.0 * 0.2f64.sin()).abs() < 1e-15);
    }

    /// From the centre of the circle that touches the edge the rays of a sphere have impact
    /// `cos θ/2`, no path of their own, and the spreading of their impact.
    #[test]
    fn rays_of_a_sphere_are_the_circle_s() {
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, 1.333.into(), 100.0, 0);
        let plane = ScatteringPlane::new(&tracer, 0, 0.0, [0.0; 2]);
        let silhouette = shape.silhouette();
        let edge = Edge { support: 1.0, depth: 0.0, radius: 1.0 };
        let mut rays = Reflections::new(&plane, &silhouette);
        for angle in [1.0, 0.5, 0.2f64] {
            let (_, exit) = rays.at(angle).unwrap();
            let seen = Seen::new(&plane, &edge, angle, &exit);
            assert!((seen.cos - (0.5 * angle).cos()).abs() < 1e-12);
            // W = -2 sin θ/2, and L = W + βθ + 2 (sin γ - γ cos γ) = 0
            assert!(seen.path.abs() < 1e-12, "{}", seen.path);
            assert!((seen.spreading - seen.cos).abs() < 1e-11, "{}", seen.spreading);
        }
        let layout = Layout::new(1000.0);
        let channels = channels(&plane, &silhouette, &layout, &edge).unwrap();
        let ([ratio, path, spreading], _) = channels.at(0.3);
        assert!((ratio - 1.0).abs() + path.abs() + (spreading - 1.0).abs() < 1e-7);
    }
}
