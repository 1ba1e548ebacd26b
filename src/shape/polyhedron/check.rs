//! Whether corners and facets make a closed convex body; messages name the facet, counted from 1.

use super::facet::Facet;
use glam::DVec3;
use std::collections::HashMap;

/// Largest coordinate that is taken for a length.
const LARGEST: f64 = 1e100;
/// Most facets: every pair of a beam and a facet is looked at.
pub(super) const MOST_FACETS: usize = 1000;
/// Area (of a facet) and thickness (of a body) below which there is none, relative to the body's size.
const THIN: f64 = 1e-6;

/// Distance of a corner from the plane it should be in or behind, relative to the body's size: files have six
/// or seven digits. Phases are off by as many radians times the size parameter.
const FLAT: f64 = 5e-6;

/// Why corners and facets make no body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum BodyError {
    #[error("vertex {vertex}: {value} is no coordinate; accepted: finite, below 1e100")]
    Coordinate { vertex: usize, value: f64 },
    #[error("{facets} facets; accepted: 4 to 1000 (every beam is cut by every facet)")]
    Facets { facets: usize },
    #[error("facet {facet}: vertex {vertex} does not exist or is named twice")]
    Corner { facet: usize, vertex: usize },
    #[error("facet {facet}: it has no area (its corners are on a line)")]
    NoArea { facet: usize },
    #[error("facet {facet}: its corners are not in one plane, or it is not convex")]
    NotFlat { facet: usize },
    #[error("facet {facet}: the edge {from}-{to} is open: no other facet shares it")]
    Open { facet: usize, from: usize, to: usize },
    #[error(
        "facet {facet}: turned inside out: facet {other} runs along the edge {from}-{to} the same way"
    )]
    Flipped { facet: usize, other: usize, from: usize, to: usize },
    #[error("the body has no thickness ({relative:.1e} of its size)")]
    NoThickness { relative: f64 },
    #[error("all facets are turned inside out: corners are to run anticlockwise seen from outside")]
    InsideOut,
    #[error(
        "facet {facet}: vertex {vertex} is in front of it: hollow bodies are not taken, beams are those of convex ones"
    )]
    Hollow { facet: usize, vertex: usize },
    #[error("{name} = {value}: {accepted}")]
    Proportion { name: &'static str, value: f64, accepted: &'static str },
}

/// Finite and of a size that can be multiplied.
pub(super) fn coordinates(vertices: &[DVec3]) -> Result<(), BodyError> {
    for (place, vertex) in vertices.iter().enumerate() {
        let sound = |x: &f64| x.is_finite() && x.abs() < LARGEST;
        if let Some(value) = vertex.to_array().into_iter().find(|x| !sound(x)) {
            return Err(BodyError::Coordinate { vertex: place + 1, value });
        }
    }
    Ok(())
}

/// Whether a body has so many.
pub(super) fn number(loops: &[Vec<usize>]) -> Result<(), BodyError> {
    if (4..=MOST_FACETS).contains(&loops.len()) {
        return Ok(());
    }
    Err(BodyError::Facets { facets: loops.len() })
}

/// Every facet is a flat convex polygon, and every edge is shared by two that run along it in opposite ways.
pub(super) fn closed(vertices: &[DVec3], loops: &[Vec<usize>]) -> Result<(), BodyError> {
    let mut edges: HashMap<(usize, usize), usize> = HashMap::new();
    let mut conflicts: HashMap<usize, usize> = HashMap::new();
    let mut clashes: Vec<[usize; 4]> = Vec::new();
    for (place, corners) in loops.iter().enumerate() {
        let facet = place + 1;
        polygon(vertices, corners, facet)?;
        for (from, to) in pairs(corners) {
            if let Some(other) = edges.insert((from, to), facet) {
                clashes.push([facet, other, from + 1, to + 1]);
                for of in [facet, other] {
                    *conflicts.entry(of).or_default() += 1;
                }
            }
        }
    }
    // of two facets that run the same way that is turned over which disagrees with more of its neighbours
    let worst = |[a, b, ..]: &[usize; 4]| conflicts[a].max(conflicts[b]);
    if let Some(&[a, b, from, to]) = clashes.iter().max_by_key(|clash| worst(clash)) {
        let (facet, other) = if conflicts[&b] > conflicts[&a] { (b, a) } else { (a, b) };
        return Err(BodyError::Flipped { facet, other, from, to });
    }
    for (place, corners) in loops.iter().enumerate() {
        for (from, to) in pairs(corners) {
            if !edges.contains_key(&(to, from)) {
                return Err(BodyError::Open { facet: place + 1, from: from + 1, to: to + 1 });
            }
        }
    }
    Ok(())
}

fn pairs(corners: &[usize]) -> impl Iterator<Item = (usize, usize)> {
    (0..corners.len()).map(|k| (corners[k], corners[(k + 1) % corners.len()]))
}

/// A facet by itself.
fn polygon(vertices: &[DVec3], corners: &[usize], facet: usize) -> Result<(), BodyError> {
    for (k, &vertex) in corners.iter().enumerate() {
        if vertex >= vertices.len() || corners[..k].contains(&vertex) {
            return Err(BodyError::Corner { facet, vertex: vertex.wrapping_add(1) });
        }
    }
    if corners.len() < 3 {
        return Err(BodyError::NoArea { facet });
    }
    let plane = Facet::of(vertices, corners);
    let area = plane.area(vertices);
    if area.is_nan() || area <= THIN * THIN {
        return Err(BodyError::NoArea { facet });
    }
    let off = |&i: &usize| (vertices[i].dot(plane.normal) - plane.distance).abs() > FLAT;
    let count = corners.len();
    let dented = (0..count).any(|k| {
        let [a, b, c] = [k, k + 1, k + 2].map(|i| vertices[corners[i % count]]);
        (b - a).cross(c - b).dot(plane.normal) < -FLAT
    });
    if corners.iter().any(off) || dented {
        return Err(BodyError::NotFlat { facet });
    }
    Ok(())
}

/// All corners are behind all facets, and there is a volume.
pub(super) fn convex(
    vertices: &[DVec3],
    facets: &[Facet],
    volume: f64,
    surface: f64,
) -> Result<(), BodyError> {
    if volume.abs() < THIN * surface {
        return Err(BodyError::NoThickness { relative: volume.abs() / surface });
    }
    if volume < 0.0 {
        return Err(BodyError::InsideOut);
    }
    for (facet, plane) in facets.iter().enumerate() {
        let front = |v: &DVec3| v.dot(plane.normal) - plane.distance > FLAT;
        if let Some(vertex) = vertices.iter().position(front) {
            return Err(BodyError::Hollow { facet: facet + 1, vertex: vertex + 1 });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::Body;
    use super::*;

    fn cube() -> (Vec<DVec3>, Vec<Vec<usize>>) {
        let at = |k: usize, bit: usize| if k >> bit & 1 == 1 { 1.0 } else { 0.0 };
        let corners = (0..8).map(|k| DVec3::new(at(k, 0), at(k, 1), at(k, 2))).collect();
        let loops = vec![
            vec![0, 2, 3, 1],
            vec![4, 5, 7, 6],
            vec![0, 1, 5, 4],
            vec![2, 6, 7, 3],
            vec![0, 4, 6, 2],
            vec![1, 3, 7, 5],
        ];
        (corners, loops)
    }

    /// Each fault by its own name and facet.
    #[test]
    fn faults_are_named() {
        let (corners, loops) = cube();
        assert!(Body::new(&corners, &loops).is_ok());
        type Change<'c> = &'c dyn Fn(&mut Vec<DVec3>, &mut Vec<Vec<usize>>);
        let with = |change: Change| {
            let (mut corners, mut loops) = cube();
            change(&mut corners, &mut loops);
            Body::new(&corners, &loops).unwrap_err()
        };
        let open = with(&|_, loops| {
            loops.pop();
        });
        assert!(matches!(open, BodyError::Open { facet: 1, .. }), "{open}");
        let flipped = with(&|_, loops| loops[3].reverse());
        assert!(matches!(flipped, BodyError::Flipped { facet: 4, .. }), "{flipped}");
        let inside_out = with(&|_, loops| loops.iter_mut().for_each(|l| l.reverse()));
        assert_eq!(inside_out, BodyError::InsideOut);
        let flat = with(&|corners, _| corners.iter_mut().for_each(|v| v.z *= 1e-9));
        let thin = matches!(flat, BodyError::NoThickness { .. } | BodyError::NoArea { .. });
        assert!(thin, "{flat}");
        for value in [1e300, f64::NAN, f64::INFINITY] {
            let huge = with(&|corners, _| corners[2].y = value);
            assert!(matches!(huge, BodyError::Coordinate { vertex: 3, .. }), "{huge}");
        }
        let bent = with(&|corners, _| corners[7] *= 1.2);
        assert!(matches!(bent, BodyError::NotFlat { facet: 2 }), "{bent}");
        let missing = with(&|_, loops| loops[2][1] = 99);
        assert_eq!(missing, BodyError::Corner { facet: 3, vertex: 100 });
        let line = with(&|_, loops| loops[0].truncate(2));
        assert_eq!(line, BodyError::NoArea { facet: 1 });
        assert_eq!(with(&|_, loops| loops.truncate(2)), BodyError::Facets { facets: 2 });
    }

    /// A dent, as in a hollow column, is refused by name.
    #[test]
    fn hollows_are_refused() {
        let (mut corners, mut loops) = cube();
        corners.push(DVec3::new(0.5, 0.5, 0.7));
        let top = loops.remove(1);
        for (from, to) in pairs(&top) {
            loops.push(vec![from, to, 8]);
        }
        let hollow = Body::new(&corners, &loops).unwrap_err();
        assert!(matches!(hollow, BodyError::Hollow { .. }), "{hollow}");
    }
}
