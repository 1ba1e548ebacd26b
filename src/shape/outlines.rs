//! Two families of outlines by a few numbers: a cosine series, and superellipsoids.

use super::error::ShapeError;
use super::own::{Outline, OwnBody};
use crate::math::jet::Jet;
use crate::math::scalar::Scalar;

/// `r(θ) = Σ c_n cos nθ`, θ from straight down, as falling drops are written since Pruppacher & Pitter (1971);
/// Chebyshev particles are those of two terms.
#[derive(Debug)]
struct Harmonics(Vec<f64>);

impl Outline for Harmonics {
    fn level<T: Scalar>(&self, q: Jet<T>, depth: Jet<T>) -> Jet<T> {
        let r = q.root();
        let mu = depth / r;
        // Clenshaw's sum of Chebyshev polynomials: cos nθ = T_n(cos θ)
        let zero = r * 0.0;
        let (mut b1, mut b2) = (zero, zero);
        for c in self.0.iter().skip(1).rev() {
            (b1, b2) = (mu * b1 * 2.0 - b2 + *c, b1);
        }
        r - mu * b1 + b2 - self.0[0]
    }
}

/// `(x² + y²)^(m/2) + (z/c)^m = 1`.
#[derive(Debug)]
struct Superellipsoid {
    axis_ratio: f64,
    exponent: f64,
}

impl Outline for Superellipsoid {
    fn level<T: Scalar>(&self, q: Jet<T>, depth: Jet<T>) -> Jet<T> {
        let height = depth * depth;
        let half = 0.5 * self.exponent;
        (q - height).power(half) + (height / (self.axis_ratio * self.axis_ratio)).power(half) - 1.0
    }
}

/// Smallest share of the mean radius that an outline may have anywhere.
const LEAST_RADIUS: f64 = 0.05;

impl OwnBody {
    /// A body of revolution of outline `r(θ) = Σ c_n cos nθ`, θ from straight down, in any unit.
    ///
    /// ```
    /// use gonio::shape::{OwnBody, Shape};
    /// let pear = Shape::own(OwnBody::harmonics(&[1.0, 0.0, 0.0, 0.05])?, 0.0);
    /// let [down, up] = [1.0, -1.0].map(|s| pear.radius_towards(s * pear.down.x, s * pear.down.y, s * pear.down.z));
    /// assert!((down / up - 1.05 / 0.95).abs() < 1e-9);
    /// # Ok::<(), gonio::shape::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// Radii that are not positive everywhere, or differ by more than a factor of 10.
    pub fn harmonics(coefficients: &[f64]) -> Result<Self, ShapeError> {
        let mean = coefficients.first().copied().unwrap_or(0.0);
        let fault = |fault: String| ShapeError::OwnBody {
            name: "harmonics".into(),
            fault,
            accepted: "c_0 above 0, and r(θ) = Σ c_n cos nθ positive at all θ",
        };
        let sound = mean > 0.0 && coefficients.iter().all(|c| c.is_finite());
        if !sound {
            return Err(fault(format!("c_0 = {mean}")));
        }
        let radius = |degrees: u32| {
            let theta = f64::from(degrees).to_radians();
            coefficients.iter().zip(0..).map(|(c, n)| c * (f64::from(n) * theta).cos()).sum::<f64>()
        };
        if let Some(at) = (0..=180).find(|&degrees| radius(degrees) < LEAST_RADIUS * mean) {
            return Err(fault(format!("r = {:.4} at θ = {at}°", radius(at))));
        }
        Self::new("harmonics", Harmonics(coefficients.to_vec()))
    }

    /// A superellipsoid of revolution, `(x² + y²)^(m/2) + (z/c)^m = 1`: `axis_ratio` is c, vertical over
    /// horizontal diameter, `exponent` m (2: a spheroid; towards a cylinder as it grows).
    ///
    /// # Errors
    /// An exponent below 2, where curvature has no bound at the equator and the poles, or radii that differ by more
    /// than a factor of 10.
    pub fn superellipsoid(axis_ratio: f64, exponent: f64) -> Result<Self, ShapeError> {
        let sound = axis_ratio > 0.0 && axis_ratio.is_finite() && (2.0..=20.0).contains(&exponent);
        if !sound {
            return Err(ShapeError::OwnBody {
                name: "superellipsoid".into(),
                fault: format!("axis_ratio = {axis_ratio}, exponent = {exponent}"),
                accepted: "a ratio above 0 and an exponent of 2 to 20",
            });
        }
        Self::new("superellipsoid", Superellipsoid { axis_ratio, exponent })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;

    /// An exponent of 2 is the spheroid; a series of one term the sphere.
    #[test]
    fn known_bodies_are_among_them() {
        let found = Shape::own(OwnBody::superellipsoid(0.8, 2.0).unwrap(), 0.2);
        let known = Shape::spheroid(0.8, 0.2).unwrap();
        for (x, y, z) in [(0.6, 0.0, 0.8), (0.0, 1.0, 0.0), (0.48, 0.6, 0.64)] {
            let (a, b) = (found.radius_towards(x, y, z), known.radius_towards(x, y, z));
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
        let ball = Shape::own(OwnBody::harmonics(&[3.0]).unwrap(), 0.0);
        assert!(ball.is_sphere());
    }

    /// The radius towards any θ is the series, relative to that straight down, and curvature is that of differences.
    #[test]
    fn the_series_is_the_radius() {
        let c = [1.0, 0.02, -0.06, 0.03, 0.01];
        let body = OwnBody::harmonics(&c).unwrap();
        let shape = Shape::own(body, 0.0);
        let down = shape.down;
        let across = glam::DVec3::new(down.x, down.y, down.z).any_orthonormal_vector();
        let along = glam::DVec3::new(down.x, down.y, down.z);
        let series = |theta: f64| {
            c.iter().zip(0..).map(|(c, n)| c * (f64::from(n) * theta).cos()).sum::<f64>()
        };
        let radius = |theta: f64| {
            let way = along * theta.cos() + across * theta.sin();
            shape.radius_towards(way.x, way.y, way.z)
        };
        for k in 0..=12 {
            let theta = 0.25 * f64::from(k);
            let (a, b) = (radius(theta) / radius(0.0), series(theta) / series(0.0));
            assert!((a - b).abs() < 1e-10, "{theta}: {a} {b}");
        }
    }

    #[test]
    fn outlines_that_bound_nothing_are_refused() {
        let refused = |c: &[f64], word: &str| {
            let error = OwnBody::harmonics(c).unwrap_err().to_string();
            assert!(error.contains(word), "{error}");
        };
        refused(&[], "c_0 = 0");
        refused(&[-1.0], "c_0 = -1");
        refused(&[1.0, f64::NAN], "c_0");
        refused(&[1.0, 1.1], "at θ = ");
        for (ratio, exponent) in [(1.0, 1.5), (1.0, f64::NAN), (0.0, 3.0), (30.0, 2.0)] {
            assert!(OwnBody::superellipsoid(ratio, exponent).is_err());
        }
    }
}
