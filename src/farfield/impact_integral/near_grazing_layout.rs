//! Where the integral over rays near the rim takes over, and the angles at which its wave is known; the
//! same for all planes of an order.

use super::rays::{RAYS, Rays};
use crate::farfield::assignment::near_grazing_taper::{airy_angle, deviation_slope};
use crate::farfield::branch::window::Window;
use crate::farfield::deflection::curve::DeflectionCurve;
use crate::math::parallel::*;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Where the integral takes over, and the knots of its wave; common to all planes of an order.
#[derive(Clone, Debug, PartialEq)]
pub struct NearGrazingLayout {
    /// Launch points `sin α` at which the weight leaves 0 and reaches 1.
    pub start: f64,
    /// Where the integral has taken over entirely.
    pub full: f64,
    /// Launch point `sin α` of a sphere's bow.
    pub bow: f64,
    /// Knots between axes: angles from the anchor, and the slope of the reference path there relative
    /// to its impact.
    pub knots: Vec<Vec<[f64; 2]>>,
    /// Degree of the polynomials through real rays, or through what they have beside a sphere's.
    degree: usize,
    /// Those of a sphere, where polynomials of all would not settle.
    like: Option<Arc<Rays>>,
    /// Share of the stretch from `start` to the rim that is left out before the last ray.
    spare: f64,
    /// Size parameter up to which one plane stands for all azimuths; `None` where they differ.
    one_plane_to: Option<f64>,
}

/// Most knots of a plane: more are only asked for between angles that are not to be trusted. One plane that stands for
/// all may have more, up to a size parameter; the time of its integrals grows like the square of that.
const MOST: f64 = 1500.0;
const MOST_OF_ONE_PLANE: f64 = 5000.0;
/// Knots per period of the wave against its reference.
const KNOTS_PER_PERIOD: f64 = 4.0;

impl NearGrazingLayout {
    /// A layout without knots yet. Where nothing depends on azimuth path and angles are analytic in the launch point
    /// to the rim and beyond; else only nearly so, and low degrees must do for what is beside those of a sphere
    /// (`like`).
    pub fn new(
        [start, full, bow]: [f64; 3],
        one_plane_to: Option<f64>,
        order: u32,
        like: Option<Arc<Rays>>,
    ) -> Self {
        let round = like.is_none();
        // by sums over partial waves, in the penumbra of raindrops of 0.41 to 0.6 mm
        let degree = match order {
            _ if round => RAYS - 1,
            1 => 6,
            _ => 7,
        };
        // the last rays meet the surface so flatly that their differentials lose digits, and on
        // deformed particles path and angles have a part there that is odd in the grazing angle
        let spare = if round { 0.002 } else { 0.02 };
        Self { start, full, bow, knots: Vec::new(), degree, like, spare, one_plane_to }
    }

    /// The same with twice the knots.
    pub(crate) fn finer(&self) -> Self {
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

    /// Real rays of a plane from the start of the taper to the last that leaves.
    pub(crate) fn rays(&self, curve: &DeflectionCurve) -> Option<Rays> {
        let to = curve.last_ray().alpha.sin() - self.spare * (1.0 - self.start);
        Rays::between(curve, [self.start, to], self.degree, self.like.as_deref())
    }

    /// Weight of the integral for a launch point `sin α`.
    pub fn weight(&self, sin: f64) -> f64 {
        self.window().weight(sin)
    }

    fn window(&self) -> Window {
        Window { start: self.start, full: self.full }
    }

    /// What the integral leaves to the wave of a single ray: the complement of its weight, with the next term of
    /// stationary phase, since the weight changes over few Fresnel zones. The phase's derivatives by impact,
    /// `x (L(β) - βϑ)`, are those of a sphere.
    pub(crate) fn left_to_ray(&self, sin: f64, index: f64, order: u32, x: f64) -> Complex64 {
        let [weight, slope, bend] = self.window().with_derivatives(sin);
        if weight == 0.0 || weight == 1.0 {
            return (1.0 - weight).into();
        }
        let (second, third) = deviation_slope(index, order, sin);
        Complex64::new(1.0 - weight, (bend - third / second * slope) / (2.0 * x * second))
    }

    /// Spread knots that serve all curves of an order: from the ray at `start` past the bow, as far as
    /// its dark side reaches. The real rays of each curve come with it. `None` where they would reach the
    /// axis, where waves from all azimuths meet.
    pub fn spread_knots(
        &mut self,
        curves: &[&DeflectionCurve],
        axis_gap: f64,
        index: f64,
        caustic_disorder: f64,
        x: f64,
    ) -> Option<Vec<Rays>> {
        const DARK_ZETA: f64 = 7.5;
        const PENUMBRA: f64 = 8.0;
        const LONGEST_DARK: f64 = 0.45;
        const FARTHEST_PENUMBRA: f64 = 0.5;
        if self.one_plane_to.is_none() {
            self.keeps_off_axis(curves, axis_gap)?;
        }
        let rays: Vec<Rays> =
            curves.par_iter().map(|curve| self.rays(curve)).collect::<Option<_>>()?;
        let known = curves.iter().zip(&rays);
        let marks: Vec<Marks> =
            known.map(|(curve, rays)| Marks::of(curve, rays, self)).collect::<Option<_>>()?;
        let sense = marks[0].sense;
        let least = |f: fn(&Marks) -> f64| marks.iter().map(f).fold(f64::MAX, f64::min);
        let most = |f: fn(&Marks) -> f64| marks.iter().map(f).fold(f64::MIN, f64::max);
        let order = curves.first()?.plane().order;
        // beyond the last ray its penumbra dies away with x^{1/3}: where rays turned back at a bow, on the
        // side they came from
        let penumbra = (PENUMBRA * x.cbrt().recip()).min(FARTHEST_PENUMBRA);
        let start = least(|m| m.start);
        let (begin, dark) = if order == 1 {
            (start, penumbra)
        } else {
            let dark = (DARK_ZETA * airy_angle(index, order, x)).min(LONGEST_DARK);
            (start.min(least(|m| m.last) - penumbra), dark)
        };
        let bow_at = most(|m| m.farthest);
        let zone = (0.5 * x * deviation_slope(index, order, self.bow).1).cbrt().recip();
        let spare = 0.1 * caustic_disorder + zone + x.powf(-2.0 / 3.0);
        let stretch = [begin, start, bow_at, bow_at + dark];
        let one = self.one_plane_to.is_some_and(|largest| x <= largest);
        let most = if one { MOST_OF_ONE_PLANE } else { MOST };
        let all = knots(stretch, sense, [self.start, self.bow], spare, [x, most])?;
        self.knots = if self.one_plane_to.is_some() {
            between_axes(&all, marks[0].anchor, axis_gap)
        } else {
            vec![before_axis(all, &marks)]
        };
        self.knots.retain(|run| run.len() > 1);
        (!self.knots.is_empty()).then_some(rays)
    }

    /// `None` where rays in the taper leave too near the axis.
    fn keeps_off_axis(&self, curves: &[&DeflectionCurve], axis_gap: f64) -> Option<()> {
        let clear = |curve: &&DeflectionCurve| {
            let angle = curve.ray_at(self.start)?.angle;
            ((angle - (angle / PI).round() * PI).abs() > 0.7 * axis_gap).then_some(())
        };
        curves.iter().try_for_each(clear)
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

/// The knots on the bow's side of the axis, on all planes.
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

/// Angles on one plane, from that of the anchor on, counted towards the bow.
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
    fn of(curve: &DeflectionCurve, rays: &Rays, layout: &NearGrazingLayout) -> Option<Self> {
        let first = curve.ray_at(layout.start)?.angle;
        let [farthest, last] = curve.reaches(layout.start, layout.full)?;
        let sense = farthest.signum();
        let anchor = rays.anchor(layout.bow).angle;
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
    [x, most]: [f64; 2],
) -> Option<Vec<[f64; 2]>> {
    let mut at = begin;
    let mut knots = Vec::new();
    while (knots.len() as f64) < most {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Knots go on from begin to end, as close as the band of impacts asks for; their slopes lie in it.
    #[test]
    fn knots_are_as_close_as_the_band_of_impacts_asks_for() {
        let (x, spare) = (5000.0, 0.01);
        let ends = [-0.1, 0.0, 0.3, 0.4];
        for sense in [1.0, -1.0] {
            let found = knots(ends, sense, [0.8, 0.95], spare, [x, MOST]).unwrap();
            assert_eq!(sense * found[0][0], -0.1);
            assert!(sense * found[found.len() - 1][0] >= 0.4);
            for pair in found.windows(2) {
                let step = sense * (pair[1][0] - pair[0][0]);
                // half the band from the inner impact to the rim
                let half = 1.0 - (pair[0][1] + 0.95);
                assert!((step * x * (half + spare) * KNOTS_PER_PERIOD / TAU - 1.0).abs() < 1e-9);
                assert!((0.025..=0.1 + 1e-12).contains(&half), "{half}");
            }
        }
        assert!(knots([-0.1, 0.0, 0.3, 40.0], 1.0, [0.8, 0.95], spare, [x, MOST]).is_none());
    }

    /// Runs between axes end exactly the gap from them, and none crosses.
    #[test]
    fn runs_keep_off_the_axes() {
        let all: Vec<[f64; 2]> =
            (0..=90).map(|k| [0.05 * f64::from(k) - 0.5, f64::from(k)]).collect();
        for knots in [all.clone(), all.into_iter().rev().collect::<Vec<_>>()] {
            let (anchor, gap) = (0.3, 0.1);
            let runs = between_axes(&knots, anchor, gap);
            assert_eq!(runs.len(), 3);
            for run in &runs {
                let angles: Vec<f64> = run.iter().map(|knot| anchor + knot[0]).collect();
                let half_turns = |a: &f64| (a / PI).floor();
                assert!(angles.windows(2).all(|w| half_turns(&w[0]) == half_turns(&w[1])));
                let off = |a: &f64| (a - (a / PI).round() * PI).abs();
                assert!(angles.iter().all(|a| off(a) > gap - 1e-12));
            }
            let nearest = |a: f64| {
                let ends = runs.iter().flat_map(|run| [run[0][0], run[run.len() - 1][0]]);
                ends.map(|end| (anchor + end - a).abs()).fold(f64::MAX, f64::min)
            };
            for axis in [0.0, PI] {
                assert!((nearest(axis - gap)).min(nearest(axis + gap)) < 1e-12);
            }
        }
    }

    #[test]
    fn twice_the_knots_are_half_as_far() {
        let mut layout = NearGrazingLayout::new([0.7, 0.8, 0.9], Some(2e4), 4, None);
        layout.knots = vec![vec![[0.0, 1.0], [0.4, 3.0], [1.0, 2.0]]];
        let finer = layout.finer();
        assert_eq!(
            finer.knots[0],
            vec![[0.0, 1.0], [0.2, 2.0], [0.4, 3.0], [0.7, 2.5], [1.0, 2.0]]
        );
        assert_eq!((layout.weight(0.7), layout.weight(0.75), layout.weight(0.8)), (0.0, 0.5, 1.0));
    }
}
