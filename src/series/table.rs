//! A slab of a phase table from the exact series: a sphere needs one azimuth only.
//!
//! Where cells of the θ axis are coarser than the lobes of the forward peak, a sample holds the mean
//! over its cell; what the samples of the rest of the sphere miss of the exact scattering
//! cross-section (their ripple is finer than the cells) is closed there too, by one factor.
//!
//! Means over drop sizes, over a band of wavelengths and over the sun's disc enter here
//! ([`super::mean`], `sun_disc.rs`); cross-sections are then those of the mean particle.

use super::curves::{Curves, SERIES_ERROR};
use super::debye::{DebyeSeries, Term};
use super::debye_error::BandErrors;
use super::layered::Layered;
use super::layered::mean::RadialEnsemble;
use super::lorenz_mie::{Sphere, sums};
use super::mean::{Ensemble, MeanError};
use super::{SeriesError, elements};
use crate::color::LimbDarkening;
use crate::medium::Medium;
use crate::phase_table::{Axes, ForwardPeak, Quantity, Slab};
use crate::scene::SunDisc;
use crate::size_distribution::SizeDistribution;
use crate::sun_disc::DiscMean;
use ndarray::Array3;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// What is summed.
#[derive(Clone, Debug)]
pub enum Source {
    /// The whole series.
    LorenzMie,
    /// Debye terms; their sum is normalised with the exact scattering cross-section. Of one size
    /// and one wavelength only.
    Debye(Vec<Term>),
}

/// Spheres and their light.
#[derive(Clone, Debug)]
pub struct SphereJob<'a> {
    /// Which series.
    pub source: Source,
    /// Of the spheres.
    pub sizes: SizeDistribution,
    /// What they are made of.
    pub medium: &'a Medium,
    /// In the surroundings, metres.
    pub wavelength: f64,
    /// Full width at half maximum of a band about it, in the surroundings, metres; 0: none.
    pub bandwidth: f64,
    /// What the sun's disc does.
    pub sun_disc: SunDisc,
    /// Relative error of means asked for.
    pub tolerance: f64,
    /// A mean that misses it is marked in the slab rather than an error.
    pub allow_unmet: bool,
}

/// Lobes of the forward peak that are averaged over cells, and samples per lobe.
const LOBES: f64 = 20.0;
const SAMPLES_PER_LOBE: f64 = 8.0;
/// Step of θ, in lobes, from which on cells hold means. The sum over point samples is off by about
/// 0.01 (step x)², so that with finer steps it misses 1 by less than 1e-3.
const COARSE: f64 = 0.08;
/// Relative error of the amplitudes of a radial profile in units of the tolerance: 1e-9 at 1 %, so
/// that behind, where they are a hundred times smaller than in the forward peak, it is below 1e-7.
pub const PROFILE_ERROR: f64 = 1e-7;
/// Relative error of a mean over the sun's disc, see [`super::sun_disc`].
const DISC_ERROR: f64 = 3e-4;

/// One wavelength of a table of spheres: `theta` ascending, radians. The values have one azimuth.
///
/// # Errors
/// A wavelength outside the medium's data, an index or size parameter that the series does not
/// accept, or a mean over too many spheres.
pub fn sphere_slab(
    job: &SphereJob,
    theta: &[f64],
    quantity: Quantity,
    forward_peak: ForwardPeak,
) -> Result<Slab, MeanError> {
    let wavelength = job.wavelength;
    let index = match job.medium.body(wavelength, job.sizes.effective_radius())? {
        Some(body) => body.surface(),
        None => job.medium.index(wavelength)?,
    };
    let largest = TAU * job.sizes.limits(job.tolerance, TAU / wavelength).1 / wavelength;
    let mut cells = Vec::new();
    if forward_peak == ForwardPeak::CellAverage {
        cells = coarse_cells(theta, largest);
    }
    let within: Vec<(Vec<f64>, Vec<f64>)> =
        cells.iter().map(|&(low, high)| samples(low, high, largest)).collect();
    let angles: Vec<f64> =
        theta.iter().chain(within.iter().flat_map(|(angles, _)| angles)).copied().collect();
    let curves = job.seen(largest, index, &angles)?;

    let scale = 1.0 / curves.scattering;
    let (mut elements, mut rest) = (curves.elements, Vec::new());
    if !cells.is_empty() {
        rest = elements.split_off(theta.len());
    }
    let axes = Axes { wavelength: vec![wavelength], theta: theta.to_vec(), phi: vec![0.0] };
    let weights = axes.solid_angle();
    let sum = |rows: &[[f64; 4]]| -> f64 {
        rows.iter().zip(&weights).map(|(row, w)| row[0] * scale * w).sum()
    };
    let sum_before_peak = sum(&elements);
    let mut taken = 0;
    for (i, (angles, shares)) in within.iter().enumerate() {
        elements[i] = mean(&rest[taken..taken + angles.len()], shares);
        taken += angles.len();
    }
    let total: f64 = weights.sum();
    if (total / (4.0 * PI) - 1.0).abs() < 1e-6 && !cells.is_empty() {
        let peak = sum(&elements[..cells.len()]);
        let factor = ((1.0 - curves.left_out - sum(&elements) + peak) / peak).clamp(0.5, 2.0);
        elements[..cells.len()].iter_mut().flatten().for_each(|m| *m *= factor);
    }
    let values = Array3::from_shape_fn((quantity.elements(), theta.len(), 1), |(e, i, _)| {
        (of_sphere(&elements[i], e) * scale) as f32
    });
    let weighted = curves.errors.weighted;
    Ok(Slab {
        wavelength,
        index,
        outside_index: 1.0,
        values,
        caustic_order: None,
        scattering_cross_section: curves.scattering,
        extinction_cross_section: curves.extinction,
        absorption_cross_section: curves.absorption,
        forward_extinction: curves.forward,
        asymmetry: curves.asymmetry,
        energy: None,
        sum_before_peak,
        peak_share: 0.0,
        error_estimate: weighted,
        error_by_band: curves.errors.by_band,
        tolerance_met: (!weighted.is_nan()).then_some(weighted <= job.tolerance),
        error_by_direction: curves.errors.by_direction,
        left_out: curves.left_out,
        methods: Vec::new(),
    })
}

/// Element `e` (row by row) of a sphere's Mueller matrix from S11, S12, S33, S34.
fn of_sphere(elements: &[f64; 4], e: usize) -> f64 {
    match e {
        0 | 5 => elements[0],
        1 | 4 => elements[1],
        10 | 15 => elements[2],
        11 => elements[3],
        14 => -elements[3],
        _ => 0.0,
    }
}

impl SphereJob<'_> {
    /// The curves as seen with the sun's disc, for spheres up to a size parameter.
    fn seen(&self, largest: f64, index: Complex64, theta: &[f64]) -> Result<Curves, MeanError> {
        let limb = match self.sun_disc {
            SunDisc::None => return self.curves(index, theta),
            SunDisc::Uniform => None,
            SunDisc::LimbDarkened => Some(LimbDarkening::at(self.medium.vacuum(self.wavelength)?)),
        };
        let disc = DiscMean::new(largest, limb);
        let mut curves = self.curves(index, &disc.fine_angles())?;
        curves.elements = disc.means(&curves.elements, theta);
        curves.errors = curves.errors.at_least(DISC_ERROR);
        Ok(curves)
    }

    /// The curves of a point-like sun.
    fn curves(&self, index: Complex64, theta: &[f64]) -> Result<Curves, MeanError> {
        let radius = match self.sizes.single() {
            Some(radius) if self.bandwidth == 0.0 => radius,
            _ => return self.mean_curves(theta),
        };
        let x = TAU * radius / self.wavelength;
        let area = (self.wavelength / TAU).powi(2);
        if let Some(body) = self.medium.body(self.wavelength, radius)? {
            let sphere = Layered::body(x, &body, PROFILE_ERROR * self.tolerance)?;
            return Ok(Curves::of_layered(&sphere, theta, radius, self.wavelength));
        }
        let sphere = Sphere::new(x, index)?;
        let (amplitudes, forward, left_out, errors) = match &self.source {
            Source::LorenzMie => {
                let (s1, s2) = sphere.amplitudes(&[0.0])[0];
                let forward = TAU * area * (s1 + s2).re;
                (
                    sphere.amplitudes_parallel(theta),
                    Some(forward),
                    0.0,
                    BandErrors::even(SERIES_ERROR),
                )
            }
            // Cross-sections are those of the whole sphere, the terms part of it.
            Source::Debye(terms) => {
                let series = DebyeSeries::new(x, index)?;
                let (a, b) = series.coefficients(terms);
                let scattered = 2.0 / (x * x) * sums(&a, &b).0;
                let left_out = 1.0 - scattered / sphere.efficiencies().q_sca;
                if !(-1.0..=1.0).contains(&left_out) {
                    return Err(cancelling(1.0 - left_out).into());
                }
                if left_out == 1.0 {
                    return Err(faded(scattered).into());
                }
                let errors = BandErrors::of_terms(&series, terms, &sphere).at_least(SERIES_ERROR);
                // Of all terms together, by way of the Debye coefficients.
                let (s1, s2) = series.sum(&[Term::All], &[0.0])[0];
                let forward = TAU * area * (s1 + s2).re;
                (series.sum_parallel(terms, theta), Some(forward), left_out, errors)
            }
        };
        let shadow = PI * radius * radius;
        let q = sphere.efficiencies();
        Ok(Curves {
            elements: amplitudes.into_iter().map(|pair| elements(pair, area)).collect(),
            scattering: q.q_sca * shadow,
            extinction: q.q_ext * shadow,
            absorption: q.q_abs * shadow,
            forward,
            asymmetry: q.asymmetry,
            left_out,
            errors,
        })
    }

    fn mean_curves(&self, theta: &[f64]) -> Result<Curves, MeanError> {
        if self.medium.radial().is_some() {
            let ensemble = RadialEnsemble {
                sizes: &self.sizes,
                medium: self.medium,
                wavelength: self.wavelength,
                bandwidth: self.bandwidth,
                tolerance: self.tolerance,
                accept_unmet: self.allow_unmet,
            };
            return Ok(Curves::of_mean(ensemble.mean(theta)?));
        }
        let ensemble = Ensemble {
            sizes: self.sizes.clone(),
            medium: self.medium,
            wavelength: self.wavelength,
            bandwidth: self.bandwidth,
            tolerance: self.tolerance,
            accept_unmet: self.allow_unmet,
        };
        Ok(Curves::of_mean(ensemble.mean(theta)?))
    }
}

/// Terms of a small or soft sphere are far larger than what is left when all of them are added up.
fn cancelling(times: f64) -> SeriesError {
    SeriesError::Invalid {
        field: "model.orders",
        value: format!("terms that scatter {times:.1e} times as much as the sphere"),
        accepted: "Debye terms of spheres that are not small, soft or below n = 1, where they cancel \
                   but for a small rest; method = \"mie\" has that rest",
    }
}

/// Terms of which nothing is left beside the whole: a phase function of them would be rounding alone.
fn faded(scattered: f64) -> SeriesError {
    SeriesError::Invalid {
        field: "model.orders",
        value: format!("terms with a scattering efficiency of {scattered:.1e}"),
        accepted: "orders whose light is not absorbed inside; method = \"mie\" has the whole",
    }
}

/// Cells about the forward direction that are coarser than [`COARSE`]. The cell at 0 is half as wide
/// as its neighbour: it is the step that counts, else no cell would ever follow a fine first one.
pub(crate) fn coarse_cells(theta: &[f64], size_parameter: f64) -> Vec<(f64, f64)> {
    let last = theta.len() - 1;
    let cell = |i: usize| {
        let low = if i == 0 { theta[0] } else { 0.5 * (theta[i - 1] + theta[i]) };
        let high = if i == last { theta[last] } else { 0.5 * (theta[i] + theta[i + 1]) };
        (low, high)
    };
    let reach = LOBES * PI / size_parameter;
    let step = |i: usize| if i < last { theta[i + 1] - theta[i] } else { theta[i] - theta[i - 1] };
    let coarse = |&i: &usize| cell(i).0 < reach && step(i) * size_parameter > COARSE * PI;
    (0..theta.len()).take_while(coarse).map(cell).collect()
}

/// Angles within a cell and their shares of its solid angle.
pub(crate) fn samples(low: f64, high: f64, size_parameter: f64) -> (Vec<f64>, Vec<f64>) {
    let lobes = (high - low) * size_parameter / PI;
    let count = (lobes * SAMPLES_PER_LOBE).ceil().clamp(4.0, 65536.0) as usize;
    let angles: Vec<f64> =
        (0..count).map(|k| low + (high - low) * (k as f64 + 0.5) / count as f64).collect();
    let total: f64 = angles.iter().map(|t| t.sin()).sum();
    let shares = angles.iter().map(|t| t.sin() / total).collect();
    (angles, shares)
}

fn mean(rows: &[[f64; 4]], shares: &[f64]) -> [f64; 4] {
    let mut sum = [0.0; 4];
    for (row, share) in rows.iter().zip(shares) {
        sum.iter_mut().zip(row).for_each(|(to, from)| *to += share * from);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever the step is to the lobes: P times solid angle sums to 1.
    #[test]
    fn values_sum_to_one_on_any_grid() {
        for radius in [1e-6, 2e-6, 5e-6, 2e-5, 8e-5] {
            for count in [46, 91, 181, 361, 721, 1801, 3601] {
                let theta: Vec<f64> =
                    (0..count).map(|i| PI * i as f64 / (count - 1) as f64).collect();
                let job = SphereJob {
                    source: Source::LorenzMie,
                    sizes: SizeDistribution::delta(radius),
                    medium: &Medium::Constant(Complex64::new(1.333, 0.0)),
                    wavelength: 5e-7,
                    bandwidth: 0.0,
                    sun_disc: SunDisc::None,
                    tolerance: 1e-3,
                    allow_unmet: false,
                };
                let (quantity, peak) = (Quantity::PhaseFunction, ForwardPeak::CellAverage);
                let slab = sphere_slab(&job, &theta, quantity, peak).unwrap();
                let axes = Axes { wavelength: vec![5e-7], theta, phi: vec![0.0] };
                let sum = slab.sum(&axes);
                assert!((sum - 1.0).abs() < 1e-3, "{radius} m, {count} angles: {sum}");
            }
        }
    }
}
