//! What stands below the panels: a table of numbers, and notes.

use super::pen::{Drawn, GREY, INK, Pen, width_of};
use plotters::prelude::*;

/// Rows of cells, the first their heads, and lines of words.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Foot {
    /// Rows of the same number of cells.
    pub rows: Vec<Vec<String>>,
    /// Below them.
    pub notes: Vec<String>,
}

/// Height of a row and of a note, their letters, gap between columns.
const ROW: u32 = 18;
const LETTERS: u32 = 13;
const GAP: i32 = 22;

impl Foot {
    pub(super) fn height(&self) -> u32 {
        let lines = (self.rows.len() + self.notes.len()) as u32;
        if lines == 0 { 0 } else { ROW * lines + 18 }
    }

    /// What it needs across.
    pub(super) fn least_width(&self) -> u32 {
        let table = self.columns().iter().map(|wide| wide + GAP).sum::<i32>();
        let notes = self.notes.iter().map(|note| width_of(note, LETTERS)).max().unwrap_or(0);
        table.max(notes) as u32 + 24
    }

    /// Widths of the columns.
    fn columns(&self) -> Vec<i32> {
        let count = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let cells = |column: usize| self.rows.iter().filter_map(move |row| row.get(column));
        let widest = |column| cells(column).map(|cell| width_of(cell, LETTERS)).max();
        (0..count).map(|column| widest(column).unwrap_or(0)).collect()
    }

    pub(super) fn draw<B: DrawingBackend>(
        &self,
        pen: &Pen<'_, B>,
        (left, top): (i32, i32),
    ) -> Drawn<B> {
        let mut y = top + 6;
        let columns = self.columns();
        for (i, row) in self.rows.iter().enumerate() {
            let mut x = left;
            for (cell, wide) in row.iter().zip(&columns) {
                let colour = if i == 0 { GREY } else { INK };
                pen.words(cell, (x, y), LETTERS, colour)?;
                x += wide + GAP;
            }
            y += ROW as i32;
        }
        for note in &self.notes {
            pen.words(note, (left, y), LETTERS, GREY)?;
            y += ROW as i32;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_as_wide_as_their_widest_cell() {
        let row = |cells: [&str; 2]| cells.map(String::from).to_vec();
        let foot = Foot { rows: vec![row(["a", "longest"]), row(["bcd", "e"])], notes: vec![] };
        assert_eq!(foot.columns(), [width_of("bcd", LETTERS), width_of("longest", LETTERS)]);
        assert_eq!((Foot::default().height(), foot.height()), (0, 2 * ROW + 18));
    }
}
