//! The sky: sunlight scattered once in a sheet of rain, in front of a background.
//!
//! The sun is a disc behind the camera. A vertical curtain of rain of optical depth τ stands
//! across the antisolar direction, lit from the front. Light that comes from depth t has been
//! dimmed by exp(−t/μ₀) on its way in and exp(−t/μ) on its way out (μ₀, μ: cosines to the curtain's
//! normal), so its radiance over the sun's irradiance is
//! `P · μ₀/(μ₀+μ) · (1 − exp(−τ(1/μ₀ + 1/μ)))`. The background is that which is seen beside the bow, through the rain: its
//! colour comes out as it is stated, and the bow is added as light.
//! Drops or crystals that fill the air all around (`RainShape::Around`) have μ = μ₀ = 1 everywhere.
//! Light scattered more than once is left out, but where there is a [layer](super::layer).

use super::camera::Camera;
use super::error::RenderError;
use super::layer::{LayerLight, Place};
use super::linear_picture::LinearPicture;
use super::picture::Picture;
use super::tristimulus::Tristimulus;
use crate::color::{
    Illuminant, Observer, SUN_ANGULAR_RADIUS, encode_srgb, fit_gamut, xyz_to_linear_srgb,
};
use crate::math::parallel::*;
use crate::phase_table::{PhaseTable, Quantity};
use crate::sun_disc::DiscPoints;
use crate::transfer::{Side, once};
use glam::DVec3;
use std::f64::consts::TAU;

/// Where the drops are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RainShape {
    /// A curtain of rain at a distance.
    Curtain,
    /// Rain all about the observer.
    Around,
}

/// Everything but the camera and the drops.
#[derive(Clone, Debug, PartialEq)]
pub struct Sky {
    /// Sun above the horizon, radians.
    pub sun_elevation: f64,
    /// Whether the sun's disc smooths it.
    pub sun_disc: bool,
    /// What shines.
    pub illuminant: Illuminant,
    /// Whose eyes.
    pub observer: Observer,
    /// Where the rain is.
    pub rain: RainShape,
    /// Optical depth of the rain along a line of sight.
    pub optical_depth: f64,
    /// Colour of what is seen through the rain, beside the bow, linear sRGB.
    pub background: [f64; 3],
    /// Colour below the horizon, linear sRGB; absent: rain falls there too.
    pub ground: Option<[f64; 3]>,
    /// Luminance of the brightest bow pixel before the background is added.
    pub brightness: f64,
    /// Exposure given outright (white is 1/exposure sr⁻¹), in place of `brightness`.
    pub exposure: Option<f64>,
    /// Transmission axis of a polarising filter, radians from the horizontal, counter-clockwise.
    pub polariser: Option<f64>,
    /// Draw the horizon as a line.
    pub horizon_line: bool,
}

/// A kind of drop and how many of them there are (relative numbers).
pub struct Drops<'a> {
    /// How one kind of drop scatters.
    pub table: &'a PhaseTable,
    /// Drops of this kind, relative to the others.
    pub number: f64,
}

/// Rings of the sun's disc and points on each.
const RINGS: usize = 4;
const POINTS: usize = 12;

/// XYZ of Stokes I, Q, U over the directions, mixed by number × cross-section.
struct Mixture {
    /// Without azimuth dependence, or from a table that sees the disc: averaged over it beforehand.
    smooth: Vec<Kind>,
    /// The others, per ring of the disc.
    rings: Vec<Vec<Kind>>,
    disc: DiscPoints,
}

/// One kind of drop: its share, and XYZ of I or of I, Q, U.
struct Kind {
    share: f64,
    stokes: Vec<Tristimulus>,
}

impl Kind {
    /// Add the share of this kind in a direction; false where its table does not reach.
    fn add(&self, theta: f64, phi: f64, factors: [f64; 3], sum: &mut [f64; 3]) -> bool {
        for (element, factor) in self.stokes.iter().zip(factors) {
            let Some(xyz) = element.at(theta, phi) else { return false };
            (0..3).for_each(|c| sum[c] += self.share * factor * xyz[c]);
        }
        true
    }
}

/// A drawn sky, and what it lacks.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// As the camera sees it.
    pub picture: Picture,
    /// Share of the rain seen whose scattering angles no table has: there is the background alone.
    pub untold: f64,
}

/// Draw the sky.
///
/// # Errors
/// [`RenderError`] when tables lack colours, polarisation or the directions that the camera sees,
/// belong to another sun, or when the camera sees no sky.
pub fn render(camera: &Camera, sky: &Sky, drops: &[Drops<'_>]) -> Result<Drawn, RenderError> {
    render_layer(camera, sky, drops, None)
}

/// Draw the sky with a layer in place of the rain; the same without one.
///
/// # Errors
/// As [`render`].
pub fn render_layer(
    camera: &Camera,
    sky: &Sky,
    drops: &[Drops<'_>],
    layer: Option<&LayerLight>,
) -> Result<Drawn, RenderError> {
    let pixels = seen(camera, sky, drops, layer)?;
    let peak = brightest(&pixels);
    let usual = if peak > 0.0 { sky.brightness / peak } else { 0.0 };
    let exposure = sky.exposure.unwrap_or(usual);
    let mut picture = Picture::new(camera.width, camera.height);
    for (rgb, pixel) in picture.rgb.chunks_exact_mut(3).zip(&pixels) {
        rgb.copy_from_slice(&pixel.srgb(sky, exposure, layer));
    }
    let rain = pixels.iter().filter(|p| matches!(p, Pixel::Rain { .. })).count();
    let untold = pixels.iter().filter(|p| p.is_untold()).count();
    Ok(Drawn { picture, untold: untold as f64 / rain as f64 })
}

/// The light of the bow alone, linear sRGB per irradiance of the sun, and the luminance of its brightest place.
///
/// # Errors
/// As [`render`].
pub fn light(
    camera: &Camera,
    sky: &Sky,
    drops: &[Drops<'_>],
    layer: Option<&LayerLight>,
) -> Result<(LinearPicture, f64), RenderError> {
    let pixels = seen(camera, sky, drops, layer)?;
    let of = |pixel: &Pixel| match pixel {
        Pixel::Rain { bow: Some(xyz), .. } => xyz_to_linear_srgb(*xyz).map(|v| v as f32),
        _ => [0.0; 3],
    };
    let rgb = pixels.iter().flat_map(of).collect();
    Ok((LinearPicture { width: camera.width, height: camera.height, rgb }, brightest(&pixels)))
}

/// Luminance of the brightest pixel: the bow is what the picture is about; light from near the sun may burn out.
fn brightest(pixels: &[Pixel]) -> f64 {
    let most = |behind: bool| {
        pixels.iter().fold(0.0_f64, |most, pixel| match pixel {
            Pixel::Rain { bow: Some(xyz), back, .. } if *back || !behind => most.max(xyz[1]),
            _ => most,
        })
    };
    if most(true) > 0.0 { most(true) } else { most(false) }
}

/// What all pixels see.
fn seen(
    camera: &Camera,
    sky: &Sky,
    drops: &[Drops<'_>],
    layer: Option<&LayerLight>,
) -> Result<Vec<Pixel>, RenderError> {
    camera.validate()?;
    check(sky, drops)?;
    let mixture = Mixture::new(sky, drops)?;
    let pixels: Vec<Pixel> = (0..camera.width * camera.height)
        .into_par_iter()
        .map(|i| {
            let (row, column) = (i / camera.width, i % camera.width);
            pixel(camera, sky, (&mixture, layer), column as f64 + 0.5, row as f64 + 0.5)
        })
        .collect();
    if !pixels.iter().any(|p| matches!(p, Pixel::Rain { bow: Some(_), .. })) {
        let rain = pixels.iter().any(|p| matches!(p, Pixel::Rain { .. }));
        let accepted = if rain {
            "a view in which the tables have directions: none of the scattering angles seen is \
             in a table"
        } else {
            "a view of the sky: no pixel looks at rain (above the horizon and away from the sun, or rain.shape = \
             \"around\")"
        };
        return Err(RenderError::Invalid {
            field: "camera".into(),
            value: format!(
                "elevation {:.1}, azimuth {:.1}, field of view {:.1} degrees",
                camera.elevation.to_degrees(),
                camera.azimuth.to_degrees(),
                camera.field_of_view.to_degrees()
            ),
            accepted: accepted.into(),
        });
    }
    Ok(pixels)
}

/// What one pixel sees.
enum Pixel {
    /// Beyond the lens's circle.
    Nothing,
    Ground,
    HorizonLine,
    /// Its disc.
    Sun,
    Rain {
        /// XYZ over the sun's irradiance, sr⁻¹; nothing where no table reaches.
        bow: Option<[f64; 3]>,
        /// Whether the line of sight meets the rain.
        met: bool,
        /// More than 90° from the sun.
        back: bool,
    },
}

impl Pixel {
    /// Rain of whose light no table tells.
    fn is_untold(&self) -> bool {
        matches!(self, Pixel::Rain { bow: None, met: true, .. })
    }

    fn srgb(&self, sky: &Sky, exposure: f64, layer: Option<&LayerLight>) -> [u8; 3] {
        let lit = |xyz: [f64; 3]| xyz_to_linear_srgb(xyz.map(|v| v * exposure));
        let linear = match self {
            Pixel::Nothing => [0.0; 3],
            Pixel::Ground => {
                let own = layer.map(|layer| lit(layer.ground));
                sky.ground.or(own).unwrap_or([0.0; 3])
            }
            Pixel::HorizonLine => [0.5; 3],
            Pixel::Sun => [1.0; 3],
            Pixel::Rain { bow, .. } => {
                let bow = lit(bow.unwrap_or([0.0; 3]));
                std::array::from_fn(|c| bow[c] + sky.background[c])
            }
        };
        fit_gamut(linear).map(|v| (255.0 * encode_srgb(v)).round() as u8)
    }
}

fn pixel(
    camera: &Camera,
    sky: &Sky,
    (mixture, layer): (&Mixture, Option<&LayerLight>),
    column: f64,
    row: f64,
) -> Pixel {
    let Some(view) = camera.direction(column, row) else { return Pixel::Nothing };
    if sky.horizon_line {
        let below = camera.direction(column, row + 1.0);
        if below.is_some_and(|b| (b.z < 0.0) != (view.z < 0.0)) {
            return Pixel::HorizonLine;
        }
    }
    let ground = match layer.map(|layer| layer.place) {
        Some(Place::Above) => true,
        Some(Place::Below) => false,
        Some(Place::Curtain) | None => sky.ground.is_some(),
    };
    if view.z < 0.0 && ground {
        return Pixel::Ground;
    }
    let (sun_sine, sun_cosine) = sky.sun_elevation.sin_cos();
    let light = DVec3::new(sun_cosine, 0.0, -sun_sine);
    if (-view).dot(light) > SUN_ANGULAR_RADIUS.cos() {
        return Pixel::Sun;
    }
    let (single, met) = match layer {
        None => (single_factor(sky, view), None),
        Some(layer) => {
            let met = layer.place.met(view);
            (met.map(|met| layer.once(met.cosine)), met)
        }
    };
    let Some(single) = single else {
        return Pixel::Rain { bow: None, met: false, back: false };
    };

    // The frame of the table: z along the light, x to the upper side.
    let upper = DVec3::new(sun_sine, 0.0, sun_cosine);
    let side = light.cross(upper);
    let scattered = -view;
    let (along, x, y) = (scattered.dot(light), scattered.dot(upper), scattered.dot(side));
    let theta = x.hypot(y).atan2(along);
    let phi = y.atan2(x);
    let axis = sky.polariser.map(|angle| filter_axis(view, angle));
    let filter = axis.map(|axis| filter_angle(axis, theta, phi, (upper, side, light)));
    let more = match (layer, met) {
        (Some(layer), Some(met)) => {
            let filter = axis.map(|axis| axis.dot(met.perpendicular).atan2(axis.dot(met.parallel)));
            layer.more(&met, filter)
        }
        _ => [0.0; 3],
    };
    let bow = mixture.at(theta, phi, filter);
    let bow = bow.map(|xyz| std::array::from_fn(|c| (xyz[c] * single + more[c]).max(0.0)));
    Pixel::Rain { bow, met: true, back: along < 0.0 }
}

/// Radiance of light scattered once in the rain, over irradiance and phase function; nothing where the line of sight
/// does not meet it.
fn single_factor(sky: &Sky, view: DVec3) -> Option<f64> {
    let (mu, mu0) = match sky.rain {
        RainShape::Curtain => (view.x, sky.sun_elevation.cos()),
        RainShape::Around => (1.0, 1.0),
    };
    (mu > 1e-6 && mu0 > 1e-6).then(|| once(Side::Lit, sky.optical_depth, mu, mu0))
}

/// Transmission axis of a filter, its angle from the horizontal as the camera's holder sees it.
fn filter_axis(view: DVec3, angle: f64) -> DVec3 {
    let horizontal = view.cross(DVec3::Z).normalize_or(DVec3::NEG_Y);
    let vertical = horizontal.cross(view);
    horizontal * angle.cos() + vertical * angle.sin()
}

/// Angle between the filter's axis and the parallel direction of the scattered light, with
/// `E_t = E∥ cos ψ + E⊥ sin ψ`.
fn filter_angle(
    filter: DVec3,
    theta: f64,
    phi: f64,
    (upper, side, light): (DVec3, DVec3, DVec3),
) -> f64 {
    let (st, ct) = theta.sin_cos();
    let (sp, cp) = phi.sin_cos();
    let parallel = (upper * cp + side * sp) * ct - light * st;
    let perpendicular = upper * sp - side * cp;
    filter.dot(perpendicular).atan2(filter.dot(parallel))
}

impl Mixture {
    fn new(sky: &Sky, drops: &[Drops<'_>]) -> Result<Self, RenderError> {
        let (rings, radius) = if sky.sun_disc { (RINGS, SUN_ANGULAR_RADIUS) } else { (1, 0.0) };
        let disc = DiscPoints::new(radius, rings, if sky.sun_disc { POINTS } else { 1 });
        let cross_section = |table: &PhaseTable| {
            let sum: f64 = table.slabs.iter().map(|s| s.scattering_cross_section).sum();
            sum / table.slabs.len() as f64
        };
        let total: f64 = drops.iter().map(|d| d.number * cross_section(d.table)).sum();
        let elements: &[usize] = if sky.polariser.is_some() { &[0, 4, 8] } else { &[0] };
        let kind_of = |kind: &Drops<'_>, mu: Option<f64>, smooth: bool| {
            // A table that is a mean over the disc is not smoothed again.
            let smoothed = kind.table.header.averaging.has_sun_disc();
            let radius = if smoothed { 0.0 } else { radius };
            let stokes = elements.iter().map(|&element| {
                if smooth {
                    Tristimulus::smoothed(kind.table, element, sky.illuminant, sky.observer, radius)
                } else {
                    let (light, eye) = (sky.illuminant, sky.observer);
                    Tristimulus::of_table(kind.table, element, light, eye, mu)
                }
            });
            let share = kind.number * cross_section(kind.table) / total;
            Ok::<_, RenderError>(Kind { share, stokes: stokes.collect::<Result<Vec<_>, _>>()? })
        };
        let is_round = |kind: &Drops<'_>| kind.table.header.axes.phi.len() == 1;
        let is_smooth =
            |kind: &&Drops<'_>| is_round(kind) || kind.table.header.averaging.has_sun_disc();
        let (smooth, flat): (Vec<_>, Vec<_>) = drops.iter().partition(is_smooth);
        let smooth = smooth
            .into_iter()
            .map(|kind| kind_of(kind, None, is_round(kind)))
            .collect::<Result<_, _>>()?;
        let rings = disc
            .mu
            .iter()
            .map(|&mu| {
                let mu = sky.sun_disc.then_some(mu);
                flat.iter().map(|kind| kind_of(kind, mu, false)).collect::<Result<Vec<_>, _>>()
            })
            .collect::<Result<_, _>>()?;
        Ok(Self { smooth, rings, disc })
    }

    /// XYZ in a direction, averaged over the disc, behind a filter at angle ψ if there is one.
    fn at(&self, theta: f64, phi: f64, filter: Option<f64>) -> Option<[f64; 3]> {
        let factors = match filter {
            None => [1.0, 0.0, 0.0],
            Some(psi) => [0.5, 0.5 * (2.0 * psi).cos(), 0.5 * (2.0 * psi).sin()],
        };
        let mut total = [0.0; 3];
        for kind in &self.smooth {
            if !kind.add(theta, phi, factors, &mut total) {
                return None;
            }
        }
        if self.rings.iter().all(Vec::is_empty) {
            return Some(total.map(|v| v.max(0.0)));
        }
        let (mut sum, mut count) = ([0.0; 3], 0.0);
        for (ring, kinds) in self.rings.iter().enumerate() {
            for (t, p) in self.disc.around(ring, theta, phi) {
                let mut here = [0.0; 3];
                if kinds.iter().all(|kind| kind.add(t, p, factors, &mut here)) {
                    (0..3).for_each(|c| sum[c] += here[c]);
                    count += 1.0;
                }
            }
        }
        (count > 0.0).then(|| std::array::from_fn(|c| (total[c] + sum[c] / count).max(0.0)))
    }
}

fn check(sky: &Sky, drops: &[Drops<'_>]) -> Result<(), RenderError> {
    let invalid = |field: &str, value: String, accepted: &str| {
        Err(RenderError::Invalid { field: field.into(), value, accepted: accepted.into() })
    };
    if drops.is_empty() {
        return invalid("drops", "none".into(), "at least one kind of drop");
    }
    for kind in drops {
        if !(kind.number > 0.0 && kind.number.is_finite()) {
            return invalid("drops.number", kind.number.to_string(), "a number above 0");
        }
        let header = &kind.table.header;
        if sky.polariser.is_some() && header.quantity != Quantity::Mueller {
            let accepted = "a filter needs tables with quantity = \"mueller\"";
            return invalid("filter.polariser_deg", "given".into(), accepted);
        }
        let off = (header.sun_elevation - sky.sun_elevation).abs();
        if !header.rotational_symmetry && off > 0.1 * TAU / 360.0 {
            let value = format!("{:.2}", sky.sun_elevation.to_degrees());
            let accepted = format!(
                "the elevation of the table of the {}, {:.2}: a flattened drop scatters \
                 differently at each",
                header.shape,
                header.sun_elevation.to_degrees()
            );
            return invalid("sun.elevation_deg", value, &accepted);
        }
    }
    if !(sky.optical_depth > 0.0 && sky.optical_depth <= 100.0) {
        return invalid("rain.optical_depth", sky.optical_depth.to_string(), "above 0, up to 100");
    }
    Ok(())
}
