//! Fourier transform of a flat convex polygon, `F(q) = ∫ exp(i q·r) d²r`, for real and complex `q`.
//!
//! By the divergence theorem a sum over edges, `F = (i|q|²)⁻¹ Σ (q̄ × e) exp(i q·m) sinc(q·e/2)`, `m` an edge's
//! middle; near `q = 0`, where that cancels, by moments of triangles (Wuttke, J. Appl. Cryst. 54, 580, 2021).
//! With `q̄` in place of `q` it holds for complex `q`, whose own square may vanish.
//!
//! ```
//! use gonio::facets::polygon::{Polygon, real};
//!
//! let square = Polygon::new(&[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]);
//! let expected = 4.0 * 3.0f64.sin() / 3.0;
//! assert!((square.transform(real([3.0, 0.0])).re - expected).abs() < 1e-14);
//! ```

use num_complex::Complex64;

/// Corners in the plane, anticlockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    corners: Vec<[f64; 2]>,
    radius: f64,
}

/// Below this `|q|` times the polygon's radius the sum over edges loses digits, and moments are taken.
pub(super) const SMALL: f64 = 0.2;
/// Moments that leave less than 1e-16 below [`SMALL`].
const MOMENTS: usize = 11;
/// Half phase along an edge below which `sin h / h` is taken by its series.
pub(super) const SHORT: f64 = 0.05;

/// A real `q` as a complex one.
pub fn real(q: [f64; 2]) -> [Complex64; 2] {
    q.map(Complex64::from)
}

/// `tan h / h` for a small half phase.
#[inline(always)]
pub(super) fn tangent_series<T>(h2: T) -> T
where
    T: Copy
        + std::ops::Mul<Output = T>
        + std::ops::Mul<f64, Output = T>
        + std::ops::Add<f64, Output = T>,
{
    let tail = h2 * (62.0 / 2835.0) + 17.0 / 315.0;
    h2 * (h2 * (h2 * tail + 2.0 / 15.0) + 1.0 / 3.0) + 1.0
}

impl Polygon {
    /// Of corners about the point that phases refer to.
    pub fn new(corners: &[[f64; 2]]) -> Self {
        let radius = corners.iter().map(|c| c[0].hypot(c[1])).fold(0.0, f64::max);
        Self { corners: corners.to_vec(), radius }
    }

    /// Its corners.
    pub fn corners(&self) -> &[[f64; 2]] {
        &self.corners
    }

    /// Largest distance of a corner from the origin.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    fn edges(&self) -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
        let c = &self.corners;
        (0..c.len()).map(|j| (c[j], c[(j + 1) % c.len()]))
    }

    /// Its area.
    pub fn area(&self) -> f64 {
        0.5 * self.edges().map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>()
    }

    /// `∫ exp(i q·r) d²r`.
    pub fn transform(&self, q: [Complex64; 2]) -> Complex64 {
        let square = q[0].norm_sqr() + q[1].norm_sqr();
        if square.sqrt() * self.radius < SMALL {
            return self.by_moments(q);
        }
        let i = Complex64::i();
        let along = |v: [f64; 2]| q[0] * v[0] + q[1] * v[1];
        let sum: Complex64 = self
            .edges()
            .map(|(a, b)| {
                let e = [b[0] - a[0], b[1] - a[1]];
                let h = 0.5 * along(e);
                let (u, v) = ((i * along(a)).exp(), (i * along(b)).exp());
                let mean = if h.norm() < SHORT {
                    0.5 * (u + v) * tangent_series(h * h)
                } else {
                    (v - u) / (2.0 * i * h)
                };
                (q[0].conj() * e[1] - q[1].conj() * e[0]) * mean
            })
            .sum();
        sum / (i * square)
    }

    /// Triangles of the origin and an edge: `c Σ h_n(a, b)/(n+2)!`, `h_n` the complete symmetric polynomial.
    fn by_moments(&self, q: [Complex64; 2]) -> Complex64 {
        let along = |v: [f64; 2]| Complex64::i() * (q[0] * v[0] + q[1] * v[1]);
        let triangle = |(a, b): ([f64; 2], [f64; 2])| {
            let twice = a[0] * b[1] - b[0] * a[1];
            let (a, b) = (along(a), along(b));
            // h_n = a h_{n−1} + bⁿ
            let (mut complete, mut power, mut factorial) =
                (Complex64::from(1.0), a * 0.0 + 1.0, 2.0);
            let mut sum = complete / factorial;
            for n in 1..MOMENTS {
                power *= b;
                complete = a * complete + power;
                factorial *= (n + 2) as f64;
                sum += complete / factorial;
            }
            twice * sum
        };
        self.edges().map(triangle).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::gauss_legendre::nodes;

    fn hexagon() -> Polygon {
        let corner = |k: i32| {
            let (sin, cos) = (f64::from(k) * std::f64::consts::PI / 3.0).sin_cos();
            [20.0 * cos + 3.0, 20.0 * sin - 7.0]
        };
        Polygon::new(&std::array::from_fn::<_, 6, _>(|k| corner(k as i32)))
    }

    /// Gauss's rule on every triangle of a fan from the first corner.
    fn by_rule(polygon: &Polygon, q: [Complex64; 2]) -> Complex64 {
        let rule = nodes(48);
        let c = polygon.corners();
        let mut sum = Complex64::default();
        for k in 1..c.len() - 1 {
            let side = |to: [f64; 2]| [to[0] - c[0][0], to[1] - c[0][1]];
            let (a, b) = (side(c[k]), side(c[k + 1]));
            let twice = a[0] * b[1] - a[1] * b[0];
            for (x, wx) in &rule {
                for (y, wy) in &rule {
                    let s = 0.5 * (x + 1.0);
                    let t = 0.5 * (y + 1.0) * (1.0 - s);
                    let r = [c[0][0] + s * a[0] + t * b[0], c[0][1] + s * a[1] + t * b[1]];
                    let phase = Complex64::i() * (q[0] * r[0] + q[1] * r[1]);
                    sum += phase.exp() * (0.25 * wx * wy * (1.0 - s) * twice);
                }
            }
        }
        sum
    }

    /// Against a rule that knows nothing of edges: from no phase to many turns, along and across edges, with
    /// absorption, and where the square of a complex q vanishes.
    #[test]
    fn sums_over_edges_are_integrals() {
        let polygon = hexagon();
        let area = polygon.area();
        assert!((area - 600.0 * 3.0f64.sqrt()).abs() < 1e-9);
        let turn = 0.4f64;
        for size in [0.0, 1e-12, 1e-8, 1e-5, 1e-3, 7e-3, 9e-3, 0.02, 0.1, 1.0] {
            for (direction, loss) in [
                ([turn.cos(), turn.sin()], [0.0, 0.0]),
                ([1.0, 0.0], [0.0, 0.0]),
                ([0.5, 0.75f64.sqrt()], [0.0, 0.0]),
                ([0.3, -0.8], [0.1, 0.05]),
                ([0.6, 0.0], [0.0, 0.6]),
            ] {
                let q = [0, 1].map(|k| size * Complex64::new(direction[k], 0.1 * loss[k]));
                let (found, wanted) = (polygon.transform(q), by_rule(&polygon, q));
                let scale = area.max(wanted.norm());
                assert!(
                    (found - wanted).norm() < 2e-13 * scale,
                    "{size} {direction:?}: {found} {wanted}"
                );
            }
        }
        let null = [Complex64::new(0.05, 0.0), Complex64::new(0.0, 0.05)];
        assert!((polygon.transform(null) - by_rule(&polygon, null)).norm() < 1e-12 * area);
    }

    #[test]
    fn the_tangent_is_its_series() {
        for h in [1e-6f64, 0.01, SHORT] {
            assert!((tangent_series(h * h) - h.tan() / h).abs() < 1e-13);
        }
    }
}
