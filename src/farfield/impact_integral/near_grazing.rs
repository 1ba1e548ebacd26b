//! The rim wave: all rays of one order that enter or leave near grazing incidence, as one integral.
//!
//! For orders from 4 on, the bow is made so close to the rim that its two rays, the last ray that
//! leaves, and the penumbra beyond it lie within one wave zone: no formula for two rays holds. But
//! along a plane the wave is an integral over the exit rays' impact `β` (distance of the ray
//! from the centre, in the plane),
//! `S(ϑ) = -ix √(x/2π) e^{-iπm/2 ∓ iπ/4} ∫ dβ a(β) exp(ix [L(β) - βϑ])`, `L = W + βϑ(β)`,
//! `a = T √(1/|∂(β, s⊥)/∂(u, v)|)`,
//! whose points of stationary phase are the rays; it stays true where they merge, and its integrand
//! goes on smoothly beyond the last ray, where waves tunnel through the surface: the coefficients of
//! the curved interface ([`crate::optics::Grazing::whole`]) are analytic there. Launch points beyond the
//! rim are not traced: path, angles of incidence, curvatures and frames are polynomials through real rays, taken
//! a few wave zones further. For the sphere this is the Debye term in its asymptotic form (the sum
//! over partial waves as an integral); measured against it, it errs by 0.05 % at x = 5000.
//!
//! The integral takes over from single rays with a smooth weight: rays well inside the rim are left
//! to the plain segments of the plane, with the weight's complement.

use super::glory::Glory;
use super::integrand::{Integrand, Sums};
use super::near_grazing_layout::NearGrazingLayout;
use super::prefactor::Prefactor;
use super::rays::Rays;
use crate::farfield::branch::knots::{Kind, Knot, Segment, SingleKnot};
use crate::farfield::deflection::curve::DeflectionCurve;
use num_complex::Complex64;
use std::f64::consts::PI;

/// The integral over rays near the rim of one plane.
pub(crate) struct NearGrazing<'l> {
    layout: &'l NearGrazingLayout,
    rays: &'l Rays,
    before: Prefactor,
    integrand: Integrand,
    size_parameter: f64,
}

impl<'l> NearGrazing<'l> {
    /// From the rays of a layout. `None` where the surface cannot be followed as far as waves tunnel.
    pub(crate) fn new(
        curve: &DeflectionCurve,
        layout: &'l NearGrazingLayout,
        rays: &'l Rays,
        size_parameter: f64,
    ) -> Option<Self> {
        // the phase's slope strays beyond the knots by this at most
        const STRAY: f64 = 0.5;
        let index = curve.plane().tracer.index();
        let offsets = || layout.knots.iter().flatten().map(|knot| knot[0]);
        let (low, high) = (offsets().fold(f64::MAX, f64::min), offsets().fold(f64::MIN, f64::max));
        let end = rays.end_of_tunnel(index, size_parameter);
        let spread = high - low + STRAY;
        let weight = |sin: f64| layout.weight(sin);
        let integrand = rays.integrand(weight, end, spread, index, size_parameter)?;
        let ahead = layout.start + 0.01 * (layout.full - layout.start);
        let before = Prefactor::between(curve, [layout.start, ahead], size_parameter)?;
        Some(Self { layout, rays, before, integrand, size_parameter })
    }

    /// The wave as segments, one for each run of knots.
    pub(crate) fn segments(&self) -> Option<Vec<Segment>> {
        self.layout.knots.iter().map(|run| self.segment(run)).collect()
    }

    fn segment(&self, run: &[[f64; 2]]) -> Option<Segment> {
        let x = self.size_parameter;
        // towards the rim impacts grow in size
        let sense = self.before.sense;
        let anchor = self.rays.anchor(self.layout.bow);
        let place = |(&[offset, _], turned): (&[f64; 2], f64)| {
            let path = anchor.path - anchor.impact * offset - sense * turned;
            [anchor.angle + offset, path]
        };
        let places: Vec<[f64; 2]> = run.iter().zip(turned_paths(run)).map(place).collect();
        let sums = self.integrand.sums(&places, x);
        let knot = |((&[_, shift], &[angle, path]), sums): ((&[f64; 2], &[f64; 2]), &Sums)| {
            let slope = -(anchor.impact + sense * shift);
            let factor = self.before.towards(angle) / angle.sin().abs().sqrt();
            wave_knot([angle, path, slope], factor, sums, x)
        };
        let knots: Vec<Knot> = run.iter().zip(&places).zip(&sums).map(knot).collect();
        let finite = knots.iter().all(Knot::is_finite);
        finite.then_some(Segment { kind: Kind::Wave, knots })
    }

    /// The wave about each axis between its knots.
    pub(crate) fn about_axes(&self, reach: f64) -> Vec<Glory> {
        let anchor = self.rays.anchor(self.layout.bow).angle;
        let all = || self.layout.knots.iter().flatten().map(|knot| (anchor + knot[0]) / PI);
        let (low, high) = all().fold((f64::MAX, f64::MIN), |(l, h), a| (l.min(a), h.max(a)));
        let spare = 1.5 * reach / PI;
        let (from, to) = ((low - spare).ceil() as i64, (high + spare).floor() as i64);
        let wave = |number: i64| {
            Glory::new(&self.integrand, &self.before, number, reach, self.size_parameter)
        };
        (from..=to).map(wave).collect()
    }
}

/// A knot of a wave from its sums: `place` is angle, reference path and the slope of that.
pub(crate) fn wave_knot(place: [f64; 3], factor: Complex64, sums: &Sums, x: f64) -> Knot {
    let [angle, path, path_slope] = place;
    let mut knot = SingleKnot { angle, path, path_slope, ..SingleKnot::default() };
    let shrink = -0.5 * angle.cos() / angle.sin();
    for (element, (sum, by_impact)) in sums[0].iter().zip(&sums[1]).enumerate() {
        let value = factor * sum;
        // d/dϑ of exp(-ix(βϑ + W_ref)) and of 1/√sin ϑ
        let by_angle = -Complex64::i() * x * (factor * by_impact + path_slope * value);
        knot.amplitudes[element] = value;
        knot.rates[element] = by_angle + shrink * value;
    }
    knot.into()
}

/// For each knot the part of the reference path that is due to the knots' own slopes.
fn turned_paths(knots: &[[f64; 2]]) -> Vec<f64> {
    let step = |w: &[[f64; 2]]| 0.5 * (w[0][1] + w[1][1]) * (w[1][0] - w[0][0]);
    let mut paths = vec![0.0];
    for pair in knots.windows(2) {
        paths.push(paths[paths.len() - 1] + step(pair));
    }
    let nearest = |k: &usize| knots[*k][0].abs();
    let zero = (0..paths.len()).min_by(|a, b| nearest(a).total_cmp(&nearest(b))).unwrap_or(0);
    let offset = paths[zero];
    paths.iter().map(|path| path - offset).collect()
}

#[cfg(test)]
mod tests;
