//! What a database is written from.

use super::size_grid::SizeGrid;
use crate::export::average::Averaged;
use crate::export::{ExportError, invalid};

/// Tables by size, their averages, and how many Legendre moments are wanted.
pub(super) struct Source<'a> {
    pub grid: &'a SizeGrid,
    /// In the order of the grid's tables.
    pub averaged: &'a [Averaged],
    pub first: &'a Averaged,
    pub moments: usize,
}

impl<'a> Source<'a> {
    /// # Errors
    /// When there is no table.
    pub(super) fn new(
        grid: &'a SizeGrid,
        averaged: &'a [Averaged],
        moments: usize,
    ) -> Result<Self, ExportError> {
        match averaged.first() {
            Some(first) if !grid.tables.is_empty() => Ok(Self { grid, averaged, first, moments }),
            _ => Err(invalid("table", "none", "at least one table")),
        }
    }
}
