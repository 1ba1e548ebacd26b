//! Facets of one plane become one polygon: a beam that met them one by one would be cut for nothing.

use super::soup::Soup;
use crate::shape::polyhedron::facet::Facet;
use glam::DVec3;
use std::collections::HashMap;

/// Distance of a corner from the plane of the facet that joins others, relative to the body's size: roundings
/// of a file's digits.
const ONE_PLANE: f64 = 1.5e-6;

/// Polygons, and of each the number (from 1) of the facet of the file that joined the others.
pub(super) struct Joined {
    pub corners: Vec<DVec3>,
    pub facets: Vec<Vec<usize>>,
    pub of_file: Vec<usize>,
}

/// Join the facets of a closed surface, the largest first.
pub(super) fn join(soup: &Soup) -> Joined {
    let planes: Vec<Facet> = soup.facets.iter().map(|f| Facet::of(&soup.corners, f)).collect();
    let areas: Vec<f64> = planes.iter().map(|plane| plane.area(&soup.corners)).collect();
    let mut order: Vec<usize> = (0..planes.len()).collect();
    order.sort_by(|&a, &b| areas[b].total_cmp(&areas[a]).then(a.cmp(&b)));
    let mut edges: HashMap<(usize, usize), usize> = HashMap::new();
    for (facet, corners) in soup.facets.iter().enumerate() {
        edges.extend(pairs(corners).map(|edge| (edge, facet)));
    }
    let mut region: Vec<Option<usize>> = vec![None; planes.len()];
    let mut loops: Vec<(usize, Vec<usize>)> = Vec::new();
    for &seed in &order {
        if region[seed].is_some() {
            continue;
        }
        let plane = &planes[seed];
        let flat = |facet: usize| {
            let off = |&i: &usize| (soup.corners[i].dot(plane.normal) - plane.distance).abs();
            let sliver = areas[facet] < ONE_PLANE;
            let same_side = sliver || planes[facet].normal.dot(plane.normal) > 0.0;
            same_side && soup.facets[facet].iter().all(|i| off(i) < ONE_PLANE)
        };
        let mut members = vec![seed];
        region[seed] = Some(seed);
        let mut next = 0;
        while let Some(&member) = members.get(next) {
            next += 1;
            for (from, to) in pairs(&soup.facets[member]) {
                let Some(&other) = edges.get(&(to, from)) else { continue };
                if region[other].is_none() && flat(other) {
                    region[other] = Some(seed);
                    members.push(other);
                }
            }
        }
        match outline(&members, soup, &edges, &region) {
            Some(outline) => loops.push((seed, outline)),
            // a plane with a hole in it, or pinched: left as it is
            None => {
                loops.extend(members.iter().map(|&member| (member, soup.facets[member].clone())))
            }
        }
    }
    loops.sort_by_key(|(facet, _)| *facet);
    compact(soup, loops)
}

fn pairs(corners: &[usize]) -> impl Iterator<Item = (usize, usize)> {
    (0..corners.len()).map(|k| (corners[k], corners[(k + 1) % corners.len()]))
}

/// The one loop about facets of a plane.
fn outline(
    members: &[usize],
    soup: &Soup,
    edges: &HashMap<(usize, usize), usize>,
    region: &[Option<usize>],
) -> Option<Vec<usize>> {
    let mut next: HashMap<usize, usize> = HashMap::new();
    let mut first = None;
    for &member in members {
        for (from, to) in pairs(&soup.facets[member]) {
            let outside = edges.get(&(to, from)).is_none_or(|&o| region[o] != region[member]);
            if outside {
                first.get_or_insert(from);
                if next.insert(from, to).is_some() {
                    return None;
                }
            }
        }
    }
    let first = first?;
    let mut found = vec![first];
    let mut at = *next.get(&first)?;
    while at != first && found.len() <= next.len() {
        found.push(at);
        at = *next.get(&at)?;
    }
    (found.len() == next.len()).then_some(found)
}

/// Without corners that only two polygons have (they lie on an edge), and without those that none has.
fn compact(soup: &Soup, loops: Vec<(usize, Vec<usize>)>) -> Joined {
    let mut shared = vec![0usize; soup.corners.len()];
    loops.iter().for_each(|(_, l)| l.iter().for_each(|&i| shared[i] += 1));
    let mut number: HashMap<usize, usize> = HashMap::new();
    let mut joined = Joined { corners: Vec::new(), facets: Vec::new(), of_file: Vec::new() };
    for (facet, corners) in loops {
        let kept = corners.into_iter().filter(|&i| shared[i] > 2);
        let renumbered = kept.map(|i| {
            *number.entry(i).or_insert_with(|| {
                joined.corners.push(soup.corners[i]);
                joined.corners.len() - 1
            })
        });
        joined.facets.push(renumbered.collect());
        joined.of_file.push(facet + 1);
    }
    joined
}
