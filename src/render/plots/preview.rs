//! Preview of a table: the phase function over the sphere of directions, curves through it, and
//! the colours of its bow.

use crate::color::{Illuminant, Observer, SUN_ANGULAR_RADIUS, SunDisc, to_srgb, wavelength_srgb};
use crate::math::digits::to_digits;
use crate::phase_table::{PhaseTable, Slab};
use crate::render::RenderError;
use crate::render::directions::DirectionGrid;
use crate::render::picture::Picture;
use crate::render::plots::error_strip;
use crate::render::plots::font::{FONT, ensure_font};
use crate::render::plots::heat_map::power_of_ten;
use crate::render::plots::heat_map::{colour_bar, draw_pixels};
use crate::render::tristimulus::{Tristimulus, rotational_xyz};
use plotters::coord::Shift;
use plotters::prelude::*;
use std::ops::Range;
use std::path::Path;

const WIDTH: u32 = 1280;
const HEIGHT: u32 = 960;
/// Scattering angles of the panel of colours, degrees: both bows and the dark band between them.
const BOW: Range<f64> = 118.0..152.0;
/// Share of the directions that may lie below (and, in the heat map, above) the scale: the forward
/// peak and the zeros of interference would else leave no room for the bow.
const OFF_SCALE: f64 = 0.004;

type Area<'a> = DrawingArea<BitMapBackend<'a>, Shift>;

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
    let radius = to_digits(header.radius * 1e3, 6);
    let title = format!("Phase function of a {} of radius {radius} mm{sun}", header.shape);
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

/// P(θ) at one wavelength, along one azimuth.
struct Curve {
    wavelength: f64,
    phi: f64,
    /// Which half of the plane, where there are two.
    half: &'static str,
    /// Degrees and powers of ten.
    points: Vec<(f64, f64)>,
}

/// P(θ) at three wavelengths, upwards and (where it differs) downwards.
fn curves(table: &PhaseTable) -> Vec<Curve> {
    let axes = &table.header.axes;
    let grid = DirectionGrid::new(axes);
    let count = table.slabs.len();
    let mut chosen: Vec<usize> = vec![count / 8, count / 2, count - 1 - count / 8];
    chosen.sort_by(|&i, &j| table.slabs[i].wavelength.total_cmp(&table.slabs[j].wavelength));
    chosen.dedup();
    let halves: &[(f64, &'static str)] = if grid.is_rotational() {
        &[(0.0, "")]
    } else {
        &[(0.0, ", up (φ = 0°)"), (std::f64::consts::PI, ", down (φ = 180°)")]
    };
    let halves: Vec<_> =
        halves.iter().filter(|(phi, _)| grid.corners(axes.theta[0], *phi).is_some()).collect();
    let points = |slab: &Slab, phi: f64| -> Vec<(f64, f64)> {
        let point = |&theta: &f64| {
            let corners = grid.corners(theta, phi)?;
            let value: f64 =
                corners.iter().map(|&(i, w)| w * f64::from(sample(slab, i, axes.phi.len()))).sum();
            Some((theta.to_degrees(), value.log10()))
        };
        axes.theta.iter().filter_map(point).filter(|p| p.1.is_finite()).collect()
    };
    let curve = |slab: &Slab, &(phi, half): &(f64, &'static str)| Curve {
        wavelength: slab.wavelength,
        phi,
        half,
        points: points(slab, phi),
    };
    let slabs = chosen.iter().map(|&i| &table.slabs[i]);
    slabs
        .flat_map(|slab| halves.iter().map(move |half| (slab, half)))
        .map(|(slab, half)| curve(slab, half))
        .collect()
}

/// The curves in the colours of their wavelengths.
fn draw_curves(area: &Area<'_>, table: &PhaseTable) -> Result<(), RenderError> {
    let axes = &table.header.axes;
    let curves = curves(table);
    let errors = error_strip::steps(table);
    let height = area.dim_in_pixel().1;
    let (area, strip) =
        area.split_vertically(if errors.is_empty() { height } else { height * 3 / 4 });
    if !errors.is_empty() {
        error_strip::draw(&strip, errors, degrees(&axes.theta))?;
    }
    let y = log_range(curves.iter().flat_map(|c| c.points.iter().map(|p| 10f64.powf(p.1))), 1.0);
    let mut chart = ChartBuilder::on(&area)
        .caption("phase function by scattering angle, and the stated error", (FONT, 16))
        .margin(12)
        .x_label_area_size(42)
        .y_label_area_size(64)
        .build_cartesian_2d(degrees(&axes.theta), y.clone())?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(RGBColor(225, 225, 225))
        .x_desc("scattering angle θ (°)")
        .y_desc("P (sr⁻¹)")
        .x_label_formatter(&labels_over(&degrees(&axes.theta), TICKS))
        .y_labels((y.end - y.start) as usize + 2)
        .y_label_formatter(&|v| decade_label(*v))
        .label_style((FONT, 15))
        .axis_desc_style((FONT, 16))
        .draw()?;
    for Curve { wavelength, phi, half, points } in curves {
        let [r, g, b] = wavelength_srgb(wavelength);
        let color = RGBColor(r, g, b).mix(if phi == 0.0 { 0.8 } else { 0.35 });
        chart
            .draw_series(LineSeries::new(points, color.stroke_width(1)))?
            .label(format!("{:.0} nm{half}", wavelength * 1e9))
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], color.stroke_width(3)));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .background_style(WHITE.mix(0.85))
        .border_style(RGBColor(200, 200, 200))
        .label_font((FONT, 14))
        .draw()?;
    Ok(())
}

/// What the panel of colours shows.
enum BowPanel {
    /// Why there is none.
    Missing(String),
    /// Colour by (θ, φ) in degrees, and the axes' ranges.
    Colors { theta: Range<f64>, phi: Option<Range<f64>>, color: Box<dyn Fn(f64, f64) -> [f64; 3]> },
}

/// Colours of the bow under D65 with the sun's disc, as XYZ.
fn bow_colors(table: &PhaseTable) -> BowPanel {
    let axes = &table.header.axes;
    let all = degrees(&axes.theta);
    let theta = all.start.max(BOW.start)..all.end.min(BOW.end);
    if theta.end - theta.start < 1.0 {
        return BowPanel::Missing("the table does not reach the rainbow (118° to 152°)".into());
    }
    if axes.phi.len() == 1 {
        let out: Vec<f64> = (0..=600)
            .map(|i| (theta.start + (theta.end - theta.start) * f64::from(i) / 600.0).to_radians())
            .collect();
        let (light, eye) = (Illuminant::D65, Observer::Cie1931);
        return match rotational_xyz(table, 0, light, eye, SUN_ANGULAR_RADIUS, &out) {
            Err(error) => BowPanel::Missing(error.to_string()),
            Ok(xyz) => {
                let range = theta.clone();
                let color = move |degrees: f64, _| {
                    let place = (degrees - range.start) / (range.end - range.start);
                    xyz[((600.0 * place).round().max(0.0) as usize).min(600)]
                };
                BowPanel::Colors { theta, phi: None, color: Box::new(color) }
            }
        };
    }
    match Tristimulus::of_table(table, 0, Illuminant::D65, Observer::Cie1931, None) {
        Err(error) => BowPanel::Missing(error.to_string()),
        Ok(colors) => {
            let disc = SunDisc::new(SUN_ANGULAR_RADIUS, 4, 8);
            let phi = Some(degrees(&axes.phi));
            let color =
                move |t: f64, p: f64| colors.over_disc(&disc, t.to_radians(), p.to_radians());
            BowPanel::Colors { theta, phi, color: Box::new(color) }
        }
    }
}

/// The panel of colours; the brightest point of the primary bow gets luminance 0.85.
fn draw_bow(area: &Area<'_>, panel: BowPanel) -> Result<(), RenderError> {
    let (theta, phi, color) = match panel {
        BowPanel::Missing(reason) => {
            let style = (FONT, 15).into_font().color(&RGBColor(90, 90, 90));
            area.draw(&Text::new(format!("no colours: {reason}"), (40, 40), style))?;
            return Ok(());
        }
        BowPanel::Colors { theta, phi, color } => (theta, phi, color),
    };
    let y = phi.clone().unwrap_or(0.0..1.0);
    let mut builder = ChartBuilder::on(area);
    builder
        .caption("colours of the bow (D65, sun's disc averaged)", (FONT, 16))
        .margin(12)
        .x_label_area_size(42)
        .y_label_area_size(64);
    let mut chart = builder.build_cartesian_2d(theta.clone(), y.clone())?;

    let mut brightest = f64::MIN_POSITIVE;
    for i in 0..200 {
        for j in 0..8 {
            let t = theta.start + (theta.end - theta.start) * f64::from(i) / 199.0;
            let p = y.start + (y.end - y.start) * f64::from(j) / 8.0;
            brightest = brightest.max(color(t, p)[1]);
        }
    }
    let exposure = 0.85 / brightest;
    draw_pixels(&chart, (theta.start, y.end), |along, up| {
        to_srgb(color(within(&theta, along), within(&y, up)), exposure)
    })?;
    let (bow_label, azimuth_label) = (labels_over(&theta, TICKS), labels_over(&y, TICKS));
    let mut mesh = chart.configure_mesh();
    mesh.disable_mesh()
        .x_desc("scattering angle θ (°)")
        .x_label_formatter(&bow_label)
        .label_style((FONT, 15))
        .axis_desc_style((FONT, 16));
    if phi.is_some() {
        mesh.y_desc("azimuth φ (°), 0 = up").y_label_formatter(&azimuth_label);
    } else {
        mesh.disable_y_axis();
    }
    mesh.draw()?;
    Ok(())
}

/// Element 11 at a θ-major index.
fn sample(slab: &Slab, index: usize, azimuths: usize) -> f32 {
    slab.values[[0, index / azimuths, index % azimuths]]
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

/// Labels that plotters puts on an axis unless told otherwise, at most.
const TICKS: usize = 10;

/// Labels of an axis with so many ticks at most: as many decimals as tell the ticks apart.
fn labels_over(range: &Range<f64>, ticks: usize) -> impl Fn(&f64) -> String {
    let step = (range.end - range.start) / ticks as f64;
    let decimals = (-step.log10()).ceil().clamp(0.0, 9.0) as usize;
    move |value| format!("{value:.decimals$}")
}

/// The label of a power of ten, or of what lies between two.
fn decade_label(exponent: f64) -> String {
    match exponent.round() {
        whole if (exponent - whole).abs() < 1e-6 => power_of_ten(whole as i32),
        _ => match to_digits(10f64.powf(exponent), 2) {
            plain if (0.01..1000.0).contains(&plain) => plain.to_string(),
            other => format!("{other:e}"),
        },
    }
}

fn degrees(axis: &[f64]) -> Range<f64> {
    let (from, to) = (axis[0].to_degrees(), axis[axis.len() - 1].to_degrees());
    if to > from { from..to } else { from - 0.5..from + 0.5 }
}

/// A place in a range by its share.
fn within(range: &Range<f64>, share: f64) -> f64 {
    range.start + share * (range.end - range.start)
}

/// Powers of ten that hold the positive values from a low quantile up to `top`, padded.
fn log_range(values: impl Iterator<Item = f64>, top: f64) -> Range<f64> {
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
