//! What the integral over rays near the rim needs along a plane, as polynomials in the launch
//! point: path, impact, spreading, and how the ray meets the surface each time.
//!
//! Real rays give the polynomials; beyond the rim, where none leaves, they are continued by a few wave
//! zones, and the coefficients of the curved interface ([`Grazing::whole`]) follow from them there.

use super::integrand::Integrand;
use super::met_fields::{MeetingChannels, transfer};
use super::ray_channels::{Channels, row, unwrap_turns};
use super::smooth_part::SmoothPart;
use crate::farfield::deflection::curve::DeflectionCurve;
use crate::farfield::deflection::scan::Scan;
use crate::farfield::deflection::scattering_plane::ScatteringPlane;
use crate::math::chebyshev::{self, Chebyshev};
use crate::optics::Grazing;
use crate::shape::Shape;
use crate::trace::{Meeting, Tracer};
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Real rays through which the polynomials pass.
pub(crate) const RAYS: usize = 20;
/// Wave zones `x^{-2/3}` beyond the last ray at which tunnelling has ended.
pub(crate) const TUNNEL: f64 = 4.0;
/// Samples of the integrand per period of its phase.
const SAMPLES_PER_PERIOD: f64 = 1.8;
/// Samples of which each is computed by itself.
const FEW: usize = 64;
/// Phase of the wave outside, from its turning point to the surface, from which on the coefficients of the curved
/// interface are asymptotic series.
const FAR: f64 = 18.0;

/// What the integral needs along a plane, as polynomials in the launch point `sin α`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Rays {
    channels: Channels<Chebyshev<1>>,
    /// Launch points of the first and the last real ray.
    from: f64,
    to: f64,
}

/// The reference of a rim wave: impact and path of the waves at the bow's impact, and the angle at
/// which their phase stands still.
pub(crate) struct Anchor {
    pub angle: f64,
    pub impact: f64,
    pub path: f64,
}

impl Rays {
    /// The anchor for a launch point. It varies smoothly with azimuth, also where no real ray leaves.
    pub(crate) fn anchor(&self, sin: f64) -> Anchor {
        let ((path, path_rate), (impact, rate)) = (self.path(sin), self.impact(sin));
        let angle = path_rate / rate;
        Anchor { angle, impact, path: path - impact * angle }
    }

    /// Those of a sphere from a launch point to the rim, through which they are analytic.
    pub(crate) fn of_sphere(order: u32, index: Complex64, from: f64) -> Option<Self> {
        const SPARE: f64 = 0.002;
        let shape = Shape::sphere();
        // rays know nothing of the size
        let tracer = Tracer::new(&shape, index, 1.0, order);
        let plane = ScatteringPlane::new(&tracer, order, 0.0, [0.0; 2]);
        let scan = Scan { nodes: 64 + 16 * order as usize, axis_gap: 0.02, limit: FRAC_PI_2 };
        let silhouette = shape.silhouette();
        let curve = DeflectionCurve::new(plane, &silhouette, scan)?;
        Self::between(&curve, [from, 1.0 - SPARE], RAYS - 1, None)
    }

    /// Trace real rays between two launch points; polynomials of a `degree` pass through what they have beside
    /// those of a sphere (`like`), or through all.
    pub(crate) fn between(
        curve: &DeflectionCurve,
        [from, to]: [f64; 2],
        degree: usize,
        like: Option<&Self>,
    ) -> Option<Self> {
        let plane = curve.plane();
        let points = chebyshev::points(RAYS, from, to);
        let mut meetings: Vec<Meeting> = Vec::new();
        let mut rows = Vec::with_capacity(RAYS);
        let like: Option<Vec<Channels<f64>>> =
            like.map(|like| points.iter().map(|&sin| like.channels.at(sin)).collect());
        for &sin in &points {
            let node = curve.ray_at(sin)?;
            let [u, v] = node.place;
            plane.tracer.trace_with_meetings(u, v, plane.order, &mut meetings)?;
            rows.push(row(curve, &node, &meetings)?);
        }
        unwrap_turns(&mut rows);
        let fit = |value: &dyn Fn(&Channels<f64>) -> f64| {
            let fit = |values: Vec<[f64; 1]>| Chebyshev::fit(&values, from, to);
            let all = rows.iter().map(value);
            let Some(like) = &like else {
                return fit(all.map(|value| [value]).collect()).truncated(degree).rounded();
            };
            let round: Vec<[f64; 1]> = like.iter().map(|row| [value(row)]).collect();
            let beside = all.zip(&round).map(|(value, [round])| [value - round]).collect();
            (fit(beside).truncated(degree) + fit(round)).rounded()
        };
        let meeting = |hit: usize| MeetingChannels {
            square: fit(&|row| row.meetings[hit].square),
            radius: fit(&|row| row.meetings[hit].radius),
            turn: fit(&|row| row.meetings[hit].turn),
        };
        let channels = Channels {
            impact: fit(&|row| row.impact),
            path: fit(&|row| row.path),
            spreading: fit(&|row| row.spreading),
            inside: fit(&|row| row.inside),
            meetings: (0..meetings.len()).map(meeting).collect(),
            last_turn: fit(&|row| row.last_turn),
        };
        Some(Self { channels, from, to })
    }

    /// The impact and its slope by launch point.
    fn impact(&self, sin: f64) -> (f64, f64) {
        at(&self.channels.impact, sin)
    }

    /// The path and its slope by launch point.
    fn path(&self, sin: f64) -> (f64, f64) {
        at(&self.channels.path, sin)
    }

    /// The launch point beyond the rim up to which waves tunnel.
    pub(crate) fn end_of_tunnel(&self, index: Complex64, x: f64) -> f64 {
        (self.last_real() + TUNNEL * x.powf(-2.0 / 3.0)).min(0.98 * index.re)
    }

    /// The integrand on an even grid of launch points up to `end`, fine enough for directions that
    /// differ from that of a ray by `spread` radians.
    pub(crate) fn integrand(
        &self,
        weight: impl Fn(f64) -> f64,
        end: f64,
        spread: f64,
        index: Complex64,
        x: f64,
    ) -> Option<Integrand> {
        // the phase turns by x (ϑ(β) - ϑ) per impact
        let count = ((end - self.from) * x * spread * SAMPLES_PER_PERIOD / TAU).ceil();
        let step = (end - self.from) / count;
        let count = count as usize;
        let mut integrand = Integrand::with_capacity(count);
        let place = |k: usize| self.from + k as f64 * step;
        // where entry and exit are far from grazing, all but the path is smooth once the ways outside are in it
        let far = |sin: f64| self.outside(sin).into_iter().all(|way| x * way > FAR);
        let smooth_count = (1..count).take_while(|&k| far(place(k))).count();
        let turned = |sin: f64| {
            let turn = Complex64::cis(x * self.outside(sin).iter().sum::<f64>());
            Some(self.amplitude(sin, index, x)?.map(|m| m * turn))
        };
        let smooth = if smooth_count > FEW {
            let ends = [place(1), place(smooth_count)];
            Some(SmoothPart::between(ends, |sin| self.zone(sin, x), turned)?)
        } else {
            None
        };
        for k in 1..count {
            let sin = place(k);
            let weight = weight(sin) * step;
            let [impact] = self.channels.impact.value(sin);
            let [mut path] = self.channels.path.value(sin);
            let amplitude = match &smooth {
                Some(smooth) if k <= smooth_count => {
                    path -= self.outside(sin).iter().sum::<f64>();
                    smooth.at(sin)
                }
                _ => self.amplitude(sin, index, x)?,
            };
            integrand.push(impact, path, amplitude.map(|m| m * weight));
        }
        integrand.fill_lanes();
        Some(integrand)
    }

    /// The ways of the waves outside, from their turning points to the first meeting and from the last.
    fn outside(&self, sin: f64) -> [f64; 2] {
        let way = |meeting: Option<&MeetingChannels<Chebyshev<1>>>| {
            let Some(meeting) = meeting else { return 0.0 };
            let ([square], [radius]) = (meeting.square.value(sin), meeting.radius.value(sin));
            radius * Grazing::path_outside(square.max(0.0).sqrt().min(1.0))
        };
        let meetings = &self.channels.meetings;
        [way(meetings.first()), way(meetings.last())]
    }

    /// S1 … S4 of the ray at a launch point, with the spreading of impacts and what is absorbed.
    fn amplitude(&self, sin: f64, index: Complex64, x: f64) -> Option<[Complex64; 4]> {
        let matrix = self.transfer(sin, index, x)?;
        let [spreading] = self.channels.spreading.value(sin);
        let [inside] = self.channels.inside.value(sin);
        let (_, rate) = self.impact(sin);
        let absorbed = (-x * index.im * inside / index.re).exp();
        Some(matrix.map(|m| m * (rate.abs() * spreading.max(0.0).sqrt() * absorbed)))
    }

    /// The change of the launch point over which the surface's coefficients change: a wave zone where a meeting is
    /// grazing, more the farther it is from that.
    fn zone(&self, sin: f64, x: f64) -> f64 {
        let zone = |meeting: &MeetingChannels<Chebyshev<1>>| {
            let (square, slope) = at(&meeting.square, sin);
            let size = (0.5 * x * meeting.radius.value(sin)[0]).powf(2.0 / 3.0);
            (1.0 + 0.25 * (size * square).abs()) / (size * slope).abs()
        };
        self.channels.meetings.iter().map(zone).fold(f64::INFINITY, f64::min)
    }

    /// Launch point at which the first of entry and exit becomes grazing.
    fn last_real(&self) -> f64 {
        let grazing = |meeting: Option<&MeetingChannels<Chebyshev<1>>>| {
            let Some(meeting) = meeting else { return f64::INFINITY };
            let mut sin = self.to;
            for _ in 0..20 {
                let (value, slope) = at(&meeting.square, sin);
                let step = (value / slope).clamp(-0.02, 0.02);
                if !step.is_finite() {
                    return f64::INFINITY;
                }
                sin -= step;
            }
            sin
        };
        let meetings = &self.channels.meetings;
        let (entry, exit) = (grazing(meetings.first()), grazing(meetings.last()));
        entry.min(if exit > self.from { exit } else { f64::INFINITY }).clamp(self.to, self.to + 0.3)
    }

    /// S1 … S4 of the ray at a launch point, with the phases of the waves outside.
    fn transfer(&self, sin: f64, index: Complex64, x: f64) -> Option<[Complex64; 4]> {
        let meetings = self.channels.meetings.iter().map(|meeting| meeting.at(sin));
        let [across, along] = transfer(meetings, self.channels.last_turn.value(sin)[0], index, x);
        let all = [across[0], along[1], -across[1], -along[0]];
        all.iter().all(|s| s.is_finite()).then_some(all)
    }
}

fn at(series: &Chebyshev<1>, sin: f64) -> (f64, f64) {
    let ([value], [slope]) = series.at(sin);
    (value, slope)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const INDEX: f64 = 1.333;

    fn with_curve(order: u32, test: impl FnOnce(&DeflectionCurve)) {
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, INDEX.into(), 1e4, order);
        let silhouette = shape.silhouette();
        let plane = ScatteringPlane::new(&tracer, order, 0.0, [0.0; 2]);
        let scan = Scan { nodes: 100, axis_gap: 0.02, limit: FRAC_PI_2 };
        test(&DeflectionCurve::new(plane, &silhouette, scan).unwrap());
    }

    /// Between the turning points of the waves outside a sphere's path is `2p (√(n² - β²) + β asin β/n)` but for
    /// the axis' angle, and its phase stands still at `2p asin(β/n)`: analytic through the rim.
    #[test]
    fn channels_of_a_sphere_are_known() {
        for order in [2u32, 4] {
            with_curve(order, |curve| {
                let rays = Rays::between(curve, [0.6, 0.999], RAYS - 1, None).unwrap();
                let p = f64::from(order);
                for sin in [0.6, 0.8, 0.97, 1.0, 1.02f64] {
                    let anchor = rays.anchor(sin);
                    let inside = (sin / INDEX).asin();
                    // angles grow with the impact, which is negative where rays have crossed the axis
                    let sense = anchor.impact.signum();
                    assert!((sense * anchor.impact - sin).abs() < 1e-9, "{sin}: {}", anchor.impact);
                    let axis = curve.plane().axis_angle();
                    let expected = axis + sense * (2.0 * p * inside - PI);
                    let turned =
                        expected + if sense > 0.0 { 0.0 } else { 2.0 * (2.0 * p * inside - PI) };
                    assert!(
                        (anchor.angle - turned).abs() < 1e-6,
                        "{sin}: {} {turned}",
                        anchor.angle
                    );
                }
                assert!((rays.last_real() - 1.0).abs() < 1e-6, "{}", rays.last_real());
                let x: f64 = 1e4;
                let end = rays.end_of_tunnel(INDEX.into(), x);
                assert!((end - (1.0 + TUNNEL * x.powf(-2.0 / 3.0))).abs() < 1e-6);
            });
        }
    }

    /// Fields from channels are those of the traced ray, but for the phase outside, far from grazing.
    #[test]
    fn fields_from_channels_are_those_of_traced_rays() {
        with_curve(3, |curve| {
            let rays = Rays::between(curve, [0.3, 0.8], RAYS - 1, None).unwrap();
            for sin in [0.4, 0.55, 0.7] {
                let node = curve.ray_at(sin).unwrap();
                let traced = curve.plane().transfer(&node.exit, node.angle);
                let [s1, s2, s3, s4] = rays.transfer(sin, INDEX.into(), 1e6).unwrap();
                assert!((s1.norm() - traced.s1.norm()).abs() < 1e-6, "{sin}: {s1} {}", traced.s1);
                assert!((s2.norm() - traced.s2.norm()).abs() < 1e-6, "{sin}: {s2} {}", traced.s2);
                assert!(s3.norm() + s4.norm() < 1e-12);
                // the same sense of both polarisations
                let both = (s1 * s2.conj()).re * (traced.s1 * traced.s2.conj()).re;
                assert!(both > 0.0 || traced.s2.norm() < 1e-3, "{sin}");
            }
        });
    }
}
