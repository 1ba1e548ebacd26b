//! One order: its scattering planes at some azimuths, and its segments at any other.

use super::azimuthal_smoothness::azimuthal_smoothness;
use super::cut_layout::CutLayout;
use super::matching::{Traced, trace};
use crate::farfield::branch::accumulate::Side;
use crate::farfield::branch::knots::{
    CHANNELS, Kind, Knot, PAIR_AMPLITUDE, PLAIN_AMPLITUDE, SLOPE, Segment,
};
use crate::farfield::deflection::scattering_plane::axial_ray;
use crate::farfield::forward::penumbra::Penumbra;
use crate::farfield::impact_integral::glory::Glory;
use crate::farfield::impact_integral::near_grazing_layout::{self, NearGrazingLayout};
use crate::farfield::settings::FarFieldSettings;
use crate::math::fused::multiply_add;
use crate::math::half_turn::shares;
use crate::trace::Tracer;
use multiversion::multiversion;
use multiversion::target::target_cfg_f;
use std::borrow::Cow;
use std::f64::consts::{PI, TAU};

/// Azimuth steps per half-turn, before refinement by the tolerance: for orders of plain rays and
/// pairs, and for those with rim waves, whose phases change faster.
const HALF_TURN_STEPS: usize = 40;
const HALF_TURN_STEPS_RIM: usize = 60;
/// How far planes may differ from what their neighbours make of them (see [`azimuthal_smoothness`]) to be
/// interpolated over azimuth; else there are some times more, and if that does not help those asked for
/// are traced one by one. Interpolation between them has steps half as long and more neighbours, and
/// errs by a small part of that.
const ROUGHEST: f64 = 0.2;
const FINER: usize = 4;
/// The last order that is worth it: higher ones are weak, and their waves have many knots.
const LAST_CHECKED: u32 = 3;
/// Neighbours in the interpolation over azimuth.
const STENCIL: usize = 8;
/// Order times deformation from which planes no longer correspond across the axis.
const HOPELESS_TANGLE: f64 = 0.068;

/// Segments of one order at azimuths `j π / (count - 1)`, or at the azimuths asked for.
pub(crate) struct OrderPlanes {
    pub order: u32,
    pub planes: Vec<Vec<Segment>>,
    /// How the planes were cut.
    pub layout: CutLayout,
    /// Lowest and highest angle of each segment over all planes, with some room.
    spans: Vec<(f64, f64)>,
    /// Waves about the axis, where nothing depends on azimuth.
    pub about_axis: Vec<Glory>,
    pub axis_gap: f64,
    pub azimuths: Azimuths,
}

/// Where the planes stand.
#[derive(Clone, Debug)]
pub(crate) enum Azimuths {
    /// One serves all: nothing depends on azimuth.
    Any,
    /// Even steps over a half-turn, both ends in.
    Even,
    /// Exactly these, in [0, π], ascending.
    Listed(Vec<f64>),
}

impl OrderPlanes {
    pub(crate) fn new(
        tracer: &Tracer,
        order: u32,
        settings: &FarFieldSettings,
        edge: Option<&Penumbra>,
    ) -> Option<Self> {
        let azimuths = azimuths(tracer, settings);
        let checked = order <= LAST_CHECKED && matches!(azimuths, Azimuths::Even);
        let found = Self::at(tracer, order, settings, edge, azimuths, 1)?;
        let rough =
            |found: &Self| azimuthal_smoothness(&found.planes, settings.size_parameter) > ROUGHEST;
        if !checked || !rough(&found) {
            return Some(found);
        }
        let listed = listed(settings);
        if listed.len() > FINER * found.planes.len() {
            let finer = Self::at(tracer, order, settings, edge, Azimuths::Even, FINER);
            if let Some(found) = finer.filter(|found| !rough(found)) {
                return Some(found);
            }
        }
        Self::at(tracer, order, settings, edge, Azimuths::Listed(listed), 1)
    }

    /// With planes at these azimuths, `finer` times as many as usual where they are even.
    fn at(
        tracer: &Tracer,
        order: u32,
        settings: &FarFieldSettings,
        edge: Option<&Penumbra>,
        azimuths: Azimuths,
        finer: usize,
    ) -> Option<Self> {
        let centre = axial_ray(tracer, order);
        let steps = finer * if order > 3 { HALF_TURN_STEPS_RIM } else { HALF_TURN_STEPS };
        let places = azimuths.places(settings, steps);
        // knots per radian at 1 %: the strongest orders have more
        let density = if order == 0 && edge.is_some() {
            48.0
        } else if order <= 2 {
            36.0
        } else {
            16.0
        };
        let density = density * (0.01 / settings.tolerance).powf(0.25).clamp(0.6, 4.0);
        let caustic_disorder = caustic_disorder(tracer, order);
        let x = settings.size_parameter;
        let with_rim = axis_gaps(order, caustic_disorder, true).into_iter().filter_map(|gap| {
            let rim = rim_layout(tracer, order, x, caustic_disorder, gap)?;
            Some((Some(rim), gap))
        });
        let without = axis_gaps(order, caustic_disorder, false).into_iter().map(|gap| (None, gap));
        let tries = with_rim.chain(without);
        tries.into_iter().find_map(|(rim, axis_gap)| {
            let layout = CutLayout {
                scan: 64 + 16 * order as usize,
                axis_gap,
                folds: Vec::new(),
                cut: None,
                density,
                knots: Vec::new(),
                size_parameter: x,
                rim,
                edge: edge.map(Penumbra::taper),
            };
            let traced = trace(tracer, order, centre, &places, layout, caustic_disorder)?;
            let Traced { mut planes, layout, about_axis } = traced;
            for (segments, &azimuth) in planes.iter_mut().zip(&places) {
                segments.extend(edge.iter().flat_map(|edge| edge.segments(azimuth)));
            }
            let spans = spans(&planes);
            let azimuths = azimuths.clone();
            Some(Self { order, planes, layout, spans, about_axis, axis_gap, azimuths })
        })
    }

    /// How many segments each plane has.
    pub(crate) fn segments_per_plane(&self) -> usize {
        self.planes.first().map_or(0, Vec::len)
    }

    /// Whether the order has an axis gap about θ = 0 or π.
    pub(crate) fn crosses(&self, axis: f64) -> bool {
        let near = |knot: &Knot| {
            let theta = (knot[0].rem_euclid(2.0 * PI) - axis).abs();
            let theta = theta.min(2.0 * PI - theta);
            (theta - self.axis_gap).abs() < 1e-6
        };
        let ends =
            |s: &Segment| s.knots.first().is_some_and(near) || s.knots.last().is_some_and(near);
        self.planes.first().is_some_and(|m| m.iter().any(ends))
    }

    /// Whether a segment reaches any of the samples on one side of its plane, at any azimuth.
    pub(crate) fn meets(&self, number: usize, theta: &[f64], side: Side) -> bool {
        let (low, high) = self.spans[number];
        let (Some(&first), Some(&last)) = (theta.first(), theta.last()) else { return false };
        let (from, to) = if side == Side::Near { (first, last) } else { (-last, -first) };
        // some whole number of turns m with [from, to] + 2πm in reach
        ((high - from) / TAU).floor() >= ((low - to) / TAU).ceil()
    }

    /// One segment at an azimuth in [0, π].
    pub(crate) fn segment(&self, number: usize, azimuth: f64) -> Cow<'_, Segment> {
        match &self.azimuths {
            Azimuths::Any => Cow::Borrowed(&self.planes[0][number]),
            Azimuths::Listed(list) => {
                let k = list.partition_point(|&a| a < azimuth - 1e-9).min(list.len() - 1);
                Cow::Borrowed(&self.planes[k][number])
            }
            Azimuths::Even => Cow::Owned(self.interpolated(number, azimuth)),
        }
    }

    /// A segment between the traced azimuths, by a polynomial through eight of them.
    fn interpolated(&self, number: usize, azimuth: f64) -> Segment {
        let template = &self.planes[0][number];
        let parity = parity(&template.kind);
        let mut weights = [[0.0; CHANNELS]; STENCIL];
        let mut sources: [&[Knot]; STENCIL] = [&[]; STENCIL];
        for (k, share) in shares::<STENCIL>(azimuth, self.planes.len()).iter().enumerate() {
            sources[k] = &self.planes[share.index][number].knots;
            let weight = share.weight;
            weights[k] =
                if share.mirrored { parity.map(|p| p * weight) } else { [weight; CHANNELS] };
        }
        let mut knots = vec![[0.0; CHANNELS]; template.knots.len()];
        blend(&mut knots, &sources, &weights);
        Segment { kind: template.kind, knots }
    }
}

/// How far rays of an order stray from those of a sphere: order times deformation of the outline.
pub(crate) fn caustic_disorder(tracer: &Tracer, order: u32) -> f64 {
    let silhouette = tracer.shape().silhouette();
    let radii: Vec<f64> = (0..16).map(|k| silhouette.radius(k as f64 * PI / 8.0)).collect();
    let (low, high) = radii.iter().fold((f64::MAX, 0.0f64), |(l, h), r| (l.min(*r), h.max(*r)));
    f64::from(order) * (high - low)
}

/// Gaps tried about crossings of the axis, radians: the tangle of rays there grows with the order
/// and with the deformation of the outline.
fn axis_gaps(order: u32, caustic_disorder: f64, rim: bool) -> Vec<f64> {
    const NARROWEST: f64 = 0.02;
    const WIDEST: f64 = 0.35;
    // Orders up to 3 do not cross the axis again; those that do are hopeless beyond this.
    if order > 3 && caustic_disorder > HOPELESS_TANGLE && !rim {
        return Vec::new();
    }
    let mut gaps = [3.0, 6.0].map(|f| (f * caustic_disorder).clamp(NARROWEST, WIDEST)).to_vec();
    gaps.dedup();
    gaps
}

/// Lowest and highest angle of each segment over all planes, with room for interpolation.
fn spans(planes: &[Vec<Segment>]) -> Vec<(f64, f64)> {
    const ROOM: f64 = 1e-3;
    let count = planes.first().map_or(0, Vec::len);
    let span = |s: usize| {
        let ends =
            planes.iter().flat_map(|m| m[s].knots.first().into_iter().chain(m[s].knots.last()));
        let angles = ends.map(|knot| knot[0]);
        angles.fold((f64::MAX, f64::MIN), |(l, h), a| (l.min(a - ROOM), h.max(a + ROOM)))
    };
    (0..count).map(span).collect()
}

/// Weighted sums of knots, channel by channel.
#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
fn blend(knots: &mut [Knot], sources: &[&[Knot]; STENCIL], weights: &[Knot; STENCIL]) {
    if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
        blend_with::<true>(knots, sources, weights);
    } else {
        blend_with::<false>(knots, sources, weights);
    }
}

#[inline(always)]
fn blend_with<const FMA: bool>(
    knots: &mut [Knot],
    sources: &[&[Knot]; STENCIL],
    weights: &[Knot; STENCIL],
) {
    let count = sources.iter().map(|s| s.len()).fold(knots.len(), usize::min);
    let sources = sources.map(|s| &s[..count]);
    for (i, knot) in knots[..count].iter_mut().enumerate() {
        let mut sum = [0.0; CHANNELS];
        for (source, weights) in sources.iter().zip(weights) {
            for c in 0..CHANNELS {
                sum[c] = multiply_add::<FMA>(weights[c], source[i][c], sum[c]);
            }
        }
        *knot = sum;
    }
}

/// Where the integral over rays near the rim takes over, if it serves this order.
fn rim_layout(
    tracer: &Tracer,
    order: u32,
    x: f64,
    caustic_disorder: f64,
    axis_gap: f64,
) -> Option<NearGrazingLayout> {
    let rotational = tracer.shape().rotational_symmetry();
    let marks = near_grazing_layout::taper(
        tracer.index().re,
        order,
        x,
        caustic_disorder,
        axis_gap,
        rotational,
    )?;
    Some(NearGrazingLayout::new(marks, rotational))
}

/// Sign of each channel in the mirror: S3 and S4 change theirs.
fn parity(kind: &Kind) -> Knot {
    let odd: &[usize] = match kind {
        Kind::Plain { .. } | Kind::Wave => &[PLAIN_AMPLITUDE + 4, SLOPE + 4],
        Kind::Pair { .. } => &[PAIR_AMPLITUDE + 4, PAIR_AMPLITUDE + 12],
    };
    std::array::from_fn(|c| if odd.iter().any(|&o| (o..o + 4).contains(&c)) { -1.0 } else { 1.0 })
}

pub(crate) fn mirror(segment: &mut Segment) {
    let parity = parity(&segment.kind);
    for knot in &mut segment.knots {
        for (value, sign) in knot.iter_mut().zip(parity) {
            *value *= sign;
        }
    }
}

/// The azimuths of all planes that the asked ones need: each column its own and that of the
/// opposite side.
fn listed(settings: &FarFieldSettings) -> Vec<f64> {
    let mut list: Vec<f64> = settings.azimuths.iter().flat_map(|&a| [a, PI - a]).collect();
    list.sort_by(f64::total_cmp);
    list.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    list
}

fn azimuths(tracer: &Tracer, settings: &FarFieldSettings) -> Azimuths {
    if tracer.shape().rotational_symmetry() {
        return Azimuths::Any;
    }
    let list = listed(settings);
    if list.len() <= HALF_TURN_STEPS { Azimuths::Listed(list) } else { Azimuths::Even }
}

impl Azimuths {
    fn places(&self, settings: &FarFieldSettings, half_turn_steps: usize) -> Vec<f64> {
        match self {
            Azimuths::Any => vec![0.0],
            Azimuths::Listed(list) => list.clone(),
            Azimuths::Even => {
                let finer = (0.01 / settings.tolerance).powf(0.125).clamp(0.8, 2.0);
                let steps = (half_turn_steps as f64 * finer).ceil() as usize;
                (0..=steps).map(|j| j as f64 * PI / steps as f64).collect()
            }
        }
    }
}
