//! How finely one column of a Lee diagram is sampled, so that its colours are right and nothing is
//! computed that nobody sees.
//!
//! Two rays that reach the same angle from impact parameters `b₁`, `b₂` (in radii) beat with the
//! frequency `x (b₁ - b₂)` in angle and with the difference of their paths in wavenumber.
//! - **Angles.** The sun's disc lets slow beats pass and damps fast ones; beyond a cut-off the
//!   colours average them out as well, so that the filter of [`SunFilter`](crate::sun_disc::SunFilter) drops
//!   them. The intensity of a drop holds no frequency above `2x` (partial waves end near n = x). A
//!   grid of step `2π / (2x + cut-off + transition)` therefore gives the average without aliasing.
//! - **Wavelengths** stand unevenly, most densely where the eye weighs most (`wavelengths.rs`); an
//!   even grid falls into step with pairs of rays. What passes the filter are beats of nearly the
//!   same way through the drop, few over the visible; a moderate number of wavelengths resolves
//!   them. Small drops need more: there nearly every beat passes.
//! - **Resonances** of light that runs round inside recur in the size parameter at the spacing
//!   `arctan(m')/m'`, `m' = √(m² - 1)` (Chýlek 1990, J. Opt. Soc. Am. A 7, 1609). A grid that is
//!   nearly commensurate with it hits or misses all of them alike. The number of wavelengths is
//!   moved to the nearest one whose step is a whole number of spacings and the golden section.

use super::wavelengths::{BAND, nodes};
use crate::color::SUN_ANGULAR_RADIUS;
use crate::math::GOLDEN;
use crate::series::even_angles::AngleSums;
use std::f64::consts::{PI, TAU};
use std::ops::Range;

/// Cut-off of the filter: this share of the size parameter …
const CUTOFF_SHARE: f64 = 0.6;
/// … and never less, or more. The disc damps a beat of 1500 only to 10 %: ended there, the finest
/// fringes of drops beyond 0.6 mm cost ΔE 1.1.
const CUTOFF: (f64, f64) = (1000.0, 3000.0);
/// The same of rays, whose angles cost more and whose diagrams keep less of the fine fringes.
const CUTOFF_SHARE_APART: f64 = 0.3;
const CUTOFF_APART: (f64, f64) = (500.0, 1500.0);
/// The same near the axis, where path differences are small.
const CUTOFF_NEAR_AXIS: (f64, f64) = (500.0, 2500.0);
/// Width over which the filter falls from 1 to 0; its kernel is then shorter than five disc radii.
pub const TRANSITION: f64 = 1000.0;
/// Closer to the axis than this, beats between opposite sides of the drop are slow in wavelength.
const NEAR_AXIS: f64 = 15.0 * PI / 180.0;
/// Partial waves beyond n = x that still count, in angular frequency.
const BEYOND_EDGE: f64 = 15.0;
/// Number of wavelengths: for small drops; from which size parameter it falls, and with which
/// power; and the least. Measured, see `validation/look.md`.
const MOST: f64 = 2000.0;
const FALLS_FROM: f64 = 1500.0;
const FALLS_AS: f64 = 1.3;
const LEAST: f64 = 240.0;
/// The same of waves without beats between orders: a few beats of the supernumerary bows remain.
const MOST_APART: f64 = 64.0;
const LEAST_APART: f64 = 40.0;
/// Two rays of one order stand this far apart at the most, between 15° and 165°.
const WITHIN_ORDER: f64 = 0.8;
/// Least number with a spread of sizes, which takes its sizes from the same samples.
const LEAST_SPREAD: f64 = 240.0;
/// Without the disc nothing damps the beats: path differences up to this many radii, this often.
const LONGEST_PATH: f64 = 5.5;
const PER_BEAT: f64 = 1.5;
/// Wavelengths that share one grid of angles and one limb darkening.
const BANDS: usize = 8;

/// Which waves beat with each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beats {
    /// All: the exact series.
    All,
    /// Rays of one order only; the orders' intensities are added. What is lost are beats with path
    /// differences of several radii, which colours of the smallest drops already average out.
    WithinOrders,
}

/// What decides how a column is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SamplingNeed {
    /// Metres.
    pub radius: f64,
    /// Refractive index of the drop, real part, in the middle of the visible.
    pub index: f64,
    /// Averaged over the sun's disc.
    pub sun_disc: bool,
    /// How fast intensities change with size.
    pub beats: Beats,
    /// Standard deviation of ln(radius).
    pub size_spread: f64,
    /// First and last scattering angle, radians.
    pub angles: (f64, f64),
    /// Factor on the number of wavelengths, and on the cut-off in angle.
    pub fineness: f64,
}

/// How finely one column is sampled.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampling {
    /// Wavelengths, metres, descending.
    pub wavelengths: Vec<f64>,
    /// Interval of wavelength that each stands for, up to a common factor.
    pub widths: Vec<f64>,
    /// Beats that are kept, radians⁻¹.
    pub cutoff: f64,
    /// Finest step in scattering angle that any wavelength needs, radians.
    pub finest_step: f64,
    /// Wavelengths (places in the list above) that share a grid of angles.
    pub bands: Vec<Band>,
}

/// Neighbouring wavelengths on one grid of angles.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// Which samples it is the mean over.
    pub places: Range<usize>,
    /// Steps in scattering angle per full turn.
    pub per_turn: usize,
}

impl Band {
    /// Step in scattering angle, radians.
    pub fn step(&self) -> f64 {
        TAU / self.per_turn as f64
    }
}

impl Sampling {
    /// Sampling of one column.
    pub fn new(need: &SamplingNeed) -> Self {
        let wavenumbers = (TAU / BAND.1, TAU / BAND.0);
        let range = (wavenumbers.1 - wavenumbers.0) * need.radius;
        let wanted = number(need, range);
        let count = match need.beats {
            Beats::All => off_resonance(wanted, range, need.index),
            Beats::WithinOrders => wanted.ceil() as usize,
        };
        let (wavelengths, widths) = nodes(count);
        // Sizes reach this far above the nominal one.
        let largest = need.radius * (LARGEST_QUANTILE * need.size_spread).exp();
        let share = if need.beats == Beats::All || near_axis(need) { 2.0 } else { WITHIN_ORDER };
        let highest = |wavelength: f64| share * (TAU / wavelength * largest + BEYOND_EDGE);
        let cutoff = cutoff(need).min(highest(BAND.0));
        let finest_step = TAU / (highest(BAND.0) + cutoff + TRANSITION);
        let bands = (0..count)
            .step_by(count.div_ceil(BANDS))
            .map(|from| {
                let places = from..(from + count.div_ceil(BANDS)).min(count);
                let highest = highest(wavelengths[places.end - 1]);
                let least = (highest + cutoff + TRANSITION).ceil() as usize;
                let per_turn = match need.beats {
                    Beats::All => AngleSums::per_turn(least),
                    Beats::WithinOrders => least,
                };
                Band { places, per_turn }
            })
            .collect();
        Self { wavelengths, widths, cutoff, finest_step, bands }
    }
}

/// Sizes are taken up to this quantile of the normal distribution, in standard deviations.
pub(super) const LARGEST_QUANTILE: f64 = 3.72;

/// Number of wavelengths before resonances are considered; `range` is that of the size parameter.
fn number(need: &SamplingNeed, range: f64) -> f64 {
    let middle = TAU * need.radius / 550e-9;
    let falls = (middle / FALLS_FROM).max(1.0).powf(-FALLS_AS);
    let (most, least) = match need.beats {
        Beats::All if need.size_spread > 0.0 => (MOST, LEAST_SPREAD),
        Beats::All => (MOST, LEAST),
        Beats::WithinOrders => (MOST_APART, LEAST_APART),
    };
    let with_disc = (most * falls).max(least);
    if need.beats == Beats::WithinOrders {
        return need.fineness * with_disc;
    }
    let without = (PER_BEAT * range * LONGEST_PATH / TAU).max(with_disc);
    need.fineness * if need.sun_disc { with_disc } else { without }
}

/// The number of wavelengths near `wanted` whose step is golden to the spacing of resonances.
fn off_resonance(wanted: f64, range: f64, index: f64) -> usize {
    let root = (index * index - 1.0).max(0.0).sqrt();
    if root < 1e-3 {
        return wanted.ceil() as usize;
    }
    let spacing = root.atan() / root;
    let steps = range / wanted / spacing;
    let whole = steps.floor();
    let golden = (-1..=1).flat_map(|k| {
        let whole = whole + f64::from(k);
        [whole + GOLDEN, whole + 1.0 - GOLDEN]
    });
    let below_one = (1..12).map(|power| GOLDEN.powi(power));
    let distance = |s: f64| (s / steps).ln().abs();
    let nearest = golden
        .chain(below_one)
        .filter(|s| *s > 0.0)
        .min_by(|a, b| distance(*a).total_cmp(&distance(*b)))
        .unwrap_or(steps);
    (range / (nearest * spacing)).ceil().max(1.0) as usize
}

/// Cut-off of the filter in angular frequency.
fn cutoff(need: &SamplingNeed) -> f64 {
    let size_parameter = TAU * need.radius / 550e-9;
    let (share, (least, most)) = match need.beats {
        _ if near_axis(need) => (2.0, CUTOFF_NEAR_AXIS),
        Beats::All => (CUTOFF_SHARE, CUTOFF),
        Beats::WithinOrders => (CUTOFF_SHARE_APART, CUTOFF_APART),
    };
    need.fineness * (share * size_parameter).clamp(least, most)
}

fn near_axis(need: &SamplingNeed) -> bool {
    need.angles.0 < NEAR_AXIS || need.angles.1 > PI - NEAR_AXIS
}

/// Angles that one band needs, as multiples of its step: the asked ones and the filter's reach.
pub fn grid(from: f64, to: f64, reach: f64, band: &Band) -> Range<usize> {
    let place = |theta: f64| theta.clamp(0.0, PI) / band.step();
    let last = (place(to + reach).ceil() as usize).min(band.per_turn / 2);
    place(from - reach).floor() as usize..last + 1
}

/// Closer to the axis than this, the disc is averaged as a disc and not along the angle alone: there
/// the circles of equal scattering angle bend by ρ²/2θ, 0.006° over the disc.
pub const AXIS_MARGIN: f64 = 6.0 * PI / 180.0;
/// Closest to the axis that the average along the angle reaches no further than the axis itself:
/// particles that are not round about it are not averaged over it.
pub const AXIS_LIMIT: f64 = 5.0 * SUN_ANGULAR_RADIUS;
