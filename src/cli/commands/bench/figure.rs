//! The plot of error over run time, one panel per case, both axes logarithmic.

use crate::cli::show::plot::{FONT, Figure, PALETTE};
use gonio::compare::speed::{Method, Point};
use plotters::coord::Shift;
use plotters::prelude::*;

/// Size of the figure in pixels.
pub(super) const SIZE: (u32, u32) = (1500, 620);
/// Height of the legend's strip.
const LEGEND: i32 = 46;

pub(super) struct BenchFigure<'a> {
    /// Name and title of each case.
    pub titles: Vec<(&'static str, String)>,
    pub points: &'a [Point],
}

impl BenchFigure<'_> {
    fn panel<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        case: &str,
        title: &str,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        let of_case: Vec<&Point> = self.points.iter().filter(|p| p.case == case).collect();
        let seconds = decades(of_case.iter().map(|p| p.seconds));
        let errors = decades(of_case.iter().map(|p| p.error));
        let (upper, rest) = area.split_vertically(58);
        for (line, text) in wrapped(title).iter().enumerate() {
            let place = (14, 10 + 20 * line as i32);
            upper.draw(&Text::new(text.clone(), place, (FONT, 16)))?;
        }
        let mut chart = ChartBuilder::on(&rest)
            .margin(8)
            .x_label_area_size(48)
            .y_label_area_size(70)
            .build_cartesian_2d(
                (seconds.0..seconds.1).log_scale(),
                (errors.0..errors.1).log_scale(),
            )?;
        chart
            .configure_mesh()
            .x_desc("run time (s)")
            .y_desc("relative L2 error of intensity")
            .label_style((FONT, 14))
            .axis_desc_style((FONT, 16))
            .light_line_style(RGBColor(238, 238, 238))
            .x_label_formatter(&tick)
            .y_label_formatter(&tick)
            .draw()?;
        for (method, colour) in Method::ALL.into_iter().zip(colours()) {
            let mut line: Vec<(f64, f64)> = of_case
                .iter()
                .filter(|p| p.method == method)
                .map(|p| (p.seconds, p.error))
                .collect();
            line.sort_by(|a, b| a.0.total_cmp(&b.0));
            chart.draw_series(LineSeries::new(line.iter().copied(), colour.stroke_width(2)))?;
            chart.draw_series(line.iter().map(|&p| Circle::new(p, 4, colour.filled())))?;
        }
        let mut labelled: Vec<(f64, f64)> = Vec::new();
        for p in &of_case {
            // without a filter the grids are the same; labels must not lie on one another
            let near = |&(x, y): &(f64, f64)| {
                (x / p.seconds).ln().abs() < 0.4 && (y / p.error).ln().abs() < 0.2
            };
            if p.method == Method::PaperUnfiltered || labelled.iter().any(near) {
                continue;
            }
            labelled.push((p.seconds, p.error));
            let label = Text::new(format!("{}", p.setting), (6, -16), (FONT, 13));
            chart.draw_series([EmptyElement::at((p.seconds, p.error)) + label])?;
        }
        Ok(())
    }
}

impl Figure for BenchFigure<'_> {
    fn draw<B: DrawingBackend>(
        &self,
        root: &DrawingArea<B, Shift>,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        let (_, height) = root.dim_in_pixel();
        let (panels, legend) = root.split_vertically(height as i32 - LEGEND);
        for (area, (case, title)) in
            panels.split_evenly((1, self.titles.len().max(1))).iter().zip(&self.titles)
        {
            self.panel(area, case, title)?;
        }
        let settings = ["numbers: rays across", "", "numbers: tolerance"];
        for (i, (method, colour)) in Method::ALL.into_iter().zip(colours()).enumerate() {
            let x = 40 + 480 * i as i32;
            legend.draw(&PathElement::new([(x, 20), (x + 34, 20)], colour.stroke_width(2)))?;
            legend.draw(&Circle::new((x + 17, 20), 4, colour.filled()))?;
            let note =
                if settings[i].is_empty() { String::new() } else { format!(" ({})", settings[i]) };
            let text = format!("{}{note}", method.name());
            legend.draw(&Text::new(text, (x + 44, 11), (FONT, 16)))?;
        }
        Ok(())
    }
}

/// A tick's value without the noise of its last digits.
fn tick(value: &f64) -> String {
    format!("{}", (value * 1e6).round() / 1e6)
}

fn colours() -> [RGBColor; 3] {
    [PALETTE[1], PALETTE[4], PALETTE[0]]
}

/// Range that holds all values with room on either side, on a logarithmic axis.
fn decades(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values.fold((f64::INFINITY, 0.0f64), |(l, h), v| (l.min(v), h.max(v)));
    if low > 0.0 && low <= high { (0.5 * low, 3.0 * high) } else { (0.1, 1.0) }
}

/// A title in lines short enough for a panel.
fn wrapped(title: &str) -> Vec<String> {
    const WIDTH: usize = 52;
    let mut lines = vec![String::new()];
    for word in title.split(' ') {
        let last = lines.len() - 1;
        let line = &mut lines[last];
        if !line.is_empty() && line.chars().count() + word.chars().count() >= WIDTH {
            lines.push(word.into());
        } else {
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines
}
