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
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::PlocBuilder;

/// The steps of `obvhs::bvh2::builder::build_bvh2`, which reads a clock besides, and a browser's engine has none.
fn hierarchy(boxes: &[Aabb]) -> Bvh2 {
    let by = BvhBuildParams::fast_build();
    let (reinserted, again) =
        (by.reinsertion_batch_ratio, by.post_collapse_reinsertion_batch_ratio_multiplier);
    let indices = (0..boxes.len() as u32).collect();
    let (precision, depth) = (by.sort_precision, by.search_depth_threshold);
    let mut built = PlocBuilder::with_capacity(boxes.len()).build(
        by.ploc_search_distance,
        boxes,
        indices,
        precision,
        depth,
    );
    let mut optimizer = ReinsertionOptimizer::default();
    optimizer.run(&mut built, reinserted, None);
    collapse(&mut built, by.max_prims_per_leaf.clamp(1, 255), by.collapse_traversal_cost);
    optimizer.run(&mut built, reinserted * again, None);
    built
}

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
        let hierarchy = hierarchy(&boxes);
        Self { sheets, addresses, hierarchy }
    }

    /// Visit every patch that contains a direction, sheet by sheet in no particular order.
    pub fn patches(&self, direction: Vec3<f64>, mut visit: impl FnMut(Hit)) {
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

/// Decide in `f64` whether a patch contains a direction.
fn contains(sheet: &Sheet, triangle: usize, d: Vec3<f64>) -> Option<Hit<'_>> {
    let indices = sheet.triangles[triangle];
    let corner = |i: u32| sheet.corners[i as usize].direction;
    // Evaluate each edge in one canonical sense, so that both its patches get the same number.
    let edge = |i: u32, j: u32| {
        let (sign, normal) = if i < j {
            (1.0, corner(i).cross(corner(j)))
        } else {
            (-1.0, corner(j).cross(corner(i)))
        };
        let product = d.dot(normal);
        // A direction exactly on an edge counts as moved by ε, ε² and ε³ along the axes, the same for all.
        let side = [product, normal.x, normal.y, normal.z].into_iter().find(|v| *v != 0.0);
        (sign * product, sign * side.unwrap_or(0.0))
    };
    let [a, b, c] = indices;
    let edges = [edge(b, c), edge(c, a), edge(a, b)];
    let weights = edges.map(|(product, _)| product);
    let sum = weights[0] + weights[1] + weights[2];
    let sense = sum.signum();
    let front = d.dot(corner(a)) > 0.0;
    (front && edges.iter().all(|(_, side)| side * sense > 0.0)).then(|| Hit {
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
    use super::super::sheets::{Corner, sheets};
    use super::*;
    use crate::math::vec3::Field;
    use crate::shape::Shape;
    use crate::trace::{Tracer, Wavefront};
    use num_complex::Complex64;

    fn corner(direction: Vec3<f64>) -> Corner {
        Corner {
            direction,
            reference: Vec3::default(),
            path: 0.0,
            spread: 1.0,
            field: [Field::default(); 2],
            focal_lines: 0,
            place: [0.0; 2],
        }
    }

    /// The faces of an octahedron, each cut in four, seen from outside counter-clockwise, or all the other
    /// way round.
    fn octahedron(reversed: bool) -> CollectingSphere {
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mut corners = Vec::new();
        for axis in axes {
            for sign in [1.0, -1.0] {
                let [x, y, z] = axis.map(|a| a * sign);
                corners.push(corner(Vec3 { x, y, z }));
            }
        }
        let mut triangles: Vec<[u32; 3]> = Vec::new();
        for face in
            [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
        {
            let mut between = |i: usize, j: usize| -> u32 {
                let direction = (corners[i].direction + corners[j].direction).normalized();
                let known =
                    |c: &Corner| (c.direction - direction).dot(c.direction - direction) < 1e-12;
                let number = corners.iter().position(known);
                number.unwrap_or_else(|| {
                    corners.push(corner(direction));
                    corners.len() - 1
                }) as u32
            };
            let [a, b, c] = face;
            let [ab, bc, ca] = [between(a, b), between(b, c), between(c, a)];
            let [a, b, c] = face.map(|i| i as u32);
            triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        if reversed {
            triangles.iter_mut().for_each(|triangle| triangle.reverse());
        }
        CollectingSphere::new(vec![Sheet { order: 1, corners, triangles }])
    }

    fn hits(sphere: &CollectingSphere, d: Vec3<f64>) -> Vec<(usize, [f64; 3], f64)> {
        let mut found = Vec::new();
        sphere.patches(d, |hit| found.push((hit.triangle, hit.weights, hit.sense)));
        found
    }

    /// Each direction lies in one face, whose weights make it of the corners again.
    #[test]
    fn directions_are_found_once_with_their_weights() {
        for (reversed, sense) in [(false, 1.0), (true, -1.0)] {
            let sphere = octahedron(reversed);
            assert_eq!(sphere.addresses.len(), 32);
            for k in 0..200 {
                let z: f64 = -0.995 + 0.01 * f64::from(k);
                let (sin, cos) = (2.399963 * f64::from(k)).sin_cos();
                let rho = (1.0 - z * z).sqrt();
                let d = Vec3 { x: rho * cos, y: rho * sin, z };
                let found = hits(&sphere, d);
                assert_eq!(found.len(), 1, "{d:?}");
                let (triangle, weights, found_sense) = found[0];
                assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-14 && found_sense == sense);
                let sheet = &sphere.sheets[0];
                let mixed = sheet.triangles[triangle]
                    .iter()
                    .zip(weights)
                    .fold(Vec3::default(), |sum, (&i, w)| {
                        sum + sheet.corners[i as usize].direction * w
                    });
                let off = mixed.normalized() - d;
                assert!(off.dot(off) < 1e-28, "{off:?}");
            }
        }
    }

    /// Exactly upon an edge, and upon a corner, there is one patch too: neither none nor all around.
    #[test]
    fn directions_on_edges_and_corners_are_found_once() {
        let half = 0.5f64.sqrt();
        for reversed in [false, true] {
            let sphere = octahedron(reversed);
            for (x, y, z) in [
                (half, half, 0.0),
                (0.96, 0.28, 0.0),
                (-0.6, -0.8, 0.0),
                (-0.28, 0.0, 0.96),
                (-half, 0.0, half),
                (0.0, half, -half),
                (1.0, 0.0, 0.0),
                (0.0, -1.0, 0.0),
                (0.0, 0.0, 1.0),
                (0.0, 0.0, -1.0),
            ] {
                let found = hits(&sphere, Vec3 { x, y, z });
                assert_eq!(found.len(), 1, "{reversed} {x} {y} {z}: {found:?}");
            }
        }
    }

    #[test]
    fn nothing_is_found_where_nothing_is() {
        assert!(CollectingSphere::new(Vec::new()).addresses.is_empty());
        let mut sheet = octahedron(false).sheets.swap_remove(0);
        sheet.triangles.truncate(1);
        let sphere = CollectingSphere::new(vec![sheet]);
        assert!(hits(&sphere, Vec3 { x: -0.6, y: -0.48, z: -0.64 }).is_empty());
        assert_eq!(hits(&sphere, Vec3 { x: 0.96, y: 0.2, z: 0.196 }).len(), 1);
    }

    /// Straight through a sphere goes one ray of order 1, though the patches of all spokes meet there.
    #[test]
    fn a_corner_that_all_spokes_share_counts_once() {
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, Complex64::new(1.33, 0.0), 1e3, 1);
        let wavefront = Wavefront::corners(&shape, 40, 32, 0.0);
        let sphere = CollectingSphere::new(sheets(&tracer, &wavefront, &[1]));
        for (x, z) in [(0.0, 1.0), (1e-12, 1.0), (0.1, 0.995)] {
            assert_eq!(hits(&sphere, Vec3 { x, y: 0.0, z }).len(), 1, "at {x}");
        }
    }
}
