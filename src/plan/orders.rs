//! Which orders matter: those that hold more of the light than the tolerance lets go, of all of it or of what goes
//! where they have their bows.

use crate::farfield::assignment::Thresholds;
use crate::optics::fresnel;
use crate::shape::Shape;
use std::f64::consts::{PI, TAU};

/// Share of the light that orders left out may hold at a tolerance.
pub(super) fn remainder_limit(tolerance: f64, by: &Thresholds) -> f64 {
    by.left_out_per_tolerance * tolerance
}

/// The last order that matters for a sphere of this index.
///
/// ```
/// assert!(gonio::plan::last_order(1.33, 1e-4) > gonio::plan::last_order(1.33, 1e-2));
/// ```
pub fn last_order(index: f64, tolerance: f64) -> u32 {
    last_order_by(&Thresholds::MEASURED, index, tolerance)
}

/// The same by given thresholds.
pub(super) fn last_order_by(by: &Thresholds, index: f64, tolerance: f64) -> u32 {
    let left = left_inside(index, by.highest_order);
    let limit = remainder_limit(tolerance, by);
    let last = left.iter().position(|&rest| rest < limit);
    last.map_or(by.highest_order, |p| p as u32).max(by.least_last_order)
}

/// The orders that matter: all up to the last one, and of a sphere those beyond that have their bow where next to no
/// other light goes (10 and 11 of water: 2 % of what is at 100 to 110°, 3.5 % of what is straight back). On other bodies
/// such bows lie elsewhere.
///
/// ```
/// use gonio::{plan::orders_that_matter, shape::Shape};
/// assert_eq!(orders_that_matter(1.3314, 0.01, &Shape::sphere()), [0, 1, 2, 3, 4, 5, 6, 7, 10, 11]);
/// assert_eq!(orders_that_matter(1.3314, 0.01, &Shape::spheroid(0.9, 0.0)?), [0, 1, 2, 3, 4, 5, 6, 7]);
/// # Ok::<(), gonio::shape::ShapeError>(())
/// ```
pub fn orders_that_matter(index: f64, tolerance: f64, shape: &Shape) -> Vec<u32> {
    orders_that_matter_by(&Thresholds::MEASURED, index, tolerance, shape)
}

/// The same by given thresholds.
pub(super) fn orders_that_matter_by(
    by: &Thresholds,
    index: f64,
    tolerance: f64,
    shape: &Shape,
) -> Vec<u32> {
    let last = last_order_by(by, index, tolerance);
    let mut orders: Vec<u32> = (0..=last).collect();
    if shape.is_sphere() {
        let shares = largest_shares(index, by.highest_order);
        let limit = by.left_out_of_a_band_per_tolerance * tolerance;
        orders.extend((last + 1..=by.highest_order).filter(|&p| shares[p as usize] > limit));
    }
    orders
}

/// The largest share that each order of a sphere has of the unpolarised light in a band of 10°, without interference.
fn largest_shares(index: f64, last: u32) -> Vec<f64> {
    const RAYS: usize = 2000;
    const BANDS: usize = 18;
    let mut power = vec![[0.0; BANDS]; last as usize + 1];
    for i in 0..RAYS {
        let impact_squared: f64 = (i as f64 + 0.5) / RAYS as f64;
        let inside = (impact_squared.sqrt() / index).min(1.0).asin();
        let outside = impact_squared.sqrt().asin();
        let f = fresnel((1.0 - impact_squared).sqrt(), index.into());
        for (r, t) in [(f.r_perpendicular, f.t_perpendicular), (f.r_parallel, f.t_parallel)] {
            let (reflected, mut left) = (r.norm_sqr(), t.norm_sqr());
            for (order, bands) in power.iter_mut().enumerate() {
                let deviation = PI - 2.0 * outside - order as f64 * (PI - 2.0 * inside);
                let turned = deviation.rem_euclid(TAU);
                let theta = turned.min(TAU - turned);
                let band = ((theta / PI * BANDS as f64) as usize).min(BANDS - 1);
                bands[band] += if order == 0 { reflected } else { left * (1.0 - reflected) };
                if order > 0 {
                    left *= reflected;
                }
            }
        }
    }
    let total = |band: usize| power.iter().map(|bands| bands[band]).sum::<f64>();
    let totals: Vec<f64> = (0..BANDS).map(total).collect();
    let share = |(power, total): (&f64, &f64)| if *power > 0.0 { power / total } else { 0.0 };
    power.iter().map(|bands| bands.iter().zip(&totals).map(share).fold(0.0, f64::max)).collect()
}

/// Share of unpolarised light still inside a sphere after each order, by impact parameter.
fn left_inside(index: f64, last: u32) -> Vec<f64> {
    const RAYS: usize = 400;
    let mut left = vec![0.0; last as usize + 1];
    for i in 0..RAYS {
        let impact_squared = (i as f64 + 0.5) / RAYS as f64;
        if impact_squared >= index * index {
            continue; // totally reflected outside: nothing enters
        }
        let f = fresnel((1.0 - impact_squared).sqrt(), index.into());
        for (r, t) in [(f.r_perpendicular, f.t_perpendicular), (f.r_parallel, f.t_parallel)] {
            let (reflected, mut inside) = (r.norm_sqr(), t.norm_sqr());
            for share in &mut left {
                *share += 0.5 * inside / RAYS as f64;
                inside *= reflected;
            }
        }
    }
    // after order p the wave has been reflected p times inside; index 0: all that entered
    left
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thresholds_bound_the_last_order() {
        let by = Thresholds { highest_order: 6, least_last_order: 5, ..Thresholds::MEASURED };
        assert_eq!(last_order_by(&by, 1.33, 1e-9), 6);
        assert_eq!(last_order_by(&by, 1.33, 0.9), 5);
    }

    /// Reflection alone goes to no band but shares all; the primary bow of water is most of 130 to 140°, no order above
    /// 11 more than a hundredth of any band; by geometrical optics of 2e5 rays, order 10 has 1.80 % and 11 3.37 %.
    #[test]
    fn high_orders_have_their_share_where_their_bows_are() {
        let shares = largest_shares(1.3314, 24);
        assert!(shares[2] > 0.85 && shares[12..].iter().all(|share| *share < 0.01), "{shares:?}");
        assert!((shares[10] - 0.0180).abs() < 1e-3 && (shares[11] - 0.0337).abs() < 1e-3);
        assert!(shares.iter().all(|share| (0.0..=1.0).contains(share)));
    }

    #[test]
    fn light_inside_only_gets_less() {
        let left = left_inside(1.5, 10);
        assert!(left[0] > 0.8 && left.windows(2).all(|w| w[1] < w[0]), "{left:?}");
    }
}
