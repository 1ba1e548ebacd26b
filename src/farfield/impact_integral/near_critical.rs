//! The wave at a fold where rays come to be totally reflected inside the particle.
//!
//! In a deformed particle a ray's angles of incidence differ from hit to hit, and those of a bow may
//! pass the critical angle at one of them. There the coefficients of reflection run like a square
//! root on one side and turn the phase on the other: a pair's series about the fold and its complex
//! rays behind it ([`crate::farfield::deflection::fold`]) know nothing of that. The integral over impacts along the plane
//! ([`super::near_grazing`]) asks for real rays alone, whatever coefficients they have. It begins with a taper
//! before the inner of the two rays of the segment's last direction, and goes on to the rim and as far
//! beyond as waves tunnel, since an end before the rim would be an edge that shines.

use super::integrand::Sums;
use super::near_grazing::wave_knot;
use super::prefactor::Prefactor;
use super::rays::{Rays, TUNNEL};
use crate::farfield::branch::knots::{Kind, Knot, Segment};
use crate::farfield::branch::window::Window;
use crate::farfield::deflection::curve::DeflectionCurve;
use crate::farfield::deflection::fold::Fold;
use crate::farfield::deflection::scattering_plane::{Node, ScannedRay};
use std::f64::consts::TAU;

/// Squared cosine outside below which the coefficients of reflection run too fast for a series.
const NEAR_CRITICAL: f64 = 0.02;
const BELOW_ENTRY: f64 = 0.5;
/// Fresnel zones of a ray within the taper, and the share of the launch points before it.
const FRESNEL_ZONES: f64 = 12.0;
const MOST_ROOM: f64 = 0.9;
/// Degree of the polynomials through real rays, and the share of the stretch from the fold to the last
/// ray that is left to their continuation: next to the rim path and angles have a part that is odd in
/// the grazing angle.
const DEGREE: usize = 10;
const SPARE: f64 = 0.25;
/// How far they may be continued, over the stretch from the fold to the last ray they pass through.
const MOST_CONTINUED: f64 = 0.8;
/// Spread across the plane, over that at the fold, from which on impacts serve as coordinates.
const LEAST_SPREAD: f64 = 0.4;
/// Share of the angle to the inner rays that no longer serve that may be used.
const INNER_SHARE: f64 = 0.6;
/// Knots per period of either ray's wave against the mean path, and per unit of the Airy function's
/// argument next to the fold.
const KNOTS_PER_PERIOD: f64 = 8.0;
const KNOTS_PER_UNIT: f64 = 2.0;

/// Whether a ray meets the surface inside near or beyond the critical angle, other than by being near
/// the rim.
fn meets_total_reflection(curve: &DeflectionCurve, [u, v]: [f64; 2]) -> bool {
    let plane = curve.plane();
    let mut meetings = Vec::new();
    plane.tracer.trace_with_meetings(u, v, plane.order, &mut meetings);
    let Some(entry) = meetings.first() else { return false };
    let critical = NEAR_CRITICAL.min(BELOW_ENTRY * entry.cos_squared_outside);
    meetings.iter().take(plane.order as usize).skip(1).any(|m| m.cos_squared_outside < critical)
}

/// For each fold: angle from it to the nearest ray of its segment that comes near total reflection
/// inside; infinite where none does.
pub(crate) fn critical_angles(curve: &DeflectionCurve, ends: &[[Node; 2]]) -> Vec<f64> {
    let nearest = |(k, fold): (usize, &Fold)| {
        let [first, last] = [ends[k - 1][1], ends[k][0]];
        let between = |ray: &&ScannedRay| first.alpha < ray.alpha && ray.alpha < last.alpha;
        let scanned = curve.nodes().iter().filter(between).map(|ray| (ray.place, ray.angle));
        let traced = [first, last].into_iter().chain(curve.interpolated(fold.alpha));
        scanned
            .chain(traced.map(|ray| (ray.place, ray.angle)))
            .filter(|&(place, _)| meets_total_reflection(curve, place))
            .map(|(_, angle)| (angle - fold.angle).abs())
            .fold(f64::INFINITY, f64::min)
    };
    curve.numbered_folds().map(nearest).collect()
}

/// How far an integral over impacts reaches on the lit side of fold `number`. `None` where it
/// does not serve.
pub(crate) fn integral_reach(
    curve: &DeflectionCurve,
    number: usize,
    size_parameter: f64,
) -> Option<f64> {
    let (k, fold) = curve.numbered_folds().nth(number)?;
    Some(Stretch::of_fold(curve, fold, k, size_parameter)?.reach)
}

/// The stretch of launch points about a fold along which impacts serve as coordinates.
pub(crate) struct Stretch {
    /// First and last launch point `sin α`.
    from: f64,
    to: f64,
    /// Angle from the fold within which both rays of a direction lie well inside, as far as that
    /// limits them.
    pub reach: f64,
}

impl Stretch {
    /// About a fold that is landmark number `k`.
    pub(crate) fn of_fold(
        curve: &DeflectionCurve,
        fold: &Fold,
        k: usize,
        size_parameter: f64,
    ) -> Option<Self> {
        let limits =
            [curve.launch(&curve.landmarks[k - 1])?, curve.launch(&curve.landmarks[k + 1])?];
        Self::about(curve, fold, limits, size_parameter)
    }

    /// Between the landmarks before and behind the fold. `None` where the polynomials would have to
    /// be continued too far, or through rays whose impacts do not serve.
    fn about(curve: &DeflectionCurve, fold: &Fold, limits: [f64; 2], x: f64) -> Option<Self> {
        let across = |ray: &Node| curve.plane().spread_across(&ray.exit, ray.angle);
        let least = LEAST_SPREAD * across(&curve.ray_at(fold.alpha.sin())?);
        let serves = |ray: &&ScannedRay| ray.across * least.signum() > least.abs();
        let (inside, beyond): (Vec<&ScannedRay>, Vec<&ScannedRay>) =
            curve.nodes().iter().partition(|ray| ray.alpha < fold.alpha);
        let first = inside.iter().rev().take_while(|ray| serves(ray)).last()?;
        let last = beyond.iter().take_while(|ray| serves(ray)).last()?;
        let off = |ray: &ScannedRay| (ray.angle - fold.angle).abs();
        let (mut from, mut to, mut reach) = (limits[0], limits[1], f64::MAX);
        if first.alpha > inside.first()?.alpha {
            (from, reach) = (from.max(first.alpha.sin()), INNER_SHARE * off(first));
        }
        to -= SPARE * (to - fold.alpha.sin());
        if last.alpha.sin() < to {
            return None;
        }
        let continued = TUNNEL * x.powf(-2.0 / 3.0) + limits[1] - to;
        (continued < MOST_CONTINUED * (to - fold.alpha.sin())).then_some(Self { from, to, reach })
    }
}

/// Places of the knots, angles from the fold, for a fold whose argument is `per_angle` times that.
pub(crate) fn knots([dark, lit]: [f64; 2], per_angle: f64) -> Vec<f64> {
    let step = |argument: f64| {
        let period = TAU / argument.max(1e-9).sqrt();
        (period / KNOTS_PER_PERIOD).min(1.0 / KNOTS_PER_UNIT)
    };
    let (mut at, end) = (-dark * per_angle, lit * per_angle);
    let mut places = Vec::new();
    while at < end {
        places.push(at / per_angle);
        at += step(at);
    }
    places.push(lit);
    places
}

/// The wave at the given angles from the fold. `ends` are the fold's two rays at the last of them.
/// `None` where its rays cannot be followed.
pub(crate) fn segment(
    curve: &DeflectionCurve,
    fold: &Fold,
    stretch: &Stretch,
    [before, behind]: [&Node; 2],
    places: &[f64],
    x: f64,
) -> Option<Segment> {
    const ASIDE: f64 = 1e-3;
    let (bow, inner) = (fold.alpha.sin(), before.alpha.sin());
    let rate = (curve.ray_at(inner + ASIDE)?.angle - before.angle).abs() / ASIDE;
    let taper = (FRESNEL_ZONES / (x * rate).sqrt()).min(MOST_ROOM * (inner - stretch.from));
    let rise = Window { start: inner - taper, full: inner };
    let rays = Rays::between(curve, [rise.start, stretch.to], DEGREE, None)?;
    let end = curve.last_ray().alpha.sin() + TUNNEL * x.powf(-2.0 / 3.0);
    let off = |ray: &Node| (ray.angle - fold.angle).abs();
    let spread =
        off(&curve.ray_at(rise.start)?).max(off(curve.last_ray())) - places.first()?.min(0.0);
    let index = curve.plane().tracer.index();
    let integrand = rays.integrand(|sin| rise.weight(sin), end, spread, index, x)?;
    let prefactor = Prefactor::between(curve, [rise.start, 0.5 * (rise.start + bow)], x)?;

    // the reference is the mean path of the two rays: at the fold, and where the segment ends
    let anchor = rays.anchor(bow);
    let impact = |node: &Node| node.exit.reference.dot(curve.plane().frame(node.angle).1);
    let mean = 0.5 * (impact(before) + impact(behind));
    let bend = (mean - anchor.impact) / (fold.lit * places.last()?);
    let reference = |place: &f64| {
        let off = fold.lit * place;
        let angle = fold.angle + off;
        [angle, anchor.path + anchor.impact * (anchor.angle - angle) - 0.5 * bend * off * off]
    };
    let references: Vec<[f64; 2]> = places.iter().map(reference).collect();
    let knot = |(&[angle, path], sums): (&[f64; 2], &Sums)| {
        let slope = -anchor.impact - bend * (angle - fold.angle);
        let factor = prefactor.towards(angle) / angle.sin().abs().sqrt();
        wave_knot([angle, path, slope], factor, sums, x)
    };
    let knots: Vec<_> = references.iter().zip(&integrand.sums(&references, x)).map(knot).collect();
    knots.iter().all(Knot::is_finite).then_some(Segment { kind: Kind::Wave, knots })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Knots go from the dark side to the last lit direction; closer where the two rays' waves beat faster.
    #[test]
    fn knots_are_closer_where_waves_beat_faster() {
        let (dark, lit, per_angle) = (0.1, 0.4, 60.0);
        let places = knots([dark, lit], per_angle);
        assert_eq!((places[0], *places.last().unwrap()), (-dark, lit));
        let steps: Vec<f64> = places.windows(2).map(|w| w[1] - w[0]).collect();
        assert!(steps.iter().all(|&step| step > 0.0));
        // on the dark side by the Airy function's unit, on the lit side by its period
        assert!((steps[0] * per_angle - 1.0 / KNOTS_PER_UNIT).abs() < 1e-12);
        let k = places.len() - 4;
        let period = TAU / (places[k] * per_angle).sqrt();
        assert!((steps[k] * per_angle - period / KNOTS_PER_PERIOD).abs() < 1e-9);
    }
}
