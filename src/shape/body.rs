//! A body in the light: its kind, the direction of its axis, and what every kind is asked for.

use super::error::ShapeError;
use super::level::{Level, Slope};
use super::own::OwnBody;
use super::raindrop::{self, Raindrop, RaindropModel};
use super::{sphere, spheroid};
use crate::math::scalar::Scalar;
use crate::math::vec3::Vec3;

/// The kind of body, its equal-volume sphere scaled to radius 1.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Body {
    /// A sphere.
    Sphere,
    /// A spheroid.
    Spheroid(spheroid::Spheroid),
    /// A falling raindrop.
    Raindrop(Raindrop),
    /// One that is none of these, by its own formula.
    Own(OwnBody),
}

/// A body, and the direction of its axis in the frame of the light (see [`crate::optics`]).
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// The body itself.
    pub(crate) body: Body,
    /// Unit vector from the body's centre to its lower pole, in the frame of the light.
    pub down: Vec3<f64>,
}

impl Body {
    /// Whether the surface is known to have no hollow, which a line might leave and enter again.
    pub(super) fn is_convex(&self) -> bool {
        match self {
            Body::Sphere | Body::Spheroid(_) => true,
            Body::Raindrop(drop) => drop.is_convex(),
            Body::Own(_) => false,
        }
    }
}

impl Shape {
    /// A sphere.
    pub fn sphere() -> Self {
        Self { body: Body::Sphere, down: Vec3 { x: -1.0, y: 0.0, z: 0.0 } }
    }

    /// A spheroid with the sun at an elevation (radians); `axis_ratio` is vertical over horizontal.
    pub fn spheroid(axis_ratio: f64, sun_elevation: f64) -> Result<Self, ShapeError> {
        let body = Body::Spheroid(spheroid::Spheroid::new(axis_ratio)?);
        Ok(Self { body, down: down(sun_elevation) })
    }

    /// A falling raindrop of equal-volume radius (metres) with the sun at an elevation (radians).
    pub fn raindrop(
        radius: f64,
        model: RaindropModel,
        sun_elevation: f64,
    ) -> Result<Self, ShapeError> {
        let body = Body::Raindrop(Raindrop::new(radius, model)?);
        Ok(Self { body, down: down(sun_elevation) })
    }

    /// A body by its own formula (see [`crate::shape::Outline`]) with the sun at an elevation (radians).
    pub fn own(body: OwnBody, sun_elevation: f64) -> Self {
        Self { body: Body::Own(body), down: down(sun_elevation) }
    }

    /// True when scattering cannot depend on azimuth: a sphere, or light along the axis.
    pub fn rotational_symmetry(&self) -> bool {
        self.is_sphere() || self.down.x.abs() < 1e-12
    }

    /// True when the body is known to look the same from below.
    pub fn mirror_symmetry(&self) -> bool {
        match &self.body {
            Body::Sphere | Body::Spheroid(_) => true,
            Body::Raindrop(drop) => drop.is_sphere(),
            Body::Own(_) => false,
        }
    }

    /// The sun's elevation (radians) that the axis was laid for.
    pub fn sun_elevation(&self) -> f64 {
        self.down.z.atan2(-self.down.x)
    }

    /// True when the body is a sphere, by whatever kind it is described.
    pub fn is_sphere(&self) -> bool {
        match &self.body {
            Body::Sphere => true,
            Body::Spheroid(spheroid) => spheroid.is_sphere(),
            Body::Raindrop(drop) => drop.is_sphere(),
            Body::Own(own) => own.is_sphere(),
        }
    }

    /// `F` and its derivatives up to the second order at `(q, ζ)`.
    pub(super) fn level<T: Scalar>(&self, q: T, depth: T) -> Level<T> {
        match &self.body {
            Body::Sphere => sphere::level(q),
            Body::Spheroid(spheroid) => spheroid.level(q, depth),
            Body::Raindrop(drop) => drop.level(q, depth),
            Body::Own(own) => own.level(q, depth),
        }
    }

    /// `F` and its first derivatives at `(q, ζ)`: what an intersection needs.
    pub(crate) fn slope<T: Scalar>(&self, q: T, depth: T) -> Slope<T> {
        match &self.body {
            Body::Sphere => sphere::slope(q),
            Body::Spheroid(spheroid) => spheroid.slope(q, depth),
            Body::Raindrop(drop) => drop.slope(q, depth),
            Body::Own(own) => own.slope(q, depth),
        }
    }

    /// Radius about the centre within which `F` is not smooth; every line through it hits the body.
    pub(super) fn rough_core(&self) -> f64 {
        match &self.body {
            Body::Sphere | Body::Spheroid(_) => 0.0,
            Body::Raindrop(_) => raindrop::ROUGH_CORE,
            Body::Own(own) => own.rough_core(),
        }
    }

    /// Largest distance of the surface from the centre.
    pub fn bounding_radius(&self) -> f64 {
        match &self.body {
            Body::Sphere => 1.0,
            Body::Spheroid(spheroid) => spheroid.bounding_radius(),
            Body::Raindrop(drop) => drop.bounding_radius(),
            Body::Own(own) => own.bounding_radius(),
        }
    }
}

/// The axis in the frame of the light for a sun at this elevation (radians).
fn down(sun_elevation: f64) -> Vec3<f64> {
    let (sin, cos) = sun_elevation.sin_cos();
    // cos(90°) is not quite zero in floating point; the symmetry of light along the axis should be
    let cos = if cos.abs() < 1e-15 { 0.0 } else { cos };
    Vec3 { x: -cos, y: 0.0, z: sin }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn the_axis_turns_with_the_sun() {
        for elevation in [0.0, 0.4, FRAC_PI_2] {
            let shape = Shape::spheroid(0.8, elevation).unwrap();
            assert!((shape.down.dot(shape.down) - 1.0).abs() < 1e-15);
            // light of a high sun goes down
            assert!((shape.down.z - elevation.sin()).abs() < 1e-15);
            assert_eq!(shape.rotational_symmetry(), elevation == FRAC_PI_2);
        }
        let elevation = 0.4;
        assert!(Shape::spheroid(1.0, elevation).unwrap().is_sphere());
        assert!(Shape::spheroid(1.0, elevation).unwrap().rotational_symmetry());
    }

    #[test]
    fn an_axis_ratio_out_of_range_is_named() {
        for ratio in [0.09, 10.1, f64::NAN, -1.0] {
            let error = Shape::spheroid(ratio, 0.0).unwrap_err();
            assert!(
                matches!(error, ShapeError::AxisRatio(_))
                    && error.to_string().contains("0.1 to 10")
            );
        }
    }

    /// Bodies have the volume of the unit sphere and lie within their bounding radius. Gauss's rule
    /// in the cosine about the axis, which is exact for what a raindrop's profile is.
    #[test]
    fn volumes_are_that_of_the_unit_sphere() {
        let nodes = crate::math::gauss_legendre::nodes(40);
        for (shape, bound) in [
            (Shape::sphere(), 1e-14),
            (Shape::spheroid(0.7, 0.0).unwrap(), 1e-12),
            (Shape::spheroid(1.6, 0.0).unwrap(), 1e-12),
            (Shape::raindrop(1e-3, RaindropModel::ChuangBeard1990, 0.0).unwrap(), 2e-3),
        ] {
            let mut volume = 0.0;
            for (mu, weight) in &nodes {
                let radius = shape.radius_towards(-mu, (1.0 - mu * mu).sqrt(), 0.0);
                assert!(radius <= shape.bounding_radius() + 1e-14, "{shape:?}");
                volume += 2.0 * PI / 3.0 * weight * radius.powi(3);
            }
            assert!((volume / (4.0 * PI / 3.0) - 1.0).abs() < bound, "{shape:?}: {volume}");
        }
    }
}
