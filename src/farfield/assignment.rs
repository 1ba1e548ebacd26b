//! Which method stands for which order: decided by the scene alone, never by the directions asked for.
//!
//! Scattering planes serve as long as their rays correspond from azimuth to azimuth. How far rays of an
//! order stray from those of a sphere grows with the order and with the deformation of the outline (see
//! [`super::azimuth::order_planes::caustic_disorder`]); beyond some of it the order is a sum on a complex wavefront
//! ([`super::complex_wavefront`]), which asks nothing of its rays. Between two values of it both are
//! computed and mixed, so that nothing jumps where one takes over from the other.

use super::azimuth::order_planes::caustic_disorder;
use crate::trace::Tracer;

/// Order times deformation over which the sum takes over, for orders that cross the axis once and for
/// those whose bows are made near the rim.
const LOW_ORDERS: [f64; 2] = [0.14, 0.165];
const HIGH_ORDERS: [f64; 2] = [0.09, 0.1];
/// Bodies that look the same from below keep their rays in order further: planes of a spheroid of axis ratio
/// 0.9 are reciprocal within 1e-4 up to order 3.
const OF_MIRROR_SYMMETRY: f64 = 2.0;
/// The first of the latter.
const FIRST_HIGH_ORDER: u32 = 4;

/// Share of the sum in the wave of an order; the rest is that of scattering planes. Reflection (order 0)
/// has its own wave at the rim, and what is rotationally symmetric one plane.
pub(super) fn share_of_sum(tracer: &Tracer, order: u32) -> f64 {
    if order == 0 || tracer.shape().rotational_symmetry() {
        return 0.0;
    }
    let more = if tracer.shape().mirror_symmetry() { OF_MIRROR_SYMMETRY } else { 1.0 };
    share(order, caustic_disorder(tracer, order) / more)
}

fn share(order: u32, disorder: f64) -> f64 {
    let [from, to] = if order < FIRST_HIGH_ORDER { LOW_ORDERS } else { HIGH_ORDERS };
    let t = ((disorder - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{RaindropModel, Shape};
    use num_complex::Complex64;

    fn shares(radius_mm: f64, elevation: f64) -> Vec<f64> {
        let sun = elevation.to_radians();
        let model = RaindropModel::BeardChuang1987;
        let shape = Shape::raindrop(1e-3 * radius_mm, model, sun).unwrap();
        let tracer = Tracer::new(&shape, Complex64::new(1.33, 0.0), 5000.0, 5);
        (0..=5).map(|order| share_of_sum(&tracer, order)).collect()
    }

    #[test]
    fn shares_rise_with_order_and_deformation() {
        assert_eq!(shares(0.5, 20.0), [0.0; 6]);
        assert_eq!(shares(2.0, 20.0), [0.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
        let all: Vec<f64> = (40..200).map(|r| shares(0.01 * f64::from(r), 20.0)[2]).collect();
        assert!(all.windows(2).all(|w| w[1] >= w[0] && w[1] - w[0] < 0.6), "{all:?}");
    }

    /// Seen along its axis a drop is round, however flat.
    #[test]
    fn drops_lit_from_above_have_one_plane() {
        assert_eq!(shares(2.0, 90.0), [0.0; 6]);
    }
}
