//! The sum itself: ring by ring, cell by cell, for those columns that a cell's rays come near.

use super::channels::{Channels, PLACE, Place, channels};
use super::coarse::{CoarseGrid, Kind, SPOKES, blend};
use super::kernel::{Column, Ray};
use super::lattice::Lattice;
use crate::optics::AmplitudeMatrix;
use crate::trace::Tracer;

/// Rays count as long as the window is above `exp -CUT_OFF`.
const CUT_OFF: f64 = 9.0;

/// All orders that are sums on a complex wavefront.
pub struct ComplexWavefront<'a> {
    tracer: Tracer<'a>,
    size_parameter: f64,
    place: Place,
    sheets: Vec<Sheet>,
}

/// One order, of which a share of the amplitude is summed.
struct Sheet {
    order: u32,
    share: f64,
    grid: CoarseGrid,
    lattice: Lattice,
}

impl<'a> ComplexWavefront<'a> {
    /// Trace the coarse rays of some orders, for a share of the amplitude of each.
    pub fn new(tracer: &Tracer<'a>, shares: &[(u32, f64)], size_parameter: f64) -> Self {
        Self::at(tracer, shares, size_parameter, PLACE)
    }

    /// The same with the wavefront at another place: what changes is error.
    pub fn at(
        tracer: &Tracer<'a>,
        shares: &[(u32, f64)],
        size_parameter: f64,
        place: Place,
    ) -> Self {
        let orders: Vec<u32> = shares.iter().map(|share| share.0).collect();
        let grids = CoarseGrid::of_orders(tracer, &orders, size_parameter, place);
        let sheets = shares
            .iter()
            .zip(grids)
            .map(|(&(order, share), grid)| {
                let lattice = Lattice::new(&grid.steps);
                Sheet { order, share, grid, lattice }
            })
            .collect();
        Self { tracer: tracer.clone(), size_parameter, place, sheets }
    }

    /// Amplitudes of all orders in directions of some azimuths, scattering angles ascending.
    pub fn columns(&self, theta: &[f64], azimuths: &[f64]) -> Vec<Vec<AmplitudeMatrix>> {
        let mut columns: Vec<Column> =
            azimuths.iter().map(|&phi| Column::new(theta, phi, self.size_parameter)).collect();
        for sheet in &self.sheets {
            self.add_sheet(sheet, theta, &mut columns);
        }
        columns.iter_mut().map(Column::finish).collect()
    }

    /// Add the waves in some directions of one azimuth, scattering angles ascending.
    pub fn add(&self, theta: &[f64], phi: f64, sums: &mut [AmplitudeMatrix]) {
        let found = self.columns(theta, &[phi]).swap_remove(0);
        sums.iter_mut().zip(found).for_each(|(sum, wave)| *sum += wave);
    }

    fn add_sheet(&self, sheet: &Sheet, theta: &[f64], columns: &mut [Column]) {
        let x = self.size_parameter;
        let (Some(&first), Some(&last)) = (theta.first(), theta.last()) else { return };
        let window = (2.0 * CUT_OFF / (x * self.place.imaginary)).sqrt().min(2.0);
        let mut near: Vec<usize> = Vec::with_capacity(columns.len());
        for ring in &sheet.lattice.rings {
            let rows = sheet.grid.rows(ring.alpha);
            for spoke in 0..SPOKES {
                let cell = sheet.grid.cell(rows.cell, spoke);
                if cell.kind == Kind::Empty {
                    continue;
                }
                near.clear();
                let reach = cell.radius + window;
                near.extend(
                    (0..columns.len())
                        .filter(|&c| columns[c].is_near(cell.centre, reach, [first, last])),
                );
                if near.is_empty() {
                    continue;
                }
                let points = ring.points_between(spoke);
                if points.is_empty() {
                    continue;
                }
                let values = (cell.kind == Kind::Smooth).then(|| sheet.grid.row(&rows, spoke));
                for point in points {
                    let psi = ring.azimuth(point);
                    let found = match &values {
                        Some(values) => Some(blend(values, psi, spoke)),
                        None => self.traced(sheet, ring.alpha, psi),
                    };
                    let Some(channels) = found else { continue };
                    let ray = Ray::new(&channels, ring.weight * sheet.share, self.place, x);
                    for &c in &near {
                        columns[c].add(&ray, window);
                    }
                }
            }
        }
    }

    /// The channels of one ray.
    fn traced(&self, sheet: &Sheet, alpha: f64, psi: f64) -> Option<Channels> {
        let rim = sheet.grid.silhouette_radius(psi);
        let place = [rim * alpha.sin() * psi.cos(), rim * alpha.sin() * psi.sin()];
        let exit = self.tracer.trace_order(place[0], place[1], sheet.order)?;
        channels(&exit, self.place, rim * rim)
    }
}
