//! Heat maps: a block of pixels inside a chart, and the colour bar that explains it.

use crate::render::error::RenderError;
use crate::render::plots::font::FONT;
use plotters::coord::Shift;
use plotters::coord::ranged1d::Ranged;
use plotters::element::BitMapElement;
use plotters::prelude::*;
use std::ops::Range;

/// Fill a chart's plotting area with pixels; `top_left` is its corner in the chart's coordinates,
/// `color` gets the place as shares of the width (from the left) and the height (from below).
///
/// # Errors
/// [`RenderError::Drawing`] from the backend.
pub fn draw_pixels<'a, X, Y>(
    chart: &ChartContext<'a, BitMapBackend<'a>, Cartesian2d<X, Y>>,
    top_left: (f64, f64),
    mut color: impl FnMut(f64, f64) -> [u8; 3],
) -> Result<(), RenderError>
where
    X: Ranged<ValueType = f64>,
    Y: Ranged<ValueType = f64>,
{
    let (columns, rows) = chart.plotting_area().get_pixel_range();
    let (width, height) = ((columns.end - columns.start) as u32, (rows.end - rows.start) as u32);
    let mut pixels = Vec::with_capacity((3 * width * height) as usize);
    for row in 0..height {
        let up = 1.0 - (f64::from(row) + 0.5) / f64::from(height);
        for column in 0..width {
            pixels.extend(color((f64::from(column) + 0.5) / f64::from(width), up));
        }
    }
    let Some(element) = BitMapElement::with_owned_buffer(top_left, (width, height), pixels) else {
        return Err(RenderError::Drawing("heat map of the wrong size".into()));
    };
    chart.plotting_area().draw(&element)?;
    Ok(())
}

/// A vertical colour bar with one tick per decade; `decades` in powers of ten.
///
/// # Errors
/// [`RenderError::Drawing`] from the backend.
pub fn colour_bar(
    area: &DrawingArea<BitMapBackend<'_>, Shift>,
    title: &str,
    decades: Range<f64>,
    color: impl Fn(f64) -> [u8; 3],
) -> Result<(), RenderError> {
    let (width, height) = area.dim_in_pixel();
    let (width, height) = (width as i32, height as i32);
    let (top, bottom, bar) = (40, height - 40, 22);
    for y in top..bottom {
        let fraction = f64::from(bottom - y) / f64::from(bottom - top);
        let [r, g, b] = color(fraction);
        let line = PathElement::new(vec![(0, y), (bar, y)], RGBColor(r, g, b));
        area.draw(&line)?;
    }
    area.draw(&Rectangle::new([(0, top), (bar, bottom)], BLACK))?;
    let style = (FONT, 15).into_font().color(&BLACK);
    area.draw(&Text::new(title.to_owned(), (0, 14), style.clone()))?;
    for power in (decades.start.ceil() as i32)..=(decades.end.floor() as i32) {
        let fraction = (f64::from(power) - decades.start) / (decades.end - decades.start);
        let y = bottom - (fraction * f64::from(bottom - top)) as i32;
        area.draw(&PathElement::new(vec![(bar, y), (bar + 5, y)], BLACK))?;
        let label = power_of_ten(power);
        if bar + 9 < width {
            area.draw(&Text::new(label, (bar + 9, y - 8), style.clone()))?;
        }
    }
    Ok(())
}

/// `10⁻³` and the like.
pub(in crate::render) fn power_of_ten(power: i32) -> String {
    let digits = power.to_string();
    let superscript = digits.chars().map(|c| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => digit.to_digit(10).and_then(|d| char::from_u32(0x2070 + d)).unwrap_or(digit),
    });
    format!("10{}", superscript.collect::<String>())
}
