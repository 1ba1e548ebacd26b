//! A diagram of colours: radius (log or linear) across, scattering angle upwards, and the bows of
//! ray optics as lines to compare with.

use crate::color::to_srgb;
use crate::render::error::RenderError;
use crate::render::picture::Picture;
use crate::render::plots::font::{FONT, ensure_font};
use crate::render::plots::heat_map::draw_pixels;
use crate::render::plots::ticks;
use plotters::coord::Shift;
use plotters::coord::ranged1d::{AsRangedCoord, Ranged, ValueFormatter};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::ops::Range;

/// What is drawn and written around it.
pub struct ColorDiagram<'a> {
    /// Above the picture.
    pub title: &'a str,
    /// Second line: how the colours were made.
    pub subtitle: &'a str,
    /// Millimetres, ascending.
    pub radii: &'a [f64],
    /// Whether the axis of radii is logarithmic.
    pub logarithmic: bool,
    /// Degrees, ascending.
    pub theta: &'a [f64],
    /// XYZ per radius and angle.
    pub xyz: &'a [Vec<[f64; 3]>],
    /// Exposure per radius.
    pub exposure: &'a [f64],
    /// Angles (degrees) with a name, drawn as ticks on the right.
    pub marks: &'a [(f64, String)],
}

const WIDTH: u32 = 1100;
const HEIGHT: u32 = 760;
/// Height of the title and its second line.
const HEAD: i32 = 62;
/// Room on the right for the marks' names.
const MARGIN: u32 = 150;

impl ColorDiagram<'_> {
    /// Draw.
    ///
    /// # Errors
    /// [`RenderError::Drawing`].
    pub fn picture(&self) -> Result<Picture, RenderError> {
        ensure_font()?;
        let mut picture = Picture::new(WIDTH as usize, HEIGHT as usize);
        {
            let root =
                BitMapBackend::with_buffer(&mut picture.rgb, (WIDTH, HEIGHT)).into_drawing_area();
            root.fill(&WHITE)?;
            let (head, body) = root.split_vertically(HEAD);
            head.draw(&Text::new(self.title, (20, 12), (FONT, 22).into_font().color(&BLACK)))?;
            let grey = (FONT, 14).into_font().color(&RGBColor(90, 90, 90));
            head.draw(&Text::new(self.subtitle, (20, 40), grey))?;
            let last = self.radii.len() - 1;
            let (low, mut high) = (self.radii[0], self.radii[last]);
            if high <= low {
                high = low * 1.01;
            }
            if self.logarithmic {
                self.draw(&body, (low..high).log_scale())?;
            } else {
                self.draw(&body, plotters::coord::types::RangedCoordf64::from(low..high))?;
            }
            root.present()?;
        }
        Ok(picture)
    }

    fn draw<X>(
        &self,
        area: &DrawingArea<BitMapBackend<'_>, Shift>,
        x: impl AsRangedCoord<CoordDescType = X, Value = f64>,
    ) -> Result<(), RenderError>
    where
        X: Ranged<ValueType = f64> + ValueFormatter<f64>,
    {
        let angles = self.theta[0]..self.theta[self.theta.len() - 1].max(self.theta[0] + 0.01);
        let mut chart = ChartBuilder::on(area)
            .margin(10)
            .margin_right(MARGIN)
            .x_label_area_size(48)
            .y_label_area_size(64)
            .build_cartesian_2d(x, angles.clone())?;
        let (columns, rows) = (self.radii.len(), self.theta.len());
        draw_pixels(&chart, (self.radii[0], angles.end), |along, up| {
            let column = ((along * columns as f64) as usize).min(columns - 1);
            let angle = angles.start + up * (angles.end - angles.start);
            let above = self.theta.partition_point(|&t| t < angle).clamp(1, (rows - 1).max(1));
            let (low, high) = (above - 1, above.min(rows - 1));
            let span = (self.theta[high] - self.theta[low]).max(1e-12);
            let share = ((angle - self.theta[low]) / span).clamp(0.0, 1.0);
            let (a, b) = (self.xyz[column][low], self.xyz[column][high]);
            let mixed = std::array::from_fn(|c| a[c] + share * (b[c] - a[c]));
            to_srgb(mixed, self.exposure[column])
        })?;
        let end = self.radii[columns - 1].max(1.01 * self.radii[0]);
        let plot = chart.plotting_area().get_pixel_range();
        chart
            .configure_mesh()
            .disable_mesh()
            .x_label_formatter(&|_| String::new())
            .set_tick_mark_size(LabelAreaPosition::Bottom, 0)
            .x_desc("drop radius (mm)")
            .y_desc("scattering angle θ (°)")
            .y_label_formatter(&|v| trimmed(*v))
            .label_style((FONT, 15))
            .axis_desc_style((FONT, 17))
            .draw()?;
        self.label_radii(area, &plot, self.radii[0], end)?;
        let (columns, rows) = plot;
        let style = (FONT, 13).into_font().color(&BLACK);
        for (angle, name) in self.marks.iter().filter(|m| angles.contains(&m.0)) {
            let share = (angles.end - angle) / (angles.end - angles.start);
            // The area starts below the title.
            let y = rows.start - HEAD + (share * f64::from(rows.end - rows.start)) as i32;
            area.draw(&PathElement::new(vec![(columns.end, y), (columns.end + 8, y)], BLACK))?;
            area.draw(&Text::new(name.clone(), (columns.end + 12, y - 7), style.clone()))?;
        }
        Ok(())
    }

    /// Ticks and numbers below the plot: the axis of `plotters` labels one decade of a log scale.
    fn label_radii(
        &self,
        area: &DrawingArea<BitMapBackend<'_>, Shift>,
        (columns, rows): &(Range<i32>, Range<i32>),
        low: f64,
        high: f64,
    ) -> Result<(), RenderError> {
        let label = |area: &DrawingArea<_, Shift>, x: i32, tick: f64| -> Result<(), RenderError> {
            let centred = Pos::new(HPos::Center, VPos::Top);
            let style = (FONT, 15).into_font().color(&BLACK).pos(centred);
            let bottom = rows.end - HEAD;
            area.draw(&PathElement::new(vec![(x, bottom), (x, bottom + 6)], BLACK))?;
            area.draw(&Text::new(trimmed(tick), (x, bottom + 8), style))?;
            Ok(())
        };
        if let [radius] = self.radii {
            // one column has no axis
            return label(area, (columns.start + columns.end) / 2, *radius);
        }
        let scale = |r: f64| if self.logarithmic { r.ln() } else { r };
        let ticks = match self.logarithmic {
            true => ticks::logarithmic(low, high),
            false => ticks::linear(low, high),
        };
        for tick in ticks {
            let share = (scale(tick) - scale(low)) / (scale(high) - scale(low));
            let x = columns.start + (share * f64::from(columns.end - columns.start)).round() as i32;
            label(area, x, tick)?;
        }
        Ok(())
    }
}

/// A number without trailing zeros.
fn trimmed(value: f64) -> String {
    let text = format!("{value:.5}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
