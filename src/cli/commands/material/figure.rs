//! The plot of n and k by wavelength, of one material or two.

use super::evaluated::extent;
use crate::cli::failure::Result;
use crate::cli::show::plot::{FONT, Figure, PALETTE};
use gonio::medium::Medium;
use plotters::coord::Shift;
use plotters::coord::ranged1d::{AsRangedCoord, ValueFormatter};
use plotters::prelude::*;

/// Size of the figure in pixels.
pub(super) const SIZE: (u32, u32) = (960, 800);
/// Points of each curve.
const POINTS: usize = 480;
/// Height of one line of the sources below the plots.
const LINE: i32 = 18;
/// Characters of the sources that fit in one line.
const LINE_LENGTH: usize = 130;

/// One material's curve.
struct Curve {
    name: String,
    nm: Vec<f64>,
    n: Vec<f64>,
    k: Vec<f64>,
}

/// n above, k below, sources at the foot.
pub(super) struct IndexFigure {
    curves: Vec<Curve>,
    range: (f64, f64),
    sources: Vec<String>,
}

impl IndexFigure {
    /// The curves over the wavelengths asked for (nm), or over what the data cover of 350 to 800 nm.
    pub(super) fn new(media: &[&Medium], asked: Option<&[f64]>) -> Result<Self> {
        let range = match asked.map(extent) {
            Some((from, to)) if from < to => (from, to),
            _ => common_range(media),
        };
        let mut curves = Vec::new();
        let mut sources = Vec::new();
        for medium in media {
            let mut curve = Curve { name: medium.name(), nm: vec![], n: vec![], k: vec![] };
            for i in 0..POINTS {
                let nm = range.0 + (range.1 - range.0) * i as f64 / (POINTS - 1) as f64;
                let index = medium.index(nm / 1e9)?;
                curve.nm.push(nm);
                curve.n.push(index.re);
                curve.k.push(index.im);
            }
            curves.push(curve);
            sources.extend(wrap(&format!("{}: {}", medium.name(), medium.source())));
        }
        Ok(Self { curves, range, sources })
    }

    /// Lowest and highest value with a margin, of all curves.
    fn span(&self, values: impl Fn(&Curve) -> &[f64]) -> (f64, f64) {
        let all: Vec<f64> = self.curves.iter().flat_map(|c| values(c).iter().copied()).collect();
        let (low, high) = extent(&all);
        let margin = (0.06 * (high - low)).max(1e-6 * high.abs());
        (low - margin, high + margin)
    }

    /// Draws one panel; `y` is its range on whichever scale.
    fn panel<B: DrawingBackend, Y>(
        &self,
        area: &DrawingArea<B, Shift>,
        y: Y,
        label: &str,
        values: impl Fn(&Curve) -> &[f64],
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>>
    where
        Y: AsRangedCoord<Value = f64>,
        Y::CoordDescType: ValueFormatter<f64>,
    {
        let mut chart = ChartBuilder::on(area)
            .margin(12)
            // Half of the last label stands beyond the axis.
            .margin_right(30)
            .x_label_area_size(44)
            .y_label_area_size(96)
            .build_cartesian_2d(self.range.0..self.range.1, y)?;
        let digits = |v: &f64| {
            let text = if v.abs() < 0.01 { format!("{v:.1e}") } else { format!("{v:.5}") };
            if text.contains('e') { text } else { text.trim_end_matches('0').to_string() }
        };
        chart
            .configure_mesh()
            .x_desc("wavelength in vacuum (nm)")
            .y_desc(label)
            .label_style((FONT, 15))
            .axis_desc_style((FONT, 17))
            .light_line_style(RGBColor(240, 240, 240))
            .y_label_formatter(&digits)
            .draw()?;
        for (curve, colour) in self.curves.iter().zip(PALETTE) {
            let points = curve.nm.iter().copied().zip(values(curve).iter().copied());
            chart
                .draw_series(LineSeries::new(points, colour.stroke_width(2)))?
                .label(curve.name.clone())
                .legend(move |(x, y)| {
                    PathElement::new([(x, y), (x + 24, y)], colour.stroke_width(2))
                });
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::UpperRight)
            .label_font((FONT, 15))
            .background_style(WHITE.mix(0.85))
            .border_style(RGBColor(180, 180, 180))
            .legend_area_size(34)
            .draw()
    }

    fn draw_extinction<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        let all: Vec<f64> = self.curves.iter().flat_map(|c| c.k.iter().copied()).collect();
        let (low, high) = extent(&all);
        let label = "extinction coefficient k";
        if high == 0.0 {
            let text = "k = 0: the data hold no absorption";
            return area.draw(&Text::new(text, (120, 30), (FONT, 17)));
        }
        if low > 0.0 && high > 30.0 * low {
            let (low, high) = (0.7 * low, 1.4 * high);
            return self.panel(area, (low..high).log_scale(), label, |c| &c.k);
        }
        let (_, high) = self.span(|c| &c.k);
        self.panel(area, 0.0..high, label, |c| &c.k)
    }
}

impl Figure for IndexFigure {
    fn draw<B: DrawingBackend>(
        &self,
        root: &DrawingArea<B, Shift>,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        let (_, height) = root.dim_in_pixel();
        let foot = LINE * self.sources.len() as i32 + 10;
        let (plots, sources) = root.split_vertically(height as i32 - foot);
        let transparent = self.curves.iter().all(|c| c.k.iter().all(|k| *k == 0.0));
        let share = if transparent { 0.9 } else { 0.55 };
        let (upper, lower) =
            plots.split_vertically((share * f64::from(height as i32 - foot)) as i32);
        let (low, high) = self.span(|c| &c.n);
        self.panel(&upper, low..high, "index of refraction n", |c| &c.n)?;
        self.draw_extinction(&lower)?;
        for (i, line) in self.sources.iter().enumerate() {
            let style = TextStyle::from((FONT, 13)).color(&RGBColor(90, 90, 90));
            sources.draw(&Text::new(line.clone(), (14, LINE * i as i32), style))?;
        }
        Ok(())
    }
}

/// What all media cover of 350 to 800 nm, or of anything.
fn common_range(media: &[&Medium]) -> (f64, f64) {
    let mut covered = (0.0_f64, f64::INFINITY);
    for medium in media {
        let (from, to) = medium.valid_range();
        covered = (covered.0.max(from * 1e9), covered.1.min(to * 1e9));
    }
    let visible = (covered.0.max(350.0), covered.1.min(800.0));
    if visible.0 < visible.1 { visible } else { covered }
}

/// Cuts a text into lines at blanks.
fn wrap(text: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.len() - 1;
        if lines[last].is_empty() {
            lines[last].push_str(word);
        } else if lines[last].chars().count() + word.chars().count() < LINE_LENGTH {
            lines[last].push(' ');
            lines[last].push_str(word);
        } else {
            lines.push(word.to_string());
        }
    }
    lines
}
