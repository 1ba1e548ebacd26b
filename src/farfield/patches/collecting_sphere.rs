//! The collecting sphere: which patches contain a direction.
//!
//! A bounding-volume hierarchy over the patches' boxes gives candidates in `f32`, with boxes padded
//! for rounding and for the sphere's bulge; the decision is made in `f64` by the signs of triple
//! products. Two patches that share an edge evaluate the same product for it, with opposite sign,
//! so that no direction falls between them or into both.

use super::sheets::Sheet;
use crate::math::vec3::Vec3;
use glam::Vec3A;
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use std::time::Duration;

/// Sheets of patches, ready to be asked for directions.
pub struct CollectingSphere {
    sheets: Vec<Sheet>,
    /// (sheet, triangle) of every box in the hierarchy.
    addresses: Vec<(u32, u32)>,
    hierarchy: Bvh2,
}

/// A patch that contains the direction asked for.
#[derive(Clone, Copy, Debug)]
pub struct Hit<'a> {
    /// The sheet it lies on.
    pub sheet: &'a Sheet,
    /// Which triangle of the sheet.
    pub triangle: usize,
    /// Weights of the three corners, sum 1.
    pub weights: [f64; 3],
    /// Whether the patch keeps (+1) or reverses (-1) its sense of rotation on the sphere.
    pub sense: f64,
}

/// Rounding of directions to `f32`, on the unit sphere.
const ROUNDING: f32 = 2.4e-7;

impl CollectingSphere {
    /// Build the hierarchy over all patches.
    pub fn new(sheets: Vec<Sheet>) -> Self {
        let mut addresses = Vec::new();
        let mut boxes = Vec::new();
        for (s, sheet) in sheets.iter().enumerate() {
            for t in 0..sheet.triangles.len() {
                addresses.push((s as u32, t as u32));
                boxes.push(bounding_box(sheet, t));
            }
        }
        let mut time = Duration::default();
        let params = BvhBuildParams::fast_build();
        let hierarchy = build_bvh2(&boxes, params, &mut time);
        Self { sheets, addresses, hierarchy }
    }

    /// Number of patches held.
    pub fn len(&self) -> usize {
        self.addresses.len()
    }

    /// True when no ray left the particle in any order held.
    pub fn is_empty(&self) -> bool {
        self.addresses.is_empty()
    }

    /// Visit every patch that contains a direction, sheet by sheet in no particular order.
    pub fn patches(&self, direction: Vec3<f64>, mut visit: impl FnMut(Hit)) {
        let direction = beside_axis(direction);
        let point = Vec3A::new(direction.x as f32, direction.y as f32, direction.z as f32);
        self.hierarchy.point_traverse(point, |hierarchy, node| {
            let node = &hierarchy.nodes[node as usize];
            for slot in node.first_index..node.first_index + node.prim_count {
                let primitive = hierarchy.primitive_indices[slot as usize] as usize;
                let (s, t) = self.addresses[primitive];
                if let Some(hit) = contains(&self.sheets[s as usize], t as usize, direction) {
                    visit(hit);
                }
            }
            true
        });
    }
}

/// A direction exactly on the axis, where all spokes of a grid meet in one corner, moved into one of the
/// patches about it: else each of them would count.
fn beside_axis(d: Vec3<f64>) -> Vec3<f64> {
    /// Far below a patch, and far above the rounding of its corners; the second breaks the tie between
    /// two halves of a mirror-symmetrical grid.
    const X: f64 = 1e-9;
    const Y: f64 = 0.3e-9;
    let on_axis = d.x.abs().max(d.y.abs()) < X;
    if on_axis { Vec3 { x: X, y: Y, z: d.z } } else { d }
}

/// Decide in `f64` whether a patch contains a direction.
fn contains(sheet: &Sheet, triangle: usize, d: Vec3<f64>) -> Option<Hit<'_>> {
    let indices = sheet.triangles[triangle];
    let corner = |i: u32| sheet.corners[i as usize].direction;
    // Evaluate each edge in one canonical sense, so that both its patches get the same number.
    let edge = |i: u32, j: u32| {
        if i < j { d.dot(corner(i).cross(corner(j))) } else { -d.dot(corner(j).cross(corner(i))) }
    };
    let [a, b, c] = indices;
    let weights = [edge(b, c), edge(c, a), edge(a, b)];
    let sum = weights[0] + weights[1] + weights[2];
    let sense = sum.signum();
    // A direction exactly on an edge belongs to the side that sees it with a plus sign.
    let inside = |w: f64| w * sense > 0.0 || (w == 0.0 && sense > 0.0);
    let front = d.dot(corner(a)) > 0.0;
    (front && weights.iter().all(|&w| inside(w))).then(|| Hit {
        sheet,
        triangle,
        weights: weights.map(|w| w / sum),
        sense,
    })
}

/// Box of a patch, padded for `f32` and for the bulge of the sphere over its chords.
fn bounding_box(sheet: &Sheet, triangle: usize) -> Aabb {
    let corners = sheet.triangles[triangle].map(|i| {
        let d = sheet.corners[i as usize].direction;
        Vec3A::new(d.x as f32, d.y as f32, d.z as f32)
    });
    let mut aabb = Aabb::from_points(&corners);
    let size = aabb.diagonal().length();
    let pad = Vec3A::splat(ROUNDING + size * size / 6.0);
    aabb.min -= pad;
    aabb.max += pad;
    aabb
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::farfield::patches::sheets;
    use crate::shape::Shape;
    use crate::trace::{Tracer, Wavefront};
    use num_complex::Complex64;

    /// Straight through a sphere goes one ray of order 1, though the patches of all spokes meet there.
    #[test]
    fn a_corner_that_all_spokes_share_counts_once() {
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, Complex64::new(1.33, 0.0), 1e3, 1);
        let wavefront = Wavefront::corners(&shape, 40, 32, 0.0);
        let sphere = CollectingSphere::new(sheets::sheets(&tracer, &wavefront, &[1]));
        for (x, z) in [(0.0, 1.0), (1e-12, 1.0), (0.1, 0.995)] {
            let mut hits = 0;
            sphere.patches(Vec3 { x, y: 0.0, z }, |_| hits += 1);
            assert_eq!(hits, 1, "at {x}");
        }
    }
}
