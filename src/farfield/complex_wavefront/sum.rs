//! The sum itself: ring by ring, cell by cell, for those columns that a cell's rays come near.

use super::channels::{Channels, FIELDS, PLACE, Place, by_launch, channels, width};
use super::coarse::{CoarseGrid, Kind, SPOKES, blend};
use super::edge_cells::EdgeCells;
use super::kernel::{Column, Ray};
use super::lattice::{Lattice, Ring};
use crate::cancel;
use crate::farfield::wave_field::WaveField;
use crate::optics::AmplitudeMatrix;
use crate::trace::Tracer;

/// How finely an order is summed.
struct Fineness {
    /// Rays count as long as the window is above `exp -cut_off`.
    cut_off: f64,
    /// Steps of the lattice, in those that add `exp -8` to the integral.
    steps: f64,
}

impl Fineness {
    /// Low orders within a few thousandths; of high ones the wave beside the last ray, which no sum has, is so
    /// much more that one percent will do.
    fn of_order(order: u32) -> Self {
        const LAST_FINE: u32 = 3;
        if order > LAST_FINE {
            Self { cut_off: 5.0, steps: 1.33 }
        } else {
            Self { cut_off: 9.0, steps: 1.0 }
        }
    }
}

/// One order as a sum on a complex wavefront, or a share of its amplitude.
pub struct ComplexWavefront<'a> {
    tracer: Tracer<'a>,
    size_parameter: f64,
    place: Place,
    order: u32,
    share: f64,
    pub(super) grid: CoarseGrid,
    pub(super) lattice: Lattice,
    pub(super) edges: EdgeCells,
}

impl<'a> ComplexWavefront<'a> {
    /// One order, all of its amplitude.
    pub fn new(tracer: &Tracer<'a>, order: u32, size_parameter: f64) -> Self {
        Self::at(tracer, order, size_parameter, PLACE)
    }

    /// The same with the wavefront at another place: what changes is error.
    pub fn at(tracer: &Tracer<'a>, order: u32, size_parameter: f64, place: Place) -> Self {
        let grid = CoarseGrid::of_order(tracer, order, size_parameter, place);
        Self::of_grid(tracer, (order, 1.0), grid, size_parameter, place)
    }

    /// Some orders, whose coarse rays are traced together, each with a share of its amplitude.
    pub fn of_orders(tracer: &Tracer<'a>, shares: &[(u32, f64)], size_parameter: f64) -> Vec<Self> {
        let orders: Vec<u32> = shares.iter().map(|share| share.0).collect();
        let grids = CoarseGrid::of_orders(tracer, &orders, size_parameter, PLACE);
        let sum = |(&share, grid)| Self::of_grid(tracer, share, grid, size_parameter, PLACE);
        shares.iter().zip(grids).map(sum).collect()
    }

    fn of_grid(
        tracer: &Tracer<'a>,
        (order, share): (u32, f64),
        grid: CoarseGrid,
        size_parameter: f64,
        place: Place,
    ) -> Self {
        let lattice = Lattice::new(&grid.steps, Fineness::of_order(order).steps);
        let edges = EdgeCells::new(&grid, &lattice);
        Self { tracer: tracer.clone(), size_parameter, place, order, share, grid, lattice, edges }
    }

    /// Its order.
    pub fn order(&self) -> u32 {
        self.order
    }

    /// Amplitudes in directions of some azimuths, scattering angles ascending.
    pub fn columns(&self, theta: &[f64], azimuths: &[f64]) -> Vec<Vec<AmplitudeMatrix>> {
        let mut columns: Vec<Column> =
            azimuths.iter().map(|&phi| Column::new(theta, phi, self.size_parameter)).collect();
        self.add_rays(theta, &mut columns);
        columns.iter_mut().map(Column::finish).collect()
    }

    fn add_rays(&self, theta: &[f64], columns: &mut [Column]) {
        let x = self.size_parameter;
        let (Some(&first), Some(&last)) = (theta.first(), theta.last()) else { return };
        let window = (2.0 * Fineness::of_order(self.order).cut_off / (x * self.place.imaginary))
            .sqrt()
            .min(2.0);
        // which columns the rays of each cell of a row come near
        let mut near: Vec<Vec<usize>> = vec![Vec::new(); SPOKES];
        let mut row = None;
        for (k, ring) in self.lattice.rings.iter().enumerate() {
            let rows = self.grid.rows(ring.alpha);
            if row != Some(rows.cell) {
                row = Some(rows.cell);
                cancel::checkpoint();
                for (spoke, near) in near.iter_mut().enumerate() {
                    near.clear();
                    let cell = self.grid.cell(rows.cell, spoke);
                    if cell.kind != Kind::Empty {
                        let reach = cell.radius + window;
                        let met =
                            |c: &usize| columns[*c].is_near(cell.centre, reach, [first, last]);
                        near.extend((0..columns.len()).filter(met));
                    }
                }
            }
            for (spoke, near) in near.iter().enumerate() {
                if near.is_empty() {
                    continue;
                }
                let cell = self.grid.cell(rows.cell, spoke);
                let mut add = |ray: &Ray| near.iter().for_each(|&c| columns[c].add(ray, window));
                if cell.kind == Kind::Edge {
                    let trace = |k: usize, rays: &mut Vec<Ray>| self.traced(k, spoke, rays);
                    match self.edges.rays((rows.cell, spoke), k, trace) {
                        Some(rays) => rays.iter().for_each(&mut add),
                        None => {
                            let mut rays = Vec::new();
                            self.traced(k, spoke, &mut rays);
                            rays.iter().for_each(&mut add);
                        }
                    }
                    continue;
                }
                let points = ring.points_between(spoke);
                if points.is_empty() {
                    continue;
                }
                // rays whose wave is narrower than a step of the lattice stand for no more
                let weight = ring.weight * self.share * (cell.width / ring.step()).min(1.0);
                let values = self.grid.row(&rows, spoke);
                for point in points {
                    let channels = blend(&values, ring.azimuth(point), spoke);
                    add(&Ray::new(&channels, weight, self.place, x));
                }
            }
        }
    }

    /// Rays of a ring of the lattice between a spoke and the next, traced one by one.
    fn traced(&self, ring: usize, spoke: usize, rays: &mut Vec<Ray>) {
        let ring = &self.lattice.rings[ring];
        let found = ring.points_between(spoke).filter_map(|point| {
            let channels = self.channels(ring, ring.azimuth(point))?;
            let weight = ring.weight * self.share;
            Some(Ray::new(&channels, weight, self.place, self.size_parameter))
        });
        rays.extend(found);
    }

    /// The channels of one ray. Next to total reflection directions run so fast that its wave may be far
    /// narrower than a step of the lattice: it stands for no more than its own width.
    fn channels(&self, ring: &Ring, psi: f64) -> Option<Channels> {
        let (rim, slope) = self.grid.silhouette(psi);
        let place = [rim * ring.alpha.sin() * psi.cos(), rim * ring.alpha.sin() * psi.sin()];
        let exit = self.tracer.trace_order(place[0], place[1], self.order)?;
        let tangents = by_launch(&exit, [ring.alpha, psi], (rim, slope));
        let share = width(tangents, self.size_parameter, self.place) / ring.step();
        let share = share.min(1.0);
        let mut found = channels(&exit, self.place, rim * rim)?;
        found[FIELDS..].iter_mut().for_each(|value| *value *= share);
        Some(found)
    }
}

impl WaveField for ComplexWavefront<'_> {
    fn add(&self, theta: &[f64], phi: f64, sums: &mut [AmplitudeMatrix]) {
        let found = self.columns(theta, &[phi]).swap_remove(0);
        sums.iter_mut().zip(found).for_each(|(sum, wave)| *sum += wave);
    }

    fn add_columns(&self, theta: &[f64], azimuths: &[f64], columns: &mut [Vec<AmplitudeMatrix>]) {
        for (column, found) in columns.iter_mut().zip(self.columns(theta, azimuths)) {
            column.iter_mut().zip(found).for_each(|(sum, wave)| *sum += wave);
        }
    }
}
