//! Means over drop sizes and over a band of wavelengths, with a stated error.
//!
//! The integrand has ever narrower resonances; equal steps in x converge to it only as 1/steps
//! (a gamma distribution about x = 114 needs 5·10⁵ sizes for 1e-4). So for spheres that have narrow
//! resonances the Debye series is cut behind an order Q: up to there the intensity is band-limited
//! in x by the longest path, and the rule of equal steps has no error once the step resolves that
//! path, whatever the number of steps; the orders behind the cut enter by their mean power
//! (`behind.rs`), absorption without its beats. Q grows until the difference to Q/2 says that the
//! error is met.
//!
//! Small spheres have no narrow resonances, and too few waves for orders to average out: they enter
//! with their exact coefficients on Gauss panels, halved until they agree (`mean_nodes.rs`).

use super::SeriesError;
use super::mean_nodes::{Line, ZoneError};
use super::mean_sum::{Summed, exact, fine_and_coarse};
use crate::fault::{Blame, Fault};
use crate::medium::{Medium, MediumError};
use crate::size_distribution::SizeDistribution;
use std::f64::consts::PI;

/// What is averaged: spheres of a medium at one wavelength of a table.
#[derive(Clone, Debug)]
pub struct Ensemble<'a> {
    /// Number of spheres by radius.
    pub sizes: SizeDistribution,
    /// What they are made of.
    pub medium: &'a Medium,
    /// Wavelength in vacuum, metres.
    pub wavelength: f64,
    /// Full width at half maximum (metres) of a band about it, of the shape `cos²`; 0: none.
    pub bandwidth: f64,
    /// Relative error asked for.
    pub tolerance: f64,
    /// Whether a mean that does not meet it is given all the same, with its error.
    pub accept_unmet: bool,
}

/// Why an average cannot be taken.
#[derive(Debug, thiserror::Error)]
pub enum MeanError {
    /// A size or an index that the series does not accept.
    #[error(transparent)]
    Series(#[from] SeriesError),
    /// A wavelength outside the data.
    #[error(transparent)]
    Medium(#[from] MediumError),
    /// More spheres than anybody would wait for.
    #[error(
        "the average over sizes or wavelengths from size parameter {from:.0} to {to:.0} needs \
         {steps:.1e} spheres: accepted are at most {MAX_STEPS:e}; take a narrower distribution, \
         smaller particles or a larger tolerance"
    )]
    TooLong {
        /// Least size parameter.
        from: f64,
        /// Largest size parameter.
        to: f64,
        /// Number of spheres.
        steps: f64,
    },
    /// The error asked for is out of reach.
    #[error(
        "the average over sizes or wavelengths did not converge: relative error {reached:.1e} with \
         {spheres} spheres, asked for {asked:e}; take a larger tolerance, or have \
         the table marked (model.allow_unmet_tolerance = true, --allow-unmet-tolerance)"
    )]
    NotMet {
        /// The tolerance.
        asked: f64,
        /// The least error that was reached.
        reached: f64,
        /// Spheres of the last attempt.
        spheres: usize,
    },
}

impl Blame for MeanError {
    fn fault(&self) -> Fault {
        match self {
            MeanError::Series(error) => error.fault(),
            MeanError::Medium(error) => error.fault(),
            MeanError::TooLong { .. } => Fault::Input,
            MeanError::NotMet { .. } => Fault::Run,
        }
    }
}

/// Mean per particle.
#[derive(Clone, Debug)]
pub struct Mean {
    /// S11, S12, S33, S34 by angle as areas per solid angle, m²/sr.
    pub elements: Vec<[f64; 4]>,
    /// Scattering cross-section, m².
    pub scattering: f64,
    /// Absorption cross-section, m².
    pub absorption: f64,
    /// Extinction by the optical theorem on the mean amplitudes straight ahead, m²: scattering and
    /// absorption by another way.
    pub forward_extinction: f64,
    /// Mean cosine of the scattering angle.
    pub asymmetry: f64,
    /// Relative error: the largest of that of S11, root mean square over all angles, of scattering
    /// and of absorption, estimated from half the cut and from panels twice as wide; and the share of the
    /// light in the tails of the distribution, which is left out.
    pub error: f64,
    /// Spheres that were solved.
    pub spheres: usize,
}

/// Order of the first cut at a tolerance of 1e-4, its least and its most.
const CUT: (f64, f64, f64) = (28.0, 8.0, 256.0);
/// Most orders before the cut.
const MAX_CUT: u32 = 1 << 14;
/// Most spheres of one average.
const MAX_STEPS: f64 = 1e7;
/// Most halvings of the panels.
const MAX_LEVEL: u32 = 12;
/// Share of the light in the neglected tails of the distribution, in units of the tolerance.
const TAIL: f64 = 0.2;
/// Cut Q is at least that much more exact than Q/2 (measured: 2 to 10 times).
const GAIN: f64 = 2.0;
/// Angles at which the two are compared.
const COMPARED: usize = 61;
/// Standard deviation of the band `cos²` in units of its full width at half maximum.
const BAND_DEVIATION: f64 = 0.361_512_4;
/// What three places on the narrower of two distributions leave, in units of the sixth power of the
/// ratio of their widths.
const THREE_PLACES: f64 = 1.0 / 8.0;
/// Least number of wavelengths of a band that is about as wide as the distribution of sizes.
const LEAST_BAND: f64 = 16.0;

/// A part of the spheres summed more finely.
enum Finer {
    Small(Compared),
    Large(Compared),
}

/// One way of summing a part of the spheres, and the coarser one it is compared with.
struct Compared {
    /// At the asked angles, then at those of the comparison.
    fine: Summed,
    /// At those of the comparison alone.
    coarse: Summed,
    spheres: usize,
}

impl Ensemble<'_> {
    /// The mean at scattering angles (radians).
    ///
    /// # Errors
    /// A wavelength outside the medium's data, an index the series does not accept, more spheres than
    /// [`MeanError::TooLong`] allows, or a tolerance that is not met (unless that is accepted).
    pub fn mean(&self, theta: &[f64]) -> Result<Mean, MeanError> {
        let one_size = self.sizes.single();
        if self.bandwidth > 0.0 && one_size.is_none() {
            return self.over_both(theta);
        }
        let line = match one_size {
            Some(radius) if self.bandwidth > 0.0 => self.band(radius),
            _ => {
                let index = self.medium.index(self.wavelength)?;
                Line::Sizes { sizes: &self.sizes, wavelength: self.wavelength, index }
            }
        };
        self.along(&line, theta)
    }

    fn band(&self, radius: f64) -> Line<'_> {
        Line::Band { radius, centre: self.wavelength, width: self.bandwidth, medium: self.medium }
    }

    /// Over sizes and a band: along the wider of the two nothing but a slow change is left of the
    /// narrower one, of which three places with its mean and variance are enough.
    fn over_both(&self, theta: &[f64]) -> Result<Mean, MeanError> {
        let spread = self.sizes.effective_variance().sqrt();
        let ratio = BAND_DEVIATION * self.bandwidth / self.wavelength / spread;
        let three = |deviation: f64| {
            let offset = 3f64.sqrt() * deviation;
            [(-offset, 1.0 / 6.0), (0.0, 2.0 / 3.0), (offset, 1.0 / 6.0)]
        };
        let mut total: Option<Mean> = None;
        let mut add = |mean: Mean, weight: f64| {
            let part = mean.scaled(weight);
            total = Some(match total.take() {
                None => part,
                Some(sum) => sum.plus(&part),
            });
        };
        if THREE_PLACES * ratio.powi(-6) < self.tolerance {
            let mean = self.sizes.moment(1.0);
            let deviation = (self.sizes.moment(2.0) - mean * mean).max(0.0).sqrt();
            for (shift, weight) in three(deviation) {
                add(self.along(&self.band(mean + shift), theta)?, weight);
            }
        } else if THREE_PLACES * ratio.powi(6) < self.tolerance {
            for (shift, weight) in three(BAND_DEVIATION * self.bandwidth) {
                add(self.at(self.wavelength + shift, theta)?, weight);
            }
        } else {
            let count = (2.0 * self.bandwidth / self.wavelength / spread).max(LEAST_BAND).ceil();
            for i in 0..count as usize {
                let offset = 2.0 * (i as f64 + 0.5) / count - 1.0;
                let weight = (0.5 * PI * offset).cos().powi(2) * 2.0 / count;
                add(self.at(self.wavelength + offset * self.bandwidth, theta)?, weight);
            }
        }
        total.ok_or_else(|| SeriesError::SizeParameter(f64::NAN).into())
    }

    /// Over sizes at another wavelength.
    fn at(&self, wavelength: f64, theta: &[f64]) -> Result<Mean, MeanError> {
        Ensemble { wavelength, bandwidth: 0.0, ..self.clone() }.mean(theta)
    }

    /// The mean along one line: each of its two parts is made finer until together they are exact
    /// enough.
    fn along(&self, line: &Line, theta: &[f64]) -> Result<Mean, MeanError> {
        let compared = (0..COMPARED).map(|i| PI * i as f64 / (COMPARED - 1) as f64);
        let all: Vec<f64> = theta.iter().copied().chain(compared).collect();
        let first = CUT.0 * (1e-4 / self.tolerance).powf(0.2);
        let mut cut = 2 * (0.5 * first.clamp(CUT.1, CUT.2)).ceil() as u32;
        let mut level = 1;
        let mut small = self.exactly(line, &all, level, None)?;
        let mut large = self.cut(line, &all, cut)?;
        let mut least = f64::INFINITY;
        loop {
            let total = small.fine.clone().plus(&large.fine);
            let at_compared = total.last(COMPARED);
            let (error_small, error_large) =
                (small.error(&at_compared), large.error(&at_compared) / GAIN);
            let spheres = small.spheres + large.spheres;
            // The light of spheres in the tails is missing in all of it.
            let error = error_small + error_large + TAIL * self.tolerance;
            if error <= self.tolerance {
                return Ok(Mean::new(total, theta.len(), error, spheres));
            }
            least = least.min(error);
            // A sum that is no number never gets better.
            let (asked, hopeless) = (self.tolerance, !error.is_finite());
            let finer = match hopeless {
                true => Ok(None),
                false => self.finer(line, &all, &small, [error_small, error_large], (level, cut)),
            };
            match finer {
                Ok(Some(Finer::Small(better))) => (small, level) = (better, level + 1),
                Ok(Some(Finer::Large(better))) => (large, cut) = (better, 2 * cut),
                Ok(None) | Err(MeanError::TooLong { .. }) if self.accept_unmet && !hopeless => {
                    return Ok(Mean::new(total, theta.len(), error, spheres));
                }
                Ok(None) | Err(MeanError::TooLong { .. }) => {
                    return Err(MeanError::NotMet { asked, reached: least, spheres });
                }
                Err(other) => return Err(other),
            }
        }
    }

    /// The next attempt at the part that errs more, given both errors and how fine they are; `None`
    /// where neither can be finer.
    fn finer(
        &self,
        line: &Line,
        all: &[f64],
        small: &Compared,
        [error_small, error_large]: [f64; 2],
        (level, cut): (u32, u32),
    ) -> Result<Option<Finer>, MeanError> {
        if error_small > error_large && error_small > 0.5 * self.tolerance {
            if level == MAX_LEVEL {
                return Ok(None);
            }
            let before = small.fine.last(COMPARED);
            return Ok(Some(Finer::Small(self.exactly(line, all, level + 1, Some(before))?)));
        }
        if 2 * cut > MAX_CUT {
            return Ok(None);
        }
        Ok(Some(Finer::Large(self.cut(line, all, 2 * cut)?)))
    }

    /// The small spheres, on panels halved `level` times, and on wider ones.
    fn exactly(
        &self,
        line: &Line,
        all: &[f64],
        level: u32,
        before: Option<Summed>,
    ) -> Result<Compared, MeanError> {
        let tail = TAIL * self.tolerance;
        let too_long = |steps| {
            let (from, to) = line.range(tail);
            MeanError::TooLong { from, to, steps }
        };
        let nodes = line.exact(tail, level, MAX_STEPS)?.map_err(too_long)?;
        let coarse = match before {
            Some(before) => before,
            None => {
                let nodes = line.exact(tail, level - 1, MAX_STEPS)?.map_err(too_long)?;
                exact(&nodes, &all[all.len() - COMPARED..])?
            }
        };
        Ok(Compared { fine: exact(&nodes, all)?, coarse, spheres: nodes.len() })
    }

    /// The large spheres, with the series cut behind an order, and behind half of it.
    fn cut(&self, line: &Line, all: &[f64], cut: u32) -> Result<Compared, MeanError> {
        let tail = TAIL * self.tolerance;
        let compared = &all[all.len() - COMPARED..];
        let zones = line.zones(tail, cut, MAX_STEPS)?.map_err(|steps| {
            let (from, to) = line.range(tail);
            MeanError::TooLong { from, to, steps }
        })?;
        let (mut fine, mut coarse) = (Summed::nothing(all.len()), Summed::nothing(COMPARED));
        let mut spheres = 0;
        for zone in zones {
            let [more, more_coarse] = fine_and_coarse(&zone.nodes, zone.cut, all, compared)?;
            (fine, coarse) = (fine.plus(&more), coarse.plus(&more_coarse));
            spheres += zone.nodes.len();
        }
        Ok(Compared { fine, coarse, spheres })
    }
}

impl From<ZoneError> for MeanError {
    fn from(error: ZoneError) -> Self {
        match error {
            ZoneError::Series(error) => error.into(),
            ZoneError::Medium(error) => error.into(),
        }
    }
}

impl Compared {
    /// The difference of the two in units of a total at the angles of the comparison.
    fn error(&self, total: &Summed) -> f64 {
        if self.spheres == 0 {
            return 0.0;
        }
        let fine = self.fine.last(COMPARED);
        let rows = fine.elements.iter().zip(&self.coarse.elements).zip(&total.elements);
        let squares = rows.map(|((a, b), of)| ((b[0] - a[0]) / of[0]).powi(2));
        let angles = (squares.sum::<f64>() / COMPARED as f64).sqrt();
        let scattering = (fine.scattering - self.coarse.scattering).abs() / total.scattering;
        let mut absorption = (fine.absorption - self.coarse.absorption).abs();
        if absorption > 0.0 {
            absorption /= total.absorption;
        }
        // NaN must not be lost.
        [angles, scattering, absorption].into_iter().fold(0.0, |most: f64, error| {
            if error.is_nan() {
                error
            } else if most.is_nan() {
                most
            } else {
                most.max(error)
            }
        })
    }
}

impl Mean {
    fn new(total: Summed, angles: usize, error: f64, spheres: usize) -> Mean {
        let mut elements = total.elements;
        elements.truncate(angles);
        Mean {
            elements,
            scattering: total.scattering,
            absorption: total.absorption,
            forward_extinction: total.extinction,
            asymmetry: total.forward / total.scattering,
            error,
            spheres,
        }
    }

    fn scaled(mut self, factor: f64) -> Mean {
        self.elements.iter_mut().flatten().for_each(|value| *value *= factor);
        self.scattering *= factor;
        self.absorption *= factor;
        self.forward_extinction *= factor;
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
        self.forward_extinction += other.forward_extinction;
        self.error += other.error;
        self.spheres += other.spheres;
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::series::lorenz_mie::Sphere;
    use num_complex::Complex64;

    fn mean(scattering: f64, asymmetry: f64) -> Mean {
        Mean {
            elements: vec![[scattering, 0.1, 0.2, 0.3]; 2],
            scattering,
            absorption: 0.5 * scattering,
            forward_extinction: 1.5 * scattering,
            asymmetry,
            error: 0.01,
            spheres: 3,
        }
    }

    /// Areas add up, the asymmetry is weighted by what is scattered.
    #[test]
    fn means_add_up() {
        let sum = mean(1.0, 0.8).plus(&mean(3.0, 0.4).scaled(2.0));
        assert_eq!((sum.scattering, sum.absorption, sum.spheres), (7.0, 3.5, 6));
        assert_eq!(sum.forward_extinction, 10.5);
        assert!((sum.asymmetry - (0.8 + 6.0 * 0.4) / 7.0).abs() < 1e-15);
        assert!((sum.error - 0.03).abs() < 1e-15 && sum.elements[1][0] == 7.0);
        assert!((sum.elements[0][3] - 0.9).abs() < 1e-15);
    }

    /// One size in a band so narrow that nothing changes in it is one sphere: `dC/dΩ = S11/k²`.
    #[test]
    fn a_single_size_in_a_narrow_band_is_its_sphere() {
        let (wavelength, radius) = (500e-9, 2e-6);
        let medium = Medium::Constant(Complex64::new(1.5, 0.05));
        let ensemble = Ensemble {
            sizes: SizeDistribution::delta(radius),
            medium: &medium,
            wavelength,
            bandwidth: 0.2e-9,
            tolerance: 1e-4,
            accept_unmet: false,
        };
        let theta = [0.0, 0.7, 2.0, PI];
        let found = ensemble.mean(&theta).unwrap();
        let k = 2.0 * PI / wavelength;
        let sphere = Sphere::new(k * radius, Complex64::new(1.5, 0.05)).unwrap();
        for (row, (s1, s2)) in found.elements.iter().zip(sphere.amplitudes(&theta)) {
            let exact = 0.5 * (s1.norm_sqr() + s2.norm_sqr()) / (k * k);
            assert!((row[0] / exact - 1.0).abs() < 1e-3, "{} {exact}", row[0]);
        }
        let area = PI * radius * radius;
        let e = sphere.efficiencies();
        assert!((found.scattering / (e.q_sca * area) - 1.0).abs() < 1e-4);
        assert!((found.absorption / (e.q_abs * area) - 1.0).abs() < 1e-4);
        assert!((found.asymmetry - e.asymmetry).abs() < 1e-4);
    }

    /// The difference of two ways in units of the whole; what is no number is not lost.
    #[test]
    fn errors_are_differences_over_the_whole() {
        let filled = |value: f64| Summed {
            elements: vec![[value; 4]; COMPARED],
            scattering: value,
            absorption: value,
            extinction: value,
            forward: value,
        };
        let error = |fine: f64, coarse: Summed, spheres: usize| {
            Compared { fine: filled(fine), coarse, spheres }.error(&filled(2.0))
        };
        assert!((error(1.0, filled(1.1), 4) - 0.05).abs() < 1e-14);
        assert_eq!(error(1.0, filled(1.1), 0), 0.0);
        // one angle alone counts by the root of its share
        let mut one = filled(1.0);
        one.elements[3][0] = 1.5;
        assert!((error(1.0, one, 4) - 0.25 / (COMPARED as f64).sqrt()).abs() < 1e-14);
        let mut none = filled(1.0);
        none.elements[3][0] = f64::NAN;
        assert!(error(1.0, none, 4).is_nan());
    }
}
