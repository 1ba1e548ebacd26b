//! Where the rainbows of a sphere are by ray optics (Descartes 1637).

use std::f64::consts::{PI, TAU};

/// The scattering angle (radians) at which rays of an order turn back, for a sphere of real index: the
/// ray with `cos² i = (n² - 1)/(p² - 1)` is deviated least. Nothing for orders below 2, and for an index
/// that has no such ray.
///
/// ```
/// let primary = gonio::optics::rainbow_angle(4.0 / 3.0, 2).unwrap();
/// assert!((180.0 - primary.to_degrees() - 42.03).abs() < 0.01);
/// assert!(gonio::optics::rainbow_angle(2.5, 2).is_none());
/// ```
pub fn rainbow_angle(index: f64, order: u32) -> Option<f64> {
    let p = f64::from(order);
    let squared = (index * index - 1.0) / (p * p - 1.0);
    if order < 2 || !(0.0..1.0).contains(&squared) {
        return None;
    }
    let incident = squared.sqrt().acos();
    let refracted = (incident.sin() / index).asin();
    let turned = (p - 1.0) * PI + 2.0 * incident - 2.0 * p * refracted;
    let angle = turned.rem_euclid(TAU);
    Some(angle.min(TAU - angle))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The deviation is stationary at the angle: it changes by the square of a step in the impact.
    #[test]
    fn deviation_is_stationary() {
        for (index, order) in [(1.333, 2), (1.333, 3), (1.5, 2), (1.2, 5)] {
            let p = f64::from(order);
            let deviation = |i: f64| (p - 1.0) * PI + 2.0 * i - 2.0 * p * (i.sin() / index).asin();
            let incident = f64::sqrt((index * index - 1.0) / (p * p - 1.0)).acos();
            let slope = (deviation(incident + 1e-5) - deviation(incident - 1e-5)) / 2e-5;
            assert!(slope.abs() < 1e-8, "{index} {order}: {slope}");
            let folded = deviation(incident).rem_euclid(TAU);
            let angle = rainbow_angle(index, order).unwrap();
            assert!((angle - folded.min(TAU - folded)).abs() < 1e-12);
        }
        assert!(rainbow_angle(1.333, 1).is_none());
    }
}
