//! A closed convex body of flat facets, scaled so that the sphere of equal volume has radius 1.

mod check;
mod crystal;
mod crystals;
mod facet;
mod mesh;

pub use check::BodyError;
pub use crystal::Crystal;
pub use facet::Facet;
pub use mesh::{Format, Mesh, MeshError};

use glam::DVec3;
use std::f64::consts::PI;

/// A closed convex polyhedron about its centre of volume, of the volume of the unit sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    vertices: Vec<DVec3>,
    facets: Vec<Facet>,
}

impl Body {
    /// A body of corners (any unit) and loops of corner numbers, anticlockwise seen from outside; it is moved
    /// and scaled to the volume of the unit sphere.
    ///
    /// ```
    /// use gonio::facets::Body;
    /// use glam::DVec3;
    ///
    /// // a pyramid without its base
    /// let corners = [DVec3::Z, DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y];
    /// let open = Body::new(&corners, &[vec![0, 1, 2], vec![0, 2, 3], vec![0, 3, 4], vec![0, 4, 1]]);
    /// assert!(open.unwrap_err().to_string().contains("open"));
    /// ```
    ///
    /// # Errors
    /// Coordinates that are no sizes, facets that are none, edges that do not close, facets turned inside out,
    /// a body without thickness or with a hollow; the message names the facet, counted from 1.
    pub fn new(vertices: &[DVec3], loops: &[Vec<usize>]) -> Result<Self, BodyError> {
        Self::with_size(vertices, loops).map(|(body, _)| body)
    }

    /// The same, and the radius of the sphere of equal volume in units of the corners.
    fn with_size(vertices: &[DVec3], loops: &[Vec<usize>]) -> Result<(Self, f64), BodyError> {
        check::coordinates(vertices)?;
        check::number(loops)?;
        // checks compare with the body's size
        let middle = vertices.iter().sum::<DVec3>() / vertices.len() as f64;
        let size = vertices.iter().map(|v| (*v - middle).length()).fold(0.0, f64::max);
        if size == 0.0 {
            return Err(BodyError::NoThickness { relative: 0.0 });
        }
        let scaled: Vec<DVec3> = vertices.iter().map(|v| (*v - middle) / size).collect();
        check::closed(&scaled, loops)?;
        let facets = loops.iter().map(|corners| Facet::of(&scaled, corners)).collect();
        let body = Self { vertices: scaled, facets };
        let (volume, centre) = body.moments();
        check::convex(&body.vertices, &body.facets, volume, body.surface())?;
        let scale = (4.0 / 3.0 * PI / volume).cbrt();
        Ok((body.mapped(|v| (v - centre) * scale), size / scale))
    }

    /// The body with its corners mapped by what keeps its shape.
    fn mapped(self, map: impl Fn(DVec3) -> DVec3) -> Self {
        let vertices: Vec<DVec3> = self.vertices.into_iter().map(map).collect();
        let facets = self.facets.iter().map(|f| Facet::of(&vertices, &f.corners)).collect();
        Self { vertices, facets }
    }

    /// Its corners, in units of the radius of the sphere of equal volume.
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// Its facets.
    pub fn facets(&self) -> &[Facet] {
        &self.facets
    }

    /// Its volume: that of the unit sphere.
    pub fn volume(&self) -> f64 {
        self.moments().0
    }

    /// Area of all its facets.
    pub fn surface(&self) -> f64 {
        self.facets.iter().map(|facet| facet.area(&self.vertices)).sum()
    }

    /// Radius of the circle that has a facet's area, a mean over the surface.
    pub fn facet_radius(&self) -> f64 {
        let areas = self.facets.iter().map(|facet| facet.area(&self.vertices));
        areas.map(|area| area * (area / PI).sqrt()).sum::<f64>() / self.surface()
    }

    /// Area of its shadow in light of a direction.
    pub fn shadow(&self, direction: DVec3) -> f64 {
        let lit = |f: &Facet| (-f.normal.dot(direction)).max(0.0) * f.area(&self.vertices);
        self.facets.iter().map(lit).sum()
    }

    /// Largest distance of two corners.
    pub fn diameter(&self) -> f64 {
        let v = &self.vertices;
        let from = |i: usize| v[i + 1..].iter().map(move |w| (*w - v[i]).length());
        (0..v.len()).flat_map(from).fold(0.0, f64::max)
    }

    /// Least distance of two parallel planes that hold the body between them, one of them a facet's.
    pub fn width(&self) -> f64 {
        let depth = |f: &Facet| {
            let to = |v: &DVec3| f.distance - v.dot(f.normal);
            self.vertices.iter().map(to).fold(0.0, f64::max)
        };
        self.facets.iter().map(depth).fold(f64::INFINITY, f64::min)
    }

    /// The body turned.
    #[must_use]
    pub fn turned(&self, rotation: &glam::DMat3) -> Self {
        let vertices = self.vertices.iter().map(|v| *rotation * *v).collect();
        let facet = |f: &Facet| Facet { normal: *rotation * f.normal, ..f.clone() };
        Self { vertices, facets: self.facets.iter().map(facet).collect() }
    }

    /// Volume, and centre of it.
    fn moments(&self) -> (f64, DVec3) {
        let (mut volume, mut centre) = (0.0, DVec3::ZERO);
        for facet in &self.facets {
            let c = &facet.corners;
            for k in 1..c.len() - 1 {
                let [a, b, d] = [c[0], c[k], c[k + 1]].map(|i| self.vertices[i]);
                let part = a.dot(b.cross(d)) / 6.0;
                volume += part;
                centre += part * 0.25 * (a + b + d);
            }
        }
        (volume, centre / volume)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cauchy: the mean shadow of a convex body is a quarter of its surface.
    #[test]
    fn the_mean_shadow_is_a_quarter_of_the_surface() {
        for body in [
            Body::hexagonal_column(0.2).unwrap(),
            Body::bullet(1.5, 0.9).unwrap(),
            Body::octahedron().unwrap(),
        ] {
            let count = 20_000;
            let mean: f64 = (0..count)
                .map(|i| {
                    let z = 1.0 - (2 * i + 1) as f64 / f64::from(count);
                    let (s, c) = (f64::from(i) * crate::math::GOLDEN * 2.0 * PI).sin_cos();
                    body.shadow(DVec3::new((1.0 - z * z).sqrt() * c, (1.0 - z * z).sqrt() * s, z))
                })
                .sum::<f64>()
                / f64::from(count);
            assert!((mean / (body.surface() / 4.0) - 1.0).abs() < 1e-4);
            assert!((body.volume() - 4.0 / 3.0 * PI).abs() < 1e-12);
            assert!(body.moments().1.length() < 1e-12, "about its centre");
        }
    }
}
