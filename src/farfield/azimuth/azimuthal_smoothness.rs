//! How far planes are from varying smoothly with azimuth.
//!
//! A polynomial over azimuth is only as good as what it passes through. Where rays of some azimuths
//! are totally reflected, the last ray that leaves jumps from one plane to the next, and all knots
//! of a segment with it; planes filled from their neighbours have kinks; two rays' wave may change
//! faster than there are planes. So every plane is compared with the polynomial through its
//! neighbours.

use crate::farfield::branch::knots::{CHANNELS, Kind, Knot, Segment};

/// Weights of the neighbours one, two and three steps away on either side, of the polynomial of fifth
/// degree through them, half-way.
const WEIGHTS: [f64; 3] = [0.75, -0.3, 0.05];

/// Largest difference between planes at even steps over a half-turn and what their neighbours make
/// of them: the phase of their paths at equal angles, or waves relative to their largest. Infinite
/// where segments are of different kinds.
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
    let (mut paths, mut waves, mut size) = (0.0f64, 0.0f64, 0.0f64);
    for j in 0..=last {
        for (i, knot) in planes[j][s].knots.iter().enumerate() {
            let mut expected = Knot::default();
            for (k, weight) in WEIGHTS.iter().enumerate() {
                for neighbour in around(j, k + 1) {
                    add(&mut expected, *weight, &planes[neighbour][s].knots[i]);
                }
            }
            let (knot, expected) = (knot.single(), expected.single());
            let path = knot.path + knot.path_slope * (expected.angle - knot.angle);
            paths = paths.max((expected.path - path).abs());
            // S1 and S2, which are even in azimuth
            for (found, expected) in knot.amplitudes[..2].iter().zip(&expected.amplitudes) {
                let off = expected - found;
                waves = waves.max(off.re.abs()).max(off.im.abs());
                size = size.max(found.re.abs()).max(found.im.abs());
            }
        }
    }
    let wave = planes[0][s].kind == Kind::Wave;
    (size_parameter * paths).max(if wave { waves / size } else { 0.0 })
}

fn add(sum: &mut Knot, weight: f64, knot: &Knot) {
    for c in 0..CHANNELS {
        sum.channels_mut()[c] += weight * knot.channels()[c];
    }
}
