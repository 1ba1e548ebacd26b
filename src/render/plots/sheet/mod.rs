//! Sheets: charts and pictures side by side on one page, a title above and a table of numbers below.
//!
//! Charts are drawn here from lines and letters alone, so that their axes may be logarithmic or of equal scale, strips
//! of colours stand above them, and the legend stands below them, where no curve is.

mod axis;
mod chart;
mod foot;
mod legend;
mod line;
mod pen;

pub use axis::Axis;
pub use chart::{Chart, Label, Mark, Strip};
pub use foot::Foot;
pub use line::Curve;

use crate::render::error::RenderError;
use crate::render::picture::Picture;
use crate::render::plots::font::ensure_font;
use pen::{Drawn, Pen};
use plotters::element::BitMapElement;
use plotters::prelude::*;

/// One part of a sheet.
#[derive(Clone, Debug)]
pub enum Panel {
    /// Curves over two axes.
    Chart(Chart),
    /// A picture with words above it.
    Picture {
        /// Above it.
        title: String,
        /// At the most as large as a panel less [`PICTURE_HEAD`].
        picture: Picture,
    },
}

/// A page of panels.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Above all.
    pub title: String,
    /// Panels in a row.
    pub columns: usize,
    /// Width and height of a panel, pixels.
    pub panel: (u32, u32),
    /// Row by row.
    pub panels: Vec<Panel>,
    /// Below all.
    pub foot: Foot,
}

/// Height of the title of the sheet, and of the words above a picture.
const HEAD: u32 = 40;
/// Height of the words above a picture, with the gap below it.
pub const PICTURE_HEAD: u32 = 34;
/// Between the edge and what is drawn.
const MARGIN: i32 = 12;

impl Sheet {
    /// Pixels across and down.
    pub fn size(&self) -> (u32, u32) {
        let rows = self.panels.len().div_ceil(self.columns.max(1)) as u32;
        let (width, height) = self.panel;
        let width = (width * self.columns as u32).max(self.foot.least_width());
        (width, HEAD + height * rows + self.foot.height())
    }

    /// Whether pictures are on it, which SVG does not hold.
    pub fn has_pictures(&self) -> bool {
        self.panels.iter().any(|panel| matches!(panel, Panel::Picture { .. }))
    }

    /// As a picture.
    ///
    /// # Errors
    /// [`RenderError::Drawing`].
    pub fn picture(&self) -> Result<Picture, RenderError> {
        ensure_font()?;
        let (width, height) = self.size();
        let mut picture = Picture::new(width as usize, height as usize);
        {
            let root =
                BitMapBackend::with_buffer(&mut picture.rgb, (width, height)).into_drawing_area();
            root.fill(&WHITE)?;
            self.draw(&Pen::new(&root))?;
            root.present()?;
        }
        Ok(picture)
    }

    /// As the text of an SVG document.
    ///
    /// # Errors
    /// [`RenderError::Drawing`], also where there are pictures on the sheet.
    pub fn svg(&self) -> Result<String, RenderError> {
        if self.has_pictures() {
            return Err(RenderError::Drawing("a sheet with pictures is no SVG".into()));
        }
        ensure_font()?;
        let mut text = String::new();
        {
            let root = SVGBackend::with_string(&mut text, self.size()).into_drawing_area();
            root.fill(&WHITE)?;
            self.draw(&Pen::new(&root))?;
            root.present()?;
        }
        Ok(text)
    }

    fn draw<B: DrawingBackend>(&self, pen: &Pen<'_, B>) -> Drawn<B> {
        pen.words(&self.title, (MARGIN, 12), 19, pen::INK)?;
        let (width, height) = (self.panel.0 as i32, self.panel.1 as i32);
        for (i, panel) in self.panels.iter().enumerate() {
            let (row, column) = ((i / self.columns) as i32, (i % self.columns) as i32);
            let corner = (column * width, HEAD as i32 + row * height);
            match panel {
                Panel::Chart(chart) => chart.draw(pen, corner, self.panel)?,
                Panel::Picture { title, picture } => {
                    pen.words(title, (corner.0 + MARGIN, corner.1 + 4), 14, pen::INK)?;
                    let size = (picture.width as u32, picture.height as u32);
                    let place = (corner.0 + MARGIN, corner.1 + PICTURE_HEAD as i32 - 8);
                    let image = BitMapElement::with_owned_buffer(place, size, picture.rgb.clone());
                    if let Some(image) = image {
                        pen.root.draw(&image)?;
                    }
                }
            }
        }
        let rows = self.panels.len().div_ceil(self.columns) as i32;
        self.foot.draw(pen, (MARGIN, HEAD as i32 + rows * height))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet() -> Sheet {
        let curve =
            Curve::new("x²", [200, 0, 0], (0..=10).map(|i| (f64::from(i), f64::from(i * i))));
        let chart = Chart {
            title: "squares".into(),
            x: Axis::linear("x", 0.0, 10.0),
            y: Axis::linear("x² (m²)", 0.0, 100.0),
            curves: vec![curve],
            ..Chart::default()
        };
        Sheet {
            title: "all squares".into(),
            columns: 1,
            panel: (400, 300),
            panels: vec![Panel::Chart(chart)],
            foot: Foot::default(),
        }
    }

    /// The curve is where its axes have it: red at the middle of the abscissa a quarter of the way up, nowhere above.
    #[test]
    fn curves_lie_on_their_axes() {
        let picture = sheet().picture().unwrap();
        assert_eq!((picture.width, picture.height), (400, 340));
        let red: Vec<(usize, usize)> = (0..400 * 340)
            .filter(|i| {
                let rgb = &picture.rgb[3 * i..3 * i + 3];
                rgb[0] > 150 && rgb[1] < 90 && rgb[2] < 90
            })
            .map(|i| (i % 400, i / 400))
            .filter(|(_, row)| *row < 270)
            .collect();
        let (left, right) = (red.iter().map(|p| p.0).min(), red.iter().map(|p| p.0).max());
        let (top, bottom) = (red.iter().map(|p| p.1).min(), red.iter().map(|p| p.1).max());
        let ([left, right], [top, bottom]) =
            ([left, right].map(Option::unwrap), [top, bottom].map(Option::unwrap));
        let middle = (left + right) / 2;
        let rows: Vec<usize> = red.iter().filter(|p| p.0 == middle).map(|p| p.1).collect();
        let wanted = bottom as f64 - 0.25 * (bottom - top) as f64;
        assert!(rows.iter().all(|&row| (row as f64 - wanted).abs() < 6.0), "{rows:?} {wanted}");
    }

    /// SVG has the words; pictures are refused there.
    #[test]
    fn svg_holds_lines_and_words() {
        let text = sheet().svg().unwrap();
        assert!(text.contains("all squares") && text.contains("x² (m²)"));
        let picture = Panel::Picture { title: "a".into(), picture: Picture::new(4, 3) };
        let with = Sheet { panels: vec![picture], ..sheet() };
        assert!(with.has_pictures() && with.svg().is_err() && with.picture().is_ok());
    }
}
