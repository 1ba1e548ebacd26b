//! Rays in a sphere whose index varies along the radius: Bouguer's invariant.
//!
//! `n r sin ψ = b` holds along the ray, so that a chord turns where `n(r) r = b` (radius `r_t`) and
//! sweeps about the centre, on an optical path,
//! ```text
//! Φ = 2 ∫ b dr/(r s)        L = 2 ∫ n² r dr/s        s = √(n²r² - b²),  r from r_t to 1
//! ```
//! The straight chord with the same turning point, of index `n_t = b/r_t`, is subtracted in closed
//! form; what is left is smooth in t, `r² = r_t² + (1 - r_t²) t²`, also for rays through the centre.
//! After Born & Wolf 1999, sec. 3.2.1; the subtraction is this program's.
//!
//! ```
//! use gonio::medium::radial::{Body, Profile, Smooth};
//! use gonio::trace::{Chord, RadialRays};
//!
//! // Luneburg's lens: every ray leaves at the point of the far side that lies on the axis
//! let lens = Body::smooth(Smooth::profile(&Profile::Luneburg { c: 2.0 }, 1.0));
//! let Chord::Through { swept, .. } = RadialRays::new(&lens).chord(0.5) else { unreachable!() };
//! assert!((swept + 0.5f64.asin() - std::f64::consts::PI).abs() < 1e-9);
//! ```

use super::symmetry_plane::Rainbow;
use crate::math::gauss_legendre;
use crate::medium::radial::Body;
use std::f64::consts::PI;

/// What becomes of a ray that meets the surface from outside, at an impact parameter in units of
/// the radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Chord {
    /// From surface to surface.
    Through {
        /// Angle about the centre, radians.
        swept: f64,
        /// Optical path in units of the radius.
        path: f64,
    },
    /// It winds about the centre without end (`n r` never falls to b): all of it is absorbed there.
    Centre,
    /// The index at the surface lets nothing in at this impact.
    Reflected,
}

/// Chords inside one body.
#[derive(Clone, Debug)]
pub struct RadialRays<'a> {
    body: &'a Body,
    /// Nodes on [0, 1] with weights.
    pub(super) nodes: Vec<(f64, f64)>,
    /// Radii between which the index is smooth, ascending, without 0 and 1.
    breaks: Vec<f64>,
}

/// Nodes between two kinks: 12 give 1e-12 for smooth lenses.
const NODES: usize = 24;
/// Radii at which a turning point is looked for from outside in.
const SCAN: usize = 512;
/// A ray that has not turned here never will.
const INNERMOST: f64 = 1e-9;

impl<'a> RadialRays<'a> {
    /// Rays in a body.
    pub fn new(body: &'a Body) -> Self {
        let nodes =
            gauss_legendre::nodes(NODES).into_iter().map(|(t, w)| (0.5 * (t + 1.0), 0.5 * w));
        let mut breaks = body.breaks();
        breaks.retain(|r| *r > 0.0 && *r < 1.0);
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        Self { body, nodes: nodes.collect(), breaks }
    }

    pub(super) fn index(&self, radius: f64) -> f64 {
        self.body.index(radius).re
    }

    /// The chord of impact parameter `b ≥ 0`.
    pub fn chord(&self, b: f64) -> Chord {
        if self.index(1.0) <= b {
            return Chord::Reflected;
        }
        let Some((turning, index)) = self.turning(b) else { return Chord::Centre };
        self.integrated(b, turning, index)
    }

    /// Deviation of the ray with so many chords (not folded into 0 … π): `2 asin b - π + p Φ`.
    pub fn deflection(&self, b: f64, chords: u32) -> Option<f64> {
        let outside = 2.0 * b.asin() - PI;
        match (chords, self.chord(b)) {
            (0, _) => Some(outside),
            (p, Chord::Through { swept, .. }) => Some(outside + f64::from(p) * swept),
            _ => None,
        }
    }

    /// Radius and index at which a ray turns.
    pub(super) fn turning(&self, b: f64) -> Option<(f64, f64)> {
        if b == 0.0 {
            let index = self.index(INNERMOST);
            return index.is_finite().then_some((0.0, index)).filter(|_| index * INNERMOST < 0.5);
        }
        let above = |r: f64| self.index(r) * r > b;
        let mut outer = 1.0;
        let radii = (1..SCAN).map(|i| 1.0 - i as f64 / SCAN as f64);
        for inner in radii.chain([1e-4, 1e-6, INNERMOST]) {
            if above(inner) {
                outer = inner;
                continue;
            }
            let (mut low, mut high) = (inner, outer);
            while high - low > 1e-16 * high {
                let middle = 0.5 * (low + high);
                if middle <= low || middle >= high {
                    break;
                }
                if above(middle) {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            // On a jump of n r (total reflection inside) the straight chord is that of the radius.
            return Some((high, b / high));
        }
        None
    }

    fn integrated(&self, b: f64, turning: f64, index: f64) -> Chord {
        let span = 1.0 - turning * turning;
        let mut ends: Vec<f64> = vec![0.0];
        let place = |r: f64| ((r * r - turning * turning) / span).sqrt();
        ends.extend(self.breaks.iter().filter(|r| **r > turning).map(|r| place(*r)));
        ends.push(1.0);
        let (mut swept, mut path) = (2.0 * turning.acos(), 2.0 * index * span.sqrt());
        for pair in ends.windows(2) {
            for &(node, weight) in &self.nodes {
                let (angle, length) =
                    self.rest(b, turning, index, pair[0] + (pair[1] - pair[0]) * node);
                swept += 2.0 * angle * weight * (pair[1] - pair[0]);
                path += 2.0 * length * weight * (pair[1] - pair[0]);
            }
        }
        Chord::Through { swept, path }
    }

    /// What the angle and the path gain per t over those of the straight chord.
    pub(super) fn rest(&self, b: f64, turning: f64, index: f64, t: f64) -> (f64, f64) {
        let span = 1.0 - turning * turning;
        let square = turning * turning + span * t * t;
        let radius = square.sqrt();
        let n2 = self.index(radius).powi(2);
        let s = (n2 * square - b * b).max(f64::MIN_POSITIVE).sqrt();
        let straight = index * span.sqrt() * t;
        // 1/s - 1/s₀
        let rest = (index * index - n2) * square / (s * straight * (s + straight));
        let dr = span * t / radius;
        let path = (n2 * radius * rest + (n2 - index * index) * radius / straight) * dr;
        (b / radius * rest * dr, path)
    }

    /// Impacts and scattering angles at which the deflection of so many chords is stationary: the rainbows
    /// of one order, however many there are.
    pub fn rainbows(&self, chords: u32) -> Vec<Rainbow> {
        if chords == 0 {
            return Vec::new();
        }
        let largest = self.index(1.0).min(1.0);
        let at = |i: usize| largest * i as f64 / SCAN as f64;
        let slope = |b: f64| {
            let step = 1e-5;
            let side = |b: f64| self.deflection(b.clamp(0.0, largest - 1e-9), chords);
            Some((side(b + step)? - side(b - step)?) / (2.0 * step))
        };
        let mut found = Vec::new();
        // The impacts 0 and 1 are ends, no bows.
        for i in 1..SCAN - 1 {
            let (mut low, mut high) = (at(i), at(i + 1));
            let (Some(below), Some(above)) = (slope(low), slope(high)) else { continue };
            if below == 0.0 || below * above >= 0.0 {
                continue;
            }
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                match slope(middle) {
                    Some(value) if value * below > 0.0 => low = middle,
                    _ => high = middle,
                }
            }
            if let Some(deflection) = self.deflection(low, chords) {
                found.push(Rainbow { impact: low, deviation: folded(deflection) });
            }
        }
        found
    }
}

/// The scattering angle of a deflection.
fn folded(deflection: f64) -> f64 {
    deflection.cos().clamp(-1.0, 1.0).acos()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::medium::radial::{Profile, Smooth};
    use serde_json::Value;

    const CLOSED_FORMS: &str = include_str!("../../tests/data/layered/grin_ray_checks.json");

    fn body(profile: Profile) -> Body {
        Body::smooth(Smooth::profile(&profile, 1.0))
    }

    /// Luneburg lenses, fish-eye, Gaussian: angle swept and path of the closed forms.
    #[test]
    fn closed_forms() {
        let all: Value = serde_json::from_str(CLOSED_FORMS).unwrap();
        let mut compared = 0;
        for test in all["tests"].as_array().unwrap() {
            let number = |key: &str| test[key].as_f64();
            let profile = match test["profile"].as_str().unwrap() {
                "luneburg_C" => Profile::Luneburg { c: number("C").unwrap() },
                name if name.contains("fish") => Profile::FishEye,
                name if name.contains("gauss") => {
                    let a = number("a").unwrap_or(1.4);
                    Profile::Gaussian { a, b: a.ln() }
                }
                _ => continue,
            };
            let phi = number("Phi").or(number("quad_Phi"));
            let (Some(b), Some(phi)) = (number("b"), phi) else { continue };
            let body = body(profile);
            let Chord::Through { swept, path } = RadialRays::new(&body).chord(b) else {
                panic!("{test}: no chord")
            };
            assert!((swept - phi).abs() < 1e-9, "{test}: {swept}");
            if let Some(right) = number("opl_inside").or(number("quad_opl")) {
                assert!((path - right).abs() < 1e-9, "{test}: {path}");
            }
            compared += 1;
        }
        assert!(compared >= 20, "{compared}");
    }

    /// Water with n = 1.333 + 1e-3 (1 - r²) against water of 1.333: both bows move.
    #[test]
    fn bows_of_a_drop_with_a_gradient() {
        for (profile, chords, theta) in [
            (vec![1.334, -1e-3], 2, 138.09144),
            (vec![1.334, -1e-3], 3, 128.85131),
            (vec![1.333], 2, 137.92189),
            (vec![1.333], 3, 129.10924),
        ] {
            let body = body(Profile::Polynomial(profile));
            let bows = RadialRays::new(&body).rainbows(chords);
            assert_eq!(bows.len(), 1);
            let found = bows[0].deviation.to_degrees();
            assert!((found - theta).abs() < 1e-4, "{chords}: {found} {theta}");
        }
    }

    /// Luneburg's lens without interference and reflection: `P = β dβ/(π sin θ dθ) = cos θ/π` up to 90°.
    #[test]
    fn the_lens_scatters_like_a_cosine() {
        const H: f64 = 1e-4;
        let lens = body(Profile::Luneburg { c: 2.0 });
        let rays = RadialRays::new(&lens);
        let angle = |b: f64| folded(rays.deflection(b, 1).unwrap());
        for b in [0.05, 0.3, 0.6, 0.9, 0.99] {
            let slope = (angle(b + H) - angle(b - H)) / (2.0 * H);
            let found = b / (PI * angle(b).sin() * slope);
            assert!((found * PI / angle(b).cos() - 1.0).abs() < 1e-4, "{b}: {found}");
        }
        assert!((0..100).all(|i| angle(0.01 * f64::from(i)) < 0.5 * PI));
    }

    /// Inverse profile: every ray that enters ends at the centre; none turns.
    #[test]
    fn spirals_end_at_the_centre() {
        let body = body(Profile::Inverse { k: 1.5 });
        let rays = RadialRays::new(&body);
        for i in 0..10 {
            assert_eq!(rays.chord(0.1 * f64::from(i)), Chord::Centre);
        }
    }
}
