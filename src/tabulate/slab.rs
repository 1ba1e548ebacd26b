//! From columns of amplitudes to the values of one slab, normalised, with the forward peak in it.

use super::forward_peak::{ForwardCells, PeakRows, PeakSample};
use crate::farfield::forward::wave::ForwardWave;
use crate::farfield::patches::gaussian_filter;
use crate::farfield::{Column, FarField};
use crate::optics::{AmplitudeMatrix, mirror_sign};
use crate::phase_table::{Axes, ForwardPeak, Quantity};
use ndarray::{Array2, Array3, ArrayViewMut3, Axis, s};
use num_complex::Complex64;
use rayon::prelude::*;

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
}

/// The values of a slab and what was found on the way.
pub struct Values {
    /// Values in sr⁻¹, shape (elements, θ, φ).
    pub values: Array3<f32>,
    /// Rays that coalesce, shape (θ, φ).
    pub caustic_order: Option<Array2<u8>>,
    /// Sum over the samples before the forward peak was treated.
    pub sum_before_peak: f64,
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
    forward: Vec<ForwardSample>,
}

/// A sample within the forward peak, before the peak is scaled.
#[derive(Clone, Copy)]
struct ForwardSample {
    rest: [[f64; 4]; 4],
    rest_amplitude: AmplitudeMatrix,
    /// Diffracted amplitude at the sample, and mean diffracted intensity over its cell.
    amplitude: AmplitudeMatrix,
    mean: f64,
    coarse: bool,
}

/// Forward diffraction, prepared for one slab.
struct Peak<'a> {
    rows: PeakRows,
    wave: ForwardWave<'a>,
}

/// Columns computed together, so that what they share is read once.
const COLUMNS_AT_ONCE: usize = 8;

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
        let peak = self.peak().map(|peak| Peak {
            rows: PeakRows::new(
                &peak,
                &cells,
                self.theta,
                self.forward_peak == ForwardPeak::CellAverage,
            ),
            wave: peak,
        });
        let lines: Vec<Line> = computed
            .par_chunks(COLUMNS_AT_ONCE)
            .flat_map_iter(|phis| {
                let columns = far_field.columns(self.theta, phis, !self.interference);
                let lines = phis.iter().zip(columns);
                lines.map(|(&phi, column)| self.line(column, phi, &cells, peak.as_ref()))
            })
            .collect();
        let weights = axes.solid_angle_factors();
        let elements = self.quantity.elements();
        let mut values = Array3::<f32>::zeros((elements, axes.theta.len(), axes.phi.len()));
        fill(values.view_mut(), &lines, places);
        let weights = (&weights.0[..], &weights.1[..]);
        let (factor, sum_before_peak, peak_share) = self.close(&lines, places, weights, &values);
        self.write_forward(&mut values, &lines, places, factor);
        let caustic_order = lines.iter().any(|l| !l.caustic_order.is_empty()).then(|| {
            Array2::from_shape_fn((axes.theta.len(), axes.phi.len()), |(i, j)| {
                lines[places[j].0].caustic_order.get(i).copied().unwrap_or(0)
            })
        });
        let asymmetry = asymmetry(&values, weights, &axes.theta);
        Values { values, caustic_order, sum_before_peak, peak_share, asymmetry }
    }

    fn forward_cells(&self) -> ForwardCells {
        let all = ForwardCells::new(self.theta, self.size_parameter);
        if self.diffraction.is_none() || self.forward_peak == ForwardPeak::Separate {
            return ForwardCells::none();
        }
        all
    }

    /// `k² C_sca` in units of the squared size parameter: what divides `S11`.
    fn scale(&self) -> f64 {
        1.0 / (self.size_parameter * self.size_parameter * self.scattering)
    }

    /// Forward diffraction, where it is in the table.
    fn peak(&self) -> Option<ForwardWave<'_>> {
        self.diffraction.filter(|_| self.forward_peak != ForwardPeak::Separate)
    }

    fn line(
        &self,
        mut column: Column,
        phi: f64,
        cells: &ForwardCells,
        peak: Option<&Peak>,
    ) -> Line {
        let scale = self.scale();
        let mut forward = Vec::new();
        if let Some(peak) = peak {
            let samples = peak.rows.at(phi);
            let sample = |(i, s)| self.forward_sample(&column, cells, i, s);
            forward = samples.into_iter().enumerate().map(sample).collect();
            let beyond = forward.len();
            let tails = peak.wave.tails(&self.theta[beyond..], phi);
            for (amplitude, tail) in column.amplitude[beyond..].iter_mut().zip(tails) {
                *amplitude += tail;
            }
        }
        let elements = self.quantity.elements();
        let mut values = Array2::zeros((elements, self.theta.len()));
        for i in forward.len()..self.theta.len() {
            self.store(&column, i, |e, value| values[[e, i]] = (value * scale) as f32);
        }
        if let Some(sigma) = self.filter {
            let bows = gaussian_filter::bows(self.theta, &column.rays);
            // the rows of the forward peak are still empty
            let beyond = forward.len();
            for mut row in values.slice_mut(s![.., beyond..]).axis_iter_mut(Axis(0)) {
                let raw: Vec<f64> = row.iter().map(|&v| f64::from(v)).collect();
                let smooth = gaussian_filter::apply(&self.theta[beyond..], &raw, &bows, sigma);
                row.iter_mut().zip(smooth).for_each(|(v, s)| *v = s as f32);
            }
        }
        Line { values, caustic_order: column.caustic_order, forward }
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

    fn forward_sample(
        &self,
        column: &Column,
        cells: &ForwardCells,
        i: usize,
        peak: PeakSample,
    ) -> ForwardSample {
        let rest_amplitude = column.amplitude[i];
        let rest = if self.interference { rest_amplitude.mueller() } else { column.incoherent[i] };
        let coarse = self.forward_peak == ForwardPeak::CellAverage && cells.is_coarse(i);
        ForwardSample { rest, rest_amplitude, amplitude: peak.amplitude, mean: peak.mean, coarse }
    }

    /// Mueller matrix of a forward sample with the diffracted power scaled by `factor`.
    fn forward_mueller(&self, sample: &ForwardSample, factor: f64) -> [[f64; 4]; 4] {
        if self.interference && !sample.coarse {
            let forward = sample.amplitude * Complex64::from(factor.sqrt());
            return (sample.rest_amplitude + forward).mueller();
        }
        let power = if sample.coarse { sample.mean } else { sample.amplitude.s11() } * factor;
        let mut mueller = sample.rest;
        for (k, row) in mueller.iter_mut().enumerate() {
            row[k] += power;
        }
        mueller
    }

    /// The factor on diffracted power that closes the budget, the sum before it, and the peak's
    /// share of all scattered light.
    fn close(
        &self,
        lines: &[Line],
        places: &[(usize, bool)],
        (theta_weights, phi_weights): (&[f64], &[f64]),
        values: &Array3<f32>,
    ) -> (f64, f64, f64) {
        let scale = self.scale();
        let rings = ring_powers(values, phi_weights);
        let rest: f64 = rings.iter().zip(theta_weights).map(|(power, w)| power * w).sum();
        let forward = |factor: f64| -> f64 {
            let mut sum = 0.0;
            for (j, (line, _)) in places.iter().enumerate() {
                for (i, sample) in lines[*line].forward.iter().enumerate() {
                    sum += theta_weights[i]
                        * phi_weights[j]
                        * scale
                        * self.forward_mueller(sample, factor)[0][0];
                }
            }
            sum
        };
        let without = forward(0.0);
        let with = forward(1.0);
        let sum_before_peak = rest + with;
        let covers_sphere = {
            let sum = |weights: &[f64]| weights.iter().sum::<f64>();
            let total = sum(theta_weights) * sum(phi_weights);
            self.closes && (total / (4.0 * std::f64::consts::PI) - 1.0).abs() < 1e-6
        };
        let diffracts = self.diffraction.is_some();
        let share = if diffracts { self.shadow_area / self.scattering } else { 0.0 };
        if self.forward_peak == ForwardPeak::Separate && diffracts && covers_sphere {
            // what the rest does not hold is in the peak, as long as that is the shadow's but for its edge
            let missing = 1.0 - self.left_out - rest;
            let edge = self.peak_edge + self.size_parameter.powf(-2.0 / 3.0);
            let closed = if (missing - share).abs() < edge { missing } else { share };
            return (1.0, sum_before_peak, closed);
        }
        if self.forward_peak != ForwardPeak::CellAverage || !covers_sphere || with <= without {
            return (1.0, sum_before_peak, share);
        }
        // The sum is a + b s + c s² in the root s of the factor: interference of the peak with the rest,
        // and the peak's own power.
        let (once, twice) = (with - without, forward(4.0) - without);
        let own = 0.5 * (twice - 2.0 * once);
        let mixed = once - own;
        let missing = 1.0 - self.left_out - rest - without;
        let discriminant = (mixed * mixed + 4.0 * own * missing).max(0.0);
        let root = (discriminant.sqrt() - mixed) / (2.0 * own);
        let factor = (root.max(0.0).powi(2)).clamp(0.05, 4.0);
        (factor, sum_before_peak, share)
    }

    fn write_forward(
        &self,
        values: &mut Array3<f32>,
        lines: &[Line],
        places: &[(usize, bool)],
        factor: f64,
    ) {
        let scale = self.scale();
        let elements = self.quantity.elements();
        for (j, &(line, mirrored)) in places.iter().enumerate() {
            for (i, sample) in lines[line].forward.iter().enumerate() {
                let mueller = self.forward_mueller(sample, factor);
                for (e, value) in mueller.iter().flatten().take(elements).enumerate() {
                    let sign = if mirrored { mirror_sign(e) } else { 1.0 };
                    values[[e, i, j]] = (sign * value * scale) as f32;
                }
            }
        }
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
