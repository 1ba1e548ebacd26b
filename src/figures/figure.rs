//! What a figure is: its name, where it is printed, what to look at, and how it is made.

use super::error::FigureError;
use super::made::Made;
use super::workshop::Workshop;

/// How a figure is made.
pub(super) type Make = fn(&Workshop) -> Result<Made, FigureError>;

/// A figure of a paper.
#[derive(Clone, Copy, Debug)]
pub struct Figure {
    /// As it is asked for: `sadeghi-5`.
    pub name: &'static str,
    /// Where it is printed.
    pub source: &'static str,
    /// What it shows.
    pub caption: &'static str,
    /// What of it to compare with the paper's.
    pub compare: &'static str,
    /// Scenes that it is made from, of `data/scenes/figures`.
    pub scenes: &'static [&'static str],
    /// Whether it holds pictures, which SVG does not.
    pub pictures: bool,
    pub(super) make: Make,
}

impl Figure {
    /// Endings of the files that it can be written to.
    pub fn endings(&self) -> &'static [&'static str] {
        if self.pictures { &["png"] } else { &["png", "svg"] }
    }

    /// Compute and draw it.
    ///
    /// # Errors
    /// [`FigureError`]: what the computation of a part of it says.
    pub fn make(&self, workshop: &Workshop) -> Result<Made, FigureError> {
        (self.make)(workshop)
    }
}
