//! One wavelength of a table of facets: means over orientations, the forward peak in its cells, errors.

use super::mean::{Azimuths, Request, Sums};
use super::orientation::Stand;
use crate::optics::mirror_sign;
use crate::phase_table::{
    Axes, ERROR_BANDS, EnergyBudget, ForwardPeak, MethodPart, Quantity, Slab, error_theta,
};
use crate::series::table::coarse_cells;
use ndarray::Array3;

/// What a slab is made for.
#[derive(Clone, Copy, Debug)]
pub struct TableJob<'a> {
    /// Crystal, stand and light; angles are those of the table.
    pub request: Request<'a>,
    /// Wavelength in vacuum, metres.
    pub wavelength: f64,
    /// Radius of the sphere of equal volume, metres.
    pub radius: f64,
    /// Of the table.
    pub axes: &'a Axes,
    /// For each azimuth of the table which computed one serves it, and whether as mirror image.
    pub places: &'a [(usize, bool)],
    /// What is tabulated.
    pub quantity: Quantity,
    /// How the forward peak enters.
    pub forward_peak: ForwardPeak,
    /// Relative error asked for.
    pub tolerance: f64,
    /// Relative error of intensities that plane waves on facets are expected to have at this size.
    pub method_error: f64,
}

/// Azimuths of one orientation in a mean over all of them: one block of lanes.
pub const AZIMUTHS: usize = 8;

impl TableJob<'_> {
    /// The slab; over the whole sphere its values add up to 1 where the forward peak is averaged.
    pub fn slab(&self) -> Slab {
        let random = self.request.stand == Stand::Random;
        let cells = match self.forward_peak {
            ForwardPeak::CellAverage => {
                coarse_cells(&self.axes.theta, self.request.light.size_parameter)
            }
            _ => Vec::new(),
        };
        let replicas = Request { cells: &cells, ..self.request }.replicas();
        let mut sums = Sums::mean(&replicas);
        let elements = self.quantity.elements();
        if random {
            sums.mueller.chunks_mut(elements).for_each(mirrored);
        }
        let columns = sums.mueller.len() / (elements * self.axes.theta.len());
        let k2 = self.request.light.size_parameter.powi(2);
        let power = sums.scattering * k2;
        let (theta, phi) = (self.axes.theta.len(), self.axes.phi.len());
        let value = |sums: &Sums, e: usize, i: usize, j: usize| {
            let (column, mirror) = self.places[j];
            let sign = if mirror { mirror_sign(e) } else { 1.0 };
            sign * sums.mueller[(i * columns + column) * elements + e]
        };
        let weights = self.axes.solid_angle();
        let row_sum = |i: usize| -> f64 {
            (0..phi).map(|j| value(&sums, 0, i, j) * weights[[i, j]]).sum::<f64>() / power
        };
        let rows: Vec<f64> = (0..theta).map(row_sum).collect();
        let sum_before_peak: f64 = rows.iter().sum();
        let closing = self.closing(&rows, cells.len());
        let values = Array3::from_shape_fn((elements, theta, phi), |(e, i, j)| {
            let factor = if i < closing.rows { closing.factor } else { 1.0 };
            (value(&sums, e, i, j) * factor / power) as f32
        });
        let errors = self.errors(&replicas, &sums, columns, elements);
        let area = self.radius * self.radius;
        let extinction = sums.extinction.max(sums.absorption);
        let budget = budget(&sums);
        let (error, by_band) = errors.means();
        let lost = (sums.scattering / (extinction - sums.absorption) - 1.0).abs();
        let (error_estimate, error_by_band) = (error.max(lost), by_band.max(lost));
        Slab {
            wavelength: self.wavelength,
            index: self.request.light.index,
            outside_index: 1.0,
            values,
            caustic_order: None,
            scattering_cross_section: (extinction - sums.absorption) * area,
            extinction_cross_section: extinction * area,
            absorption_cross_section: sums.absorption * area,
            forward_extinction: Some(extinction * area),
            asymmetry: (sums.forward / sums.scattering).clamp(-1.0, 1.0),
            energy: Some(budget),
            sum_before_peak,
            peak_share: 0.0,
            error_estimate,
            error_by_band,
            tolerance_met: Some(error_estimate <= self.tolerance),
            error_by_direction: errors.by_direction(),
            left_out: 0.0,
            methods: vec![self.part(&sums, lost, errors.sampling())],
        }
    }

    /// What makes the samples of a whole sphere add up to 1: the coarse cells of the forward peak, or all.
    fn closing(&self, rows: &[f64], cells: usize) -> Closing {
        if self.forward_peak != ForwardPeak::CellAverage || !self.axes.cover_sphere() {
            return Closing { rows: 0, factor: 1.0 };
        }
        let (peak, rest): (f64, f64) = (rows[..cells].iter().sum(), rows[cells..].iter().sum());
        let factor = (1.0 - rest) / peak;
        if cells > 0 && (0.5..2.0).contains(&factor) {
            return Closing { rows: cells, factor };
        }
        Closing { rows: rows.len(), factor: 1.0 / (peak + rest) }
    }

    /// Scatter of replicas by band of scattering angle.
    fn errors(&self, replicas: &[Sums], sums: &Sums, columns: usize, elements: usize) -> Errors {
        let total = |sums: &Sums, i: usize| -> f64 {
            (0..columns).map(|c| sums.mueller[(i * columns + c) * elements]).sum()
        };
        let mut bands = Band::none();
        let count = replicas.len() as f64;
        for i in 0..self.axes.theta.len() {
            let mean = total(sums, i);
            let square: f64 = replicas.iter().map(|r| (total(r, i) - mean).powi(2)).sum();
            let variance = if count > 1.0 { square / (count * (count - 1.0)) } else { 0.0 };
            Band::at(&mut bands, self.axes.theta[i]).add(mean * mean, variance, 1.0);
        }
        Errors::new(bands, self.method_error)
    }

    /// How the table came about, in words.
    fn part(&self, sums: &Sums, lost: f64, sampling: f64) -> MethodPart {
        let request = &self.request;
        let stand = match request.stand {
            Stand::Fixed { .. } => "one orientation".to_string(),
            stand => {
                let count = request.count * request.replicas;
                let how = match stand {
                    Stand::Random => "at random",
                    Stand::Upright { .. } => "with upright axis",
                    _ => "with horizontal axis",
                };
                format!(
                    "{count} orientations {how}, {} replicas of a scrambled Sobol sequence, whose scatter \
                     is {:.2} % of the intensity",
                    request.replicas,
                    100.0 * sampling
                )
            }
        };
        let area = self.radius * self.radius;
        MethodPart {
            order: None,
            method: "beams of flat facets, each with its diffraction".into(),
            reason: format!(
                "a convex body of {} facets; {stand}; {:.0} polygons each; twice the shadow is {:.4e} m², \
                 the power over all directions {:.1} % off the optical theorem",
                request.body.facets().len(),
                sums.polygons,
                2.0 * sums.shadow * area,
                100.0 * lost
            ),
            expected_error: Some(self.method_error),
            ..MethodPart::default()
        }
    }
}

/// The first rows of a table, and what they are multiplied by.
struct Closing {
    rows: usize,
    factor: f64,
}

/// Sums over the samples of a band.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Band {
    square: f64,
    variance: f64,
    samples: f64,
}

impl Band {
    /// All bands, empty.
    pub(super) fn none() -> [Band; ERROR_BANDS] {
        [Band::default(); ERROR_BANDS]
    }

    /// That of a scattering angle.
    pub(super) fn at(bands: &mut [Band; ERROR_BANDS], theta: f64) -> &mut Band {
        let number = (theta / error_theta(1)).round() as usize;
        &mut bands[number.min(ERROR_BANDS - 1)]
    }

    /// One sample more: its square, its variance, and how much it counts.
    pub(super) fn add(&mut self, square: f64, variance: f64, samples: f64) {
        self.square += square;
        self.variance += variance;
        self.samples += samples;
    }
}

/// Errors by scattering angle: of the method, and of the number of orientations.
pub(super) struct Errors {
    bands: [Band; ERROR_BANDS],
    method: f64,
}

impl Errors {
    /// Of the scatter in each band and the relative error of the method.
    pub(super) fn new(bands: [Band; ERROR_BANDS], method: f64) -> Self {
        Self { bands, method }
    }

    /// Bands that count in the means: without the forward peak and its mirror image.
    const COUNTED: std::ops::Range<usize> = 3..43;

    fn relative(&self, band: &Band) -> f64 {
        let sampling = if band.square > 0.0 { band.variance / band.square } else { 0.0 };
        sampling + self.method * self.method
    }

    pub(super) fn by_direction(&self) -> [f64; ERROR_BANDS] {
        let of =
            |band: &Band| if band.samples > 0.0 { self.relative(band).sqrt() } else { f64::NAN };
        std::array::from_fn(|k| of(&self.bands[k]))
    }

    /// Weighted by intensity, and by band.
    pub(super) fn means(&self) -> (f64, f64) {
        let seen = || self.bands[Self::COUNTED].iter().filter(|band| band.samples > 0.0);
        let (mut squares, mut total, mut bands, mut count) = (0.0, 0.0, 0.0, 0.0);
        for band in seen() {
            let weight = band.square / band.samples;
            squares += self.relative(band) * weight;
            total += weight;
            bands += self.relative(band);
            count += 1.0;
        }
        // no band is seen, or none has light
        if count == 0.0 || total == 0.0 {
            return (self.method, self.method);
        }
        (f64::sqrt(squares / total), f64::sqrt(bands / count))
    }

    /// Share of the intensity by which the number of orientations leaves it open.
    pub(super) fn sampling(&self) -> f64 {
        (self.means().1.powi(2) - self.method * self.method).max(0.0).sqrt()
    }
}

/// Shares of the light on the mean shadow.
pub(super) fn budget(sums: &Sums) -> EnergyBudget {
    let share = |area: f64| area / sums.shadow;
    let left_by_order: Vec<f64> = sums.left_by_order.iter().map(|&area| share(area)).collect();
    let [totally_reflected, truncated] = sums.trapped.map(share);
    let absorbed = share(sums.absorption);
    let told = left_by_order.iter().sum::<f64>() + absorbed + totally_reflected + truncated;
    EnergyBudget { residual: 1.0 - told, left_by_order, absorbed, totally_reflected, truncated }
}

/// A mean with all mirror images: what changes sign in them vanishes, and by reciprocity S12 is S21, S34
/// the opposite of S43.
fn mirrored(mueller: &mut [f64]) {
    if mueller.len() < 16 {
        return;
    }
    for (element, value) in mueller.iter_mut().enumerate() {
        if mirror_sign(element) < 0.0 {
            *value = 0.0;
        }
    }
    let linear = 0.5 * (mueller[1] + mueller[4]);
    (mueller[1], mueller[4]) = (linear, linear);
    let circular = 0.5 * (mueller[11] - mueller[14]);
    (mueller[11], mueller[14]) = (circular, -circular);
}

/// Azimuths of a request by the stand.
pub fn azimuths(stand: Stand, computed: &[f64]) -> Azimuths<'_> {
    match stand {
        Stand::Random => Azimuths::Mean(AZIMUTHS),
        _ => Azimuths::At(computed),
    }
}

#[cfg(test)]
mod tests;
