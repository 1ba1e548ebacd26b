//! Tests of `collecting_sphere`.

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
            let known = |c: &Corner| (c.direction - direction).dot(c.direction - direction) < 1e-12;
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
