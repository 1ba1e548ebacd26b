//! The silhouette: the outline of the body's shadow, seen along the light.

use super::body::{Body, Shape};
use crate::math::vec3::Vec3;
use std::f64::consts::{PI, TAU};

/// Radius of the shadow's outline about the centre, by azimuth `ψ` in the plane of `(u, v)`.
#[derive(Clone, Debug)]
pub struct Silhouette<'a> {
    shape: &'a Shape,
    /// Radius and slope on an even grid of a turn, where launch points are asked for in masses.
    table: Vec<(f64, f64)>,
}

/// Points of the table: cubic Hermite between them errs by 1e-9.
const TABLE: usize = 256;

impl Shape {
    /// The outline of this shape's shadow.
    pub fn silhouette(&self) -> Silhouette<'_> {
        Silhouette { shape: self, table: Vec::new() }
    }
}

impl Silhouette<'_> {
    /// The same outline from a table: quick, and exact enough to tell where rays start.
    pub fn tabulated(self) -> Self {
        let step = TAU / TABLE as f64;
        let table = (0..TABLE).map(|i| self.radius_and_slope(i as f64 * step)).collect();
        Self { table, ..self }
    }

    /// Radius and slope from the table.
    fn tabulated_radius(&self, azimuth: f64) -> (f64, f64) {
        let place = azimuth.rem_euclid(TAU) / TAU * TABLE as f64;
        let i = place as usize;
        let t = place - i as f64;
        let ((r0, s0), (r1, s1)) = (self.table[i % TABLE], self.table[(i + 1) % TABLE]);
        let h = TAU / TABLE as f64;
        let (d, s0, s1) = (r1 - r0, s0 * h, s1 * h);
        let (c2, c3) = (3.0 * d - 2.0 * s0 - s1, s0 + s1 - 2.0 * d);
        (r0 + t * (s0 + t * (c2 + t * c3)), (s0 + t * (2.0 * c2 + t * 3.0 * c3)) / h)
    }

    /// Radius `ρ` of the outline at azimuth `ψ`: the largest `ρ` for which the line
    /// `(ρ cos ψ, ρ sin ψ, t)` still touches the body.
    ///
    /// Newton's method on `F = 0` and `∂F/∂t = 0` in `(ρ, t)`.
    pub fn radius(&self, azimuth: f64) -> f64 {
        self.radius_and_slope(azimuth).0
    }

    /// The radius, and its derivative with respect to the azimuth.
    pub fn radius_and_slope(&self, azimuth: f64) -> (f64, f64) {
        if !self.table.is_empty() {
            return self.tabulated_radius(azimuth);
        }
        let (sin, cos) = azimuth.sin_cos();
        let along = Vec3 { x: cos, y: sin, z: 0.0 };
        let down = self.shape.down;
        let (mut rho, mut t) = match &self.shape.body {
            // Newton's method from a sphere leads astray on discs and needles.
            Body::Spheroid(spheroid) => spheroid.outline(down.dot(along), down.z),
            Body::Sphere => (1.0, 0.0),
            _ => self.start(along),
        };
        for _ in 0..50 {
            let x = along * rho + Vec3 { x: 0.0, y: 0.0, z: t };
            let (q, z) = (x.dot(x), down.dot(x));
            let s = self.shape.slope(q, z);
            let l = self.shape.level(q, z);
            // first and second derivatives along `along` and the light
            let (ka, kt) = (down.dot(along), down.z);
            let (qa, qt) = (2.0 * rho, 2.0 * t);
            let fa = s.q * qa + s.z * ka;
            let ft = s.q * qt + s.z * kt;
            let ftt = 2.0 * l.q + l.qq * qt * qt + 2.0 * l.qz * qt * kt + l.zz * kt * kt;
            let fat = l.qq * qa * qt + l.qz * (qa * kt + qt * ka) + l.zz * ka * kt;
            let det = fa * ftt - ft * fat;
            let step_rho = (s.f * ftt - ft * ft) / det;
            let step_t = (fa * ft - fat * s.f) / det;
            rho -= step_rho.clamp(-0.3, 0.3);
            t -= step_t.clamp(-0.3, 0.3);
            if step_rho.abs() + step_t.abs() < 1e-15 {
                break;
            }
        }
        // On the contour the gradient has no part along the light: dF = F_along dρ + F_turn ρ dψ.
        let x = along * rho + Vec3 { x: 0.0, y: 0.0, z: t };
        let s = self.shape.slope(x.dot(x), down.dot(x));
        let across = Vec3 { x: -sin, y: cos, z: 0.0 };
        let by_rho = s.q * 2.0 * rho + s.z * down.dot(along);
        let by_turn = s.z * down.dot(across) * rho;
        (rho, -by_turn / by_rho)
    }

    /// Where to start from: next to the outline's point, which on strongly deformed bodies has rivals.
    fn start(&self, along: Vec3<f64>) -> (f64, f64) {
        const GENTLE: f64 = 1.25;
        const POINTS: u32 = 90;
        if self.shape.bounding_radius() < GENTLE {
            return (1.0, 0.0);
        }
        let point = |k: u32| {
            let (sin, cos) = (PI * f64::from(k) / f64::from(POINTS)).sin_cos();
            let radius = self.shape.radius_towards(along.x * sin, along.y * sin, cos);
            (radius * sin, radius * cos)
        };
        (1..POINTS).map(point).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((1.0, 0.0))
    }

    /// Area of the shadow, in units of the square of the radius of equal volume.
    pub fn area(&self) -> f64 {
        let count = 720;
        let step = TAU / count as f64;
        (0..count).map(|i| 0.5 * self.radius(i as f64 * step).powi(2) * step).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::RaindropModel;

    /// The shadow of a spheroid is an ellipse of half axes h and `√(v² cos² e + h² sin² e)`.
    #[test]
    fn the_shadow_of_a_spheroid_is_an_ellipse() {
        let (ratio, elevation): (f64, f64) = (0.7, 0.5);
        let (h, v) = (ratio.powf(-1.0 / 3.0), ratio.powf(2.0 / 3.0));
        let upward = (v * elevation.cos()).hypot(h * elevation.sin());
        let shape = Shape::spheroid(ratio, elevation).unwrap();
        let silhouette = shape.silhouette();
        for k in 0..20 {
            let (sin, cos) = (0.33 * f64::from(k)).sin_cos();
            let expected = ((cos / upward).powi(2) + (sin / h).powi(2)).sqrt().recip();
            assert!((silhouette.radius(0.33 * f64::from(k)) - expected).abs() < 1e-13, "{k}");
        }
        assert!((silhouette.area() - PI * h * upward).abs() < 1e-12);
        assert!((Shape::sphere().silhouette().area() - PI).abs() < 1e-12);
    }

    #[test]
    fn slopes_and_the_table_follow_the_radius() {
        const H: f64 = 1e-5;
        let shape = Shape::raindrop(2e-3, RaindropModel::BeardChuang1987, 0.4).unwrap();
        let (exact, table) = (shape.silhouette(), shape.silhouette().tabulated());
        for k in 0..25 {
            let azimuth = -1.0 + 0.31 * f64::from(k);
            let (radius, slope) = exact.radius_and_slope(azimuth);
            let by_steps = (exact.radius(azimuth + H) - exact.radius(azimuth - H)) / (2.0 * H);
            assert!((slope - by_steps).abs() < 1e-9, "{azimuth}: {slope} {by_steps}");
            let (r, s) = table.radius_and_slope(azimuth);
            assert!(
                (r - radius).abs() < 1e-8 && (s - slope).abs() < 1e-5,
                "{azimuth}: {r} {radius}"
            );
        }
    }
}
