//! The mean itself: which spheres are summed, how finely, and when that is exact enough.

use super::error::{MAX_STEPS, MeanError};
use super::nodes::Line;
use super::sum::{Summed, exact, fine_and_coarse};
use super::value::Mean;
use crate::medium::Medium;
use crate::series::SeriesError;
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

/// Order of the first cut at a tolerance of 1e-4, its least and its most.
const CUT: (f64, f64, f64) = (28.0, 8.0, 256.0);
/// Most orders before the cut.
const MAX_CUT: u32 = 1 << 14;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::series::lorenz_mie::Sphere;
    use num_complex::Complex64;

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
