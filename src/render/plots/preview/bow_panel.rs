//! The preview's panel of colours: the bow as the sun's disc shows it.

use super::axes::{Area, TICKS, degrees, labels_over, within};
use crate::color::{Illuminant, Observer, SUN_ANGULAR_RADIUS, to_srgb};
use crate::phase_table::PhaseTable;
use crate::render::error::RenderError;
use crate::render::plots::font::FONT;
use crate::render::plots::heat_map::draw_pixels;
use crate::render::tristimulus::{Tristimulus, rotational_xyz};
use crate::sun_disc::DiscPoints;
use plotters::prelude::*;
use std::ops::Range;

/// Scattering angles of the panel of colours, degrees: both bows and the dark band between them.
const BOW: Range<f64> = 118.0..152.0;
/// What the panel of colours shows.
pub(super) enum BowPanel {
    /// Why there is none.
    Missing(String),
    /// Colour by (θ, φ) in degrees, and the axes' ranges.
    Colors { theta: Range<f64>, phi: Option<Range<f64>>, color: Box<dyn Fn(f64, f64) -> [f64; 3]> },
}

/// Colours of the bow under D65 with the sun's disc, as XYZ.
pub(super) fn bow_colors(table: &PhaseTable) -> BowPanel {
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
            let disc = DiscPoints::new(SUN_ANGULAR_RADIUS, 4, 8);
            let phi = Some(degrees(&axes.phi));
            let color =
                move |t: f64, p: f64| colors.over_disc(&disc, t.to_radians(), p.to_radians());
            BowPanel::Colors { theta, phi, color: Box::new(color) }
        }
    }
}

/// The panel of colours; the brightest point of the primary bow gets luminance 0.85.
pub(super) fn draw_bow(area: &Area<'_>, panel: BowPanel) -> Result<(), RenderError> {
    let (theta, phi, color) = match panel {
        BowPanel::Missing(reason) => {
            let style = (FONT, 15).into_font().color(&RGBColor(90, 90, 90));
            for (i, line) in lines(&format!("no colours: {reason}")).into_iter().enumerate() {
                area.draw(&Text::new(line, (40, 40 + LINE * i as i32), style.clone()))?;
            }
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

/// Pixels from line to line of a note, and letters that fit into the panel's width.
const LINE: i32 = 22;
const LETTERS: usize = 62;

/// A note in lines that fit.
fn lines(note: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in note.split(' ') {
        let last = lines.len() - 1;
        if !lines[last].is_empty() && lines[last].len() + 1 + word.len() > LETTERS {
            lines.push(word.to_string());
        } else {
            let gap = if lines[last].is_empty() { "" } else { " " };
            lines[last] = format!("{}{gap}{word}", lines[last]);
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notes_are_broken_between_words() {
        let note = "no colours: wavelengths from 550 to 560 nm do not cover the visible: a colour needs 420 nm";
        let broken = lines(note);
        assert!(broken.len() == 2 && broken.iter().all(|line| line.len() <= LETTERS), "{broken:?}");
        assert_eq!(broken.join(" "), note);
    }
}
