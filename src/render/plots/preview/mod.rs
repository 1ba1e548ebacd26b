//! Preview of a table: the phase function over the sphere of directions, curves through it, and
//! the colours of its bow.

mod axes;
mod bow_panel;
mod curves;
mod error_strip;

use crate::math::digits::to_digits;
use crate::phase_table::PhaseTable;
use crate::render::directions::DirectionGrid;
use crate::render::error::RenderError;
use crate::render::picture::Picture;
use crate::render::plots::font::{FONT, ensure_font};
use crate::render::plots::heat_map::{colour_bar, draw_pixels};
use axes::{Area, OFF_SCALE, degrees, labels_over, log_range, within};
use bow_panel::{bow_colors, draw_bow};
use curves::draw_curves;
use plotters::prelude::*;
use std::path::Path;

const WIDTH: u32 = 1280;
const HEIGHT: u32 = 960;

/// Draw the preview and write it as PNG; the file appears only when it is complete.
///
/// # Errors
/// [`RenderError`] when drawing or writing fails. A table without the colours (too few
/// wavelengths) or without the bow is drawn without that panel.
pub fn write_png(table: &PhaseTable, path: &Path) -> Result<(), RenderError> {
    picture(table)?.write_png(path)
}

/// The preview as a picture.
///
/// # Errors
/// [`RenderError::Drawing`].
pub fn picture(table: &PhaseTable) -> Result<Picture, RenderError> {
    ensure_font()?;
    let mut picture = Picture::new(WIDTH as usize, HEIGHT as usize);
    {
        let root =
            BitMapBackend::with_buffer(&mut picture.rgb, (WIDTH, HEIGHT)).into_drawing_area();
        root.fill(&WHITE)?;
        let (head, body) = root.split_vertically(64);
        draw_title(&head, table)?;
        let bow = bow_colors(table);
        if table.header.axes.phi.len() > 1 {
            let (upper, lower) = body.split_vertically((HEIGHT - 64) * 54 / 100);
            draw_sphere(&upper, table)?;
            let (left, right) = lower.split_horizontally(WIDTH / 2);
            draw_curves(&left, table)?;
            draw_bow(&right, bow)?;
        } else {
            let (upper, lower) = body.split_vertically((HEIGHT - 64) * 66 / 100);
            draw_curves(&upper, table)?;
            draw_bow(&lower, bow)?;
        }
        root.present()?;
    }
    Ok(picture)
}

/// Who, how large, how lit, how computed.
fn draw_title(area: &Area<'_>, table: &PhaseTable) -> Result<(), RenderError> {
    let header = &table.header;
    let sun = if header.rotational_symmetry {
        String::new()
    } else {
        format!(", sun at {}°", to_digits(header.sun_elevation.to_degrees(), 6))
    };
    let many = header.bodies.as_ref().filter(|bodies| bodies.effective_variance > 0.0);
    let mm = |radius: f64| to_digits(radius * 1e3, 6);
    let title = match many {
        Some(sizes) => format!(
            "Phase function: {}, many sizes of effective radius {} mm{sun}",
            header.shape,
            mm(sizes.effective_radius)
        ),
        None => {
            format!("Phase function of a {} of radius {} mm{sun}", header.shape, mm(header.radius))
        }
    };
    area.draw(&Text::new(title, (20, 10), (FONT, 24).into_font().color(&BLACK)))?;
    let axis = &header.axes;
    let nm = |w: Option<&f64>| w.map_or(f64::NAN, |w| w * 1e9);
    let wavelengths = match axis.wavelength.as_slice() {
        [one] => format!("{:.1} nm", one * 1e9),
        many => format!(
            "{} wavelengths from {:.0} to {:.0} nm",
            many.len(),
            nm(many.first()),
            nm(many.last())
        ),
    };
    let line = format!(
        "method {}, {wavelengths}, {} scattering angles × {} azimuth{}",
        header.method,
        axis.theta.len(),
        axis.phi.len(),
        if axis.phi.len() == 1 { "" } else { "s" }
    );
    area.draw(&Text::new(line, (20, 40), (FONT, 15).into_font().color(&RGBColor(90, 90, 90))))?;
    Ok(())
}

/// The phase function over θ × φ: the mean over the wavelengths, on a log scale.
fn draw_sphere(area: &Area<'_>, table: &PhaseTable) -> Result<(), RenderError> {
    let axes = &table.header.axes;
    let grid = DirectionGrid::new(axes);
    let mean = mean_over_wavelengths(table);
    let range = log_range(mean.iter().copied(), 1.0 - OFF_SCALE);
    let inferno = |fraction: f64| {
        let c = colorous::INFERNO.eval_continuous(fraction.clamp(0.0, 1.0));
        [c.r, c.g, c.b]
    };
    let (chart_area, bar_area) = area.split_horizontally(WIDTH - 110);
    let (x, y) = (degrees(&axes.theta), degrees(&axes.phi));
    let mut chart = ChartBuilder::on(&chart_area)
        .caption("all directions, mean over the wavelengths", (FONT, 16))
        .margin(12)
        .x_label_area_size(42)
        .y_label_area_size(64)
        .build_cartesian_2d(x.clone(), y.clone())?;
    draw_pixels(&chart, (x.start, y.end), |along, up| {
        let (theta, phi) = (within(&x, along), within(&y, up));
        let Some(corners) = grid.corners(theta.to_radians(), phi.to_radians()) else {
            return [255; 3];
        };
        let value: f64 = corners.iter().map(|&(i, w)| w * mean[i]).sum();
        inferno((value.log10() - range.start) / (range.end - range.start))
    })?;
    chart
        .configure_mesh()
        .disable_mesh()
        .x_desc("scattering angle θ (°), 0 = forward")
        .y_desc("azimuth φ (°), 0 = up")
        .x_labels(19)
        .y_labels(9)
        .x_label_formatter(&labels_over(&x, 19))
        .y_label_formatter(&labels_over(&y, 9))
        .label_style((FONT, 15))
        .axis_desc_style((FONT, 16))
        .draw()?;
    colour_bar(&bar_area, "P (sr⁻¹)", range, inferno)
}

/// θ-major mean over the slabs of element 11.
fn mean_over_wavelengths(table: &PhaseTable) -> Vec<f64> {
    let axes = &table.header.axes;
    let mut mean = vec![0.0; axes.theta.len() * axes.phi.len()];
    for slab in &table.slabs {
        for (sum, &value) in mean.iter_mut().zip(slab.values.index_axis(ndarray::Axis(0), 0)) {
            *sum += f64::from(value) / table.slabs.len() as f64;
        }
    }
    mean
}
