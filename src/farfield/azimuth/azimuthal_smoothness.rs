//! How far planes are from varying smoothly with azimuth.
//!
//! A polynomial over azimuth is only as good as what it passes through. Where rays of some azimuths
//! are totally reflected, the last ray that leaves jumps from one plane to the next, and all knots
//! of a segment with it; planes filled from their neighbours have kinks; two rays' wave may change
//! faster than there are planes. So every plane is compared with the polynomial through its
//! neighbours.

use crate::farfield::branch::knots::{Kind, Knot, Segment, SingleKnot};

/// Weights of the neighbours one, two and three steps away on either side, of the polynomial of fifth
/// degree through them, half-way.
const WEIGHTS: [f64; 3] = [0.75, -0.3, 0.05];

/// Largest difference between planes at even steps over a half-turn and what their neighbours make
/// of them: the phase of their paths at equal angles, or waves relative to their largest; the phase of
/// such a wave counts as much as the wave is there. Infinite where segments are of different kinds.
pub(crate) fn azimuthal_smoothness(planes: &[Vec<Segment>], size_parameter: f64) -> f64 {
    if planes.len() <= WEIGHTS.len() {
        return 0.0;
    }
    let kinds = |m: &Vec<Segment>| m.iter().map(|s| s.kind).eq(planes[0].iter().map(|s| s.kind));
    if !planes.iter().all(kinds) {
        return f64::INFINITY;
    }
    let segments = 0..planes[0].len();
    segments.map(|s| of_segment(planes, s, size_parameter)).fold(0.0, f64::max)
}

fn of_segment(planes: &[Vec<Segment>], s: usize, size_parameter: f64) -> f64 {
    let last = planes.len() - 1;
    // planes beyond either end are mirror images
    let around = |j: usize, k: usize| [j.abs_diff(k), last - last.abs_diff(j + k)];
    let is_wave = planes[0][s].kind == Kind::Wave;
    let (mut paths, mut waves, mut size) = (0.0f64, 0.0f64, 0.0f64);
    for j in 0..=last {
        for (i, knot) in planes[j][s].knots.iter().enumerate() {
            let beside = WEIGHTS.iter().enumerate().flat_map(|(k, weight)| {
                around(j, k + 1).map(|neighbour| (*weight, &planes[neighbour][s].knots[i]))
            });
            let expected = Knot::weighted(beside);
            let (knot, expected) = (knot.single(), expected.single());
            let path = knot.path + knot.path_slope * (expected.angle - knot.angle);
            let strength = |knot: &SingleKnot| {
                let parts = knot.amplitudes[..2].iter().flat_map(|s| [s.re.abs(), s.im.abs()]);
                parts.fold(0.0, f64::max)
            };
            let counts = if is_wave { strength(&knot) } else { 1.0 };
            paths = paths.max((expected.path - path).abs() * counts);
            // S1 and S2, which are even in azimuth
            for (found, expected) in knot.amplitudes[..2].iter().zip(&expected.amplitudes) {
                let off = expected - found;
                waves = waves.max(off.re.abs()).max(off.im.abs());
                size = size.max(found.re.abs()).max(found.im.abs());
            }
        }
    }
    if is_wave { (size_parameter * paths).max(waves) / size } else { size_parameter * paths }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const X: f64 = 1000.0;

    /// Planes over a half-turn, one segment of two knots each, from path and first amplitude by azimuth.
    fn planes(kind: Kind, f: impl Fn(f64) -> [f64; 2]) -> Vec<Vec<Segment>> {
        let plane = |j: usize| {
            let [path, amplitude] = f(PI * j as f64 / 24.0);
            let knot = |angle: f64| {
                let mut knot = SingleKnot { angle, path, path_slope: -0.4, ..Default::default() };
                knot.amplitudes[0].re = amplitude;
                Knot::from(knot)
            };
            vec![Segment { kind, knots: vec![knot(1.0), knot(1.2)] }]
        };
        (0..=24).map(plane).collect()
    }

    const PLAIN: Kind = Kind::Plain { focal_lines: 2, from_axis: false };

    #[test]
    fn smooth_planes_are_smooth_to_both_ends() {
        let smooth = planes(PLAIN, |phi| [1.0 + 0.1 * phi.cos() + 0.02 * (2.0 * phi).cos(), 1.0]);
        assert!(azimuthal_smoothness(&smooth, X) < 2e-3);
        assert_eq!(azimuthal_smoothness(&smooth[..3], X), 0.0);
    }

    /// One plane off by a path has at least 5/16 of its phase, wherever it stands.
    #[test]
    fn a_plane_that_jumps_is_seen() {
        for j in [0, 7, 24] {
            let mut rough = planes(PLAIN, |phi| [1.0 + 0.1 * phi.cos(), 1.0]);
            let knot = &mut rough[j][0].knots[1];
            *knot = SingleKnot { path: knot.single().path + 1e-3, ..knot.single() }.into();
            let found = azimuthal_smoothness(&rough, X);
            assert!((0.9..=1.1).contains(&found), "{j}: {found}");
        }
        // angles that move with their paths along the ray's own slope are no fault
        let mut moved = planes(PLAIN, |_| [1.0, 1.0]);
        let knot = &mut moved[9][0].knots[0];
        let SingleKnot { angle, path, .. } = knot.single();
        *knot = SingleKnot { angle: angle + 1e-3, path: path - 0.4e-3, ..knot.single() }.into();
        assert!(azimuthal_smoothness(&moved, X) < 1e-3 * X * 1e-3);
    }

    #[test]
    fn waves_are_compared_by_their_amplitudes() {
        let jump = |phi: f64| [1.0, if phi > 1.5 { 1.0 } else { 0.5 }];
        assert!(azimuthal_smoothness(&planes(Kind::Wave, jump), X) > 0.1);
        assert!(azimuthal_smoothness(&planes(PLAIN, jump), X) < 1e-9);
        let mut mixed = planes(PLAIN, |_| [1.0, 1.0]);
        mixed[3][0].kind = Kind::Wave;
        assert_eq!(azimuthal_smoothness(&mixed, X), f64::INFINITY);
    }
}
