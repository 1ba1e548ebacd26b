//! One flat facet of a body.

use glam::DVec3;

/// One facet: a plane and the loop of its corners.
#[derive(Clone, Debug, PartialEq)]
pub struct Facet {
    /// Unit vector outwards.
    pub normal: DVec3,
    /// Of the plane, from the origin along the normal.
    pub distance: f64,
    /// Numbers of its corners, anticlockwise seen from outside.
    pub corners: Vec<usize>,
}

impl Facet {
    /// The plane of a loop of corners: its normal is that of the whole loop, so that no single corner decides.
    pub(super) fn of(vertices: &[DVec3], corners: &[usize]) -> Self {
        let count = corners.len();
        let first = vertices[corners[0]];
        let normal: DVec3 = (1..count.max(2) - 1)
            .map(|k| (vertices[corners[k]] - first).cross(vertices[corners[k + 1]] - first))
            .sum();
        let normal = normal.normalize_or_zero();
        let distance = corners.iter().map(|&i| vertices[i].dot(normal)).sum::<f64>() / count as f64;
        Self { normal, distance, corners: corners.to_vec() }
    }

    /// Its area.
    pub fn area(&self, vertices: &[DVec3]) -> f64 {
        let c = &self.corners;
        let twice = (1..c.len() - 1)
            .map(|k| (vertices[c[k]] - vertices[c[0]]).cross(vertices[c[k + 1]] - vertices[c[0]]));
        0.5 * twice.sum::<DVec3>().dot(self.normal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square's normal, distance and area; one corner more on an edge changes nothing.
    #[test]
    fn a_square_is_known() {
        let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [1.0, 0.0]];
        let corners = corners.map(|[x, y]| DVec3::new(x, y, 3.0));
        for order in [vec![0, 1, 2, 3], vec![0, 4, 1, 2, 3]] {
            let facet = Facet::of(&corners, &order);
            assert!(
                (facet.normal - DVec3::Z).length() < 1e-15 && (facet.distance - 3.0).abs() < 1e-15
            );
            assert!((facet.area(&corners) - 4.0).abs() < 1e-15);
        }
    }
}
