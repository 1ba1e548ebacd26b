//! Means over drop sizes and over a band of wavelengths, with a stated error.
//!
//! The integrand has ever narrower resonances; equal steps in x converge to it only as 1/steps
//! (a gamma distribution about x = 114 needs 5·10⁵ sizes for 1e-4). So the Debye series is cut
//! behind an order Q: up to there the intensity is band-limited in x by the longest path, and the
//! rule of equal steps has no error once the step resolves that path, whatever the number of
//! steps; the orders behind the cut enter by their mean power (`behind.rs`). Q grows until
//! the difference to Q/2 says that the error is met.

use super::mean_sum::{Node, Summed, fine_and_coarse};
use super::{SeriesError, checked_term_count};
use crate::medium::{Medium, MediumError};
use crate::size_distribution::SizeDistribution;
use std::f64::consts::{PI, TAU};

/// What is averaged: spheres of a medium at one wavelength of a table.
#[derive(Clone, Debug)]
pub struct Ensemble<'a> {
    pub sizes: SizeDistribution,
    pub medium: &'a Medium,
    /// Wavelength in vacuum, metres.
    pub wavelength: f64,
    /// Full width at half maximum (metres) of a band about it, of the shape `cos²`; 0: none.
    pub bandwidth: f64,
    /// Relative error asked for.
    pub tolerance: f64,
}

/// Why an average cannot be taken.
#[derive(Debug, thiserror::Error)]
pub enum MeanError {
    #[error(transparent)]
    Series(#[from] SeriesError),
    #[error(transparent)]
    Medium(#[from] MediumError),
    #[error(
        "the average over sizes or wavelengths from size parameter {from:.0} to {to:.0} needs \
         {steps:.1e} spheres: accepted are at most {MAX_STEPS:e}; take a narrower distribution, \
         smaller particles or a larger tolerance"
    )]
    TooLong { from: f64, to: f64, steps: f64 },
    #[error(
        "tolerance = {asked}: the mean at {wavelength_nm} nm is worth {reached:.1e}; ask for less, or \
         have the table marked (model.allow_unmet_tolerance = true, --allow-unmet-tolerance)"
    )]
    Unmet { wavelength_nm: f64, reached: f64, asked: f64 },
}

/// Mean per particle.
#[derive(Clone, Debug)]
pub struct Mean {
    /// S11, S12, S33, S34 by angle as areas per solid angle, m²/sr.
    pub elements: Vec<[f64; 4]>,
    /// Cross-sections, m².
    pub scattering: f64,
    pub absorption: f64,
    pub asymmetry: f64,
    /// Relative error, root mean square over all angles, estimated from half the cut.
    pub error: f64,
    /// Spheres that were solved.
    pub spheres: usize,
}

/// Order of the first cut at a tolerance of 1e-4, and its least; the rest is up to the estimate.
const CUT: (f64, f64) = (28.0, 8.0);
/// Most orders before the cut.
const MAX_CUT: u32 = 256;
/// The longest paths kept that carry light are those of rays near the rim, `2 √(n² - 1)` radii per
/// order; with this margin, and this much for the ways outside, the steps resolve the beat of the
/// last order with diffraction, and more steps change nothing.
const PATH_MARGIN: f64 = 1.1;
const WAYS_OUTSIDE: f64 = 4.0;
/// Most spheres of one average.
const MAX_STEPS: f64 = 1e7;
/// Share of the light in the neglected tails of the distribution, in units of the tolerance.
const TAIL: f64 = 0.2;
/// The largest spheres cost most and count least: those beyond which this share of the light lies
/// have half the orders before the cut, then a quarter. An error falls about as cut⁻⁵.
const RARE: [f64; 2] = [1e-2, 1e-3];
/// Cut Q is at least that much more exact than Q/2 (measured: 2 to 10 times).
const GAIN: f64 = 2.0;
/// Angles at which the two cuts are compared.
const COMPARED: usize = 61;
/// Standard deviation of the band `cos²` in units of its full width at half maximum.
const BAND_DEVIATION: f64 = 0.361_512_4;

impl Ensemble<'_> {
    /// The mean at scattering angles (radians).
    ///
    /// # Errors
    /// A wavelength outside the medium's data, an index the series does not accept, or more
    /// spheres than [`MeanError::TooLong`] allows.
    pub fn mean(&self, theta: &[f64]) -> Result<Mean, MeanError> {
        let spread = !matches!(self.sizes, SizeDistribution::Delta { .. });
        if !(spread && self.bandwidth > 0.0) {
            return self.mean_along_one(theta);
        }
        // Over sizes nothing but the slow change of the index is left of the band: three
        // wavelengths with its mean, variance and skewness are enough.
        let offset = 3f64.sqrt() * BAND_DEVIATION * self.bandwidth;
        let mut total: Option<Mean> = None;
        for (shift, weight) in [(-offset, 1.0 / 6.0), (0.0, 2.0 / 3.0), (offset, 1.0 / 6.0)] {
            let wavelength = self.wavelength + shift;
            let one = Ensemble { wavelength, bandwidth: 0.0, ..self.clone() };
            let mean = one.mean_along_one(theta)?;
            total = Some(match total {
                None => mean.scaled(weight),
                Some(sum) => sum.plus(&mean.scaled(weight)),
            });
        }
        total.ok_or_else(|| SeriesError::SizeParameter(f64::NAN).into())
    }

    /// The mean over sizes, or over wavelengths.
    fn mean_along_one(&self, theta: &[f64]) -> Result<Mean, MeanError> {
        let first = CUT.0 * (1e-4 / self.tolerance).powf(0.2);
        let mut cut = 2 * (0.5 * first.clamp(CUT.1, f64::from(MAX_CUT))).ceil() as u32;
        loop {
            let mean = self.mean_behind(theta, cut)?;
            if mean.error <= self.tolerance || 2 * cut > MAX_CUT {
                return Ok(mean);
            }
            cut *= 2;
        }
    }

    /// Stretches of radii, ascending, each with its cut.
    fn zones(&self, cut: u32) -> Vec<(f64, f64, u32)> {
        let (from, to) = self.sizes.limits(TAIL * self.tolerance);
        let one_size = matches!(self.sizes, SizeDistribution::Delta { .. });
        if one_size || self.sizes.has_steps() {
            return vec![(from, to, cut)];
        }
        let mut out = Vec::new();
        let (mut low, mut cut) = (from, cut);
        for share in RARE {
            let high = self.sizes.limits(share).1.min(to);
            out.push((low, high, cut));
            (low, cut) = (high, 2 * cut.div_ceil(4));
        }
        out.push((low, to, cut));
        out
    }

    /// The spheres between two radii with their weights, in ascending order of x.
    fn nodes(&self, (from, to): (f64, f64), steps: usize) -> Result<Vec<Node>, MeanError> {
        if self.bandwidth > 0.0 {
            let SizeDistribution::Delta { radius } = self.sizes else { return Ok(Vec::new()) };
            return (0..steps).map(|i| self.band_node(radius, i, steps)).collect();
        }
        let index = self.medium.index(self.wavelength)?;
        let (periodic, number) = (self.sizes.has_steps(), self.sizes.number());
        let nodes = (0..steps).map(|i| {
            let t = (i as f64 + 0.5) / steps as f64;
            // sin² steps make a function that ends in a step end smoothly.
            let (place, share) = if periodic {
                (t - (TAU * t).sin() / TAU, 1.0 - (TAU * t).cos())
            } else {
                (t, 1.0)
            };
            let radius = from + (to - from) * place;
            let weight = share * self.sizes.density(radius) * (to - from) / steps as f64 / number;
            Node { radius, wavelength: self.wavelength, index, weight }
        });
        Ok(nodes.collect())
    }

    fn band_node(&self, radius: f64, i: usize, steps: usize) -> Result<Node, MeanError> {
        let (low, high) = (self.wavelength - self.bandwidth, self.wavelength + self.bandwidth);
        let (slow, fast) = (1.0 / high, 1.0 / low);
        let wavenumber = slow + (fast - slow) * (i as f64 + 0.5) / steps as f64;
        let wavelength = 1.0 / wavenumber;
        let place = 0.5 * PI * (wavelength - self.wavelength) / self.bandwidth;
        // cos² by wavelength with the integral 1, dλ = λ² dν.
        let width = (fast - slow) / steps as f64;
        let weight = place.cos().powi(2) * wavelength * wavelength * width / self.bandwidth;
        Ok(Node { radius, wavelength, index: self.medium.index(wavelength)?, weight })
    }

    /// The mean with the series cut behind an order, and its difference to half that order.
    fn mean_behind(&self, theta: &[f64], cut: u32) -> Result<Mean, MeanError> {
        let compared: Vec<f64> =
            (0..COMPARED).map(|i| PI * i as f64 / (COMPARED - 1) as f64).collect();
        let all: Vec<f64> = theta.iter().chain(&compared).copied().collect();
        let (mut spheres, mut sums): (usize, Option<[Summed; 2]>) = (0, None);
        for (from, to, cut) in self.zones(cut) {
            let nodes = self.nodes((from, to), self.steps((from, to), cut)?)?;
            spheres += nodes.len();
            let zone = fine_and_coarse(&nodes, cut, &all, &compared)?;
            sums = Some(match sums {
                None => zone,
                Some([fine, coarse]) => {
                    let [more, more_coarse] = zone;
                    [Summed::plus(fine, &more), Summed::plus(coarse, &more_coarse)]
                }
            });
        }
        let Some([mut fine, coarse]) = sums else {
            return Err(SeriesError::SizeParameter(f64::NAN).into());
        };
        let at_compared = fine.elements.split_off(theta.len());
        Ok(Mean {
            elements: fine.elements,
            scattering: fine.scattering,
            absorption: fine.absorption,
            asymmetry: fine.asymmetry,
            error: difference(&at_compared, &coarse.elements) / GAIN,
            spheres,
        })
    }

    /// Number of steps between two radii with the series cut behind an order: even.
    fn steps(&self, (from, to): (f64, f64), cut: u32) -> Result<usize, MeanError> {
        let reach = self.bandwidth;
        let (from, to) =
            (TAU * from / (self.wavelength + reach), TAU * to / (self.wavelength - reach));
        let index = self.medium.index(self.wavelength)?;
        let per_order = 2.0 * (index.re * index.re - 1.0).max(0.06).sqrt();
        let longest = PATH_MARGIN * per_order * f64::from(cut) + WAYS_OUTSIDE;
        let stretch = if self.sizes.has_steps() { 2.0 } else { 1.0 };
        let steps = stretch * (to - from) * longest / TAU;
        if steps > MAX_STEPS {
            return Err(MeanError::TooLong { from, to, steps });
        }
        checked_term_count(to, index)?;
        Ok(2 * (0.5 * steps.max(64.0)).ceil() as usize)
    }
}

impl Mean {
    fn scaled(mut self, factor: f64) -> Mean {
        self.elements.iter_mut().flatten().for_each(|value| *value *= factor);
        self.scattering *= factor;
        self.absorption *= factor;
        self.error *= factor;
        self
    }

    fn plus(mut self, other: &Mean) -> Mean {
        let pairs = self.elements.iter_mut().flatten().zip(other.elements.iter().flatten());
        pairs.for_each(|(sum, value)| *sum += value);
        let scattering = self.scattering + other.scattering;
        self.asymmetry =
            (self.asymmetry * self.scattering + other.asymmetry * other.scattering) / scattering;
        self.scattering = scattering;
        self.absorption += other.absorption;
        self.error += other.error;
        self.spheres += other.spheres;
        self
    }
}

/// Root mean square of the relative difference of S11.
fn difference(fine: &[[f64; 4]], coarse: &[[f64; 4]]) -> f64 {
    let squares = fine.iter().zip(coarse).map(|(a, b)| (b[0] / a[0] - 1.0).powi(2));
    (squares.sum::<f64>() / fine.len() as f64).sqrt()
}
