//! The emitting plane: rays that just cover the silhouette.
//!
//! Polar coordinates `(α, ψ)`: the ray starts at `sin α` of the way from a centre to the
//! silhouette's rim at azimuth ψ. Even steps in α crowd the rays towards the rim, where the exit
//! direction changes like the angle of incidence and not like the distance from the axis.

use crate::shape::Shape;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Distance in α of the last ring from the rim, where differentials have no limit.
const GRAZING: f64 = 1e-4;

/// A polar grid of rays over the silhouette.
#[derive(Clone, Debug)]
pub struct Wavefront {
    /// Rings: values of α in (0, π/2).
    pub rings: Vec<f64>,
    /// Values of ψ, radians, evenly spaced over the full circle.
    pub spokes: Vec<f64>,
    /// Radius of the silhouette on each spoke.
    rim: Vec<f64>,
    area: f64,
}

impl Wavefront {
    /// `ring_count` rings at the midpoints of even steps in α, `spoke_count` spokes.
    pub fn midpoints(shape: &Shape, ring_count: usize, spoke_count: usize) -> Self {
        let silhouette = shape.silhouette();
        let ring = |i: usize| (i as f64 + 0.5) * FRAC_PI_2 / ring_count as f64;
        let spoke = |j: usize| j as f64 * TAU / spoke_count as f64;
        let spokes: Vec<f64> = (0..spoke_count).map(spoke).collect();
        let rim: Vec<f64> = spokes.iter().map(|&psi| silhouette.radius(psi)).collect();
        let area = rim.iter().map(|r| 0.5 * r * r * TAU / spoke_count as f64).sum();
        Self { rings: (0..ring_count).map(ring).collect(), spokes, rim, area }
    }

    /// Place `(u, v)` of the ray on ring `i` and spoke `j`.
    pub fn place(&self, i: usize, j: usize) -> (f64, f64) {
        let rho = self.rim[j] * self.rings[i].sin();
        let (sin, cos) = self.spokes[j].sin_cos();
        (rho * cos, rho * sin)
    }

    /// Spokes of which the others are mirror images, and for how many each stands; all where they are not
    /// even about the plane of the body's axis.
    pub(super) fn half_turn(&self) -> impl Iterator<Item = (usize, f64)> {
        let count = self.spokes.len();
        let even = count.is_multiple_of(2) && self.spokes.first() == Some(&0.0);
        let last = if even { count / 2 } else { count - 1 };
        let alone = move |j: usize| !even || j == 0 || j == last;
        (0..=last).map(move |j| (j, if alone(j) { 1.0 } else { 2.0 }))
    }

    /// Area of the silhouette that the ray on ring `i` and spoke `j` stands for.
    pub fn share(&self, i: usize, j: usize) -> f64 {
        let half = 0.25 * std::f64::consts::PI / self.rings.len() as f64;
        let (low, high) = ((self.rings[i] - half).sin(), (self.rings[i] + half).sin());
        0.5 * self.rim[j].powi(2) * (high * high - low * low) * TAU / self.spokes.len() as f64
    }

    /// A grid whose rays are corners of patches: a centre ray and `ring_count` rings, the last of
    /// which grazes the rim. Azimuths start at `first`.
    pub fn corners(shape: &Shape, ring_count: usize, spoke_count: usize, first: f64) -> Self {
        let silhouette = shape.silhouette();
        let last = FRAC_PI_2 - GRAZING;
        let spoke = |j: usize| first + j as f64 * TAU / spoke_count as f64;
        let spokes: Vec<f64> = (0..spoke_count).map(spoke).collect();
        let rim: Vec<f64> = spokes.iter().map(|&psi| silhouette.radius(psi)).collect();
        let area = rim.iter().map(|r| 0.5 * r * r * TAU / spoke_count as f64).sum();
        let rings = (1..=ring_count).map(|i| i as f64 * last / ring_count as f64).collect();
        Self { rings, spokes, rim, area }
    }

    /// Number of corner rays: the centre and all rings.
    #[allow(clippy::len_without_is_empty)] // a wavefront always has its centre
    pub fn len(&self) -> usize {
        1 + self.rings.len() * self.spokes.len()
    }

    /// Place of corner ray `n`: 0 is the centre, then ring by ring.
    pub fn vertex(&self, n: usize) -> (f64, f64) {
        if n == 0 {
            return (0.0, 0.0);
        }
        let spokes = self.spokes.len();
        self.place((n - 1) / spokes, (n - 1) % spokes)
    }

    /// Triangles between neighbouring corner rays, counter-clockwise, diagonals alternating.
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        let (rings, spokes) = (self.rings.len(), self.spokes.len());
        let number = |i: usize, j: usize| (1 + i * spokes + j % spokes) as u32;
        let mut triangles = Vec::with_capacity(2 * rings * spokes);
        for j in 0..spokes {
            triangles.push([0, number(0, j), number(0, j + 1)]);
            for i in 1..rings {
                let [a, b] = [number(i - 1, j), number(i - 1, j + 1)];
                let [c, d] = [number(i, j), number(i, j + 1)];
                if (i + j) % 2 == 0 {
                    triangles.extend([[a, c, d], [a, d, b]]);
                } else {
                    triangles.extend([[a, c, b], [b, c, d]]);
                }
            }
        }
        triangles
    }

    /// Area of the silhouette in units of the squared radius.
    pub fn area(&self) -> f64 {
        self.area
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn shares_add_up_to_the_shadow() {
        for shape in [Shape::sphere(), Shape::spheroid(0.7, 0.4).unwrap()] {
            let wavefront = Wavefront::midpoints(&shape, 23, 40);
            let shares = (0..23)
                .flat_map(|i| (0..40).map(move |j| (i, j)))
                .map(|(i, j)| wavefront.share(i, j));
            assert!((shares.sum::<f64>() / wavefront.area() - 1.0).abs() < 1e-13);
            assert!((wavefront.area() - shape.silhouette().area()).abs() < 1e-9);
        }
        // a ring's share lies about its rays: the mean of the squared radius is half the area's
        let wavefront = Wavefront::midpoints(&Shape::sphere(), 400, 8);
        let moment: f64 =
            (0..400).map(|i| 8.0 * wavefront.share(i, 0) * wavefront.rings[i].sin().powi(2)).sum();
        assert!((moment / PI - 0.5).abs() < 1e-5, "{moment}");
    }

    /// Mirror images count once, and all spokes where there are none.
    #[test]
    fn half_a_turn_stands_for_all_spokes() {
        for spokes in [4, 5, 100] {
            let wavefront = Wavefront::midpoints(&Shape::sphere(), 3, spokes);
            let sum: f64 = wavefront.half_turn().map(|(_, images)| images).sum();
            assert_eq!(sum, spokes as f64);
            let mean: f64 = wavefront.half_turn().map(|(j, n)| n * wavefront.spokes[j].cos()).sum();
            assert!(mean.abs() < 1e-12, "{spokes}: {mean}");
        }
        let turned = Wavefront::corners(&Shape::sphere(), 3, 8, 0.1);
        assert!(turned.half_turn().eq((0..8).map(|j| (j, 1.0))));
    }

    /// Triangles cover the polygon of the last ring once, all in one sense.
    #[test]
    fn triangles_cover_the_shadow_once() {
        let (rings, spokes) = (5, 12);
        let wavefront = Wavefront::corners(&Shape::sphere(), rings, spokes, 0.3);
        assert_eq!(wavefront.len(), 1 + rings * spokes);
        let triangles = wavefront.triangles();
        assert_eq!(triangles.len(), spokes * (2 * rings - 1));
        let areas: Vec<f64> = triangles
            .iter()
            .map(|t| {
                let [p, q, r] = t.map(|n| wavefront.vertex(n as usize));
                0.5 * ((q.0 - p.0) * (r.1 - p.1) - (q.1 - p.1) * (r.0 - p.0))
            })
            .collect();
        assert!(areas.iter().all(|&area| area > 0.0));
        let last = (FRAC_PI_2 - GRAZING).sin();
        let polygon = 0.5 * spokes as f64 * (TAU / spokes as f64).sin() * last * last;
        assert!((areas.iter().sum::<f64>() - polygon).abs() < 1e-13);
        assert_eq!(wavefront.vertex(0), (0.0, 0.0));
    }
}
