//! The surface of a body of revolution as seen from an origin on its axis: `r(θ)` at Gauss nodes.
//!
//! Spherical waves need the surface in polar coordinates about *their* origin. Every shape of this
//! program is a level set `F(q, ζ) = 0` (see [`crate::shape`]); along the ray from the origin at
//! polar angle θ the distance is its root, found by Newton's method inside a bracket, and the slope
//! `r'/r` follows from the implicit function. So any star-shaped body is served alike, and moving
//! the origin costs nothing. θ counts from the *upper* pole here.

use super::error::TMatrixError;
use crate::math::gauss_legendre;
use crate::shape::Shape;

/// A point of the meridian.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::series::tmatrix) struct SurfaceNode {
    /// cos θ and sin θ about the origin.
    pub cos: f64,
    pub sin: f64,
    /// Gauss weight for an integral over cos θ.
    pub weight: f64,
    /// Distance from the origin, in radii of the sphere of equal volume.
    pub radius: f64,
    /// `(dr/dθ)/r`.
    pub slope: f64,
}

/// A body of revolution with the origin of its spherical waves.
#[derive(Clone, Debug)]
pub(in crate::series::tmatrix) struct Surface<'a> {
    shape: &'a Shape,
    /// Height of the origin above the body's centre.
    pub origin: f64,
    /// Whether the lower half is the mirror image of the upper one.
    pub mirror: bool,
}

/// Angles at which a surface is looked at before anything is computed.
const SCAN: usize = 181;
/// Steps of Newton's method, safeguarded by bisection.
const NEWTON: usize = 80;
/// Largest difference between upper and lower half that rounding makes.
const MIRROR: f64 = 1e-13;

impl<'a> Surface<'a> {
    /// The surface with its origin where the ratio of largest to smallest distance is least: waves
    /// about that origin converge fastest inside and outside.
    ///
    /// # Errors
    /// A body that is not star-shaped about its own centre.
    pub(in crate::series::tmatrix) fn new(shape: &'a Shape) -> Result<Self, TMatrixError> {
        let mut surface = Self { shape, origin: 0.0, mirror: false };
        let scan = surface.scan()?;
        surface.mirror = (0..SCAN).all(|i| (scan[i] - scan[SCAN - 1 - i]).abs() < MIRROR);
        if !surface.mirror {
            surface.origin = surface.best_origin(0.5 * (scan[0] - scan[SCAN - 1]));
        }
        Ok(surface)
    }

    /// Golden-section search about the middle of the two poles.
    fn best_origin(&self, middle: f64) -> f64 {
        const SHARE: f64 = 0.618_033_988_749_894_8;
        const REACH: f64 = 0.3;
        const STEPS: usize = 24;
        let spread = |origin: f64| {
            let moved = Self { origin, ..self.clone() };
            moved.limits().map_or(f64::INFINITY, |(low, high)| high / low)
        };
        let (mut low, mut high) = (middle - REACH, middle + REACH);
        for _ in 0..STEPS {
            let (a, b) = (high - SHARE * (high - low), low + SHARE * (high - low));
            if spread(a) < spread(b) { high = b } else { low = a }
        }
        0.5 * (low + high)
    }

    /// Smallest and largest distance from the origin.
    ///
    /// # Errors
    /// A body that is not star-shaped about the origin.
    pub(in crate::series::tmatrix) fn limits(&self) -> Result<(f64, f64), TMatrixError> {
        let scan = self.scan()?;
        Ok(scan.iter().fold((f64::INFINITY, 0.0), |(low, high), &r| (low.min(r), high.max(r))))
    }

    /// Distances at even steps of θ, pole to pole.
    fn scan(&self) -> Result<Vec<f64>, TMatrixError> {
        let angle = |i: usize| std::f64::consts::PI * i as f64 / (SCAN - 1) as f64;
        (0..SCAN).map(|i| self.distance(angle(i).cos()).map(|(r, _)| r)).collect()
    }

    /// Distance along the ray at `cos θ`, and `dr/d(cos θ)`.
    fn distance(&self, cos: f64) -> Result<(f64, f64), TMatrixError> {
        let d = self.origin;
        let slope = |r: f64| self.shape.slope(r * r + 2.0 * r * d * cos + d * d, -(d + r * cos));
        let (mut low, mut high) = (1e-3, self.shape.bounding_radius() * 1.001 + d.abs());
        let mut r = 1.0f64.clamp(low, high);
        for _ in 0..NEWTON {
            let s = slope(r);
            let along = s.q * 2.0 * (r + d * cos) - s.z * cos;
            let step = s.f / along;
            if step.abs() < 1e-15 || high - low < 1e-15 {
                break;
            }
            if s.f < 0.0 {
                low = r
            } else {
                high = r
            }
            let next = r - step;
            let inside = next >= low && next <= high;
            r = if inside { next } else { 0.5 * (low + high) };
        }
        let s = slope(r);
        let along = s.q * 2.0 * (r + d * cos) - s.z * cos;
        if !(along > 0.0 && s.f.abs() < 1e-9) {
            return Err(TMatrixError::NotStarShaped { angle_deg: cos.acos().to_degrees() });
        }
        let across = s.q * 2.0 * r * d - s.z * r;
        Ok((r, -across / along))
    }

    /// Gauss nodes in cos θ: all, or the upper half with doubled weights where the body has mirror
    /// symmetry and the integrands are even.
    ///
    /// # Errors
    /// A body that is not star-shaped about the origin.
    pub(in crate::series::tmatrix) fn nodes(
        &self,
        count: usize,
    ) -> Result<Vec<SurfaceNode>, TMatrixError> {
        let count = if self.mirror { count.next_multiple_of(2) } else { count };
        let mut gauss = gauss_legendre::nodes(count);
        if self.mirror {
            gauss.drain(..count / 2);
            gauss.iter_mut().for_each(|(_, weight)| *weight *= 2.0);
        }
        let node = |(cos, weight): (f64, f64)| {
            let (radius, by_cos) = self.distance(cos)?;
            let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
            Ok(SurfaceNode { cos, sin, weight, radius, slope: -sin * by_cos / radius })
        };
        gauss.into_iter().map(node).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::RaindropModel;

    /// A spheroid's radius in closed form, `1/r² = sin²/a² + cos²/c²`.
    #[test]
    fn spheroid_in_closed_form() {
        let shape = Shape::spheroid(0.7, 0.0).unwrap();
        let (a, c) = (0.7f64.powf(-1.0 / 3.0), 0.7f64.powf(2.0 / 3.0));
        let surface = Surface::new(&shape).unwrap();
        assert!(surface.mirror && surface.origin == 0.0);
        for node in surface.nodes(31).unwrap() {
            let u = (node.sin / a).powi(2) + (node.cos / c).powi(2);
            let r = u.powf(-0.5);
            let slope = -node.sin * node.cos * (1.0 / (a * a) - 1.0 / (c * c)) / u;
            assert!((node.radius - r).abs() < 1e-14, "{} {r}", node.radius);
            assert!((node.slope - slope).abs() < 1e-13, "{} {slope}", node.slope);
        }
    }

    /// The volume does not depend on where the origin is; a drop is no mirror image of itself.
    #[test]
    fn moved_origin_keeps_the_volume() {
        let shape = Shape::raindrop(2e-3, RaindropModel::BeardChuang1987, 0.0).unwrap();
        let mut surface = Surface::new(&shape).unwrap();
        assert!(!surface.mirror && surface.origin.abs() > 0.005, "{}", surface.origin);
        let volume = |surface: &Surface| -> f64 {
            let nodes = surface.nodes(60).unwrap();
            nodes.iter().map(|n| n.weight * n.radius.powi(3)).sum::<f64>() / 2.0
        };
        let best = volume(&surface);
        surface.origin = 0.0;
        assert!((volume(&surface) - best).abs() < 1e-12, "{best}");
        assert!((best - 1.00001).abs() < 1e-5, "{best}");
    }
}
