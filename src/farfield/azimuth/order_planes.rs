//! One order: its scattering planes at some azimuths, and its segments at any other.

use super::azimuthal_smoothness::azimuthal_smoothness;
use super::blend::{STENCIL, blend};
use super::cut_layout::CutLayout;
use super::matching::{Traced, another, trace};
use super::places::{Azimuths, axis_gaps, scanned_rays, steps};
use crate::farfield::assignment::near_grazing_taper::taper;
use crate::farfield::assignment::{Rim, Spacing, Thresholds, caustic_disorder};
use crate::farfield::branch::knots::{CHANNELS, Knot, Segment};
use crate::farfield::branch::samples::Side;
use crate::farfield::deflection::guide::OrderGuide;
use crate::farfield::deflection::scattering_plane::axial_ray;
use crate::farfield::forward::penumbra::Penumbra;
use crate::farfield::impact_integral::glory::Glory;
use crate::farfield::impact_integral::near_grazing_layout::NearGrazingLayout;
use crate::farfield::impact_integral::rays::Rays;
use crate::farfield::settings::FarFieldSettings;
use crate::math::half_turn::shares;
use crate::trace::Tracer;
use std::borrow::Cow;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Planes too rough over azimuth for interpolation are so many times more, then so many; if that does not help, they
/// say how planes are cut, and each that is asked for is traced by itself.
const FINER: usize = 2;
const FINEST: usize = 4;

/// Segments of one order at azimuths `j π / (count - 1)`.
pub(crate) struct OrderPlanes {
    pub order: u32,
    pub planes: Vec<Vec<Segment>>,
    /// How the planes were cut.
    pub layout: CutLayout,
    /// Lowest and highest angle of each segment over all planes, with some room.
    pub(super) spans: Vec<(f64, f64)>,
    /// How many segments there are before those of the penumbra.
    pub(super) beside_penumbra: usize,
    /// Waves about the axis, where nothing depends on azimuth.
    pub about_axis: Vec<Glory>,
    pub axis_gap: f64,
    pub azimuths: Azimuths,
    /// Share of the order's amplitude that is left to it.
    pub share: f64,
}

impl OrderPlanes {
    /// All that an order's wave is made of: planes with an integral near the rim, planes without, or shares of
    /// both where a body is on its way from nearly round. None where planes do not correspond.
    pub(crate) fn of_order(
        tracer: &Tracer,
        order: u32,
        settings: &FarFieldSettings,
        edge: Option<&Penumbra>,
        by: &Thresholds,
        guide: Option<&OrderGuide>,
    ) -> Vec<Self> {
        let new = |near_rim| Self::new(tracer, order, settings, edge, by, (near_rim, guide));
        let deformation = tracer.shape().deformation();
        let share = by.near_grazing_share(tracer.index().re, order, Rim::of(tracer), deformation);
        let Some(mut with) = new(share > 0.0) else { return Vec::new() };
        if share == 1.0 || with.layout.rim.is_none() {
            return vec![with];
        }
        let Some(mut without) = new(false) else { return vec![with] };
        with.scale(share);
        without.scale(1.0 - share);
        vec![with, without]
    }

    fn new(
        tracer: &Tracer,
        order: u32,
        settings: &FarFieldSettings,
        edge: Option<&Penumbra>,
        by: &Thresholds,
        (near_rim, guide): (bool, Option<&OrderGuide>),
    ) -> Option<Self> {
        let at = |finer: usize| {
            let guide = guide.filter(|_| finer == 1);
            Self::at(tracer, order, settings, edge, by, (near_rim, finer, guide))
        };
        let found = at(1)?;
        let rough = |found: &Self| {
            azimuthal_smoothness(&found.planes, settings.size_parameter) > by.roughest
        };
        let even = matches!(found.azimuths, Azimuths::Even);
        if !even || order > by.last_smoothed_order || !rough(&found) {
            return Some(found);
        }
        if let Some(finer) = at(FINER).filter(|finer| !rough(finer)) {
            return Some(finer);
        }
        match at(FINEST) {
            Some(finest) if order == 0 || !rough(&finest) => Some(finest),
            _ if order == 0 => Some(found),
            _ => Some(Self { azimuths: Azimuths::Single, ..found }),
        }
    }

    /// With an integral near the rim where it serves, `finer` times as many planes as usual, and what guides them.
    fn at(
        tracer: &Tracer,
        order: u32,
        settings: &FarFieldSettings,
        edge: Option<&Penumbra>,
        by: &Thresholds,
        (near_rim, finer, guide): (bool, usize, Option<&OrderGuide>),
    ) -> Option<Self> {
        let azimuths = Azimuths::of(tracer.shape());
        let centre = axial_ray(tracer, order);
        let high = by.is_high(order);
        let places = azimuths.places(settings.tolerance, finer * steps(by, order));
        // knots per radian at 1 %: the strongest orders have more
        let density = if order == 0 && edge.is_some() {
            48.0
        } else if order < by.first_sparse_order {
            36.0
        } else {
            20.0
        };
        let density = density * (0.01 / settings.tolerance).powf(0.25).clamp(0.6, 4.0);
        let caustic_disorder = caustic_disorder(tracer.shape(), order);
        let x = settings.size_parameter;
        let near_critical = by.near_critical_serves(order, tracer.shape().rotational_symmetry());
        let gaps = axis_gaps(by.narrowest_axis_gap, caustic_disorder);
        let with_rim = gaps.iter().filter(|_| near_rim).filter_map(|&gap| {
            let rim = rim_layout(by, tracer, order, x, caustic_disorder, gap)?;
            Some((Some(rim), gap))
        });
        let serves = !by.is_hopeless(order, caustic_disorder);
        let without = gaps.iter().filter(|_| serves).map(|&gap| (None, gap));
        let tries = with_rim.chain(without);
        tries.into_iter().find_map(|(rim, axis_gap)| {
            let layout = CutLayout {
                scan: scanned_rays(order),
                axis_gap,
                folds: Vec::new(),
                cut: None,
                density,
                knots: Vec::new(),
                size_parameter: x,
                high,
                near_critical,
                rim,
                edge: edge.map(Penumbra::taper),
            };
            let disorder = caustic_disorder;
            let traced = trace(tracer, order, centre, &places, layout, disorder, guide)?;
            let Traced { mut planes, layout, about_axis } = traced;
            let beside_penumbra = planes.first().map_or(0, Vec::len);
            for (segments, &azimuth) in planes.iter_mut().zip(&places) {
                segments.extend(edge.iter().flat_map(|edge| edge.segments(azimuth)));
            }
            let spans = spans(&planes);
            let azimuths = azimuths.clone();
            Some(Self {
                order,
                planes,
                layout,
                spans,
                beside_penumbra,
                about_axis,
                axis_gap,
                azimuths,
                share: 1.0,
            })
        })
    }

    /// Leave all but a share of the order's amplitude to another method.
    pub(crate) fn scale(&mut self, share: f64) {
        self.share *= share;
        self.planes.iter_mut().flatten().for_each(|segment| segment.scale(share));
    }

    /// How many segments each plane has.
    pub(crate) fn segments_per_plane(&self) -> usize {
        self.planes.first().map_or(0, Vec::len)
    }

    /// How densely planes were traced.
    pub(crate) fn spacing(&self) -> Spacing {
        match self.azimuths {
            Azimuths::Any => Spacing::One,
            Azimuths::Even => Spacing::Even(self.planes.len()),
            Azimuths::Single => Spacing::Single,
        }
    }

    /// Whether the order has an axis gap about θ = 0 or π.
    pub(crate) fn crosses(&self, axis: f64) -> bool {
        let near = |knot: &Knot| {
            let theta = (knot.angle().rem_euclid(2.0 * PI) - axis).abs();
            let theta = theta.min(2.0 * PI - theta);
            (theta - self.axis_gap).abs() < 1e-6
        };
        let ends =
            |s: &Segment| s.knots.first().is_some_and(near) || s.knots.last().is_some_and(near);
        self.planes.first().is_some_and(|m| m.iter().any(ends))
    }

    /// Whether a segment reaches any of the samples on one side of its plane, at any azimuth.
    pub(crate) fn meets(&self, number: usize, theta: &[f64], side: Side) -> bool {
        if matches!(self.azimuths, Azimuths::Single) {
            return true;
        }
        let (low, high) = self.spans[number];
        let (Some(&first), Some(&last)) = (theta.first(), theta.last()) else { return false };
        let (from, to) = if side == Side::Near { (first, last) } else { (-last, -first) };
        // some whole number of turns m with [from, to] + 2πm in reach
        ((high - from) / TAU).floor() >= ((low - to) / TAU).ceil()
    }

    /// The plane of an azimuth, where each is traced by itself.
    pub(crate) fn traced(&self, tracer: &Tracer, azimuth: f64) -> Option<Vec<Segment>> {
        if !matches!(self.azimuths, Azimuths::Single) {
            return None;
        }
        let mut plane = another(tracer, self.order, azimuth, &self.layout)?;
        plane.iter_mut().for_each(|segment| segment.scale(self.share));
        (plane.len() == self.segments_per_plane()).then_some(plane)
    }

    /// One segment at an azimuth in [0, π], of its plane where that was traced.
    pub(crate) fn segment<'s>(
        &'s self,
        number: usize,
        azimuth: f64,
        traced: Option<&'s Vec<Segment>>,
    ) -> Cow<'s, Segment> {
        if let Some(plane) = traced {
            return Cow::Borrowed(&plane[number]);
        }
        match &self.azimuths {
            Azimuths::Any => Cow::Borrowed(&self.planes[0][number]),
            Azimuths::Even => Cow::Owned(self.interpolated(number, azimuth)),
            // a plane that was lost is like its neighbour
            Azimuths::Single => {
                let last = self.planes.len() - 1;
                let nearest = (azimuth / PI * last as f64).round() as usize;
                Cow::Borrowed(&self.planes[nearest.min(last)][number])
            }
        }
    }

    /// A segment between the traced azimuths, by a polynomial through eight of them.
    fn interpolated(&self, number: usize, azimuth: f64) -> Segment {
        let template = &self.planes[0][number];
        let parity = template.kind.parity();
        let mut weights = [[0.0; CHANNELS]; STENCIL];
        let mut sources: [&[Knot]; STENCIL] = [&[]; STENCIL];
        for (k, share) in shares::<STENCIL>(azimuth, self.planes.len()).iter().enumerate() {
            sources[k] = &self.planes[share.index][number].knots;
            let weight = share.weight;
            weights[k] =
                if share.mirrored { parity.map(|p| p * weight) } else { [weight; CHANNELS] };
        }
        let mut knots = vec![Knot::default(); template.knots.len()];
        blend(&mut knots, &sources, &weights);
        Segment { kind: template.kind, knots }
    }
}

/// Lowest and highest angle of each segment over all planes, with room for interpolation.
fn spans(planes: &[Vec<Segment>]) -> Vec<(f64, f64)> {
    const ROOM: f64 = 1e-3;
    let count = planes.first().map_or(0, Vec::len);
    let span = |s: usize| {
        let ends =
            planes.iter().flat_map(|m| m[s].knots.first().into_iter().chain(m[s].knots.last()));
        let angles = ends.map(Knot::angle);
        angles.fold((f64::MAX, f64::MIN), |(l, h), a| (l.min(a - ROOM), h.max(a + ROOM)))
    };
    (0..count).map(span).collect()
}

/// Where the integral over rays near the rim takes over, if it serves this order.
fn rim_layout(
    by: &Thresholds,
    tracer: &Tracer,
    order: u32,
    x: f64,
    caustic_disorder: f64,
    axis_gap: f64,
) -> Option<NearGrazingLayout> {
    let rim = Rim::of(tracer);
    let marks = taper(by, tracer.index().re, order, x, caustic_disorder, axis_gap, rim)?;
    let like = if rim.is_settled(order) {
        None
    } else {
        Some(Arc::new(Rays::of_sphere(order, tracer.index(), marks[0])?))
    };
    let one_plane_to = (rim != Rim::Uneven).then_some(by.largest_checked_sphere);
    Some(NearGrazingLayout::new(marks, one_plane_to, order, like))
}
