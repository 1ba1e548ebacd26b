//! Lee diagrams: the colour of scattered sunlight over scattering angle × drop radius (Lee 1998,
//! Appl. Opt. 37, 1506).
//!
//! Every column is one radius: intensity by wavelength, averaged over the sun's disc, turned into
//! XYZ. Interference between rays that took different ways through the drop leaves a ripple far
//! finer than the disc and the eye; it must average out and not be sampled. `sampling` says how
//! many angles and wavelengths that takes, [`SunFilter`] averages.
//!
//! ```
//! use gonio::color::{Illuminant, Observer};
//! use gonio::lee::{Polarisation, Request, spheres};
//! use gonio::medium::Medium;
//!
//! let diagram = spheres(&Request {
//!     radii: vec![10e-6],
//!     theta: (136..=144).map(|degrees| f64::from(degrees).to_radians()).collect(),
//!     medium: Medium::Constant(1.333.into()),
//!     sun_disc: true,
//!     size_spread: 0.0,
//!     illuminant: Illuminant::D65,
//!     observer: Observer::Cie1931,
//!     fineness: 1.0,
//! })?;
//! let seen = diagram.seen(Polarisation::Total);
//! assert!(seen[0].iter().all(|xyz| xyz[1] > 0.0));
//! # Ok::<(), gonio::lee::LeeError>(())
//! ```

mod about_axis;
mod airy;
mod columns;
mod diagram;
#[cfg(feature = "hdf5")]
pub mod file;
mod largest_first;
mod raindrops;
pub(crate) mod sampling;
mod wavelengths;

pub use crate::optics::Polarisation;
pub use airy::airy_spheres;
pub use columns::{Bodies, columns};
pub use diagram::{Diagram, PEAK, column_exposures, srgb};
pub use raindrops::{HIGHEST_ORDER, Raindrops};
pub use sampling::Beats;

use crate::cancel;
use crate::color::{ColorError, ColorWeights, Illuminant, LimbDarkening, Observer};
use crate::fault::{Blame, Fault};
use crate::math::parallel::*;
use crate::medium::{Medium, MediumError};
use crate::plan::PlanError;
use crate::population::SampledSizes;
use crate::scene::SceneError;
use crate::series::SeriesError;
use crate::series::even_angles::AngleSums;
use crate::series::lanes::{LANES, partial_waves};
use crate::simulate::SimulateError;
use crate::size_distribution::{SizeDistribution, SizeLaw};
use crate::sun_disc::SunFilter;
use about_axis::{Axis, Samples, Stimuli};
use largest_first::largest_first;
use num_complex::Complex64;
use sampling::{AXIS_LIMIT, Band, LARGEST_QUANTILE, Sampling, SamplingNeed, TRANSITION, grid};
use std::f64::consts::{PI, TAU};

/// Why a diagram cannot be computed.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum LeeError {
    #[error(transparent)]
    Color(#[from] ColorError),
    #[error(transparent)]
    Medium(#[from] MediumError),
    #[error(transparent)]
    Series(#[from] SeriesError),
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Plan(#[from] PlanError),
    #[error(transparent)]
    Simulate(#[from] SimulateError),
    #[error("{field} = {value}: {accepted}")]
    Invalid { field: &'static str, value: String, accepted: &'static str },
}

impl Blame for LeeError {
    fn fault(&self) -> Fault {
        match self {
            LeeError::Series(error) => error.fault(),
            LeeError::Simulate(error) => error.fault(),
            LeeError::Color(_)
            | LeeError::Medium(_)
            | LeeError::Scene(_)
            | LeeError::Plan(_)
            | LeeError::Invalid { .. } => Fault::Input,
        }
    }
}

/// Intensities of one drop in directions: outgoing light polarised parallel and perpendicular to
/// the scattering plane, `½(|S2|²+|S3|²)` and `½(|S1|²+|S4|²)`, for unpolarised incident light.
pub type Intensity = [f64; 2];

/// What is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// Radii of equal volume, metres.
    pub radii: Vec<f64>,
    /// Scattering angles, radians, ascending.
    pub theta: Vec<f64>,
    /// What the drops are of.
    pub medium: Medium,
    /// Average over the sun's disc.
    pub sun_disc: bool,
    /// Standard deviation of ln(radius) about each column's radius; 0 for drops of one size.
    pub size_spread: f64,
    /// What shines on them.
    pub illuminant: Illuminant,
    /// Whose eyes.
    pub observer: Observer,
    /// Factor on the numbers of angles and wavelengths; 1 is meant for ΔE below 1.
    pub fineness: f64,
}

/// A drop at one wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drop {
    /// Radius of equal volume, and wavelength in vacuum, metres.
    pub radius: f64,
    /// Wavelength in vacuum, metres.
    pub wavelength: f64,
    /// Index of the drop.
    pub index: Complex64,
}

/// Scattering angles that one band is computed at.
#[derive(Clone, Debug, PartialEq)]
pub struct Angles {
    /// Radians, ascending.
    pub theta: Vec<f64>,
    /// If they are `2πk/L` for neighbouring k: the first k, and L.
    pub even: Option<(usize, usize)>,
}

/// Neighbouring wavelengths that are computed together, since they share the angles.
const TOGETHER: usize = LANES;

/// The diagram of spheres by Lorenz–Mie.
///
/// # Errors
/// [`LeeError`] for a medium without data in the visible, or angles and radii that make no sense.
pub fn spheres(request: &Request) -> Result<Diagram, LeeError> {
    let intensities = |amplitudes: Vec<(Complex64, Complex64)>| {
        amplitudes.iter().map(|(s1, s2)| [0.5 * s2.norm_sqr(), 0.5 * s1.norm_sqr()]).collect()
    };
    let prepare = |angles: &Angles| match angles.even {
        Some((first, per_turn)) => AngleSums::even(first, angles.theta.len(), per_turn),
        None => AngleSums::any(&angles.theta),
    };
    diagram(request, Beats::All, &prepare, |drops, angles| {
        let sphere = |drop: &Drop| (TAU * drop.radius / drop.wavelength, drop.index);
        let spheres: Vec<(f64, Complex64)> = drops.iter().map(sphere).collect();
        let waves = partial_waves(&spheres).map_err(LeeError::from)?;
        Ok(angles.amplitudes(&waves).into_iter().map(intensities).collect())
    })
}

/// The diagram by any method: `prepare` makes of scattering angles what `scatter` then gives the
/// intensities of a few drops at. Only the asked angles and the filter's reach beyond them are
/// computed. Columns run in parallel, the largest drops first.
///
/// # Errors
/// Those of `scatter`, and as [`spheres`].
pub fn diagram<A, E, P, F>(
    request: &Request,
    beats: Beats,
    prepare: &P,
    scatter: F,
) -> Result<Diagram, E>
where
    E: From<LeeError> + Send,
    P: Fn(&Angles) -> A + Sync,
    F: Fn(&[Drop], &A) -> Result<Vec<Vec<Intensity>>, E> + Sync,
{
    check(request, beats)?;
    let index = request.medium.index(MIDDLE).map_err(LeeError::from)?.re;
    let xyz = largest_first(&request.radii, |radius| {
        let sampling = Sampling::new(&request.need(radius, index, beats));
        column(request, radius, (&sampling, beats), prepare, &scatter)
    })?;
    Ok(Diagram { radii: request.radii.clone(), theta: request.theta.clone(), xyz })
}

/// Where the index that stands for the whole visible is taken.
const MIDDLE: f64 = 550e-9;
/// The coarsest sampling that still shows the primary bow: thirty to sixty wavelengths.
const LEAST_FINENESS: f64 = 0.02;

/// One radius.
fn column<A, E, P, F>(
    request: &Request,
    radius: f64,
    (sampling, beats): (&Sampling, Beats),
    prepare: &P,
    scatter: &F,
) -> Result<Vec<[[f64; 3]; 2]>, E>
where
    E: From<LeeError> + Send,
    P: Fn(&Angles) -> A + Sync,
    F: Fn(&[Drop], &A) -> Result<Vec<Vec<Intensity>>, E> + Sync,
{
    cancel::checkpoint();
    let filter = request.sun_disc.then(|| SunFilter::new(sampling.cutoff, TRANSITION));
    let weights = weights(request, sampling);
    let samples = SampledSizes::new(&sizes(radius, request.size_spread));
    let bands = sampling
        .bands
        .par_iter()
        .map(|band| {
            cancel::checkpoint();
            let angles = match &filter {
                Some(filter) => {
                    let (first, last) = request.angles();
                    let places = grid(first, last, filter.reach(), band);
                    let even = Some((places.start, band.per_turn));
                    Angles { theta: places.map(|k| k as f64 * band.step()).collect(), even }
                }
                None => Angles { theta: request.theta.clone(), even: None },
            };
            let prepared = prepare(&angles);
            let mut sums = vec![[0.0; 6]; angles.theta.len()];
            for first in band.places.clone().step_by(TOGETHER) {
                cancel::checkpoint();
                let places = first..(first + TOGETHER).min(band.places.end);
                let drop = |i: usize| {
                    let wavelength = sampling.wavelengths[i];
                    let index = request.medium.index(wavelength)?;
                    let radius = samples.radius(i);
                    Ok(Drop { radius, wavelength, index })
                };
                let drops: Vec<Drop> =
                    places.map(drop).collect::<Result<_, LeeError>>().map_err(E::from)?;
                for (k, intensities) in scatter(&drops, &prepared)?.iter().enumerate() {
                    let scale = (drops[k].wavelength / TAU).powi(2) / (PI * radius * radius);
                    add(&mut sums, intensities, weights[first + k].map(|w| w * scale));
                }
            }
            let Some(filter) = &filter else { return Ok(sums) };
            let middle = sampling.wavelengths[(band.places.start + band.places.end) / 2];
            let limb = LimbDarkening::at(middle);
            let axis = |theta| Axis::near(theta).filter(|_| beats == Beats::All);
            Ok(over_disc(filter, &limb, band, &angles, &sums, &request.theta, axis))
        })
        .collect::<Result<Vec<_>, E>>()?;
    let total = |t: usize, c: usize| bands.iter().map(|band| band[t][c]).sum::<f64>().max(0.0);
    let cell = |t: usize| [0, 3].map(|first| std::array::from_fn(|c| total(t, first + c)));
    Ok((0..request.theta.len()).map(cell).collect())
}

/// The sizes of a column: log-normal about its radius.
fn sizes(radius: f64, spread: f64) -> SizeDistribution {
    let end = |side: f64| radius * (side * LARGEST_QUANTILE * spread).exp();
    let law = SizeLaw::LogNormal { median: radius, spread };
    let many = (spread > 0.0).then(|| SizeDistribution::between(law, end(-1.0), end(1.0)));
    many.and_then(Result::ok).unwrap_or_else(|| SizeDistribution::delta(radius))
}

/// The averages over the sun's disc at some angles, ascending, of sums on the grid of a band.
fn over_disc(
    filter: &SunFilter,
    limb: &LimbDarkening,
    band: &Band,
    angles: &Angles,
    sums: &[Stimuli],
    theta: &[f64],
    axis: impl Fn(f64) -> Option<Axis>,
) -> Vec<Stimuli> {
    let samples = Samples { first: angles.even.map_or(0, |even| even.0), band, values: sums };
    let kernel = filter.kernel(limb);
    theta
        .chunk_by(|a, b| axis(*a) == axis(*b))
        .flat_map(|theta| match axis(theta[0]) {
            Some(axis) => about_axis::average(axis, filter, limb, samples, theta),
            None => kernel.average(&angles.theta, band.step(), sums, theta),
        })
        .collect()
}

/// Add what one wavelength contributes.
fn add(sums: &mut [Stimuli], intensities: &[Intensity], weight: [f64; 3]) {
    for (sum, intensity) in sums.iter_mut().zip(intensities) {
        for c in 0..3 {
            sum[c] += weight[c] * intensity[0];
            sum[3 + c] += weight[c] * intensity[1];
        }
    }
}

/// Weights of the wavelengths for X, Y and Z.
fn weights(request: &Request, sampling: &Sampling) -> Vec<[f64; 3]> {
    let Sampling { wavelengths, widths, .. } = sampling;
    ColorWeights::quadrature(wavelengths, widths, request.illuminant, request.observer).weights
}

impl Request {
    /// First and last asked angle.
    fn angles(&self) -> (f64, f64) {
        (self.theta[0], self.theta[self.theta.len() - 1])
    }

    fn need(&self, radius: f64, index: f64, beats: Beats) -> SamplingNeed {
        SamplingNeed {
            radius,
            index,
            sun_disc: self.sun_disc,
            beats,
            size_spread: self.size_spread,
            angles: self.angles(),
            fineness: self.fineness,
        }
    }
}

fn check(request: &Request, beats: Beats) -> Result<(), LeeError> {
    let invalid =
        |field, value: String, accepted| Err(LeeError::Invalid { field, value, accepted });
    if let Some(bad) = request.radii.iter().find(|r| !(1e-7..=1e-2).contains(*r)) {
        let value = format!("{} mm", bad * 1e3);
        return invalid("radius", value, "accepted are 0.0001 to 10 mm");
    }
    if request.radii.is_empty() {
        return invalid("radius", "none".into(), "at least one radius is needed");
    }
    let ascending = request.theta.windows(2).all(|pair| pair[0] < pair[1]);
    let inside = request.theta.iter().all(|t| (0.0..=PI).contains(t));
    if !ascending || !inside || request.theta.is_empty() {
        let value = format!("{} angles", request.theta.len());
        return invalid("theta", value, "accepted are ascending angles from 0 to 180 degrees");
    }
    let margin = AXIS_LIMIT;
    // Rays are for particles that are not round about the axis.
    let round = beats == Beats::All;
    let (first, last) = (request.theta[0], request.theta[request.theta.len() - 1]);
    if request.sun_disc && !round && (first < margin || last > PI - margin) {
        let value = format!("{:.3} to {:.3} degrees", first.to_degrees(), last.to_degrees());
        let accepted = "with the sun's disc, angles from 1.4 to 178.6 degrees are accepted for particles \
                        that are no spheres; --no-sun-disc takes all";
        return invalid("theta", value, accepted);
    }
    if !(0.0..=0.5).contains(&request.size_spread) {
        return invalid("size_spread", request.size_spread.to_string(), "accepted are 0 to 0.5");
    }
    if !(LEAST_FINENESS..=100.0).contains(&request.fineness) {
        return invalid("fineness", request.fineness.to_string(), "accepted are 0.02 to 100");
    }
    Ok(())
}
