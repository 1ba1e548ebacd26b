//! Means of spheres that vary along the radius, over sizes or over a band of wavelengths.
//!
//! There is no Debye series of them to cut the resonances off with ([`crate::series::mean`]), so the
//! spheres themselves are averaged, in equal steps; steps are doubled until the mean and that of
//! every second sphere agree. Narrow resonances make the last digits slow: where the largest number
//! of spheres does not suffice, the mean comes with the error it has.

use super::Layered;
use crate::medium::Medium;
use crate::series::SeriesError;
use crate::series::angular::AngleSet;
use crate::series::mean::{Mean, MeanError};
use crate::size_distribution::SizeDistribution;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Spheres of a medium that varies along the radius.
#[derive(Clone, Debug)]
pub struct RadialEnsemble<'a> {
    pub sizes: &'a SizeDistribution,
    pub medium: &'a Medium,
    /// Wavelength in the surroundings, metres.
    pub wavelength: f64,
    /// Full width at half maximum (metres) of a band about it, of the shape `cos²`; 0: none.
    pub bandwidth: f64,
    /// Relative error asked for.
    pub tolerance: f64,
}

/// Spheres per unit of size parameter to begin with: about one in a period of the longest path.
const DENSITY: f64 = 3.0;
/// Fewest and most spheres of one mean.
const SPHERES: (f64, f64) = (64.0, 40_000.0);
/// Share of the light in the neglected tails, in units of the tolerance.
const TAIL: f64 = 0.2;
/// Error of one sphere's amplitudes in units of the tolerance: the forward peak, which holds most
/// of them, is a hundred times as high as the rest.
const ONE_SPHERE: f64 = 1e-3;
/// Angles at which the two means are compared.
const COMPARED: usize = 61;
/// Standard deviation of the band `cos²` in units of its full width at half maximum.
const BAND_DEVIATION: f64 = 0.361_512_4;

/// One sphere: radius, wavelength, weight.
type Node = (f64, f64, f64);

/// What spheres add up to.
#[derive(Clone, Debug)]
struct Sum {
    elements: Vec<[f64; 4]>,
    scattering: f64,
    absorption: f64,
    forward: f64,
}

impl Sum {
    fn new(angles: usize) -> Self {
        Self { elements: vec![[0.0; 4]; angles], scattering: 0.0, absorption: 0.0, forward: 0.0 }
    }

    fn add(&mut self, other: &Sum, weight: f64) {
        for (to, from) in self.elements.iter_mut().flatten().zip(other.elements.iter().flatten()) {
            *to += weight * from;
        }
        self.scattering += weight * other.scattering;
        self.absorption += weight * other.absorption;
        self.forward += weight * other.forward;
    }
}

impl RadialEnsemble<'_> {
    /// The mean at scattering angles (radians).
    ///
    /// # Errors
    /// A wavelength outside the medium's data, a profile or films that the series does not accept.
    pub fn mean(&self, theta: &[f64]) -> Result<Mean, MeanError> {
        let many = !matches!(self.sizes, SizeDistribution::Delta { .. });
        if !(many && self.bandwidth > 0.0) {
            return self.along_one(theta);
        }
        // Over sizes only the slow change of the index is left of the band.
        let offset = 3f64.sqrt() * BAND_DEVIATION * self.bandwidth;
        let mut total = Sum::new(theta.len());
        let (mut error, mut spheres) = (0.0, 0);
        for (shift, weight) in [(-offset, 1.0 / 6.0), (0.0, 2.0 / 3.0), (offset, 1.0 / 6.0)] {
            let one = Self { wavelength: self.wavelength + shift, bandwidth: 0.0, ..self.clone() };
            let mean = one.along_one(theta)?;
            let sum = Sum {
                elements: mean.elements,
                scattering: mean.scattering,
                absorption: mean.absorption,
                forward: mean.asymmetry * mean.scattering,
            };
            total.add(&sum, weight);
            error += weight * mean.error;
            spheres += mean.spheres;
        }
        Ok(finished(total, error, spheres))
    }

    fn along_one(&self, theta: &[f64]) -> Result<Mean, MeanError> {
        let compared = (0..COMPARED).map(|i| PI * i as f64 / (COMPARED - 1) as f64);
        let all: Vec<f64> = theta.iter().copied().chain(compared).collect();
        let set = AngleSet::new(&all);
        let mut steps = self.first_steps();
        loop {
            let nodes = self.nodes(steps);
            let sums = self.sums(&nodes, &set)?;
            let (mut fine, mut coarse) = (Sum::new(all.len()), Sum::new(all.len()));
            for (k, (sum, node)) in sums.iter().zip(&nodes).enumerate() {
                fine.add(sum, node.2);
                if k % 2 == 0 {
                    coarse.add(sum, 2.0 * node.2);
                }
            }
            let error = difference(&fine.elements[theta.len()..], &coarse.elements[theta.len()..]);
            if error <= self.tolerance || 2 * steps > SPHERES.1 as usize {
                fine.elements.truncate(theta.len());
                return Ok(finished(fine, error, nodes.len()));
            }
            steps *= 2;
        }
    }

    /// Even.
    fn first_steps(&self) -> usize {
        let span = match self.sizes {
            SizeDistribution::Delta { radius } => {
                let reach = self.bandwidth / self.wavelength;
                TAU * radius / self.wavelength * 2.0 * reach
            }
            sizes => {
                let (from, to) = sizes.limits(TAIL * self.tolerance);
                TAU * (to - from) / self.wavelength
            }
        };
        2 * (0.5 * (DENSITY * span).clamp(SPHERES.0, SPHERES.1)).ceil() as usize
    }

    fn nodes(&self, steps: usize) -> Vec<Node> {
        let place = |i: usize| (i as f64 + 0.5) / steps as f64;
        if let SizeDistribution::Delta { radius } = self.sizes {
            let node = |i: usize| {
                let offset = 2.0 * place(i) - 1.0;
                // cos² by wavelength with the integral 1.
                let weight = 2.0 * (0.5 * PI * offset).cos().powi(2) / steps as f64;
                (*radius, self.wavelength + offset * self.bandwidth, weight)
            };
            return (0..steps).map(node).collect();
        }
        let (from, to) = self.sizes.limits(TAIL * self.tolerance);
        let (ends, number) = (self.sizes.has_steps(), self.sizes.number());
        let node = |i: usize| {
            let t = place(i);
            // sin² steps make a function that ends in a step end smoothly.
            let (at, share) =
                if ends { (t - (TAU * t).sin() / TAU, 1.0 - (TAU * t).cos()) } else { (t, 1.0) };
            let radius = from + (to - from) * at;
            let weight = share * self.sizes.density(radius) * (to - from) / steps as f64 / number;
            (radius, self.wavelength, weight)
        };
        (0..steps).map(node).collect()
    }

    fn sums(&self, nodes: &[Node], set: &AngleSet) -> Result<Vec<Sum>, MeanError> {
        nodes.par_iter().map(|&(radius, wavelength, _)| self.one(radius, wavelength, set)).collect()
    }

    /// One sphere.
    fn one(&self, radius: f64, wavelength: f64, set: &AngleSet) -> Result<Sum, MeanError> {
        let Some(body) = self.medium.body(wavelength, radius)? else {
            return Err(SeriesError::Invalid {
                field: "medium",
                value: self.medium.name(),
                accepted: "a medium that varies along the radius",
            }
            .into());
        };
        let sphere = Layered::body(TAU * radius / wavelength, &body, ONE_SPHERE * self.tolerance)?;
        let (area, shadow) = ((wavelength / TAU).powi(2), PI * radius * radius);
        let q = sphere.efficiencies();
        let elements = sphere.amplitudes_at(set).into_iter().map(|(s1, s2)| {
            let (perpendicular, parallel, cross) = (s1.norm_sqr(), s2.norm_sqr(), s1 * s2.conj());
            [
                0.5 * area * (parallel + perpendicular),
                0.5 * area * (parallel - perpendicular),
                area * cross.re,
                -area * cross.im,
            ]
        });
        Ok(Sum {
            elements: elements.collect(),
            scattering: shadow * q.q_sca,
            absorption: shadow * q.q_abs,
            forward: shadow * q.q_sca * q.asymmetry,
        })
    }
}

fn finished(sum: Sum, error: f64, spheres: usize) -> Mean {
    Mean {
        elements: sum.elements,
        scattering: sum.scattering,
        absorption: sum.absorption,
        asymmetry: sum.forward / sum.scattering,
        error,
        spheres,
    }
}

/// Root mean square of the relative difference of S11.
fn difference(fine: &[[f64; 4]], coarse: &[[f64; 4]]) -> f64 {
    let squares = fine.iter().zip(coarse).map(|(a, b)| (b[0] / a[0] - 1.0).powi(2));
    (squares.sum::<f64>() / fine.len() as f64).sqrt()
}
