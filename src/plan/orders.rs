//! How many orders matter: those that hold more of the light than the tolerance lets go.

use crate::farfield::assignment::Thresholds;
use crate::optics::fresnel;

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

    #[test]
    fn light_inside_only_gets_less() {
        let left = left_inside(1.5, 10);
        assert!(left[0] > 0.8 && left.windows(2).all(|w| w[1] < w[0]), "{left:?}");
    }
}
