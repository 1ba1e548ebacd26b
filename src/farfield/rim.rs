//! The rim wave: all rays of one order that enter or leave near grazing incidence, as one integral.
//!
//! For orders from 4 on, the bow is made so close to the rim that its two rays, the last ray that
//! leaves, and the penumbra beyond it lie within one wave zone: no formula for two rays holds. But
//! along a meridian the wave is an integral over the exit rays' impact `β` (distance of the ray
//! from the centre, in the meridian's plane),
//! `S(ϑ) = -ix √(x/2π) e^{-iπm/2 ∓ iπ/4} ∫ dβ a(β) exp(ix [L(β) - βϑ])`, `L = W + βϑ(β)`,
//! `a = T √(1/|∂(β, s⊥)/∂(u, v)|)`,
//! whose points of stationary phase are the rays; it stays true where they merge, and its integrand
//! goes on smoothly beyond the last ray, where waves tunnel through the surface: the coefficients of
//! the curved interface ([`crate::optics::Grazing::whole`]) are analytic there. Launch points beyond the rim are not
//! traced: path, angles of incidence, curvatures and frames are polynomials through real rays, taken
//! a few wave zones further. For the sphere this is the Debye term in its asymptotic form (the sum
//! over partial waves as an integral); measured against it, it errs by 0.05 % at x = 5000.
//!
//! The integral takes over from single rays with a smooth weight: rays well inside the rim are left
//! to the plain segments of the meridian, with the weight's complement.

use super::arc::Arc;
use super::axis_wave::AxisWave;
use super::rim_integrand::{Integrand, Sums};
use super::rim_rays::{Prefactor, RAYS, Rays};
use super::segment::{CHANNELS, Kind, Knot, PLAIN_AMPLITUDE, SLOPE, Segment};
use super::taper::Taper;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Where the integral takes over, and the knots of its wave; common to all meridians of an order.
#[derive(Clone, Debug, PartialEq)]
pub struct RimLayout {
    /// Launch points `sin α` at which the weight leaves 0 and reaches 1.
    pub start: f64,
    pub full: f64,
    /// Launch point `sin α` of a sphere's bow.
    pub bow: f64,
    /// Knots between axes: angles from the anchor, and the slope of the reference path there relative
    /// to its impact.
    pub knots: Vec<Vec<[f64; 2]>>,
    /// Degree of the polynomials through real rays.
    pub(super) degree: usize,
    /// Share of the stretch from `start` to the rim that is left out before the last ray.
    pub(super) spare: f64,
    /// Whether nothing depends on azimuth.
    rotational: bool,
}

/// Lowest order served, and the same for deformed particles: there the secondary bow's wave changes
/// too fast with azimuth to be interpolated, its penumbra from continued polynomials is not
/// reciprocal, and two rays serve nearly as well.
const FIRST_ORDER: u32 = 2;
const FIRST_ORDER_DEFORMED: u32 = 4;
/// Widths of the Airy function between the bow's ray and the start of the taper.
const AIRY_WIDTHS: f64 = 5.0;
/// Fresnel zones of a ray within the taper: fewer would leave a step in the wave. The first order
/// served is ten times as strong as the others.
const FRESNEL_ZONES: f64 = 20.0;
const FRESNEL_ZONES_HIGH: f64 = 10.0;
/// Knots per period of the wave against its reference.
const KNOTS_PER_PERIOD: f64 = 4.0;

/// Impact of the ray of a sphere's bow of this order, if there is one.
fn bow(index: f64, order: u32) -> Option<f64> {
    let p = f64::from(order);
    let square = 1.0 - (index * index - 1.0) / (p * p - 1.0);
    (square > 0.0 && square < 1.0 && index > 1.05).then(|| square.sqrt())
}

/// Slope and third derivative of a sphere's deviation by impact.
fn deviation_slope(index: f64, order: u32, b: f64) -> (f64, f64) {
    let p = f64::from(order);
    let (c, ct) = (1.0 - b * b, index * index - b * b);
    (2.0 / c.sqrt() - 2.0 * p / ct.sqrt(), 2.0 * b / c.powf(1.5) - 2.0 * p * b / ct.powf(1.5))
}

/// Total deviation on a sphere.
fn deviation(index: f64, order: u32, b: f64) -> f64 {
    let p = f64::from(order);
    (p - 1.0) * PI + 2.0 * b.asin() - 2.0 * p * (b / index).asin()
}

/// Start and end of the taper, and the bow's ray, for a particle like a sphere, deformed so much that rays of this order
/// stray by `tangle`; rays in it keep farther than `axis_gap` from the axis. `None` where the
/// integral would reach too far inside, or too little is left for the taper.
pub fn taper(
    index: f64,
    order: u32,
    size_parameter: f64,
    tangle: f64,
    axis_gap: f64,
    rotational: bool,
) -> Option<[f64; 3]> {
    const DEEPEST: f64 = 0.3;
    const FEWEST_WIDTHS: f64 = 2.0;
    const FEWEST_ZONES: f64 = 5.0;
    /// Distance from the axis at which rays are clear of it, in gaps.
    const AXIS_GAPS: f64 = 1.25;
    let first = if rotational { FIRST_ORDER } else { FIRST_ORDER_DEFORMED };
    let b = bow(index, order).filter(|_| order >= first)?;
    let (_, bend) = deviation_slope(index, order, b);
    let airy = (0.5 * size_parameter * bend).cbrt().recip().min(0.5);
    let mut full = b - AIRY_WIDTHS * airy - tangle;
    if rotational {
        full = below_axis(index, order, full, AXIS_GAPS * axis_gap);
    }
    if full < DEEPEST {
        return None;
    }
    let zone = |b: f64| (size_parameter * deviation_slope(index, order, b).0.abs()).sqrt().recip();
    let zones = if order <= 3 { FRESNEL_ZONES } else { FRESNEL_ZONES_HIGH };
    let mut start = (full - zones * zone(full)).max(0.5 * full);
    if !rotational {
        start = start.max(clear_of_axis(index, order, b, AXIS_GAPS * axis_gap)?);
        full = full.max(start + FEWEST_ZONES * zone(full));
    }
    let room = full - start > 0.99 * FEWEST_ZONES * zone(full) || !rotational;
    let serves = room && full < b - FEWEST_WIDTHS * airy;
    serves.then_some([start, full, b])
}

/// The impact `b`, or the next one below it where a sphere's rays keep this far from the axis.
fn below_axis(index: f64, order: u32, b: f64, gap: f64) -> f64 {
    const STEP: f64 = 0.002;
    let near = |b: &f64| from_axis(index, order, *b) < gap;
    (0..).map(|k| b - STEP * f64::from(k)).find(|b| *b < 0.0 || !near(b)).unwrap_or(0.0)
}

/// Angle between the axis and a sphere's ray.
fn from_axis(index: f64, order: u32, b: f64) -> f64 {
    let angle = deviation(index, order, b);
    (angle - (angle / PI).round() * PI).abs()
}

/// Least impact from which on, to the bow's ray, a sphere's rays keep this far from the axis.
fn clear_of_axis(index: f64, order: u32, bow: f64, gap: f64) -> Option<f64> {
    const STEPS: u32 = 200;
    let steps = (0..STEPS).map(|k| bow * (1.0 - f64::from(k) / f64::from(STEPS)));
    let clear: Vec<f64> = steps.take_while(|&b| from_axis(index, order, b) > gap).collect();
    clear.last().copied()
}

impl RimLayout {
    /// A layout without knots yet. Where nothing depends on azimuth, path and angles are analytic in
    /// the launch point to the rim and beyond; else only nearly so, and low degrees must do.
    pub fn new([start, full, bow]: [f64; 3], rotational: bool) -> Self {
        let degree = if rotational { RAYS - 1 } else { 5 };
        // the last rays meet the surface so flatly that their differentials lose digits, and on
        // deformed particles path and angles have a part there that is odd in the grazing angle
        let spare = if rotational { 0.002 } else { 0.02 };
        Self { start, full, bow, knots: Vec::new(), degree, spare, rotational }
    }

    /// The same with twice the knots.
    pub(super) fn finer(&self) -> Self {
        let twice = |run: &Vec<[f64; 2]>| {
            let mut finer: Vec<[f64; 2]> = Vec::with_capacity(2 * run.len());
            for &[angle, slope] in run {
                if let Some(&[a, s]) = finer.last() {
                    finer.push([0.5 * (a + angle), 0.5 * (s + slope)]);
                }
                finer.push([angle, slope]);
            }
            finer
        };
        Self { knots: self.knots.iter().map(twice).collect(), ..self.clone() }
    }

    /// Weight of the integral for a launch point `sin α`.
    pub fn weight(&self, sin: f64) -> f64 {
        Taper { start: self.start, full: self.full }.weight(sin)
    }

    /// Spread knots that serve all arcs of an order: from the ray at `start` past the bow, as far as
    /// its dark side reaches. `None` where they would reach the axis, where waves from all azimuths
    /// meet.
    pub fn spread_knots(
        &mut self,
        arcs: &[&Arc],
        axis_gap: f64,
        index: f64,
        tangle: f64,
        x: f64,
    ) -> Option<()> {
        const DARK_ZETA: f64 = 7.5;
        const PENUMBRA: f64 = 8.0;
        const LONGEST_DARK: f64 = 0.45;
        const FARTHEST_PENUMBRA: f64 = 0.5;
        if !self.rotational {
            self.keeps_off_axis(arcs, axis_gap)?;
        }
        let marks: Vec<Marks> =
            arcs.iter().map(|arc| Marks::of(arc, self)).collect::<Option<_>>()?;
        let sense = marks[0].sense;
        let least = |f: fn(&Marks) -> f64| marks.iter().map(f).fold(f64::MAX, f64::min);
        let most = |f: fn(&Marks) -> f64| marks.iter().map(f).fold(f64::MIN, f64::max);
        let order = arcs.first()?.meridian().order;
        let dark = (DARK_ZETA * airy_angle(index, order, x)).min(LONGEST_DARK);
        // beyond the last ray its penumbra dies away with x^{1/3}
        let penumbra = (PENUMBRA * x.cbrt().recip()).min(FARTHEST_PENUMBRA);
        let start = least(|m| m.start);
        let begin = start.min(least(|m| m.last) - penumbra);
        let bow_at = most(|m| m.farthest);
        let zone = (0.5 * x * deviation_slope(index, order, self.bow).1).cbrt().recip();
        let spare = 0.1 * tangle + zone + x.powf(-2.0 / 3.0);
        let stretch = [begin, start, bow_at, bow_at + dark];
        let all = knots(stretch, sense, [self.start, self.bow], spare, x)?;
        self.knots = if self.rotational {
            between_axes(&all, marks[0].anchor, axis_gap)
        } else {
            vec![before_axis(all, &marks)]
        };
        self.knots.retain(|run| run.len() > 1);
        (!self.knots.is_empty()).then_some(())
    }

    /// `None` where rays in the taper leave too near the axis.
    fn keeps_off_axis(&self, arcs: &[&Arc], axis_gap: f64) -> Option<()> {
        let clear = |arc: &&Arc| {
            let angle = arc.ray_at(self.start)?.angle;
            ((angle - (angle / PI).round() * PI).abs() > 0.7 * axis_gap).then_some(())
        };
        arcs.iter().try_for_each(clear)
    }
}

/// The runs of knots between axes, each ending exactly this far from them: closer by, waves from all
/// azimuths meet.
fn between_axes(knots: &[[f64; 2]], anchor: f64, gap: f64) -> Vec<Vec<[f64; 2]>> {
    let (first, last) = (knots[0][0], knots[knots.len() - 1][0]);
    let (low, high) = (first.min(last), first.max(last));
    let half_turn = |offset: f64| ((anchor + offset) / PI).floor() as i64;
    let off = |knot: &[f64; 2], angle: f64| (knot[0] - angle).abs();
    let nearest = |angle: f64| {
        let knot = knots.iter().min_by(|a, b| off(a, angle).total_cmp(&off(b, angle)));
        [angle, knot.map_or(0.0, |knot| knot[1])]
    };
    let run = |number: i64| {
        let from = (PI * number as f64 + gap - anchor).max(low);
        let to = (PI * (number + 1) as f64 - gap - anchor).min(high);
        let [begin, end] = if first < last { [from, to] } else { [to, from] };
        let inside = knots.iter().copied().filter(|knot| from < knot[0] && knot[0] < to);
        let run = std::iter::once(nearest(begin)).chain(inside).chain([nearest(end)]).collect();
        (from < to).then_some(run)
    };
    (half_turn(low)..=half_turn(high)).filter_map(run).collect()
}

/// The knots on the bow's side of the axis, on all meridians.
fn before_axis(mut knots: Vec<[f64; 2]>, marks: &[Marks]) -> Vec<[f64; 2]> {
    const NEAREST_AXIS: f64 = 0.03;
    for mark in marks {
        let nearest = (mark.anchor / PI).round() * PI - mark.anchor;
        knots.retain(|k| {
            [nearest - PI, nearest, nearest + PI]
                .iter()
                .all(|axis| axis.signum() * k[0] < axis.abs() - NEAREST_AXIS)
        });
    }
    knots
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

/// Angle over which the argument of a sphere's Airy function grows by 1.
fn airy_angle(index: f64, order: u32, x: f64) -> f64 {
    let (p, n) = (f64::from(order).powi(2), index * index);
    let h = (p - 1.0).powi(2) / p * ((p - n) / (n - 1.0).powi(3)).sqrt();
    h.cbrt() * x.powf(-2.0 / 3.0)
}

/// Angles on one meridian, from that of the anchor on, counted towards the bow.
struct Marks {
    /// Unwrapped angle of the anchor: where the integrand's phase stands still at the bow's impact.
    anchor: f64,
    /// Direction of growing impacts: that of unwrapped angles, or against it.
    sense: f64,
    /// The ray at the start of the taper, the farthest ray, the last ray.
    start: f64,
    farthest: f64,
    last: f64,
}

impl Marks {
    fn of(arc: &Arc, layout: &RimLayout) -> Option<Self> {
        let first = arc.ray_at(layout.start)?.angle;
        let [farthest, last] = arc.reaches(layout.start, layout.full)?;
        let sense = farthest.signum();
        let anchor = Rays::to_rim(arc, layout)?.anchor(layout.bow).angle;
        let start = sense * (first - anchor);
        Some(Self {
            anchor,
            sense,
            start,
            farthest: start + sense * farthest,
            last: start + sense * last,
        })
    }
}

/// Knots from `begin` to `end` (radians from the anchor, towards the bow), close enough for waves
/// whose impact lies between that of the inner ray and the rim, give or take `spare`. The inner ray
/// goes from `start_at` to the bow at `bow_at`, its impact from `start` to `bow`. `None` where that
/// would be too many, as between angles that are not to be trusted.
fn knots(
    [begin, start_at, bow_at, end]: [f64; 4],
    sense: f64,
    [start, bow]: [f64; 2],
    spare: f64,
    x: f64,
) -> Option<Vec<[f64; 2]>> {
    const MOST: usize = 1500;
    let mut at = begin;
    let mut knots = Vec::new();
    while knots.len() < MOST {
        // towards the bow the inner ray's angle runs like a square
        let share = ((at - start_at) / (bow_at - start_at)).clamp(0.0, 1.0);
        let inner = bow - (bow - start) * (1.0 - share).sqrt();
        let half_band = 0.5 * (1.0 - inner);
        knots.push([sense * at, inner + half_band - bow]);
        if at >= end {
            return Some(knots);
        }
        at += TAU / (KNOTS_PER_PERIOD * x * (half_band + spare));
    }
    None
}

/// The integral over rays near the rim of one meridian.
pub(super) struct RimWave<'l> {
    layout: &'l RimLayout,
    rays: Rays,
    before: Prefactor,
    integrand: Integrand,
    size_parameter: f64,
}

impl<'l> RimWave<'l> {
    /// `None` where its rays cannot be followed that far.
    pub(super) fn new(arc: &Arc, layout: &'l RimLayout, size_parameter: f64) -> Option<Self> {
        // the phase's slope strays beyond the knots by this at most
        const STRAY: f64 = 0.5;
        let index = arc.meridian().tracer.index();
        let rays = Rays::to_rim(arc, layout)?;
        let offsets = || layout.knots.iter().flatten().map(|knot| knot[0]);
        let (low, high) = (offsets().fold(f64::MAX, f64::min), offsets().fold(f64::MIN, f64::max));
        let end = rays.end_of_tunnel(index, size_parameter);
        let spread = high - low + STRAY;
        let weight = |sin: f64| layout.weight(sin);
        let integrand = rays.integrand(weight, end, spread, index, size_parameter)?;
        let ahead = layout.start + 0.01 * (layout.full - layout.start);
        let before = Prefactor::between(arc, [layout.start, ahead], size_parameter)?;
        Some(Self { layout, rays, before, integrand, size_parameter })
    }

    /// The wave as segments, one for each run of knots.
    pub(super) fn segments(&self) -> Option<Vec<Segment>> {
        self.layout.knots.iter().map(|run| self.segment(run)).collect()
    }

    fn segment(&self, run: &[[f64; 2]]) -> Option<Segment> {
        let x = self.size_parameter;
        // towards the rim impacts grow in size
        let sense = self.before.sense;
        let anchor = self.rays.anchor(self.layout.bow);
        let mut knots = Vec::with_capacity(run.len());
        for (&[offset, shift], &turned) in run.iter().zip(&turned_paths(run)) {
            let angle = anchor.angle + offset;
            let path = anchor.path - anchor.impact * offset - sense * turned;
            let slope = -(anchor.impact + sense * shift);
            let factor = self.before.towards(angle) / angle.sin().abs().sqrt();
            let sums = self.integrand.sum(angle, path, x);
            knots.push(wave_knot([angle, path, slope], factor, &sums, x));
        }
        let finite = knots.iter().flatten().all(|v| v.is_finite());
        finite.then_some(Segment { kind: Kind::Wave, knots })
    }

    /// The wave about each axis between its knots.
    pub(super) fn about_axes(&self, reach: f64) -> Vec<AxisWave> {
        let anchor = self.rays.anchor(self.layout.bow).angle;
        let all = || self.layout.knots.iter().flatten().map(|knot| (anchor + knot[0]) / PI);
        let (low, high) = all().fold((f64::MAX, f64::MIN), |(l, h), a| (l.min(a), h.max(a)));
        let spare = 1.5 * reach / PI;
        let (from, to) = ((low - spare).ceil() as i64, (high + spare).floor() as i64);
        let wave = |number: i64| {
            AxisWave::new(&self.integrand, &self.before, number, reach, self.size_parameter)
        };
        (from..=to).map(wave).collect()
    }
}

/// A knot of a wave from its sums: `place` is angle, reference path and the slope of that.
pub(super) fn wave_knot(place: [f64; 3], factor: Complex64, sums: &Sums, x: f64) -> Knot {
    let [angle, path, slope] = place;
    let mut knot = [0.0; CHANNELS];
    (knot[0], knot[1], knot[2]) = (angle, path, slope);
    let shrink = -0.5 * angle.cos() / angle.sin();
    for (element, (sum, by_impact)) in sums[0].iter().zip(&sums[1]).enumerate() {
        let value = factor * sum;
        // d/dϑ of exp(-ix(βϑ + W_ref)) and of 1/√sin ϑ
        let by_angle = -Complex64::i() * x * (factor * by_impact + slope * value);
        let rate = by_angle + shrink * value;
        let c = PLAIN_AMPLITUDE + 2 * element;
        (knot[c], knot[c + 1]) = (value.re, value.im);
        let c = SLOPE + 2 * element;
        (knot[c], knot[c + 1]) = (rate.re, rate.im);
    }
    knot
}
