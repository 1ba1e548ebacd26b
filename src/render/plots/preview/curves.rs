//! Curves of the preview: the phase function over the scattering angle, and the error it states.

use super::axes::{Area, TICKS, decade_label, degrees, labels_over, log_range};
use super::error_strip;
use crate::color::wavelength_srgb;
use crate::phase_table::{PhaseTable, Slab};
use crate::render::directions::DirectionGrid;
use crate::render::error::RenderError;
use crate::render::plots::font::FONT;
use plotters::prelude::*;

/// P(θ) at one wavelength, along one azimuth.
struct Curve {
    wavelength: f64,
    phi: f64,
    /// Which half of the plane, where there are two.
    half: &'static str,
    /// Degrees and powers of ten, in pieces between angles without light.
    pieces: Vec<Vec<(f64, f64)>>,
}

/// P(θ) at three wavelengths, upwards and (where it differs) downwards.
fn curves(table: &PhaseTable) -> Vec<Curve> {
    let axes = &table.header.axes;
    let grid = DirectionGrid::new(axes);
    let count = table.slabs.len();
    let mut chosen: Vec<usize> = vec![count / 8, count / 2, count - 1 - count / 8];
    chosen.sort_by(|&i, &j| table.slabs[i].wavelength.total_cmp(&table.slabs[j].wavelength));
    chosen.dedup();
    let halves: &[(f64, &'static str)] = if grid.phi.len() == 1 {
        &[(0.0, "")]
    } else {
        &[(0.0, ", up (φ = 0°)"), (std::f64::consts::PI, ", down (φ = 180°)")]
    };
    let halves: Vec<_> =
        halves.iter().filter(|(phi, _)| grid.corners(axes.theta[0], *phi).is_some()).collect();
    let pieces = |slab: &Slab, phi: f64| -> Vec<Vec<(f64, f64)>> {
        let point = |&theta: &f64| {
            let corners = grid.corners(theta, phi)?;
            let value: f64 =
                corners.iter().map(|&(i, w)| w * f64::from(sample(slab, i, axes.phi.len()))).sum();
            Some((theta.to_degrees(), value.log10()))
        };
        let points: Vec<(f64, f64)> = axes.theta.iter().filter_map(point).collect();
        let lit = points.split(|p| !p.1.is_finite()).filter(|piece| !piece.is_empty());
        lit.map(<[_]>::to_vec).collect()
    };
    let curve = |slab: &Slab, &(phi, half): &(f64, &'static str)| Curve {
        wavelength: slab.wavelength,
        phi,
        half,
        pieces: pieces(slab, phi),
    };
    let slabs = chosen.iter().map(|&i| &table.slabs[i]);
    slabs
        .flat_map(|slab| halves.iter().map(move |half| (slab, half)))
        .map(|(slab, half)| curve(slab, half))
        .collect()
}

/// The curves in the colours of their wavelengths.
pub(super) fn draw_curves(area: &Area<'_>, table: &PhaseTable) -> Result<(), RenderError> {
    let axes = &table.header.axes;
    let curves = curves(table);
    let errors = error_strip::steps(table);
    let height = area.dim_in_pixel().1;
    let (area, strip) =
        area.split_vertically(if errors.is_empty() { height } else { height * 3 / 4 });
    if !errors.is_empty() {
        error_strip::draw(&strip, errors, degrees(&axes.theta))?;
    }
    let lit = curves.iter().flat_map(|c| c.pieces.iter().flatten());
    let y = log_range(lit.map(|p| 10f64.powf(p.1)), 1.0);
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
    for Curve { wavelength, phi, half, pieces } in curves {
        let [r, g, b] = wavelength_srgb(wavelength);
        let color = RGBColor(r, g, b).mix(if phi == 0.0 { 0.8 } else { 0.35 });
        let lines =
            pieces.into_iter().map(|points| PathElement::new(points, color.stroke_width(1)));
        chart
            .draw_series(lines)?
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

/// Element 11 at a θ-major index.
fn sample(slab: &Slab, index: usize, azimuths: usize) -> f32 {
    slab.values[[0, index / azimuths, index % azimuths]]
}
