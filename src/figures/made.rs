//! A figure as it is made: a sheet, and its numbers.

use super::error::FigureError;
use super::number::Number;
use crate::render::plots::sheet::Sheet;

/// A figure that is made.
#[derive(Clone, Debug)]
pub struct Made {
    sheet: Sheet,
    numbers: Vec<Number>,
}

impl Made {
    /// A sheet with its numbers below, unless it has a table there already.
    pub(super) fn new(mut sheet: Sheet, numbers: Vec<Number>) -> Self {
        if sheet.foot.rows.is_empty() && !numbers.is_empty() {
            let head = ["quantity", "paper", "ours", "difference"].map(String::from).to_vec();
            let rows = numbers.iter().map(|number| number.cells().to_vec());
            sheet.foot.rows = std::iter::once(head).chain(rows).collect();
        }
        Self { sheet, numbers }
    }

    /// With numbers that are not drawn below.
    pub(super) fn with_numbers(self, numbers: Vec<Number>) -> Self {
        Self { numbers, ..self }
    }

    /// What the paper gives beside ours, and what else is told.
    pub fn numbers(&self) -> &[Number] {
        &self.numbers
    }

    /// Whether pictures are on it, which SVG does not hold.
    pub fn has_pictures(&self) -> bool {
        self.sheet.has_pictures()
    }

    /// As PNG, with what the file is to tell of itself: keywords and texts.
    ///
    /// # Errors
    /// [`FigureError::Render`].
    pub fn png(&self, about: &[(&str, &str)]) -> Result<Vec<u8>, FigureError> {
        Ok(self.sheet.picture()?.png(about)?)
    }

    /// As SVG.
    ///
    /// # Errors
    /// [`FigureError::Render`], also where there are pictures.
    pub fn svg(&self) -> Result<String, FigureError> {
        Ok(self.sheet.svg()?)
    }
}
