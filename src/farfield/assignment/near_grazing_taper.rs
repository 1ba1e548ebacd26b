//! Where on a sphere the integral over rays near the rim takes over from single rays: inside the bow's ray by
//! some widths of its Airy function, over some Fresnel zones, and clear of the axis. Order 1 has no bow: its
//! last ray stands in for that of a bow, by the width of its penumbra.

use super::rim::Rim;
use super::thresholds::{TaperRoom, Thresholds};
use std::f64::consts::PI;

/// The room of an order's taper: of order 1, of a sphere's low and high orders, of all others.
fn room(by: &Thresholds, order: u32, rim: Rim) -> TaperRoom {
    let [first, low, high, other] = by.tapers;
    match (order, rim) {
        (1, _) => first,
        (_, Rim::Sphere) => {
            if by.is_high(order) {
                high
            } else {
                low
            }
        }
        _ => other,
    }
}

/// Impact of the ray of a sphere's bow of this order, if there is one.
fn bow(index: f64, order: u32) -> Option<f64> {
    let p = f64::from(order);
    let square = 1.0 - (index * index - 1.0) / (p * p - 1.0);
    (square > 0.0 && square < 1.0).then(|| square.sqrt())
}

/// Impact of the ray that the integral is about: that of the bow, or of order 1 one within the last wave zone.
fn central_impact(index: f64, order: u32, size_parameter: f64) -> Option<f64> {
    if order == 1 { Some(1.0 - size_parameter.powf(-2.0 / 3.0)) } else { bow(index, order) }
}

/// Slope and third derivative of a sphere's deviation by impact.
pub(crate) fn deviation_slope(index: f64, order: u32, b: f64) -> (f64, f64) {
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
/// stray by `caustic_disorder`; rays in it keep farther than `axis_gap` from the axis. `None` where the
/// integral would reach too far inside, or too little is left for the taper.
pub fn taper(
    by: &Thresholds,
    index: f64,
    order: u32,
    size_parameter: f64,
    caustic_disorder: f64,
    axis_gap: f64,
    rim: Rim,
) -> Option<[f64; 3]> {
    let axial = rim != Rim::Uneven;
    let b = central_impact(index, order, size_parameter).filter(|b| *b > 0.0)?;
    let (_, bend) = deviation_slope(index, order, b);
    let airy = (0.5 * size_parameter * bend).cbrt().recip().min(0.5);
    let room = room(by, order, rim);
    let mut full = b - room.airy_widths * airy - caustic_disorder;
    if axial {
        full = below_axis(index, order, full, by.taper_axis_gaps * axis_gap);
    }
    if full < room.deepest {
        return None;
    }
    let zone = |b: f64| (size_parameter * deviation_slope(index, order, b).0.abs()).sqrt().recip();
    let [low, high] = by.taper_zones;
    let zones = if by.is_high(order) { high } else { low };
    let mut start = (full - zones * zone(full)).max(room.deepest_start * full);
    if !axial {
        start = start.max(clear_of_axis(index, order, b, by.taper_axis_gaps * axis_gap)?);
        full = full.max(start + room.fewest_zones * zone(full));
    }
    let wide = full - start > 0.99 * room.fewest_zones * zone(full) || !axial;
    let serves = wide && full < b - by.fewest_airy_widths * airy;
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

/// Angle over which the argument of a sphere's Airy function grows by 1.
pub(crate) fn airy_angle(index: f64, order: u32, x: f64) -> f64 {
    let (p, n) = (f64::from(order).powi(2), index * index);
    let h = (p - 1.0).powi(2) / p * ((p - n) / (n - 1.0).powi(3)).sqrt();
    h.cbrt() * x.powf(-2.0 / 3.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const INDEX: f64 = 1.333;

    /// At the bow the deviation stands still; slopes by differences.
    #[test]
    fn the_bow_is_where_the_deviation_stands_still() {
        const H: f64 = 1e-5;
        for order in [2, 3, 4, 9] {
            let b = bow(INDEX, order).unwrap();
            assert!(deviation_slope(INDEX, order, b).0.abs() < 1e-12, "{order}");
            for b in [0.5, 0.9] {
                let at = |b: f64| deviation(INDEX, order, b);
                let slope = (at(b + H) - at(b - H)) / (2.0 * H);
                let bend = (at(b + H) - 2.0 * at(b) + at(b - H)) / (H * H);
                let (s, t) = deviation_slope(INDEX, order, b);
                assert!((s - slope).abs() < 1e-8 * (1.0 + s.abs()), "{order} {b}");
                assert!((t - bend).abs() < 1e-3 * (1.0 + t.abs()), "{order} {b}");
            }
        }
        // the primary bow of water at 137.9°
        assert!((deviation(INDEX, 2, bow(INDEX, 2).unwrap()).to_degrees() - 137.9219).abs() < 1e-3);
        assert!(bow(INDEX, 1).is_none() && bow(3.0, 2).is_none());
    }

    /// Two rays near a bow part in path by `4/3 (δ/h)^{3/2}` for the angle `δ` from it, `h` that of
    /// one unit of the Airy function.
    #[test]
    fn the_airy_function_s_unit_is_that_of_the_rays() {
        let x: f64 = 1e4;
        for order in [2u32, 3] {
            let b = bow(INDEX, order).unwrap();
            let wanted = deviation(INDEX, order, b) + 1e-5;
            let find = |mut low: f64, mut high: f64| {
                let above = |b: f64| deviation(INDEX, order, b) > wanted;
                let side = above(low);
                for _ in 0..100 {
                    let middle = 0.5 * (low + high);
                    if above(middle) == side { low = middle } else { high = middle }
                }
                low
            };
            let path = |b: f64| {
                2.0 * (f64::from(order) * (INDEX * INDEX - b * b).sqrt() - (1.0 - b * b).sqrt())
            };
            let (inner, outer) = (find(0.2, b), find(b, 1.0));
            let phase = 0.75 * x * (path(inner) - path(outer)).abs();
            let unit = 1e-5 / phase.powf(2.0 / 3.0);
            let found = airy_angle(INDEX, order, x);
            assert!((found / unit - 1.0).abs() < 2e-3, "{order}: {found} {unit}");
        }
    }

    #[test]
    fn impacts_clear_of_the_axis_are_found() {
        let b = bow(INDEX, 4).unwrap();
        let gap = 0.3;
        let clear = clear_of_axis(INDEX, 4, b, gap).unwrap();
        for k in 0..=20 {
            let b = clear + (b - clear) * f64::from(k) / 20.0;
            assert!(from_axis(INDEX, 4, b) > gap - 1e-9, "{b}");
        }
        assert!(from_axis(INDEX, 4, clear - b / 100.0) < gap + 0.03);
        // deviations of order 4 pass 2π where its rays cross the axis
        let crossing = below_axis(INDEX, 4, 0.83, 0.05);
        assert!(from_axis(INDEX, 4, crossing) >= 0.05 && crossing <= 0.83);
    }
}
