//! Axes of the preview: their ranges, and the labels of their ticks.

use crate::math::digits::to_digits;
use crate::render::plots::heat_map::power_of_ten;
use plotters::coord::Shift;
use plotters::prelude::{BitMapBackend, DrawingArea};
use std::ops::Range;

/// A part of the picture.
pub(super) type Area<'a> = DrawingArea<BitMapBackend<'a>, Shift>;

/// Share of the directions that may lie below (and, in the heat map, above) the scale: the forward
/// peak and the zeros of interference would else leave no room for the bow.
pub(super) const OFF_SCALE: f64 = 0.004;

/// Labels that plotters puts on an axis unless told otherwise, at most.
pub(super) const TICKS: usize = 10;

/// Labels of an axis with so many ticks at most: as many decimals as tell the ticks apart.
pub(super) fn labels_over(range: &Range<f64>, ticks: usize) -> impl Fn(&f64) -> String {
    let step = (range.end - range.start) / ticks as f64;
    let decimals = (-step.log10()).ceil().clamp(0.0, 9.0) as usize;
    move |value| format!("{value:.decimals$}")
}

/// The label of a power of ten, or of what lies between two.
pub(super) fn decade_label(exponent: f64) -> String {
    match exponent.round() {
        whole if (exponent - whole).abs() < 1e-6 => power_of_ten(whole as i32),
        _ => match to_digits(10f64.powf(exponent), 2) {
            plain if (0.01..1000.0).contains(&plain) => plain.to_string(),
            other => format!("{other:e}"),
        },
    }
}

/// The range of an axis of angles (radians), in degrees.
pub(super) fn degrees(axis: &[f64]) -> Range<f64> {
    let (from, to) = (axis[0].to_degrees(), axis[axis.len() - 1].to_degrees());
    if to > from { from..to } else { from - 0.5..from + 0.5 }
}

/// A place in a range by its share.
pub(super) fn within(range: &Range<f64>, share: f64) -> f64 {
    range.start + share * (range.end - range.start)
}

/// Powers of ten that hold the positive values from a low quantile up to `top`, padded.
pub(super) fn log_range(values: impl Iterator<Item = f64>, top: f64) -> Range<f64> {
    let mut values: Vec<f64> = values.filter(|v| *v > 0.0 && v.is_finite()).collect();
    let Some(last) = values.len().checked_sub(1) else { return -1.0..1.0 };
    let mut at = |quantile: f64| {
        let rank = (quantile * last as f64).round() as usize;
        values.select_nth_unstable_by(rank, f64::total_cmp).1.log10()
    };
    let (low, high) = (at(OFF_SCALE), at(top));
    let pad = (0.03 * (high - low)).max(0.1);
    low - pad..high + pad
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_tell_ticks_apart() {
        assert_eq!(labels_over(&(0.0..0.5), 10)(&0.05), "0.05");
        assert_eq!(labels_over(&(0.0..180.0), 19)(&90.0), "90");
        assert_eq!(decade_label(0.3), "2");
        assert_eq!(degrees(&[1.0]), 1f64.to_degrees() - 0.5..1f64.to_degrees() + 0.5);
    }

    /// All but the lowest few values are on the scale.
    #[test]
    fn scale_holds_the_values() {
        let range = log_range((1..=1000).map(f64::from), 1.0);
        assert!(range.start > 0.0 && range.start < 1.0 && range.end > 3.0 && range.end < 3.2);
        assert_eq!(log_range([0.0, -1.0].into_iter(), 1.0), -1.0..1.0);
    }
}
