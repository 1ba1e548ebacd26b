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
mod tests;
