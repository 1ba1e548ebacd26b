//! Scattering planes of all orders, and columns at any azimuth.
//!
//! Scattering planes are traced at a few azimuths of one half-turn; the mirror plane gives the others. Where
//! all planes of an order have the same landmarks, their segments vary smoothly with azimuth and
//! any column is interpolated from eight neighbours; where they do not vary smoothly they say how planes are
//! cut, and that of each column is traced. None of it depends on which are asked for. Orders whose planes do not correspond (more than two rays
//! coalesce somewhere: cusps, umbilics) are told by `PlaneSet::outcomes`.

use super::guides::Guides;
use super::matching::another;
use super::order_planes::OrderPlanes;
use crate::farfield::assignment::{PlanesOutcome, Thresholds};
use crate::farfield::branch::accumulate::add_segment;
use crate::farfield::branch::knots::{Kind, Segment};
use crate::farfield::branch::samples::{Samples, Side, Sums};
use crate::farfield::forward::diffraction::ForwardDiffraction;
use crate::farfield::forward::penumbra::Penumbra;
use crate::farfield::impact_integral::glory::Glory;
use crate::farfield::settings::FarFieldSettings;
use crate::farfield::wave_field::WaveField;
use crate::math::parallel::*;
use crate::optics::AmplitudeMatrix;
use crate::trace::Tracer;
use std::f64::consts::PI;

/// All planes of one wavelength.
pub struct PlaneSet<'a> {
    tracer: Tracer<'a>,
    size_parameter: f64,
    /// Those of an order stand together.
    orders: Vec<OrderPlanes>,
    edge: Option<Penumbra>,
    /// Orders whose planes do not correspond.
    unmatched: Vec<u32>,
}

/// A stretch of exit angles whose wave is computed by one formula.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Number of chords.
    pub order: u32,
    /// What its knots hold; `None` for the wave about the axis.
    pub kind: Option<Kind>,
    /// Exit angles at its ends, unwrapped, radians.
    pub angles: [f64; 2],
}

/// Where interpolation over azimuth is checked: off the even steps by nearly half of one, for both
/// numbers of steps.
pub(crate) const CHECKED_AZIMUTH: f64 = 0.3105 * PI;

impl<'a> PlaneSet<'a> {
    /// Trace all planes of a particle with this shadow.
    pub fn new(
        tracer: &Tracer<'a>,
        settings: &FarFieldSettings,
        shadow: &ForwardDiffraction,
        by: &Thresholds,
    ) -> Self {
        Self::guided(tracer, settings, shadow, by, None)
    }

    /// The same with guides to the planes of its orders.
    pub(crate) fn guided(
        tracer: &Tracer<'a>,
        settings: &FarFieldSettings,
        shadow: &ForwardDiffraction,
        by: &Thresholds,
        guides: Option<&Guides>,
    ) -> Self {
        let joined = settings.diffraction && settings.orders.contains(&0);
        let edge = joined.then(|| Penumbra::new(tracer, shadow, settings.size_parameter)).flatten();
        let traced_orders: Vec<(u32, Vec<OrderPlanes>)> = settings
            .orders
            .par_iter()
            .map(|&order| {
                let edge = edge.as_ref().filter(|_| order == 0);
                let guide = guides.and_then(|guides| guides.of(order));
                (order, OrderPlanes::of_order(tracer, order, settings, edge, by, guide))
            })
            .collect();
        let unmatched: Vec<u32> =
            traced_orders.iter().filter(|f| f.1.is_empty()).map(|f| f.0).collect();
        let orders = traced_orders.into_iter().flat_map(|f| f.1).collect();
        let edge = edge.filter(|_| !unmatched.contains(&0));
        let size_parameter = settings.size_parameter;
        Self { tracer: tracer.clone(), size_parameter, orders, edge, unmatched }
    }

    /// Circumference of the sphere of equal volume over the wavelength.
    pub(crate) fn size_parameter(&self) -> f64 {
        self.size_parameter
    }

    /// The edge wave, if diffraction and order 0 are joined.
    pub fn edge(&self) -> Option<&Penumbra> {
        self.edge.as_ref()
    }

    /// What became of each order.
    pub(crate) fn outcomes(&self) -> Vec<PlanesOutcome> {
        // where an order has two, the first has all formulas
        let orders = self.orders.chunk_by(|a, b| a.order == b.order);
        let found = orders.map(|planes| PlanesOutcome {
            order: planes[0].order,
            found: Some((planes[0].spacing(), planes[0].formulas())),
        });
        let lost = self.unmatched.iter().map(|&order| PlanesOutcome { order, found: None });
        found.chain(lost).collect()
    }

    /// Leave all but a share of an order's amplitude to another method.
    pub(crate) fn scale(&mut self, order: u32, share: f64) {
        let planes = self.orders.iter_mut().filter(|planes| planes.order == order);
        planes.for_each(|planes| planes.scale(share));
    }

    /// One order's amplitudes at samples θ (ascending) of some azimuths in [0, π].
    pub(crate) fn columns_of(
        &self,
        order: u32,
        theta: &[f64],
        azimuths: &[f64],
    ) -> Vec<Vec<AmplitudeMatrix>> {
        let orders = self.orders.iter().filter(|planes| planes.order == order);
        self.columns_of_orders(orders, theta, azimuths)
    }

    /// Amplitudes at samples θ (ascending) of some azimuths in [0, π], without forward diffraction.
    pub fn columns(&self, theta: &[f64], azimuths: &[f64]) -> Vec<Vec<AmplitudeMatrix>> {
        self.columns_of_orders(self.orders.iter(), theta, azimuths)
    }

    /// Segment by segment for all azimuths, so that what they are interpolated from stays in cache.
    fn columns_of_orders<'f>(
        &self,
        orders: impl Iterator<Item = &'f OrderPlanes> + Clone,
        theta: &[f64],
        azimuths: &[f64],
    ) -> Vec<Vec<AmplitudeMatrix>> {
        let x = self.size_parameter;
        let samples = Samples::new(theta);
        let mut sums: Vec<Sums> = azimuths.iter().map(|_| Sums::new(&samples)).collect();
        for planes in orders.clone() {
            // the plane of φ + π is the mirror image of that of π - φ
            let traced = |azimuth: f64| planes.traced(&self.tracer, azimuth);
            let both: Vec<_> = azimuths.iter().map(|&a| [traced(a), traced(PI - a)]).collect();
            for number in 0..planes.segments_per_plane() {
                let asked = azimuths.iter().zip(&both);
                let near = planes.meets(number, theta, Side::Near);
                for (sums, (&azimuth, [traced, _])) in
                    sums.iter_mut().zip(asked.clone()).filter(|_| near)
                {
                    let segment = planes.segment(number, azimuth, traced.as_ref());
                    add_segment(sums, &samples, &segment, Side::Near, x);
                }
                let far = planes.meets(number, theta, Side::Far);
                for (sums, (&azimuth, [_, traced])) in sums.iter_mut().zip(asked).filter(|_| far) {
                    let segment = planes.segment(number, PI - azimuth, traced.as_ref());
                    let mut segment = segment.into_owned();
                    segment.mirror();
                    add_segment(sums, &samples, &segment, Side::Far, x);
                }
            }
        }
        let mut columns: Vec<Vec<AmplitudeMatrix>> =
            sums.into_iter().map(|sums| sums.amplitudes()).collect();
        for wave in orders.flat_map(|planes| &planes.about_axis) {
            columns.iter_mut().for_each(|column| wave.add(theta, column));
        }
        columns
    }

    /// For every order, amplitudes of its rays on the near side of an azimuth's plane: interpolated,
    /// and traced there with twice the knots.
    pub(crate) fn checks(
        &self,
        tracer: &Tracer,
        theta: &[f64],
        azimuth: f64,
    ) -> Vec<[Vec<AmplitudeMatrix>; 2]> {
        let samples = Samples::new(theta);
        let check = |planes: &OrderPlanes| {
            let mut traced = another(tracer, planes.order, azimuth, &planes.layout.finer())?;
            traced.iter_mut().for_each(|segment| segment.scale(planes.share));
            let single = planes.traced(tracer, azimuth);
            let mut sums = [Sums::new(&samples), Sums::new(&samples)];
            for (number, segment) in traced.iter().enumerate() {
                let interpolated = planes.segment(number, azimuth, single.as_ref());
                for (sums, segment) in sums.iter_mut().zip([interpolated.as_ref(), segment]) {
                    add_segment(sums, &samples, segment, Side::Near, self.size_parameter);
                }
            }
            Some(sums.map(|sums| sums.amplitudes()))
        };
        self.orders.par_iter().filter_map(check).collect()
    }

    /// What the waves of each order in the first plane are computed by, for pictures.
    pub fn pieces(&self) -> Vec<Piece> {
        let of_order = |planes: &OrderPlanes| {
            let order = planes.order;
            let segments = planes.planes.first().into_iter().flatten();
            let piece = move |segment: &Segment| {
                let angles = [segment.knots.first()?.angle(), segment.knots.last()?.angle()];
                Some(Piece { order, kind: Some(segment.kind), angles })
            };
            let glory = move |wave: &Glory| Piece { order, kind: None, angles: wave.angles() };
            let about_axis = planes.about_axis.iter().map(glory);
            segments.filter_map(piece).chain(about_axis).collect::<Vec<_>>()
        };
        self.orders.iter().flat_map(of_order).collect()
    }

    /// How many rays more than two may coalesce near each sample: 3 within an axis gap, else 0.
    pub fn caustic_order(&self, theta: &[f64]) -> Vec<u8> {
        let gap = |axis: f64| {
            let meets = |f: &&OrderPlanes| f.about_axis.is_empty() && f.crosses(axis);
            self.orders.iter().filter(meets).map(|f| f.axis_gap).fold(0.0, f64::max)
        };
        let (forward, backward) = (gap(0.0), gap(PI));
        let marked = |t: f64| t < forward || PI - t < backward;
        theta.iter().map(|&t| if marked(t) { 3 } else { 0 }).collect()
    }
}

impl WaveField for PlaneSet<'_> {
    fn add(&self, theta: &[f64], phi: f64, sums: &mut [AmplitudeMatrix]) {
        let column = self.columns(theta, &[phi]).swap_remove(0);
        sums.iter_mut().zip(column).for_each(|(sum, wave)| *sum += wave);
    }

    fn add_columns(&self, theta: &[f64], azimuths: &[f64], columns: &mut [Vec<AmplitudeMatrix>]) {
        for (column, found) in columns.iter_mut().zip(self.columns(theta, azimuths)) {
            column.iter_mut().zip(found).for_each(|(sum, wave)| *sum += wave);
        }
    }
}
