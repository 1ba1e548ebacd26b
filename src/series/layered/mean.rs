//! Means of spheres that vary along the radius, over sizes or over a band of wavelengths.
//!
//! There is no Debye series of them to cut the resonances off with ([`crate::series::mean`]), so the
//! spheres themselves are averaged, in equal steps; steps are doubled until the mean and that of
//! every second sphere agree. Narrow resonances make the last digits slow: where the largest number
//! of spheres does not suffice, the mean is refused, or given with the error it has where that is accepted.

use super::Layered;
use crate::math::parallel::*;
use crate::medium::Medium;
use crate::series::angular::AngleSet;
use crate::series::mean::{Mean, MeanError};
use crate::series::{SeriesError, elements};
use crate::size_distribution::SizeDistribution;
use std::f64::consts::{PI, TAU};

/// Spheres of a medium that varies along the radius.
#[derive(Clone, Debug)]
pub struct RadialEnsemble<'a> {
    /// Number of spheres by radius.
    pub sizes: &'a SizeDistribution,
    /// What they are made of.
    pub medium: &'a Medium,
    /// Wavelength in the surroundings, metres.
    pub wavelength: f64,
    /// Full width at half maximum (metres) of a band about it, of the shape `cos²`; 0: none.
    pub bandwidth: f64,
    /// Relative error asked for.
    pub tolerance: f64,
    /// Whether a mean that does not meet it is given all the same, with its error.
    pub accept_unmet: bool,
}

/// Spheres per unit of size parameter to begin with: about one in a period of the longest path.
const DENSITY: f64 = 3.0;
/// Fewest and most spheres of one mean.
const SPHERES: (f64, f64) = (64.0, 40_000.0);
/// Spheres whose curves are held at once.
const AT_ONCE: usize = 256;
/// Share of the light in the neglected tails, in units of the tolerance.
const TAIL: f64 = 0.2;
/// Error of one sphere's amplitudes in units of the tolerance: the forward peak, which holds most
/// of them, is a hundred times as high as the rest.
const ONE_SPHERE: f64 = 1e-3;
/// Angles at which the two means are compared.
const COMPARED: usize = 61;
/// Standard deviation of the band `cos²` in units of its full width at half maximum.
const BAND_DEVIATION: f64 = 0.361_512_4;

/// One sphere: radius and wavelength (metres), weight.
type Node = (f64, f64, f64);

/// What spheres add up to.
#[derive(Clone, Debug)]
struct Sum {
    elements: Vec<[f64; 4]>,
    scattering: f64,
    absorption: f64,
    /// By the optical theorem.
    extinction: f64,
    forward: f64,
}

impl Sum {
    fn new(angles: usize) -> Self {
        let elements = vec![[0.0; 4]; angles];
        Self { elements, scattering: 0.0, absorption: 0.0, extinction: 0.0, forward: 0.0 }
    }

    fn add(&mut self, other: &Sum, weight: f64) {
        for (to, from) in self.elements.iter_mut().flatten().zip(other.elements.iter().flatten()) {
            *to += weight * from;
        }
        self.scattering += weight * other.scattering;
        self.absorption += weight * other.absorption;
        self.extinction += weight * other.extinction;
        self.forward += weight * other.forward;
    }

    fn mean(self, error: f64, spheres: usize) -> Mean {
        Mean {
            elements: self.elements,
            scattering: self.scattering,
            absorption: self.absorption,
            forward_extinction: self.extinction,
            asymmetry: self.forward / self.scattering,
            error,
            spheres,
        }
    }
}

impl RadialEnsemble<'_> {
    /// The mean at scattering angles (radians).
    ///
    /// # Errors
    /// A wavelength outside the medium's data, a profile or films that the series does not accept, or a
    /// tolerance that is not met (unless that is accepted).
    pub fn mean(&self, theta: &[f64]) -> Result<Mean, MeanError> {
        let (sum, error, spheres) = if self.sizes.single().is_none() && self.bandwidth > 0.0 {
            self.over_both(theta)?
        } else {
            self.along_one(theta)?
        };
        if error <= self.tolerance || self.accept_unmet {
            return Ok(sum.mean(error, spheres));
        }
        Err(MeanError::NotMet { asked: self.tolerance, reached: error, spheres })
    }

    /// Over sizes only the slow change of the index is left of a band.
    fn over_both(&self, theta: &[f64]) -> Result<(Sum, f64, usize), MeanError> {
        let offset = 3f64.sqrt() * BAND_DEVIATION * self.bandwidth;
        let mut total = Sum::new(theta.len());
        let (mut error, mut spheres) = (0.0, 0);
        for (shift, weight) in [(-offset, 1.0 / 6.0), (0.0, 2.0 / 3.0), (offset, 1.0 / 6.0)] {
            let one = Self { wavelength: self.wavelength + shift, bandwidth: 0.0, ..self.clone() };
            let (sum, err, count) = one.along_one(theta)?;
            total.add(&sum, weight);
            error += weight * err;
            spheres += count;
        }
        Ok((total, error, spheres))
    }

    fn along_one(&self, theta: &[f64]) -> Result<(Sum, f64, usize), MeanError> {
        let compared = (0..COMPARED).map(|i| PI * i as f64 / (COMPARED - 1) as f64);
        let all: Vec<f64> = theta.iter().copied().chain(compared).collect();
        let set = AngleSet::new(&all);
        let mut refinement = 1;
        loop {
            let nodes = self.nodes(refinement);
            let (mut fine, coarse) = self.sums(&nodes, &set, all.len())?;
            let error = difference(&fine, &coarse, theta.len());
            // The light of spheres in the tails is missing in all of it.
            let tails = if self.sizes.single().is_some() { 0.0 } else { TAIL * self.tolerance };
            let error = error + tails;
            // What is no number never gets better.
            let last = 2 * nodes.len() > SPHERES.1 as usize || !error.is_finite();
            if error <= self.tolerance || last {
                fine.elements.truncate(theta.len());
                return Ok((fine, error, nodes.len()));
            }
            refinement *= 2;
        }
    }

    /// Spheres in equal steps on each stretch over which the density is smooth, an even number of them.
    fn nodes(&self, refinement: usize) -> Vec<Node> {
        let even = |span: f64, least: f64| {
            refinement * 2 * (0.5 * (DENSITY * span).clamp(least, SPHERES.1)).ceil() as usize
        };
        let place = |i: usize, steps: usize| (i as f64 + 0.5) / steps as f64;
        if let Some(radius) = self.sizes.single() {
            let reach = self.bandwidth / self.wavelength;
            let steps = even(TAU * radius / self.wavelength * 2.0 * reach, SPHERES.0);
            let node = |i: usize| {
                let offset = 2.0 * place(i, steps) - 1.0;
                // cos² by wavelength with the integral 1.
                let weight = 2.0 * (0.5 * PI * offset).cos().powi(2) / steps as f64;
                (radius, self.wavelength + offset * self.bandwidth, weight)
            };
            return (0..steps).map(node).collect();
        }
        let stretches = self.sizes.stretches(TAIL * self.tolerance, TAU / self.wavelength);
        let least = SPHERES.0 / stretches.len() as f64;
        let of_stretch = |(from, to): (f64, f64)| {
            let steps = even(TAU * (to - from) / self.wavelength, least);
            let ends = self.sizes.has_step((from, to));
            let node = move |i: usize| {
                let t = place(i, steps);
                // sin² steps make a function that ends in a step end smoothly.
                let (at, share) = if ends {
                    (t - (TAU * t).sin() / TAU, 1.0 - (TAU * t).cos())
                } else {
                    (t, 1.0)
                };
                let radius = from + (to - from) * at;
                let weight = share * self.sizes.density(radius) * (to - from) / steps as f64;
                (radius, self.wavelength, weight)
            };
            (0..steps).map(node)
        };
        stretches.into_iter().flat_map(of_stretch).collect()
    }

    /// The sum over all nodes, and that over every second one.
    fn sums(&self, nodes: &[Node], set: &AngleSet, angles: usize) -> Result<(Sum, Sum), MeanError> {
        let (mut fine, mut coarse) = (Sum::new(angles), Sum::new(angles));
        for (chunk, some) in nodes.chunks(AT_ONCE).enumerate() {
            let found: Vec<Sum> =
                some.par_iter().map(|node| self.one(*node, set)).collect::<Result<_, _>>()?;
            for (k, (sum, node)) in found.iter().zip(some).enumerate() {
                fine.add(sum, node.2);
                if (chunk * AT_ONCE + k).is_multiple_of(2) {
                    coarse.add(sum, 2.0 * node.2);
                }
            }
        }
        Ok((fine, coarse))
    }

    /// One sphere.
    fn one(&self, (radius, wavelength, _): Node, set: &AngleSet) -> Result<Sum, MeanError> {
        let Some(body) = self.medium.body(wavelength, radius)? else {
            return Err(SeriesError::Invalid {
                field: "medium",
                value: self.medium.name(),
                accepted: "a medium that varies along the radius",
            }
            .into());
        };
        let x = TAU * radius / wavelength;
        let sphere = Layered::body(x, &body, ONE_SPHERE * self.tolerance)?;
        let (area, shadow) = ((wavelength / TAU).powi(2), PI * radius * radius);
        let q = sphere.efficiencies();
        let rows = sphere.amplitudes_at(set).into_iter().map(|pair| elements(pair, area));
        Ok(Sum {
            elements: rows.collect(),
            scattering: shadow * q.q_sca,
            absorption: shadow * q.q_abs,
            extinction: 2.0 * TAU * area * sphere.straight_ahead().re,
            forward: shadow * q.q_sca * q.asymmetry,
        })
    }
}

/// The largest relative difference: of S11 from an angle on, root mean square, of scattering, of
/// absorption.
fn difference(fine: &Sum, coarse: &Sum, from: usize) -> f64 {
    let rows = fine.elements[from..].iter().zip(&coarse.elements[from..]);
    let squares: f64 = rows.map(|(a, b)| (b[0] / a[0] - 1.0).powi(2)).sum();
    let angles = (squares / COMPARED as f64).sqrt();
    let relative = |a: f64, b: f64| if a == b { 0.0 } else { (b / a - 1.0).abs() };
    let scattering = relative(fine.scattering, coarse.scattering);
    let absorption = relative(fine.absorption, coarse.absorption);
    // `max` would lose what is no number.
    if angles.is_nan() { angles } else { angles.max(scattering).max(absorption) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::medium::radial::Film;
    use crate::series::mean::Ensemble;
    use crate::size_distribution::SizeLaw;

    /// Spheres with a film of their own medium are spheres: the mean by Debye's cut knows theirs.
    #[test]
    fn a_film_of_the_same_medium_changes_no_mean() {
        let plain = Medium::Constant(num_complex::Complex64::new(1.4, 1e-3));
        let film = Film { medium: plain.clone(), thickness: 50e-9 };
        let coated = plain.clone().coated(vec![film]).unwrap();
        let sizes = SizeDistribution::whole(SizeLaw::gamma(0.8e-6, 0.05)).unwrap();
        let theta = [0.0, 0.5, 1.5, 2.5, PI];
        let (wavelength, bandwidth, tolerance) = (500e-9, 0.0, 1e-3);
        let ensemble = RadialEnsemble {
            sizes: &sizes,
            medium: &coated,
            wavelength,
            bandwidth,
            tolerance,
            accept_unmet: false,
        };
        let found = ensemble.mean(&theta).unwrap();
        let known = Ensemble {
            sizes: sizes.clone(),
            medium: &plain,
            wavelength,
            bandwidth,
            tolerance,
            accept_unmet: false,
        };
        let known = known.mean(&theta).unwrap();
        for (a, b) in found.elements.iter().zip(&known.elements) {
            assert!((a[0] / b[0] - 1.0).abs() < 3e-3, "{a:?} {b:?}");
        }
        for (a, b) in [
            (found.scattering, known.scattering),
            (found.absorption, known.absorption),
            (found.forward_extinction, known.forward_extinction),
            (found.asymmetry, known.asymmetry),
        ] {
            assert!((a / b - 1.0).abs() < 2e-3, "{a:e} {b:e}");
        }
        let optical = found.scattering + found.absorption;
        assert!((found.forward_extinction / optical - 1.0).abs() < 1e-6);
    }
}
