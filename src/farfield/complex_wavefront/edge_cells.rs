//! Rays of cells in which nothing is smooth: each is traced when the first column comes near its cell, and kept
//! for all the others.

use super::coarse::{CoarseGrid, Kind, SPOKES};
use super::kernel::Ray;
use super::lattice::Lattice;
use std::ops::Range;
use std::sync::OnceLock;

/// Most rays that are kept (160 bytes each); of larger sums every block of columns traces its own.
const MOST_KEPT: usize = 1 << 20;

/// The rays of one cell, those of each ring of the lattice behind one another.
struct EdgeCell {
    /// Where the rays of each of its rings begin, and the end.
    starts: Vec<u32>,
    rays: Vec<Ray>,
}

/// What is kept of all cells; nothing of sums that are too large.
pub(super) struct EdgeCells {
    cells: Vec<OnceLock<Box<EdgeCell>>>,
    /// Rings of the lattice in each row of cells.
    rings: Vec<Range<usize>>,
}

impl EdgeCells {
    /// Room for the rays of a lattice.
    pub(super) fn new(grid: &CoarseGrid, lattice: &Lattice) -> Self {
        Self::at_most(MOST_KEPT, grid, lattice)
    }

    fn at_most(most: usize, grid: &CoarseGrid, lattice: &Lattice) -> Self {
        let mut rings: Vec<Range<usize>> = Vec::new();
        let mut count = 0;
        for (k, ring) in lattice.rings.iter().enumerate() {
            let row = CoarseGrid::row_of(ring.alpha);
            if rings.len() <= row {
                rings.resize(row + 1, k..k);
            }
            rings[row].end = k + 1;
            let edges = (0..SPOKES).filter(|&spoke| grid.cell(row, spoke).kind == Kind::Edge);
            count += edges.map(|spoke| ring.points_between(spoke).len()).sum::<usize>();
        }
        let kept = if count > most { 0 } else { rings.len() * SPOKES };
        Self { cells: std::iter::repeat_with(OnceLock::new).take(kept).collect(), rings }
    }

    /// The rays of a cell on a ring of the lattice, by what `trace` finds of all of the cell's rings; `None` where
    /// they are not kept.
    pub(super) fn rays(
        &self,
        (row, spoke): (usize, usize),
        ring: usize,
        trace: impl Fn(usize, &mut Vec<Ray>),
    ) -> Option<&[Ray]> {
        let rings = &self.rings[row];
        let cell = self.cells.get(row * SPOKES + spoke)?.get_or_init(|| {
            let mut cell = EdgeCell { starts: vec![0], rays: Vec::new() };
            for ring in rings.clone() {
                trace(ring, &mut cell.rays);
                cell.starts.push(cell.rays.len() as u32);
            }
            cell.rays.shrink_to_fit();
            Box::new(cell)
        });
        let k = ring - rings.start;
        Some(&cell.rays[cell.starts[k] as usize..cell.starts[k + 1] as usize])
    }
}

#[cfg(test)]
mod tests {
    use super::super::{ComplexWavefront, PLACE};
    use super::*;
    use crate::shape::{RaindropModel, Shape};
    use crate::trace::Tracer;

    /// Kept rays make the same sum to the last bit, for one column and for several at once; order 3 of a large
    /// drop has cells of that kind.
    #[test]
    fn kept_rays_are_the_traced_ones() {
        let x = 4000.0;
        let drop = Shape::raindrop(1e-3, RaindropModel::BeardChuang1987, 0.35).unwrap();
        let tracer = Tracer::new(&drop, 1.3314.into(), x, 3).with_curved_interface(x);
        let theta: Vec<f64> = (0..60).map(|i| 0.05 + 0.05 * f64::from(i)).collect();
        let phi = [0.1, 1.0, 2.9];
        let kept = ComplexWavefront::at(&tracer, 3, x, PLACE);
        let all = kept.columns(&theta, &phi);
        let mut traced = ComplexWavefront::at(&tracer, 3, x, PLACE);
        traced.edges = EdgeCells::at_most(0, &traced.grid, &traced.lattice);
        assert!(traced.edges.cells.is_empty() && !kept.edges.cells.is_empty());
        assert!(kept.edges.cells.iter().filter(|cell| cell.get().is_some()).count() > 100);
        assert_eq!(traced.columns(&theta, &phi), all);
        for (k, phi) in phi.iter().enumerate() {
            assert_eq!(kept.columns(&theta, &[*phi])[0], all[k]);
        }
    }
}
