//! Tracing the planes of an order at several azimuths, and cutting them into segments that
//! correspond: the same landmarks, the same knots.

use super::axis_waves::axis_waves;
use super::cut_layout::{CutLayout, FoldLayout};
use crate::farfield::branch::knots::{Kind, Knot, Segment};
use crate::farfield::deflection::curve::DeflectionCurve;
use crate::farfield::deflection::guide::{OrderGuide, PlaneGuide};
use crate::farfield::deflection::scattering_plane::{Node, ScatteringPlane, axial_ray};
use crate::farfield::impact_integral::glory::Glory;
use crate::farfield::impact_integral::near_critical;
use crate::farfield::impact_integral::rays::Rays;
use crate::math::parallel::*;
use crate::trace::Tracer;
use std::f64::consts::PI;

/// Largest argument of the Airy functions on the lit side: there the two rays are well apart.
const LIT_ZETA: f64 = 24.0;
/// Argument on the dark side at which the field has died away.
const DARK_ZETA: f64 = 7.5;
/// Longest reach of a pair segment, radians: beyond, its Chebyshev series would need more points.
const LONGEST_REACH: f64 = 0.3;
const LONGEST_DARK: f64 = 0.45;

/// Share of the angle from a fold to the nearest ray near total reflection that its pair may use, and
/// the argument of its Airy functions that it must reach.
const CLEARANCE: f64 = 0.9;
const SHORTEST_ZETA: f64 = 6.0;

/// Scattering planes over a half-turn that decide whether a fold needs an integral.
const DECIDING: usize = 9;

/// What is traced of an order.
pub(crate) struct Traced {
    pub planes: Vec<Vec<Segment>>,
    /// How they were cut.
    pub layout: CutLayout,
    /// Waves about the axis, in rotationally symmetric scenes.
    pub about_axis: Vec<Glory>,
}

/// Trace the planes of an order and cut them into corresponding segments; a `guide` knows where rays of these planes
/// start and leave.
pub(crate) fn trace(
    tracer: &Tracer,
    order: u32,
    centre: [f64; 2],
    places: &[f64],
    mut layout: CutLayout,
    caustic_disorder: f64,
    guide: Option<&OrderGuide>,
) -> Option<Traced> {
    let silhouette = tracer.shape().silhouette().tabulated();
    let plane = |phi: f64| ScatteringPlane::new(tracer, order, phi, centre);
    let guides = guide.map_or_else(Vec::new, |guide| guide.at(tracer.index().re));
    let curve = |j: usize, guide: Option<&PlaneGuide>| {
        DeflectionCurve::guided(plane(places[j]), &silhouette, layout.scanning(), guide)
    };
    let scanned = |j: usize, like: Option<&str>| {
        let found = curve(j, guides.get(j));
        let serves = |found: &DeflectionCurve| like.is_none_or(|like| found.signature() == like);
        // what a guide does not lead to may be found by itself
        if guides.is_empty() || found.as_ref().is_some_and(serves) { found } else { curve(j, None) }
    };
    // A few planes far apart tell soon whether all can correspond.
    let mut probes: Vec<usize> = [0.0, 0.25, 0.5, 0.75, 1.0]
        .map(|share| (share * (places.len() - 1) as f64) as usize)
        .to_vec();
    probes.dedup();
    let mut curves: Vec<Option<DeflectionCurve>> = places.iter().map(|_| None).collect();
    let probed: Vec<_> = probes.par_iter().map(|&j| scanned(j, None)).collect();
    for (&j, curve) in probes.iter().zip(probed) {
        curves[j] = curve;
    }
    let signature = curves[0].as_ref()?.signature();
    let alike = |curve: &DeflectionCurve| curve.signature() == signature;
    let differs = |j: &&usize| !curves[**j].as_ref().is_some_and(alike);
    if probes.iter().filter(differs).count() > 1 {
        return None;
    }
    curves.par_iter_mut().enumerate().for_each(|(j, known)| {
        if !probes.contains(&j) {
            *known = scanned(j, Some(&signature));
        }
    });
    let curves: Vec<_> = curves.into_iter().map(|curve| curve.filter(alike)).collect();
    let found: Vec<&DeflectionCurve> = curves.iter().flatten().collect();
    if places.len() - found.len() > most_missing(places.len()) {
        return None;
    }
    // others decide on a fold's segment, too, so that few azimuths are treated as many are
    let deciding = layout.near_critical && places.len() < DECIDING;
    let others: Vec<Option<DeflectionCurve>> = (0..if deciding { DECIDING } else { 0 })
        .map(|j| plane(PI * j as f64 / (DECIDING - 1) as f64))
        .map(|plane| DeflectionCurve::new(plane, &silhouette, layout.scanning()))
        .map(|curve| curve.filter(alike))
        .collect();
    let all: Vec<&DeflectionCurve> = found.iter().copied().chain(others.iter().flatten()).collect();
    layout.folds = fold_reaches(&all, layout.axis_gap, layout.size_parameter);
    let mut near_rim = Vec::new();
    if let Some(rim) = &mut layout.rim {
        let (index, x) = (tracer.index().re, layout.size_parameter);
        near_rim = rim.spread_knots(&found, layout.axis_gap, index, caustic_disorder, x)?;
    }
    let mut near_rim = near_rim.into_iter();
    let near_rim: Vec<Option<Rays>> =
        curves.iter().map(|curve| curve.as_ref().and_then(|_| near_rim.next())).collect();
    let shrinks = if layout.folds.is_empty() { 1 } else { SHRINKS };
    for _ in 0..shrinks {
        if let Some((planes, layout)) = cut(&curves, &near_rim, &others, &layout) {
            let symmetric = tracer.shape().rotational_symmetry();
            let rim = near_rim.iter().flatten().next();
            let about_axis =
                if symmetric { axis_waves(found.first()?, &layout, rim) } else { Vec::new() };
            return Some(Traced { planes, layout, about_axis });
        }
        layout.folds.iter_mut().for_each(|fold| {
            fold.dark *= 0.6;
            fold.lit *= 0.95;
        });
    }
    None
}

/// Scattering planes that may be filled from their neighbours: rays get lost here and there where a
/// plane grazes a tangle of rays.
fn most_missing(count: usize) -> usize {
    count / 10
}

/// How often the reach of pair segments is shortened when a complex ray cannot be found.
const SHRINKS: usize = 6;

/// Reach on the dark and lit side of each fold, common to all planes.
fn fold_reaches(
    curves: &[&DeflectionCurve],
    axis_gap: f64,
    size_parameter: f64,
) -> Vec<FoldLayout> {
    let measured: Vec<Vec<(f64, f64)>> = curves.iter().map(|curve| curve.folds(axis_gap)).collect();
    let count = measured.first().map_or(0, Vec::len);
    let unit = size_parameter.powf(-2.0 / 3.0);
    (0..count)
        .map(|f| {
            let weakest = measured.iter().map(|m| m[f].0).fold(f64::MAX, f64::min);
            let strongest = measured.iter().map(|m| m[f].0).fold(0.0, f64::max);
            let room = measured.iter().map(|m| m[f].1).fold(f64::MAX, f64::min);
            let dark = (DARK_ZETA * unit / weakest).min(LONGEST_DARK);
            let lit = (LIT_ZETA * unit / weakest).min(0.97 * room).min(LONGEST_REACH);
            FoldLayout { dark, lit, per_angle: strongest / unit, integral: None }
        })
        .collect()
}

/// All segments of all planes, with common numbers of knots; `near_rim` are each plane's rays near the rim.
fn cut(
    curves: &[Option<DeflectionCurve>],
    near_rim: &[Option<Rays>],
    others: &[Option<DeflectionCurve>],
    layout: &CutLayout,
) -> Option<(Vec<Vec<Segment>>, CutLayout)> {
    type Ends = Vec<[Node; 2]>;
    let find_ends = |curves: &[Option<DeflectionCurve>], layout: &CutLayout| -> Vec<Option<Ends>> {
        curves.par_iter().map(|curve| curve.as_ref().and_then(|curve| curve.ends(layout))).collect()
    };
    let mut layout = layout.clone();
    let mut ends = find_ends(curves, &layout);
    layout.cut = before_the_ends(ends.iter().flatten().filter_map(|ends| ends.last()));
    if layout.cut.is_some() {
        ends = find_ends(curves, &layout);
    }
    let other_ends = find_ends(others, &layout);
    let all = curves.iter().chain(others).zip(ends.iter().chain(&other_ends));
    let deciding: Vec<(&DeflectionCurve, &Ends)> =
        all.filter_map(|(curve, ends)| curve.as_ref().zip(ends.as_ref())).collect();
    if avoid_total_reflection(&deciding, &mut layout) {
        ends = find_ends(curves, &layout);
    }
    let plain_count = ends.iter().flatten().next()?.len();
    let pieces = |s: usize| ends.iter().flatten().map(|e| layout.pieces(&e[s])).max().unwrap_or(0);
    layout.knots = (0..plain_count).map(pieces).collect();
    let segments = |j: usize| -> Option<Vec<Segment>> {
        curves[j].as_ref()?.segments(&layout, ends[j].as_ref()?, near_rim[j].as_ref())
    };
    let cut: Vec<Option<Vec<Segment>>> = (0..curves.len()).into_par_iter().map(segments).collect();
    let template: Vec<Kind> = cut.iter().flatten().next()?.iter().map(|s| s.kind).collect();
    // a fold's integral on one plane may be a pair on another, whose impacts do not serve
    let alike = |(a, b): (&Segment, &Kind)| {
        a.kind == *b
            || matches!(
                (a.kind, b),
                (Kind::Wave, Kind::Pair { .. }) | (Kind::Pair { .. }, Kind::Wave)
            )
    };
    let same_kind =
        |m: &Vec<Segment>| m.len() == template.len() && m.iter().zip(&template).all(alike);
    let filled = fill_missing(cut.into_iter().map(|m| m.filter(same_kind)).collect())?;
    Some((filled, layout))
}

/// One more plane, cut like those of a layout.
pub(crate) fn another(
    tracer: &Tracer,
    order: u32,
    azimuth: f64,
    layout: &CutLayout,
) -> Option<Vec<Segment>> {
    let silhouette = tracer.shape().silhouette().tabulated();
    let centre = axial_ray(tracer, order);
    let curve = DeflectionCurve::new(
        ScatteringPlane::new(tracer, order, azimuth, centre),
        &silhouette,
        layout.scanning(),
    )?;
    let near_rim = match &layout.rim {
        Some(rim) => Some(rim.rays(&curve)?),
        None => None,
    };
    curve.segments(layout, &curve.ends(layout)?, near_rim.as_ref())
}

/// Where to cut last segments whose last rays differ from plane to plane, as they do where some
/// are totally reflected: their knots would jump along.
fn before_the_ends<'e>(last: impl Iterator<Item = &'e [Node; 2]> + Clone) -> Option<f64> {
    const ALIKE: f64 = 1e-3;
    const SHORTEST: f64 = 0.05;
    const SPARE: f64 = 0.04;
    let begin = last.clone().map(|[a, _]| a.alpha).fold(0.0, f64::max);
    let ends = || last.clone().map(|[_, b]| b.alpha);
    let (low, high) = (ends().fold(f64::MAX, f64::min), ends().fold(0.0, f64::max));
    let serves = high - low > ALIKE && low - begin > SHORTEST;
    serves.then_some(low - SPARE * (low - begin))
}

/// Keep folds' segments from rays near total reflection, on all planes: those that would be left too
/// short for single rays beyond become integrals, as far as all planes' impacts serve. Whether
/// any changed.
fn avoid_total_reflection(
    curves: &[(&DeflectionCurve, &Vec<[Node; 2]>)],
    layout: &mut CutLayout,
) -> bool {
    if !layout.near_critical {
        return false;
    }
    let critical: Vec<Vec<f64>> =
        curves.iter().map(|(curve, ends)| near_critical::critical_angles(curve, ends)).collect();
    let mut changed = false;
    for (f, fold) in layout.folds.iter_mut().enumerate() {
        let nearest =
            CLEARANCE * critical.iter().map(|curve| curve[f]).fold(f64::INFINITY, f64::min);
        if nearest > fold.lit {
            continue;
        }
        changed = true;
        if nearest * fold.per_angle > SHORTEST_ZETA {
            fold.lit = nearest;
            continue;
        }
        let reach = |(curve, _): &(&DeflectionCurve, _)| {
            near_critical::integral_reach(curve, f, layout.size_parameter)
        };
        let reaches: Vec<f64> = curves.iter().filter_map(reach).collect();
        if reaches.is_empty() {
            continue;
        }
        let reach = reaches.into_iter().fold(fold.lit, f64::min);
        if reach * fold.per_angle > SHORTEST_ZETA {
            fold.lit = reach;
            fold.integral = Some(near_critical::knots([fold.dark, fold.lit], fold.per_angle));
        }
    }
    changed
}

/// Planes on either side that a missing one is filled from.
const BESIDE: usize = 3;

/// Fill planes that were not found by the polynomial through the nearest on both sides. `None` when too many or an
/// outer one is missing.
fn fill_missing(planes: Vec<Option<Vec<Segment>>>) -> Option<Vec<Vec<Segment>>> {
    let found: Vec<(usize, &Vec<Segment>)> =
        planes.iter().enumerate().filter_map(|(k, plane)| Some((k, plane.as_ref()?))).collect();
    if planes.len() - found.len() > most_missing(planes.len()) {
        return None;
    }
    let filled = |k: usize| {
        let after = found.partition_point(|&(j, _)| j < k);
        if after == 0 || after == found.len() {
            return None;
        }
        let alike = |(a, b): (&Segment, &Segment)| a.kind == b.kind;
        let near = [BESIDE, 1]
            .map(|beside| &found[after.saturating_sub(beside)..(after + beside).min(found.len())])
            .into_iter()
            .find(|near| near.iter().all(|(_, plane)| plane.iter().zip(near[0].1).all(alike)))?;
        let (_, first) = near[0];
        let weight = |j: usize| {
            let others = near.iter().filter(|(other, _)| *other != j);
            let off = |from: usize, to: usize| from as f64 - to as f64;
            others.map(|&(other, _)| off(k, other) / off(j, other)).product::<f64>()
        };
        let weights: Vec<f64> = near.iter().map(|&(j, _)| weight(j)).collect();
        let knot = |s: usize, i: usize| {
            Knot::weighted(
                near.iter().zip(&weights).map(|((_, plane), w)| (*w, &plane[s].knots[i])),
            )
        };
        let segment = |(s, like): (usize, &Segment)| Segment {
            kind: like.kind,
            knots: (0..like.knots.len()).map(|i| knot(s, i)).collect(),
        };
        Some(first.iter().enumerate().map(segment).collect())
    };
    (0..planes.len()).map(|k| planes[k].clone().or_else(|| filled(k))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::farfield::branch::knots::CHANNELS;
    use crate::shape::Shape;

    const PLAIN: Kind = Kind::Plain { focal_lines: 2, from_axis: true };

    /// A polynomial of the degree that three planes on either side hold.
    fn value(k: usize) -> f64 {
        let t = k as f64 / 10.0 - 0.7;
        1.0 + t - 3.0 * t.powi(2) + 2.0 * t.powi(5)
    }

    fn plane(value: f64) -> Option<Vec<Segment>> {
        let mut knot = Knot::default();
        *knot.channels_mut() = [value; CHANNELS];
        Some(vec![Segment { kind: PLAIN, knots: vec![knot; 2] }])
    }

    /// Some missing planes are filled from their neighbours, as many as one in ten.
    #[test]
    fn missing_planes_are_filled_in_between() {
        let planes = |missing: &[usize]| {
            let of = |k: usize| if missing.contains(&k) { None } else { plane(value(k)) };
            fill_missing((0..20).map(of).collect())
        };
        for missing in [vec![], vec![7], vec![7, 8], vec![3, 15]] {
            let filled = planes(&missing).unwrap();
            for (k, plane) in filled.iter().enumerate() {
                let off = plane[0].knots[1].channels()[5] - value(k);
                assert!(off.abs() < 1e-12, "{missing:?} {k}: {off:e}");
            }
        }
        // too many, or none on one side
        assert!(planes(&[4, 9, 12]).is_none() && planes(&[0]).is_none() && planes(&[19]).is_none());
        let mut differing: Vec<_> = (0..20).map(|k| plane(f64::from(k))).collect();
        differing[5] = None;
        differing[7].as_mut().unwrap()[0].kind = Kind::Wave;
        let filled = fill_missing(differing.clone()).unwrap();
        assert!(
            (filled[5][0].knots[0].channels()[0] - 5.0).abs() < 1e-14,
            "from the next two alone"
        );
        differing[6].as_mut().unwrap()[0].kind = Kind::Wave;
        assert!(fill_missing(differing).is_none());
    }

    /// Last rays that differ are cut off a little before the first of them.
    #[test]
    fn planes_are_cut_before_last_rays_that_differ() {
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, 1.333.into(), 1000.0, 1);
        let silhouette = shape.silhouette();
        let plane = ScatteringPlane::new(&tracer, 1, 0.0, [0.0; 2]);
        let ends =
            |a: f64, b: f64| [a, b].map(|alpha| plane.node(&silhouette, alpha, 0.0, 0.0).unwrap());
        let (one, other) = (ends(0.2, 1.4), ends(0.3, 1.2));
        let cut = before_the_ends([&one, &other].into_iter()).unwrap();
        assert!((cut - (1.2 - 0.04 * 0.9)).abs() < 1e-14, "{cut}");
        assert!(before_the_ends([&one, &one].into_iter()).is_none());
        // too little would be left
        let short = ends(1.19, 1.21);
        assert!(before_the_ends([&one, &short].into_iter()).is_none());
    }
}
