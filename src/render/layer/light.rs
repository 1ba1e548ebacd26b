//! The colours of a layer, from any side.

use super::bands::{Band, bands};
use super::place::{Met, Place};
use super::{LayerSky, Scattering};
use crate::color::{ColorWeights, Illuminant, Observer};
use crate::math::parallel::*;
use crate::phase_table::{Axes, PhaseTable};
use crate::render::RenderError;
use crate::render::directions::DirectionGrid;
use crate::transfer::{Fineness, Layer, Light, Polarisation, Side};
use std::f64::consts::{FRAC_PI_2, PI};

/// Steps of the angle to the normal and of the azimuth between which colours are interpolated, degrees.
const STEP: f64 = 0.5;
const AZIMUTH_STEP: f64 = 1.0;
/// Streams of the trial that says whether light scattered once is enough.
const TRIAL_STREAMS: usize = 8;

/// A solved layer: what to multiply phase functions by, and what else there is.
#[derive(Clone, Debug)]
pub struct LayerLight {
    /// Where it is.
    pub place: Place,
    /// Share of what the layer sends back to the sun's side that was scattered more often than once in it, or by the
    /// ground.
    pub share_of_more: f64,
    /// Share of the scattered light that counts as going straight on; 0 where light scattered once is all.
    pub forward: f64,
    /// Largest relative difference from a solution of half as many streams; 0 where light scattered once is all.
    pub error: f64,
    /// The ground below, XYZ over the sun's irradiance, sr⁻¹.
    pub(in crate::render) ground: [f64; 3],
    /// In words, for who looks at the picture.
    pub notes: Vec<String>,
    once: Once,
    grid: DirectionGrid,
    /// XYZ of I, Q, U; empty where light scattered once is all.
    more: [Vec<[f32; 3]>; 3],
}

/// Factor of light scattered once.
#[derive(Clone, Debug)]
enum Once {
    /// Depth, albedo and cosine of the sun, of the whole phase function.
    Whole([f64; 3]),
    /// Without the peak, by band, each with its share of the luminance.
    Rest(Vec<(Light, f64)>),
}

impl LayerLight {
    /// Solve the layer for the tables of its particles, each with their number, and the sun.
    ///
    /// # Errors
    /// [`RenderError`] when the layer cannot be, the sun does not shine on it, or tables lack angles or colours.
    pub fn new(
        layer: &LayerSky,
        sun_elevation: f64,
        (illuminant, observer): (Illuminant, Observer),
        kinds: &[(&PhaseTable, f64)],
    ) -> Result<Self, RenderError> {
        layer.check(sun_elevation)?;
        let streams = layer.streams;
        let (bands, polarised) = bands(kinds, 2 * streams + 1)?;
        let sun = layer.place.sun(sun_elevation);
        let middle = &bands[bands.len() / 2];
        let share = layer.share_of_more(middle_layer(middle, layer), sun)?;
        let single = match layer.scattering {
            Scattering::Auto => share <= LayerSky::limit(),
            Scattering::Single => true,
            Scattering::Multiple => false,
        };
        let theta: Vec<f64> = steps(FRAC_PI_2, STEP);
        let axes = Axes { wavelength: Vec::new(), theta, phi: steps(PI, AZIMUTH_STEP) };
        let grid = DirectionGrid::new(&axes);
        let notes = vec![layer.words(share, single)];
        let depth = layer.optical_depth;
        let mut all = Self {
            place: layer.place,
            share_of_more: share,
            forward: 0.0,
            error: 0.0,
            ground: [0.0; 3],
            notes,
            once: Once::Whole([depth, middle.albedo, sun]),
            grid,
            more: Default::default(),
        };
        if single {
            return Ok(all);
        }
        let polarisation = if polarised { Polarisation::Linear } else { Polarisation::None };
        let solved =
            solve(&bands, layer, sun, Fineness { streams, polarisation, ..Fineness::default() })?;
        let wavelengths: Vec<f64> = bands.iter().map(|band| band.wavelength).collect();
        let weights = ColorWeights::new(&wavelengths, illuminant, observer)?.weights;
        all.colour(&axes, &solved, &weights, layer, sun);
        all.notes.push(format!(
            "light scattered many times: {streams} directions per hemisphere{}, at most {:.2} % off by them; {:.0} % of the \
             scattered light goes on within the forward peak and counts as not scattered",
            if polarised { "" } else { ", without polarisation (the tables have none)" },
            100.0 * all.error,
            100.0 * all.forward
        ));
        Ok(all)
    }

    /// What a table's particles scatter at the middle of its wavelengths, with cross-sections of scattering and
    /// extinction, m².
    #[cfg(feature = "hdf5")]
    pub(in crate::render) fn mean_phase(
        table: &PhaseTable,
        count: usize,
    ) -> Result<(crate::transfer::Expansion, [f64; 2]), RenderError> {
        let (bands, _) = bands(&[(table, 1.0)], count)?;
        let slab = &table.slabs[table.slabs.len() / 2];
        let sections = [slab.scattering_cross_section, slab.extinction_cross_section];
        Ok((bands[bands.len() / 2].phase.clone(), sections))
    }

    fn colour(
        &mut self,
        axes: &Axes,
        solved: &[(Light, f64)],
        weights: &[[f64; 3]],
        layer: &LayerSky,
        sun: f64,
    ) {
        let side = layer.place.side();
        self.forward = solved[0].0.forward;
        self.error = solved.iter().map(|(_, error)| *error).fold(0.0, f64::max);
        for ((light, _), weight) in solved.iter().zip(weights) {
            let from_ground = layer.ground_albedo * light.downward * sun / PI;
            (0..3).for_each(|c| self.ground[c] += weight[c] * from_ground);
        }
        let rows: Vec<Vec<[[f32; 3]; 3]>> = axes
            .theta
            .par_iter()
            .map(|theta| row(theta.cos(), side, axes, solved, weights))
            .collect();
        for element in 0..3 {
            self.more[element] = rows.iter().flatten().map(|stokes| stokes[element]).collect();
        }
        let lights = solved.iter().map(|(light, _)| light.clone());
        self.once = Once::Rest(lights.zip(weights.iter().map(|weight| weight[1])).collect());
    }

    /// Factor by which a phase function (sr⁻¹) becomes the radiance of light scattered once.
    pub(in crate::render) fn once(&self, cosine: f64) -> f64 {
        let side = self.place.side();
        match &self.once {
            Once::Whole([depth, albedo, sun]) => {
                albedo * crate::transfer::once(side, *depth, cosine, *sun)
            }
            Once::Rest(bands) => {
                bands.iter().map(|(light, share)| share * light.once(side, cosine)).sum()
            }
        }
    }

    /// XYZ of the rest, behind a filter at an angle ψ if there is one.
    pub(in crate::render) fn more(&self, met: &Met, filter: Option<f64>) -> [f64; 3] {
        let mut xyz = [0.0; 3];
        if self.more[0].is_empty() {
            return xyz;
        }
        let factors = match filter {
            None => [1.0, 0.0, 0.0],
            // U is odd in the azimuth
            Some(psi) => {
                let (sine, cosine) = (2.0 * psi).sin_cos();
                [0.5, 0.5 * cosine, 0.5 * sine * met.azimuth.signum()]
            }
        };
        let Some(corners) = self.grid.corners(met.cosine.acos(), met.azimuth.abs()) else {
            return xyz;
        };
        for (values, factor) in self.more.iter().zip(factors).filter(|(_, factor)| *factor != 0.0) {
            for (index, weight) in corners {
                for (sum, value) in xyz.iter_mut().zip(values[index]) {
                    *sum += factor * weight * f64::from(value);
                }
            }
        }
        xyz
    }
}

/// Even steps from 0 to an end, degrees apart.
fn steps(end: f64, degrees: f64) -> Vec<f64> {
    let count = (end.to_degrees() / degrees).round() as usize;
    (0..=count).map(|i| end * i as f64 / count as f64).collect()
}

/// XYZ of I, Q, U at one angle to the normal, by azimuth.
fn row(
    cosine: f64,
    side: Side,
    axes: &Axes,
    solved: &[(Light, f64)],
    weights: &[[f64; 3]],
) -> Vec<[[f32; 3]; 3]> {
    let mut sums = vec![[[0.0; 3]; 3]; axes.phi.len()];
    for ((light, _), weight) in solved.iter().zip(weights) {
        let orders = light.orders_at(side, cosine);
        for (sum, &azimuth) in sums.iter_mut().zip(&axes.phi) {
            let stokes = light.turned(&orders, azimuth);
            for (element, xyz) in sum.iter_mut().enumerate() {
                (0..3).for_each(|c| xyz[c] += (weight[c] * stokes[element]) as f32);
            }
        }
    }
    sums
}

/// All bands, with one share of light that goes straight on, so that light scattered once has one factor.
fn solve(
    bands: &[Band],
    layer: &LayerSky,
    sun: f64,
    fineness: Fineness,
) -> Result<Vec<(Light, f64)>, RenderError> {
    let degree = 2 * fineness.streams;
    let whole = |band: &Band| {
        let last = band.phase.alpha[0][degree] / (2 * degree + 1) as f64;
        band.peak + (1.0 - band.peak) * last.clamp(0.0, 0.9)
    };
    let mean = bands.iter().map(whole).sum::<f64>() / bands.len() as f64;
    let least = bands.iter().map(|band| band.peak).fold(0.0, f64::max);
    let fineness = Fineness { forward: Some(mean.max(least)), ..fineness };
    let solved: Result<Vec<_>, _> = bands
        .par_iter()
        .with_max_len(1)
        .map(|band| middle_layer(band, layer).light_with_error(sun, layer.place.side(), &fineness))
        .collect();
    Ok(solved?)
}

fn middle_layer<'a>(band: &'a Band, layer: &LayerSky) -> Layer<'a> {
    Layer {
        optical_depth: layer.optical_depth,
        albedo: band.albedo,
        phase: &band.phase,
        peak: band.peak,
        ground_albedo: layer.ground_albedo,
    }
}

impl LayerSky {
    /// Share of what a layer sends back that was scattered more often than once, by a coarse solution.
    pub(in crate::render) fn share_of_more(
        &self,
        layer: Layer<'_>,
        sun: f64,
    ) -> Result<f64, RenderError> {
        let fineness = Fineness {
            streams: TRIAL_STREAMS,
            polarisation: Polarisation::None,
            ..Fineness::default()
        };
        let light = layer.light(sun, &[], &fineness)?;
        Ok(1.0 - light.reflected_once / light.reflected)
    }
}
