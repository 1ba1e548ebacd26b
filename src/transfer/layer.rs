//! A layer and what is asked of it.

use super::error::TransferError;
use super::expansion::Expansion;

/// A plane-parallel layer of particles over a Lambertian ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer<'a> {
    /// Of extinction, along the normal.
    pub optical_depth: f64,
    /// Share of the extinction that is scattering.
    pub albedo: f64,
    /// How the particles scatter.
    pub phase: &'a Expansion,
    /// Share of the scattered light that goes straight on and is not in `phase`: a forward peak that no
    /// expansion holds.
    pub peak: f64,
    /// Share of light that the ground throws back, evenly to all sides.
    pub ground_albedo: f64,
}

/// Components of light that are followed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Polarisation {
    /// The intensity alone, as if nothing were polarised.
    None,
    /// I, Q, U: linear polarisation, without what comes back to it from circular.
    #[default]
    Linear,
    /// I, Q, U, V.
    Full,
}

impl Polarisation {
    pub(super) fn components(self) -> usize {
        match self {
            Self::None => 1,
            Self::Linear => 3,
            Self::Full => 4,
        }
    }
}

/// How finely a layer is solved.
#[derive(Clone, Debug, PartialEq)]
pub struct Fineness {
    /// Directions per hemisphere: coefficients below twice as many are kept.
    pub streams: usize,
    /// Components of light.
    pub polarisation: Polarisation,
    /// Optical depth at most that doubling starts from.
    pub start: f64,
    /// Share of the light that goes straight on, in all; absent: by δ-M.
    pub forward: Option<f64>,
    /// Orders of the series in azimuth are added up to this share of the first.
    pub least_order: f64,
}

impl Default for Fineness {
    fn default() -> Self {
        Self {
            streams: 24,
            polarisation: Polarisation::Linear,
            start: 3e-5,
            forward: None,
            least_order: 1e-6,
        }
    }
}

/// Optical depths that are accepted: beyond, the layer is as good as a wall.
const DEEPEST: f64 = 1e4;
/// Streams that are accepted.
const STREAMS: [usize; 2] = [2, 200];

/// Refuse what no layer can be.
pub(super) fn check(
    layer: &Layer<'_>,
    sun: f64,
    views: &[f64],
    fineness: &Fineness,
) -> Result<(), TransferError> {
    let within = |field, value: f64, holds: bool, accepted| {
        if holds { Ok(()) } else { Err(TransferError { field, value, accepted }) }
    };
    let depth = layer.optical_depth;
    within(
        "optical_depth",
        depth,
        depth > 0.0 && depth <= DEEPEST,
        "numbers above 0, up to 10000",
    )?;
    for (field, value) in [("albedo", layer.albedo), ("ground_albedo", layer.ground_albedo)] {
        within(field, value, (0.0..=1.0).contains(&value), "0 to 1")?;
    }
    within("peak", layer.peak, (0.0..1.0).contains(&layer.peak), "0 to below 1")?;
    within(
        "cosine of the sun",
        sun,
        sun > 0.0 && sun <= 1.0,
        "numbers above 0 (the sun above the layer), up to 1",
    )?;
    for &view in views {
        within("cosine of a view", view, view > 0.0 && view <= 1.0, "numbers above 0, up to 1")?;
    }
    let streams = fineness.streams;
    let known = (STREAMS[0]..=STREAMS[1]).contains(&streams);
    within("streams", streams as f64, known, "2 to 200")?;
    within(
        "start",
        fineness.start,
        fineness.start > 0.0 && fineness.start < 1.0,
        "numbers above 0, below 1",
    )?;
    let forward = fineness.forward.unwrap_or(layer.peak);
    within(
        "forward",
        forward,
        (layer.peak..1.0).contains(&forward),
        "from the layer's peak to below 1",
    )?;
    let first = layer.phase.alpha[0].first().copied().unwrap_or(0.0);
    within(
        "phase.alpha[0][0]",
        first,
        (first - 1.0).abs() < 1e-6,
        "1: all light is scattered somewhere",
    )
}
