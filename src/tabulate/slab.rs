//! From columns of amplitudes to the values of one slab, normalised, with the forward peak in it.

use super::forward_peak::{ForwardCells, PeakRows};
use super::peak_change::PeakChange;
use crate::farfield::forward::wave::ForwardWave;
use crate::farfield::patches::gaussian_filter;
use crate::farfield::{Column, FarField};
use crate::math::parallel::*;
use crate::optics::{AmplitudeMatrix, mirror_sign};
use crate::phase_table::{Axes, ForwardPeak, Quantity};
use ndarray::{Array2, Array3, ArrayViewMut3, Axis, s};

/// Settings of one slab.
pub struct Tabulator<'a> {
    /// Scattering angles, radians.
    pub theta: &'a [f64],
    /// Circumference of the sphere of equal volume over the wavelength.
    pub size_parameter: f64,
    /// What is tabulated.
    pub quantity: Quantity,
    /// How the forward peak enters.
    pub forward_peak: ForwardPeak,
    /// Whether amplitudes add, or intensities.
    pub interference: bool,
    /// Standard deviation (radians) of the Gaussian filter, where it stands for diffraction.
    pub filter: Option<f64>,
    /// The forward wave, where it is in the table.
    pub diffraction: Option<ForwardWave<'a>>,
    /// Cross section for scattering and area of the shadow, in units of the squared radius.
    pub scattering: f64,
    /// Area of the shadow, in squared radii.
    pub shadow_area: f64,
    /// Share of the scattered power that is in no order of the table: what Σ P·ΔΩ lacks to 1.
    pub left_out: f64,
    /// Whether the forward peak is scaled until the samples of a whole sphere add up: else that is left to
    /// whoever sums several slabs.
    pub closes: bool,
    /// [`Thresholds::peak_edge`](crate::farfield::assignment::Thresholds::peak_edge).
    pub peak_edge: f64,
    /// The one order of the far field that is tabulated; all of them if `None`.
    pub order: Option<u32>,
}

/// The values of a slab and what was found on the way.
pub struct Values {
    /// Values in sr⁻¹, shape (elements, θ, φ).
    pub values: Array3<f32>,
    /// Rays that coalesce, shape (θ, φ).
    pub caustic_order: Option<Array2<u8>>,
    /// Sum over the samples before the forward peak was treated.
    pub sum_before_peak: f64,
    /// What closing the sum has changed.
    pub peak_change: PeakChange,
    /// Share of the power in the separated peak.
    pub peak_share: f64,
    /// Mean cosine of the scattering angle.
    pub asymmetry: f64,
}

/// One computed azimuth, scaled to sr⁻¹ but for the rows of the forward peak.
struct Line {
    /// (element, θ)
    values: Array2<f32>,
    caustic_order: Vec<u8>,
    /// By cell of the forward peak and element.
    forward: Vec<PeakPower>,
}

/// A value within the forward peak as a polynomial of the peak's own scale (the root of the factor on its power):
/// the rest alone, its interference with the peak, the peak alone.
type PeakPower = [f64; 3];

fn at_scale([rest, mixed, own]: PeakPower, scale: f64) -> f64 {
    rest + scale * (mixed + scale * own)
}

/// Forward diffraction, prepared for one slab.
struct Peak<'a> {
    rows: PeakRows,
    wave: ForwardWave<'a>,
}

/// Columns computed together, at least and at most: what they share is worked out once for each such block (the table
/// of 1 mm: 37 CPU seconds in blocks of 8, 25 in blocks of 32), and every thread wants some blocks of its own.
const COLUMNS_AT_ONCE: (usize, usize) = (8, 32);
/// Columns of one order of one drop of many: other drops are computed beside it.
const COLUMNS_OF_ONE_OF_MANY: usize = 64;

impl Tabulator<'_> {
    /// Fill a slab. `computed` are azimuths in [0, π]; `places` tells, for every azimuth of the
    /// table, which of them serves it and whether as mirror image.
    pub fn tabulate(
        &self,
        far_field: &FarField,
        computed: &[f64],
        places: &[(usize, bool)],
        axes: &Axes,
    ) -> Values {
        let cells = self.forward_cells();
        let peak = self.peak().map(|wave| Peak { rows: PeakRows::new(&wave, &cells), wave });
        let angles = [&cells.theta, &self.theta[cells.len()..]].concat();
        let (fewest, most) = COLUMNS_AT_ONCE;
        let share = match self.order {
            Some(_) => COLUMNS_OF_ONE_OF_MANY,
            None => computed.len().div_ceil(3 * current_num_threads()).clamp(fewest, most),
        };
        let lines: Vec<Line> = computed
            .par_chunks(share)
            .flat_map_iter(|phis| {
                let columns = self.columns(far_field, &angles, phis);
                let lines = phis.iter().zip(columns);
                lines.map(|(&phi, column)| self.line(column, phi, &angles, &cells, peak.as_ref()))
            })
            .collect();
        let weights = axes.solid_angle_factors();
        let elements = self.quantity.elements();
        let mut values = Array3::<f32>::zeros((elements, axes.theta.len(), axes.phi.len()));
        fill(values.view_mut(), &lines, places);
        let weights = (&weights.0[..], &weights.1[..]);
        let (factor, sum_before_peak, peak_share) =
            self.close(&lines, places, axes, weights, &values);
        let before = self.write_forward(&mut values, &lines, places, factor);
        let peak_change = match factor == 1.0 {
            true => PeakChange::NONE,
            false => PeakChange::new(axes, before.view(), values.index_axis(Axis(0), 0)),
        };
        let caustic_order = lines.iter().any(|l| !l.caustic_order.is_empty()).then(|| {
            Array2::from_shape_fn((axes.theta.len(), axes.phi.len()), |(i, j)| {
                lines[places[j].0].caustic_order.get(i).copied().unwrap_or(0)
            })
        });
        let asymmetry = asymmetry(&values, weights, &axes.theta);
        Values { values, caustic_order, sum_before_peak, peak_change, peak_share, asymmetry }
    }

    /// Columns of all orders, or of the one that is asked for.
    fn columns(&self, far_field: &FarField, angles: &[f64], azimuths: &[f64]) -> Vec<Column> {
        let of_order = |order| far_field.columns_of_order(order, angles, azimuths);
        match self.order.and_then(of_order) {
            Some(columns) => columns.into_iter().map(Column::of_amplitudes).collect(),
            None => far_field.columns(angles, azimuths, !self.interference),
        }
    }

    fn forward_cells(&self) -> ForwardCells {
        if self.diffraction.is_none() || self.forward_peak == ForwardPeak::Separate {
            return ForwardCells::default();
        }
        let mean = self.forward_peak == ForwardPeak::CellAverage;
        ForwardCells::new(self.theta, self.size_parameter, mean)
    }

    /// `k² C_sca` in units of the squared size parameter: what divides `S11`.
    fn scale(&self) -> f64 {
        1.0 / (self.size_parameter * self.size_parameter * self.scattering)
    }

    /// Forward diffraction, where it is in the table.
    fn peak(&self) -> Option<ForwardWave<'_>> {
        self.diffraction.filter(|_| self.forward_peak != ForwardPeak::Separate)
    }

    /// A column, of the cells' angles and of the samples beyond.
    fn line(
        &self,
        mut column: Column,
        phi: f64,
        angles: &[f64],
        cells: &ForwardCells,
        peak: Option<&Peak>,
    ) -> Line {
        let scale = self.scale();
        let (first, inside) = (cells.len(), cells.theta.len());
        let mut forward = Vec::new();
        if let Some(peak) = peak {
            forward = self.forward(&column, cells, &peak.rows.at(phi));
            let tails = peak.wave.tails(&self.theta[first..], phi);
            for (amplitude, tail) in column.amplitude[inside..].iter_mut().zip(tails) {
                *amplitude += tail;
            }
        }
        let elements = self.quantity.elements();
        let mut values = Array2::zeros((elements, self.theta.len()));
        for i in first..self.theta.len() {
            let at = i - first + inside;
            self.store(&column, at, |e, value| values[[e, i]] = (value * scale) as f32);
        }
        if let Some(sigma) = self.filter {
            let bows = gaussian_filter::bows(angles, &column.rays);
            // the rows of the forward peak are still empty
            for mut row in values.slice_mut(s![.., first..]).axis_iter_mut(Axis(0)) {
                let raw: Vec<f64> = row.iter().map(|&v| f64::from(v)).collect();
                let smooth = gaussian_filter::apply(&self.theta[first..], &raw, &bows, sigma);
                row.iter_mut().zip(smooth).for_each(|(v, s)| *v = s as f32);
            }
        }
        let mut caustic_order = column.caustic_order;
        if !caustic_order.is_empty() {
            caustic_order =
                cells.samples().chain(inside..angles.len()).map(|k| caustic_order[k]).collect();
        }
        Line { values, caustic_order, forward }
    }

    /// Hand every element of sample `i` to `put`.
    fn store(&self, column: &Column, i: usize, mut put: impl FnMut(usize, f64)) {
        if self.interference && self.quantity == Quantity::PhaseFunction {
            put(0, column.amplitude[i].s11());
            return;
        }
        let mueller =
            if self.interference { column.amplitude[i].mueller() } else { column.incoherent[i] };
        let elements = self.quantity.elements();
        for (e, value) in mueller.iter().flatten().take(elements).enumerate() {
            put(e, *value);
        }
    }

    /// The light in the cells of the peak, by cell and element.
    fn forward(
        &self,
        column: &Column,
        cells: &ForwardCells,
        peak: &[AmplitudeMatrix],
    ) -> Vec<PeakPower> {
        let elements = self.quantity.elements();
        let mut found = vec![PeakPower::default(); cells.len() * elements];
        let mut angles = (0..cells.theta.len()).zip(peak);
        for (cell, shares) in found.chunks_exact_mut(elements).zip(&cells.shares) {
            for (share, (k, &own)) in shares.iter().zip(&mut angles) {
                let rest = column.amplitude[k];
                let mut add = |e: usize, rest: f64, mixed: f64, own: f64| {
                    let sum = &mut cell[e];
                    *sum = [sum[0] + share * rest, sum[1] + share * mixed, sum[2] + share * own];
                };
                if self.interference && elements == 1 {
                    let (alone, diffracted) = (rest.s11(), own.s11());
                    add(0, alone, (rest + own).s11() - alone - diffracted, diffracted);
                } else if self.interference {
                    let (both, alone, own) =
                        ((rest + own).mueller(), rest.mueller(), own.mueller());
                    let alone = alone.iter().flatten().zip(own.iter().flatten());
                    for (e, (both, (alone, own))) in
                        both.iter().flatten().zip(alone).take(elements).enumerate()
                    {
                        add(e, *alone, both - alone - own, *own);
                    }
                } else {
                    let (rest, own) = (column.incoherent[k], own.mueller());
                    let both = rest.iter().flatten().zip(own.iter().flatten());
                    both.take(elements)
                        .enumerate()
                        .for_each(|(e, (rest, own))| add(e, *rest, 0.0, *own));
                }
            }
        }
        found
    }

    /// The factor on diffracted power that closes the budget, the sum before it, and the peak's
    /// share of all scattered light.
    fn close(
        &self,
        lines: &[Line],
        places: &[(usize, bool)],
        axes: &Axes,
        (theta_weights, phi_weights): (&[f64], &[f64]),
        values: &Array3<f32>,
    ) -> (f64, f64, f64) {
        let covers_sphere = self.closes && axes.cover_sphere();
        let rings = ring_powers(values, phi_weights);
        let rest: f64 = rings.iter().zip(theta_weights).map(|(power, w)| power * w).sum();
        let [without, mixed, own] = self.peak_sums(lines, places, (theta_weights, phi_weights));
        let sum_before_peak = rest + without + mixed + own;
        let diffracts = self.diffraction.is_some();
        let share = if diffracts { self.shadow_area / self.scattering } else { 0.0 };
        if self.forward_peak == ForwardPeak::Separate && diffracts && covers_sphere {
            // what the rest does not hold is in the peak, as long as that is the shadow's but for its edge
            let missing = 1.0 - self.left_out - rest;
            let edge = self.peak_edge + self.size_parameter.powf(-2.0 / 3.0);
            let closed = if (missing - share).abs() < edge { missing } else { share };
            return (1.0, sum_before_peak, closed);
        }
        if self.forward_peak != ForwardPeak::CellAverage || !covers_sphere || own <= 0.0 {
            return (1.0, sum_before_peak, share);
        }
        // the sum is a + b s + c s² in the root s of the factor
        let missing = 1.0 - self.left_out - rest - without;
        let discriminant = (mixed * mixed + 4.0 * own * missing).max(0.0);
        let root = (discriminant.sqrt() - mixed) / (2.0 * own);
        let factor = (root.max(0.0).powi(2)).clamp(0.05, 4.0);
        (factor, sum_before_peak, share)
    }

    /// Sums over the cells of the peak, by solid angle.
    fn peak_sums(
        &self,
        lines: &[Line],
        places: &[(usize, bool)],
        (theta_weights, phi_weights): (&[f64], &[f64]),
    ) -> PeakPower {
        let (scale, elements) = (self.scale(), self.quantity.elements());
        let mut sums = PeakPower::default();
        for (&(line, _), by_azimuth) in places.iter().zip(phi_weights) {
            let cells = lines[line].forward.iter().step_by(elements);
            for (power, by_angle) in cells.zip(theta_weights) {
                let weight = by_azimuth * by_angle * scale;
                sums.iter_mut().zip(power).for_each(|(sum, value)| *sum += weight * value);
            }
        }
        sums
    }

    /// Write the rows of the peak; hands back what they were before its power was scaled, shape (cell, φ).
    fn write_forward(
        &self,
        values: &mut Array3<f32>,
        lines: &[Line],
        places: &[(usize, bool)],
        factor: f64,
    ) -> Array2<f64> {
        let scale = self.scale();
        let elements = self.quantity.elements();
        let cells = lines.first().map_or(0, |line| line.forward.len() / elements);
        let mut before = Array2::zeros((cells, places.len()));
        for (j, &(line, mirrored)) in places.iter().enumerate() {
            for (i, cell) in lines[line].forward.chunks_exact(elements).enumerate() {
                before[[i, j]] = at_scale(cell[0], 1.0) * scale;
                for (e, &power) in cell.iter().enumerate() {
                    let sign = if mirrored { mirror_sign(e) } else { 1.0 };
                    values[[e, i, j]] = (sign * at_scale(power, factor.sqrt()) * scale) as f32;
                }
            }
        }
        before
    }
}

/// θ rows written together: as many as one line of the processor's cache holds of a column.
const ROWS_AT_ONCE: usize = 16;

/// Spread computed lines over the azimuths of the table, blocks of θ rows in parallel.
fn fill(mut values: ArrayViewMut3<f32>, lines: &[Line], places: &[(usize, bool)]) {
    for (e, mut plane) in values.axis_iter_mut(Axis(0)).enumerate() {
        let blocks = plane.axis_chunks_iter_mut(Axis(0), ROWS_AT_ONCE);
        blocks.into_par_iter().enumerate().for_each(|(block, mut rows)| {
            for (j, &(line, mirrored)) in places.iter().enumerate() {
                let sign = if mirrored { mirror_sign(e) as f32 } else { 1.0 };
                let from = lines[line].values.slice(s![e, ROWS_AT_ONCE * block..]);
                for (row, value) in rows.axis_iter_mut(Axis(0)).zip(from) {
                    row.into_slice().expect("rows are contiguous")[j] = sign * value;
                }
            }
        });
    }
}

/// Sum of the first element over azimuth with these weights, per θ.
fn ring_powers(values: &Array3<f32>, phi_weights: &[f64]) -> Vec<f64> {
    let rows = values.index_axis(Axis(0), 0);
    let sum = |row: ndarray::ArrayView1<f32>| -> f64 {
        // four running sums, so that an addition need not wait for the one before
        let mut sums = [0.0; 4];
        for (k, (&v, w)) in row.iter().zip(phi_weights).enumerate() {
            sums[k % 4] += w * f64::from(v);
        }
        sums.iter().sum()
    };
    rows.axis_iter(Axis(0)).into_par_iter().map(sum).collect()
}

/// Mean cosine of the scattering angle over the samples.
pub fn asymmetry(
    values: &Array3<f32>,
    (theta_weights, phi_weights): (&[f64], &[f64]),
    theta: &[f64],
) -> f64 {
    let (mut sum, mut cosine) = (0.0, 0.0);
    let rings = ring_powers(values, phi_weights);
    for ((ring, weight), theta) in rings.iter().zip(theta_weights).zip(theta) {
        let power = ring * weight;
        sum += power;
        cosine += power * theta.cos();
    }
    if sum > 0.0 { cosine / sum } else { 0.0 }
}
