//! The segments of a curve: data at their knots.

use super::cut_layout::CutLayout;
use crate::farfield::branch::knots::{Kind, Knot, PairKnot, Segment, SingleKnot, parabola_slopes};
use crate::farfield::branch::window::Window;
use crate::farfield::deflection::curve::DeflectionCurve;
use crate::farfield::deflection::fold::Fold;
use crate::farfield::deflection::landmark::Landmark;
use crate::farfield::deflection::pair_values::{PAIR_CHANNELS, PairValues};
use crate::farfield::deflection::scan::Edge;
use crate::farfield::deflection::scattering_plane::Node;
use crate::farfield::deflection::sparse_rays::{KnotRay, rays_at_knots};
use crate::farfield::impact_integral::near_critical::{self, Stretch};
use crate::farfield::impact_integral::near_grazing::NearGrazing;
use crate::farfield::impact_integral::rays::Rays;
use crate::math::chebyshev::Chebyshev;
use num_complex::Complex64;

/// Chebyshev points of a pair segment.
const PAIR_POINTS: usize = 20;

impl DeflectionCurve<'_> {
    /// The rays at both ends of each plain segment. `None` where one cannot be found.
    pub fn ends(&self, layout: &CutLayout) -> Option<Vec<[Node; 2]>> {
        let mut ends = Vec::new();
        let mut fold_number = 0;
        let cut = layout.cut.map(Landmark::Cut);
        for pair in self.marks(&cut).windows(2) {
            let before_fold = fold_number;
            fold_number += usize::from(matches!(pair[0], Landmark::Fold(_)));
            let edge = |number: usize| layout.folds.get(number).map(|f| f.lit);
            let from = self.edge(pair[0], edge(before_fold), layout)?;
            let to = self.edge(pair[1], edge(fold_number), layout)?;
            ends.push([self.find(from, true)?, self.find(to, false)?]);
        }
        Some(ends)
    }

    /// The landmarks, with one more before the last.
    pub(crate) fn marks<'l>(&'l self, cut: &'l Option<Landmark>) -> Vec<&'l Landmark> {
        let mut marks: Vec<&Landmark> = self.landmarks.iter().collect();
        if let Some(cut) = cut {
            marks.insert(marks.len() - 1, cut);
        }
        marks
    }

    /// The ray where a plain segment begins or ends at a landmark; towards the neighbour given by
    /// the reach of its fold or the axis gap.
    fn edge(&self, landmark: &Landmark, reach: Option<f64>, layout: &CutLayout) -> Option<Edge> {
        Some(match landmark {
            Landmark::Axial => Edge::Alpha(0.0),
            Landmark::Cut(alpha) => Edge::Alpha(*alpha),
            Landmark::End(node) => Edge::Last(node.clone()),
            Landmark::Fold(fold) => {
                Edge::Angle { angle: fold.angle + fold.lit * reach?, near: fold.alpha }
            }
            Landmark::Axis(axis) => Edge::Axis { axis: *axis, gap: layout.axis_gap },
        })
    }

    /// Cut into segments between the ends found before, `rim` being its rays near the rim where an integral stands
    /// for them. `None` where a ray cannot be found.
    pub(crate) fn segments(
        &self,
        layout: &CutLayout,
        ends: &[[Node; 2]],
        rim: Option<&Rays>,
    ) -> Option<Vec<Segment>> {
        let mut segments = Vec::new();
        let mut folds = layout.folds.iter();
        let cut = layout.cut.map(Landmark::Cut);
        for (k, (pair, count)) in self.marks(&cut).windows(2).zip(&layout.knots).enumerate() {
            if let Landmark::Fold(fold) = pair[0] {
                let about = folds.next()?;
                let x = layout.size_parameter;
                let stretch = || Stretch::of_fold(self, fold, k, x);
                let integral =
                    about.integral.as_ref().and_then(|places| Some((places, stretch()?)));
                segments.push(match integral {
                    Some((places, stretch)) => {
                        let rays = [&ends[k - 1][1], &ends[k][0]];
                        near_critical::segment(self, fold, &stretch, rays, places, x)?
                    }
                    None => self.pair_segment(fold, about.dark, about.lit, layout)?,
                });
            }
            segments.push(self.plain_segment([pair[0], pair[1]], &ends[k], *count, layout)?);
        }
        if let Some(rim_layout) = &layout.rim {
            let integral = NearGrazing::new(self, rim_layout, rim?, layout.size_parameter)?;
            segments.extend(integral.segments()?);
        }
        Some(segments)
    }

    fn pair_segment(
        &self,
        fold: &Fold,
        dark: f64,
        reach: f64,
        layout: &CutLayout,
    ) -> Option<Segment> {
        let series = fold.sample(self.plane(), dark, reach, PAIR_POINTS)?;
        let count = 2 + (1.5 * layout.density * (dark + reach)).ceil() as usize;
        let knots = (0..=count)
            .map(|k| pair_knot(fold, &series, -dark + (dark + reach) * k as f64 / count as f64))
            .collect();
        Some(Segment { kind: Kind::Pair { focal_lines: fold.focal_lines }, knots })
    }

    /// One ray per direction between two landmarks, at `count + 1` knots.
    fn plain_segment(
        &self,
        [start, end]: [&Landmark; 2],
        [a, b]: &[Node; 2],
        count: usize,
        layout: &CutLayout,
    ) -> Option<Segment> {
        // about the axis of other particles rays are few and far from those of a sphere
        let symmetric = self.plane().tracer.shape().rotational_symmetry();
        let closer = [
            symmetric && matches!(start, Landmark::Axis(_)),
            matches!(end, Landmark::End(_)) || symmetric && matches!(end, Landmark::Axis(_)),
        ];
        let alpha =
            |k: usize| a.alpha + graded(k as f64 / count as f64, closer) * (b.alpha - a.alpha);
        // focal lines are those of the ray nearest to the middle
        let mut nearest = (f64::INFINITY, a.exit.focal_lines);
        let traced = |k: usize| {
            let node = if k == 0 {
                *a
            } else if k == count {
                *b
            } else {
                self.interpolated(alpha(k))?
            };
            let off = (k as f64 - 0.5 * count as f64 - 0.25).abs();
            if off < nearest.0 {
                nearest = (off, node.exit.focal_lines);
            }
            Some(KnotRay::new(self.plane(), &node))
        };
        let rays = rays_at_knots(count, layout.size_parameter, traced)?;
        let focal_lines = nearest.1;
        let knot = |(k, ray): (usize, &KnotRay)| self.plain_knot(alpha(k), ray, layout);
        let mut knots: Vec<Knot> = rays.iter().enumerate().map(knot).collect();
        let slopes = parabola_slopes(&knots);
        for (knot, slope) in knots.iter_mut().zip(slopes) {
            *knot = SingleKnot { rates: slope.single().amplitudes, ..knot.single() }.into();
        }
        let from_axis = matches!(start, Landmark::Axial);
        Some(Segment { kind: Kind::Plain { focal_lines, from_axis }, knots })
    }

    /// The spread of a ray, kept from zero where rays meet across the plane.
    fn bounded_spread(&self, ray: &KnotRay, layout: &CutLayout) -> f64 {
        const NEAREST: f64 = 0.05;
        let [spread, across] = ray.spreads().map(f64::abs);
        let symmetric = self.plane().tracer.shape().rotational_symmetry();
        if !layout.high || symmetric {
            return spread;
        }
        spread * (across.max(NEAREST) / across)
    }

    fn plain_knot(&self, alpha: f64, ray: &KnotRay, layout: &CutLayout) -> Knot {
        let x = layout.size_parameter;
        let (index, order) = (self.plane().tracer.index().re, self.plane().order);
        let rim = layout.rim.as_ref();
        let left = rim.map(|rim| rim.left_to_ray(alpha.sin(), index, order, x));
        let edge = layout.edge.map(|edge| reflected_share(&edge, ray.angle(), x));
        let share = edge.or(left).unwrap_or_else(|| 1.0.into());
        // No wave is stronger than the whole shadow in phase, |S| ≤ x² area/2π: the bound on rays
        // that focus at infinity, as about the axis for indices of 2 and 4.
        let spread = self.bounded_spread(ray, layout).max(4.0 / x.powi(2));
        let size = share / spread.sqrt();
        let [path, path_slope] = ray.path();
        let knot = SingleKnot {
            angle: ray.angle(),
            path,
            path_slope,
            amplitudes: ray.transfer().map(|s| s * size),
            // from the neighbours, once all are known
            rates: Default::default(),
        };
        knot.into()
    }
}

/// What the edge wave leaves to a ray reflected by an angle: the complement of its weight, with the
/// next term of stationary phase, since the weight changes over few Fresnel zones.
fn reflected_share(edge: &Window, angle: f64, x: f64) -> Complex64 {
    let cos = (0.5 * angle).cos();
    let [weight, slope, bend] = edge.with_derivatives(cos);
    if weight == 0.0 || weight == 1.0 {
        return (1.0 - weight).into();
    }
    // the phase x (L(β) - βϑ) of a sphere: second derivative, and its own relative slope
    let sin = (1.0 - cos * cos).sqrt();
    let (second, relative) = (-2.0 / sin, cos / (sin * sin));
    Complex64::new(1.0 - weight, (relative * slope - bend) / (2.0 * x * second))
}

/// A share of the way from 0 to 1 in steps that get closer towards either end: towards the rim or
/// total reflection the exit angle runs like a square root, and from the axis the amplitude falls
/// like one over it.
fn graded(share: f64, closer: [bool; 2]) -> f64 {
    match closer {
        [false, false] => share,
        [false, true] => share * (2.0 - share),
        [true, false] => share * share,
        [true, true] => share * share * (3.0 - 2.0 * share),
    }
}

fn pair_knot(fold: &Fold, series: &Chebyshev<PAIR_CHANNELS>, delta: f64) -> Knot {
    let (value, slope) = series.at(delta);
    let (value, slope) = (PairValues::from(value), PairValues::from(slope));
    let knot = PairKnot {
        angle: fold.angle + fold.lit * delta,
        path: value.path,
        path_slope: fold.lit * slope.path,
        zeta: value.zeta,
        zeta_slope: fold.lit * slope.zeta,
        sums: value.sums,
        differences: value.differences,
    };
    knot.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From 0 to 1, ever further, and steps that vanish at the ends asked for.
    #[test]
    fn graded_steps_get_closer_where_asked() {
        for closer in [[false, false], [false, true], [true, false], [true, true]] {
            let at = |k: u32| graded(f64::from(k) / 100.0, closer);
            assert_eq!((at(0), at(100)), (0.0, 1.0));
            assert!((1..=100).all(|k| at(k) > at(k - 1)));
            for (first, last, closer) in [(1, 0, closer[0]), (100, 99, closer[1])] {
                let step = at(first) - at(last);
                assert!(if closer { step < 5e-4 } else { step > 5e-3 }, "{closer:?} {step}");
            }
        }
    }

    /// Rays beyond the taper keep all, rays at the edge nothing; between, the real part is the complement
    /// of the weight, and the next term falls with the size parameter.
    #[test]
    fn reflected_rays_keep_what_the_edge_wave_leaves() {
        let edge = Window { start: 0.6, full: 0.9 };
        let at = |cos: f64, x: f64| reflected_share(&edge, 2.0 * cos.acos(), x);
        assert_eq!(at(0.5, 100.0), Complex64::from(1.0));
        assert_eq!(at(0.95, 100.0), Complex64::default());
        for cos in [0.65, 0.75, 0.85] {
            let (small, large) = (at(cos, 100.0), at(cos, 1000.0));
            assert!((small.re - (1.0 - edge.weight(cos))).abs() < 1e-12);
            assert!((small.im - 10.0 * large.im).abs() < 1e-12 && small.im != 0.0);
        }
    }
}
