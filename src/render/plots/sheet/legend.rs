//! The legend of a chart: names of curves in rows below it.

use super::line::Curve;
use super::pen::{Drawn, INK, Pen, width_of};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

/// Height of a row; of the letters; of the sample of a line; gap between names.
const ROW: i32 = 19;
const LETTERS: u32 = 13;
const SAMPLE: i32 = 24;
const GAP: i32 = 18;

/// Names with their places in rows of a width: row, and pixels from the left.
fn places(curves: &[Curve], width: i32) -> Vec<(usize, i32, &Curve)> {
    let (mut row, mut left) = (0, 0);
    let named = curves.iter().filter(|curve| !curve.name.is_empty());
    named
        .map(|curve| {
            let wide = SAMPLE + 6 + width_of(&curve.name, LETTERS) + GAP;
            if left > 0 && left + wide > width {
                (row, left) = (row + 1, 0);
            }
            let place = (row, left, curve);
            left += wide;
            place
        })
        .collect()
}

/// Height of the legend in pixels.
pub(super) fn height(curves: &[Curve], width: i32) -> i32 {
    places(curves, width).last().map_or(0, |(row, ..)| (*row as i32 + 1) * ROW)
}

/// Draw it from a corner on.
pub(super) fn draw<B: DrawingBackend>(
    pen: &Pen<'_, B>,
    curves: &[Curve],
    (left, top): (i32, i32),
    width: i32,
) -> Drawn<B> {
    for (row, along, curve) in places(curves, width) {
        let (x, y) = (left + along, top + row as i32 * ROW + ROW / 2);
        let [r, g, b] = curve.filled.unwrap_or(curve.colour);
        let colour = RGBColor(r, g, b);
        if curve.dots {
            pen.dot((x + SAMPLE / 2, y), colour)?;
        } else if curve.dashed {
            for start in [0, 9, 18] {
                pen.line(vec![(x + start, y), (x + start + 5, y)], colour, curve.width)?;
            }
        } else {
            pen.line(vec![(x, y), (x + SAMPLE, y)], colour, curve.width.max(2))?;
        }
        let anchor = (HPos::Left, VPos::Center);
        pen.anchored(&curve.name, (x + SAMPLE + 6, y), LETTERS, INK, anchor)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Long names go into the next row, and none without a name is there.
    #[test]
    fn rows_hold_what_fits() {
        let curves = ["a", "", "one long name of a curve", "another long name of one"]
            .map(|name| Curve::new(name, [0; 3], []));
        let rows: Vec<usize> = places(&curves, 300).iter().map(|place| place.0).collect();
        assert_eq!(rows, [0, 0, 1]);
        assert_eq!((height(&curves, 300), height(&[], 300)), (2 * ROW, 0));
    }
}
