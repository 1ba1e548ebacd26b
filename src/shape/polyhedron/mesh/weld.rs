//! Corners of one place become one corner.

use super::soup::{MeshError, Soup};
use crate::shape::polyhedron::check::BodyError;
use glam::{DVec3, I64Vec3};
use std::collections::HashMap;

/// Distance of corners that are one, relative to the body's size: STL files have seven digits.
const SAME: f64 = 1e-6;

/// How the corners of the file became those of the body.
#[derive(Clone, Debug)]
pub(super) struct Size {
    /// Length of the file's unit.
    pub scale: f64,
    /// Of each welded corner its first in the file.
    pub corners: Vec<usize>,
}

/// Corners about their middle, the farthest at a distance of 1; each place once.
pub(super) fn weld(soup: &Soup) -> Result<(Soup, Size), MeshError> {
    let used: Vec<usize> = soup.facets.iter().flatten().copied().collect();
    let middle = used.iter().map(|&i| soup.corners[i] / used.len() as f64).sum::<DVec3>();
    let scale = used.iter().map(|&i| (soup.corners[i] - middle).length()).fold(0.0, f64::max);
    if scale == 0.0 {
        return Err(BodyError::NoThickness { relative: 0.0 }.into());
    }
    let mut cells: HashMap<I64Vec3, Vec<usize>> = HashMap::new();
    let mut welded: Vec<DVec3> = Vec::new();
    let mut first: Vec<usize> = Vec::new();
    let mut place: Vec<Option<usize>> = vec![None; soup.corners.len()];
    for i in used {
        if place[i].is_some() {
            continue;
        }
        let at = (soup.corners[i] - middle) / scale;
        let cell = (at / SAME).floor().as_i64vec3();
        let around = (0..27).map(|k| cell + I64Vec3::new(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
        let near = |&k: &usize| (welded[k] - at).length() < SAME;
        let known = around.filter_map(|cell| cells.get(&cell)).flatten().copied().find(near);
        let number = known.unwrap_or_else(|| {
            cells.entry(cell).or_default().push(welded.len());
            welded.push(at);
            first.push(i);
            welded.len() - 1
        });
        place[i] = Some(number);
    }
    let facets = soup.facets.iter();
    let facets = facets.map(|facet| facet.iter().filter_map(|&i| place[i]).collect()).collect();
    Ok((Soup { corners: welded, facets }, Size { scale, corners: first }))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners a rounding apart are one, and neighbours are left alone.
    #[test]
    fn corners_of_one_place_are_one() {
        let corners = [0.0, 1.0, 1.0 + 3e-7, 1.001, -2.0].map(|x| DVec3::new(x, 0.0, 0.0));
        let soup = Soup { corners: corners.to_vec(), facets: vec![vec![0, 1, 3], vec![2, 4, 0]] };
        let (welded, size) = weld(&soup).unwrap();
        assert_eq!(welded.facets, [[0, 1, 2], [1, 3, 0]]);
        assert_eq!(size.corners, [0, 1, 3, 4]);
        let long = (welded.corners[3] - welded.corners[0]).length() * size.scale;
        assert!((long - 2.0).abs() < 1e-12);
    }
}
