//! The stated error by scattering angle, as a strip below the curves of a preview.

use crate::phase_table::{ERROR_BANDS, PhaseTable, error_theta};
use crate::render::error::RenderError;
use crate::render::plots::font::FONT;
use crate::render::plots::heat_map::power_of_ten;
use plotters::coord::Shift;
use plotters::prelude::*;
use std::ops::Range;

/// Smallest error drawn, as a power of ten; exact series lie on the floor.
const FLOOR: f64 = -4.0;

/// Largest stated error over the wavelengths in each band, as powers of ten at the band's edges
/// (degrees); nothing where a table states none.
pub(in crate::render) fn steps(table: &PhaseTable) -> Vec<(f64, f64)> {
    let half = 0.5 * error_theta(1).to_degrees();
    let largest = |band: usize| {
        let errors = table.slabs.iter().map(|slab| slab.error_by_direction[band]);
        errors.filter(|e| e.is_finite()).reduce(f64::max)
    };
    let step = |band: usize| {
        let (middle, power) = (error_theta(band).to_degrees(), largest(band)?.log10().max(FLOOR));
        Some([((middle - half).max(0.0), power), ((middle + half).min(180.0), power)])
    };
    (0..ERROR_BANDS).filter_map(step).flatten().collect()
}

/// Draw it over a range of scattering angles, degrees.
pub(in crate::render) fn draw(
    area: &DrawingArea<BitMapBackend<'_>, Shift>,
    steps: Vec<(f64, f64)>,
    theta: Range<f64>,
) -> Result<(), RenderError> {
    let mut chart = ChartBuilder::on(area)
        .margin(12)
        .margin_top(0)
        .x_label_area_size(0)
        .y_label_area_size(64)
        .build_cartesian_2d(theta.clone(), FLOOR..0.2)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(RGBColor(225, 225, 225))
        .disable_x_axis()
        .y_desc("stated error")
        .y_labels(5)
        .y_label_formatter(&|v| power_of_ten(v.round() as i32))
        .label_style((FONT, 13))
        .axis_desc_style((FONT, 14))
        .draw()?;
    let color = RGBColor(200, 60, 40);
    let inside = steps.into_iter().filter(|(t, _)| theta.contains(t) || *t == theta.end);
    chart.draw_series(AreaSeries::new(inside, FLOOR, color.mix(0.35)).border_style(color))?;
    Ok(())
}
