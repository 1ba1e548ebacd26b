//! Lee diagrams: the colour of scattered sunlight over scattering angle × drop radius (Lee 1998,
//! Appl. Opt. 37, 1506).
//!
//! Every column is one radius: intensity by wavelength, averaged over the sun's disc, turned into
//! XYZ. Interference between rays that took different ways through the drop leaves a ripple far
//! finer than the disc and the eye; it must average out and not be sampled. [`Sampling`] says how
//! many angles and wavelengths that takes:
//! - the intensity of a drop with size parameter `x` holds no frequency in angle above `1.5 x`
//!   between 100° and 170° (the impact parameters of the two rays that beat lie within ±x, and
//!   not both at the rim), so angles at a step of `2π/(1.5 x + 3/ρ)` let the disc of radius ρ
//!   average without aliasing;
//! - what ripple the disc leaves (its transform falls as `(lρ)^(-3/2)`) is averaged over
//!   wavelengths, either resolved or with spread phases, whichever needs fewer.

use crate::color::{ColorError, SUN_ANGULAR_RADIUS};
use crate::color::{ColorWeights, Illuminant, LimbDarkening, Observer};
use crate::medium::{Medium, MediumError};
use crate::series::SeriesError;
use crate::series::angular::AngleSet;
use crate::series::lorenz_mie::Sphere;
use num_complex::Complex64;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Why a diagram cannot be computed.
#[derive(Debug, thiserror::Error)]
pub enum LeeError {
    #[error(transparent)]
    Color(#[from] ColorError),
    #[error(transparent)]
    Medium(#[from] MediumError),
    #[error(transparent)]
    Series(#[from] SeriesError),
    #[error("{field} = {value}: {accepted}")]
    Invalid { field: &'static str, value: String, accepted: &'static str },
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
    pub medium: Medium,
    /// Average over the sun's disc.
    pub sun_disc: bool,
    /// Standard deviation of ln(radius) about each column's radius; 0 for drops of one size.
    pub size_spread: f64,
    pub illuminant: Illuminant,
    pub observer: Observer,
    /// Factor on the numbers of angles and wavelengths; 1 is meant for ΔE below 1.
    pub fineness: f64,
}

/// The diagram: XYZ of the differential cross-section over the geometrical one, sr⁻¹.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagram {
    pub radii: Vec<f64>,
    pub theta: Vec<f64>,
    /// Per radius and angle: XYZ of the parallel and of the perpendicular part.
    pub xyz: Vec<Vec<[[f64; 3]; 2]>>,
}

/// Light that an observer with or without a filter sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Polarisation {
    Total,
    Parallel,
    Perpendicular,
}

/// How finely one column is sampled.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampling {
    /// Wavelengths, metres, one in each of equal intervals of the wavenumber.
    pub wavelengths: Vec<f64>,
    /// Width of those intervals, 1/m.
    pub wavenumber_width: f64,
    /// Step in scattering angle by wavelength, radians.
    pub steps: Vec<f64>,
}

/// Visible range of the integral: beyond it lies less than 1e-3 of any stimulus.
const BAND: (f64, f64) = (380e-9, 735e-9);
/// Highest angular frequency of the ripple, in units of the size parameter.
const HIGHEST_FREQUENCY: f64 = 2.0;
/// Path differences that beat, in radii (primary bow against external reflection and beyond).
const LONGEST_PATH: f64 = 5.5;
/// Wavelengths per beat that resolve it.
const PER_BEAT: f64 = 1.5;
/// Narrow resonances of small drops ask for this many wavelengths at the least.
const RESONANCES: f64 = 400.0;
/// The golden ratio's fraction.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Where the disc has dimmed the ripple so far that wavelengths with spread phases do: their
/// number at a size parameter; it falls as the disc's transform does. Measured, see `validation/`.
const SPREAD: (f64, f64) = (800.0, 240.0);
/// Least number: dispersion shifts the bow by 2° over the visible, 0.06° from one to the next.
const LEAST: f64 = 32.0;

impl Sampling {
    /// Sampling of a radius (metres). `fineness` multiplies both numbers.
    pub fn new(radius: f64, sun_disc: bool, size_spread: f64, fineness: f64) -> Self {
        let wavenumbers = (TAU / BAND.1, TAU / BAND.0);
        let middle = TAU * radius / 550e-9;
        let disc = SUN_ANGULAR_RADIUS;
        let resolved = PER_BEAT * (wavenumbers.1 - wavenumbers.0) * LONGEST_PATH * radius / TAU;
        let spread = if sun_disc { SPREAD.1 * (middle / SPREAD.0).powf(-1.2) } else { resolved };
        let least = if size_spread > 0.0 { 240.0 } else { LEAST };
        let needed = resolved.max(RESONANCES.min(4.0 * resolved)).min(spread).max(least);
        let count = (fineness * needed).ceil() as usize;
        let jitter = if needed < resolved { 1.0 } else { 0.0 };
        let width = (wavenumbers.1 - wavenumbers.0) / count as f64;
        let wavelengths: Vec<f64> = (0..count)
            .map(|i| {
                // A quadratic Weyl sequence: even, and in step with no ripple.
                let within = 0.5 + jitter * ((GOLDEN * (i * i) as f64).fract() - 0.5);
                TAU / (wavenumbers.0 + (i as f64 + within) * width)
            })
            .collect();
        let steps = wavelengths
            .iter()
            .map(|w| {
                let alias_free = TAU / (HIGHEST_FREQUENCY * TAU * radius / w + 3.0 / disc);
                alias_free.min(0.35 * disc) / fineness
            })
            .collect();
        Self { wavelengths, wavenumber_width: width, steps }
    }

    /// Number of directions × wavelengths over a span of angles.
    pub fn samples(&self, span: f64) -> f64 {
        self.steps.iter().map(|step| span / step).sum()
    }
}

/// The diagram of spheres by Lorenz–Mie.
///
/// # Errors
/// [`LeeError`] for a medium without data in the visible, or angles and radii that make no sense.
pub fn spheres(request: &Request) -> Result<Diagram, LeeError> {
    diagram(request, |radius, wavelength, index, theta| {
        let sphere = Sphere::new(TAU * radius / wavelength, index)?;
        let amplitudes = sphere.amplitudes_at(&AngleSet::new(theta));
        Ok(amplitudes.iter().map(|(s1, s2)| [0.5 * s2.norm_sqr(), 0.5 * s1.norm_sqr()]).collect())
    })
}

/// The diagram by any method: `scatter` gives the intensities of a drop of that radius, at that
/// wavelength and index, at scattering angles (ascending). Only the asked angles, and half a sun's
/// disc beyond them, are computed. Columns run in parallel, the largest drops first.
///
/// # Errors
/// Those of `scatter`, and as [`spheres`].
pub fn diagram<E, F>(request: &Request, scatter: F) -> Result<Diagram, E>
where
    E: From<LeeError> + Send,
    F: Fn(f64, f64, Complex64, &[f64]) -> Result<Vec<Intensity>, E> + Sync,
{
    check(request)?;
    let mut order: Vec<usize> = (0..request.radii.len()).collect();
    order.sort_by(|&i, &j| request.radii[j].total_cmp(&request.radii[i]));
    let mut columns = order
        .par_iter()
        .with_max_len(1)
        .map(|&i| Ok((i, column(request, request.radii[i], &scatter)?)))
        .collect::<Result<Vec<_>, E>>()?;
    columns.sort_by_key(|(i, _)| *i);
    Ok(Diagram {
        radii: request.radii.clone(),
        theta: request.theta.clone(),
        xyz: columns.into_iter().map(|(_, column)| column).collect(),
    })
}

/// One radius.
fn column<E, F>(request: &Request, radius: f64, scatter: &F) -> Result<Vec<[[f64; 3]; 2]>, E>
where
    E: From<LeeError>,
    F: Fn(f64, f64, Complex64, &[f64]) -> Result<Vec<Intensity>, E>,
{
    let sampling = Sampling::new(radius, request.sun_disc, request.size_spread, request.fineness);
    let weights = ColorWeights::new(&sampling.wavelengths, request.illuminant, request.observer)
        .map_err(LeeError::from)?;
    let mut xyz = vec![[[0.0; 3]; 2]; request.theta.len()];
    for (i, &wavelength) in sampling.wavelengths.iter().enumerate() {
        let index = request.medium.index(wavelength).map_err(LeeError::from)?;
        let (size, share) = size_of(radius, request.size_spread, i);
        let curve = Curve::new(request, wavelength, sampling.steps[i], i);
        let intensities = scatter(size, wavelength, index, &curve.theta)?;
        let scale = share * (wavelength / TAU).powi(2) / (PI * radius * radius);
        for (out, mean) in xyz.iter_mut().zip(curve.averages(request, &intensities)) {
            for (sum, value) in out.iter_mut().zip(mean) {
                for (c, weight) in weights.weights[i].iter().enumerate() {
                    sum[c] += weight * value * scale;
                }
            }
        }
    }
    Ok(xyz)
}

/// The size of the i-th sample of a log-normal distribution about `radius`, and its share: 1, as
/// the samples are equally likely. They are spread by the golden ratio over the quantiles, so that
/// neighbouring wavelengths see different sizes and their mean sees all.
fn size_of(radius: f64, spread: f64, i: usize) -> (f64, f64) {
    if spread <= 0.0 {
        return (radius, 1.0);
    }
    let quantile = ((i as f64 + 0.5) * GOLDEN).fract().clamp(1e-4, 1.0 - 1e-4);
    (radius * (spread * normal_quantile(quantile)).exp(), 1.0)
}

/// Inverse of the normal distribution by bisection of the error function.
fn normal_quantile(quantile: f64) -> f64 {
    let (mut low, mut high) = (-6.0, 6.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let below = 0.5 * libm::erfc(-middle / std::f64::consts::SQRT_2);
        if below < quantile { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The angles at which one wavelength is computed, and the disc that averages them.
struct Curve {
    theta: Vec<f64>,
    limb: LimbDarkening,
}

impl Curve {
    /// An even grid over the asked angles and the disc beyond; its offset moves with the golden
    /// ratio from wavelength to wavelength.
    fn new(request: &Request, wavelength: f64, step: f64, i: usize) -> Self {
        let limb = LimbDarkening::at(wavelength);
        if !request.sun_disc {
            return Self { theta: request.theta.clone(), limb };
        }
        let offset = (i as f64 * GOLDEN).fract();
        let from = (request.theta[0] - SUN_ANGULAR_RADIUS).max(0.0);
        let to = (request.theta[request.theta.len() - 1] + SUN_ANGULAR_RADIUS).min(PI);
        let count = ((to - from) / step).ceil() as usize + 1;
        let theta = (0..count)
            .map(|j| from + (j as f64 - 0.5 + offset) * step)
            .filter(|t| (0.0..=PI).contains(t))
            .collect();
        Self { theta, limb }
    }

    /// Mean over the disc about each asked angle. Away from 0° and 180° circles of equal
    /// scattering angle cross the disc as straight chords.
    fn averages(&self, request: &Request, intensities: &[Intensity]) -> Vec<Intensity> {
        if !request.sun_disc {
            return intensities.to_vec();
        }
        let radius = SUN_ANGULAR_RADIUS;
        request
            .theta
            .iter()
            .map(|&centre| {
                let from = self.theta.partition_point(|&t| t < centre - radius);
                let (mut sum, mut norm) = ([0.0; 2], 0.0);
                for (t, value) in self.theta[from..].iter().zip(&intensities[from..]) {
                    if *t > centre + radius {
                        break;
                    }
                    let weight = self.limb.chord((t - centre) / radius);
                    norm += weight;
                    sum[0] += weight * value[0];
                    sum[1] += weight * value[1];
                }
                sum.map(|s| s / f64::max(norm, f64::MIN_POSITIVE))
            })
            .collect()
    }
}

impl Diagram {
    /// XYZ as seen with or without a filter, per radius and angle.
    pub fn seen(&self, polarisation: Polarisation) -> Vec<Vec<[f64; 3]>> {
        let pick = |[parallel, perpendicular]: &[[f64; 3]; 2]| match polarisation {
            Polarisation::Parallel => *parallel,
            Polarisation::Perpendicular => *perpendicular,
            Polarisation::Total => std::array::from_fn(|c| parallel[c] + perpendicular[c]),
        };
        self.xyz.iter().map(|column| column.iter().map(pick).collect()).collect()
    }
}

/// Exposure of each column such that its brightest angle has the luminance `peak`.
pub fn column_exposures(seen: &[Vec<[f64; 3]>], peak: f64) -> Vec<f64> {
    seen.iter()
        .map(|column| {
            let brightest = column.iter().fold(0.0_f64, |m, xyz| m.max(xyz[1]));
            if brightest > 0.0 { peak / brightest } else { 0.0 }
        })
        .collect()
}

fn check(request: &Request) -> Result<(), LeeError> {
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
    let margin = 5.0 * SUN_ANGULAR_RADIUS;
    let (first, last) = (request.theta[0], request.theta[request.theta.len() - 1]);
    if request.sun_disc && (first < margin || last > PI - margin) {
        let value = format!("{:.3} to {:.3} degrees", first.to_degrees(), last.to_degrees());
        let accepted = "with the sun's disc, angles from 1.4 to 178.6 degrees are accepted";
        return invalid("theta", value, accepted);
    }
    if !(0.0..=0.5).contains(&request.size_spread) {
        return invalid("size_spread", request.size_spread.to_string(), "accepted are 0 to 0.5");
    }
    if !(0.1..=100.0).contains(&request.fineness) {
        return invalid("fineness", request.fineness.to_string(), "accepted are 0.1 to 100");
    }
    Ok(())
}
