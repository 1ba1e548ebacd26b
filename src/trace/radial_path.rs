//! The way of a curved ray through a sphere, point by point: to be drawn.

use super::radial::{Chord, RadialRays};

/// Points of half a chord's path; those of a spiral, and the radius where it ends.
const PATH: usize = 48;
const SPIRAL: usize = 240;
const SPIRAL_END: f64 = 0.02;

impl RadialRays<'_> {
    /// Points of the path of a ray from where it enters (impact `b ≥ 0`, light along z, upper side x), after
    /// so many chords; of a ray that winds about the centre, until it is near it.
    pub fn path(&self, b: f64, chords: u32) -> Vec<[f64; 2]> {
        let half = self.half_chord(b);
        // Angle of the place about the centre, from the direction the light comes from.
        let mut angle = b.clamp(0.0, 1.0).asin();
        let place = |radius: f64, angle: f64| [radius * angle.sin(), -radius * angle.cos()];
        let mut points = vec![place(1.0, angle)];
        let Some((_, middle)) = half.last().copied() else { return points };
        let through = matches!(self.chord(b), Chord::Through { .. });
        for _ in 0..chords {
            points.extend(half.iter().skip(1).map(|&(r, swept)| place(r, angle + swept)));
            if !through {
                break;
            }
            let back = half.iter().rev().skip(1);
            points.extend(back.map(|&(r, swept)| place(r, angle + 2.0 * middle - swept)));
            angle += 2.0 * middle;
        }
        points
    }

    /// From the surface inwards: radii and the angle swept up to there; none where nothing enters.
    fn half_chord(&self, b: f64) -> Vec<(f64, f64)> {
        if self.index(1.0) <= b {
            return Vec::new();
        }
        let Some((turning, index)) = self.turning(b) else { return self.spiral(b) };
        // Evenly in t, from the turning point outwards; the angle is what the straight chord sweeps and
        // the rest.
        let span = 1.0 - turning * turning;
        let straight = |t: f64| ((span.sqrt() * t).atan2(turning), t);
        let mut swept = vec![(turning, 0.0)];
        let mut rest = 0.0;
        for step in 0..PATH {
            let (from, to) = (step as f64 / PATH as f64, (step + 1) as f64 / PATH as f64);
            for &(node, weight) in &self.nodes {
                let t = from + (to - from) * node;
                rest += self.rest(b, turning, index, t).0 * (to - from) * weight;
            }
            let (angle, t) = straight(to);
            swept.push(((turning * turning + span * t * t).sqrt(), angle + rest));
        }
        let whole = swept[PATH].1;
        swept.into_iter().rev().map(|(r, angle)| (r, whole - angle)).collect()
    }

    /// The way of a ray that never turns, even in ln r: `dφ = b dr/(r s)`.
    fn spiral(&self, b: f64) -> Vec<(f64, f64)> {
        let depth = SPIRAL_END.ln() / SPIRAL as f64;
        let mut points = vec![(1.0, 0.0)];
        let mut angle = 0.0;
        for step in 0..SPIRAL {
            for &(node, weight) in &self.nodes {
                let radius = (depth * (step as f64 + node)).exp();
                let nr = self.index(radius) * radius;
                angle -= depth * weight * b / (nr * nr - b * b).max(f64::MIN_POSITIVE).sqrt();
            }
            points.push(((depth * (step + 1) as f64).exp(), angle));
        }
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::medium::radial::{Body, Profile, Smooth};

    fn body(profile: Profile) -> Body {
        Body::smooth(Smooth::profile(&profile, 1.0))
    }

    /// Paths begin and end on the surface, where the chord's angle says; Luneburg's lens brings them all to
    /// one point.
    #[test]
    fn paths_lead_where_the_chords_lead() {
        let lens = body(Profile::Luneburg { c: 2.0 });
        let rays = RadialRays::new(&lens);
        for b in [0.0, 0.2, 0.7, 0.95] {
            let path = rays.path(b, 1);
            let (first, last) = (path[0], path[path.len() - 1]);
            assert!((first[0] - b).abs() < 1e-12 && first[1] <= 0.0, "{b}: {first:?}");
            assert!(last[0].abs() < 1e-8 && (last[1] - 1.0).abs() < 1e-8, "{b}: {last:?}");
            assert!(path.iter().all(|[x, z]| x.hypot(*z) < 1.0 + 1e-12));
        }
        // in a ball of one index chords are straight
        let ball = body(Profile::Polynomial(vec![1.333]));
        let path = RadialRays::new(&ball).path(0.6, 2);
        let (first, second) = (path[0], path[96]);
        for [x, z] in &path[..=96] {
            let across =
                (x - first[0]) * (second[1] - first[1]) - (z - first[1]) * (second[0] - first[0]);
            assert!(across.abs() < 1e-10, "{x} {z}");
        }
        assert_eq!(path.len(), 193);
        let inverse = body(Profile::Inverse { k: 1.5 });
        let spiral = RadialRays::new(&inverse).path(0.5, 3);
        let [x, z] = spiral[spiral.len() - 1];
        assert!((x.hypot(z) - SPIRAL_END).abs() < 1e-12);
    }
}
