//! The section `[particle]` of a scene: what scatters, how large it is, what it is made of.

use super::choice::{AxisRatioKey, CantingKeys, Choice, Named, ShapeName, chosen};
use super::error::SceneError;
use super::file::ParticleKeys;
use super::{Method, Particle, Scene};
use crate::medium::{Density, Medium, MediumSpec};
use crate::shape::{OwnBody, RaindropModel};
use crate::size_distribution::SizeDistribution;
use std::path::Path;

/// Axis ratios beyond these are needles and discs, for which neither rays nor drops are meant.
const AXIS_RATIOS: std::ops::RangeInclusive<f64> = 0.1..=10.0;
/// Radii of spheres and spheroids, millimetres: from a nanometre to a centimetre.
const RADII_MM: std::ops::RangeInclusive<f64> = 1e-6..=10.0;

/// Whether rays serve a particle: any that is no sphere, or what is asked for.
pub(super) fn is_by_rays(keys: &ParticleKeys, method: Method) -> bool {
    let sphere = keys.shape == Some(Choice(ShapeName::Sphere));
    method == Method::Rays || method == Method::Auto && !sphere
}

/// Shape, size and what goes with the shape.
pub(super) fn particle_of(
    keys: &ParticleKeys,
    sizes: Option<&SizeDistribution>,
) -> Result<Particle, SceneError> {
    let shape = chosen(keys.shape, "particle.shape")?;
    let radius = |accept: &dyn Fn(f64) -> Result<(), String>| match sizes {
        Some(sizes) => Ok(sizes.effective_radius()),
        None => radius(keys, accept),
    };
    if let (Some(ratio), true) = (keys.axis_ratio, shape != ShapeName::Spheroid) {
        let accepted = format!("only a spheroid has an axis ratio; the shape is {}", shape.name());
        return Err(SceneError::invalid("particle.axis_ratio", ratio, accepted));
    }
    if let (Some(model), true) = (keys.model, shape != ShapeName::Raindrop) {
        let accepted = format!("only a raindrop has a shape model; the shape is {}", shape.name());
        return Err(SceneError::invalid("particle.model", model.0.name(), accepted));
    }
    match shape {
        ShapeName::Sphere => Ok(Particle::Sphere { radius: radius(&plain_radius)? }),
        ShapeName::Spheroid => Ok(Particle::Spheroid {
            radius: radius(&plain_radius)?,
            axis_ratio: match keys.axis_ratio {
                Some(AxisRatioKey::Law(law)) => law.axis_ratio(2.0 * radius(&plain_radius)?),
                other => axis_ratio(other)?,
            },
        }),
        ShapeName::Raindrop => {
            let model = chosen(keys.model, "particle.model")?;
            if let Some((_, to)) = sizes.map(SizeDistribution::bounds) {
                raindrop_limit(model, to * 1e3).map_err(|accepted| sizes_error(keys, accepted))?;
            }
            let radius = radius(&|radius_mm| raindrop_radius(model, radius_mm))?;
            Ok(Particle::Raindrop { radius, model })
        }
    }
}

/// What is wrong with a distribution of sizes.
fn sizes_error(keys: &ParticleKeys, accepted: impl Into<String>) -> SceneError {
    let written = keys.size_distribution.as_ref().map(ToString::to_string).unwrap_or_default();
    SceneError::invalid("particle.size_distribution", written, accepted)
}

/// Many sizes in place of one; files that it names are looked for in `folder`.
pub(super) fn size_distribution(
    keys: &ParticleKeys,
    folder: &Path,
) -> Result<Option<SizeDistribution>, SceneError> {
    let Some(sizes) = &keys.size_distribution else { return Ok(None) };
    if keys.radius_mm.or(keys.radius_um).or(keys.diameter_mm).is_some() {
        let accepted = "the size is given twice; leave out radius_mm, radius_um and diameter_mm";
        return Err(sizes_error(keys, accepted));
    }
    let checked = sizes.checked(folder).map_err(|accepted| sizes_error(keys, accepted))?;
    let (from, to) = checked.bounds();
    let sphere = keys.shape == Some(Choice(ShapeName::Sphere));
    let bounded = from > 0.0 && to.is_finite();
    if !(sphere || bounded || sizes.is_delta()) {
        let accepted = "drops that are no spheres need both limits, such as from_radius_mm = 0.1, \
                        to_radius_mm = 1.5";
        return Err(sizes_error(keys, accepted));
    }
    Ok(Some(checked))
}

/// The largest drop of many.
fn raindrop_limit(model: RaindropModel, to_mm: f64) -> Result<(), String> {
    raindrop_radius(model, to_mm).map_err(|error| format!("drops up to {to_mm} mm: {error}"))
}

/// The radius in metres from whichever size was given; `accept` judges it in millimetres.
fn radius(
    keys: &ParticleKeys,
    accept: impl Fn(f64) -> Result<(), String>,
) -> Result<f64, SceneError> {
    let given: Vec<(&str, f64, f64)> = [
        ("particle.radius_mm", keys.radius_mm, 1.0),
        ("particle.radius_um", keys.radius_um, 1e-3),
        ("particle.diameter_mm", keys.diameter_mm, 0.5),
    ]
    .into_iter()
    .filter_map(|(key, value, unit)| value.map(|value| (key, value, unit)))
    .collect();
    match given[..] {
        [(key, value, unit)] => {
            let radius_mm = value * unit;
            accept(radius_mm).map_err(|accepted| SceneError::invalid(key, value, accepted))?;
            Ok(radius_mm * 1e-3)
        }
        [] => Err(SceneError::missing(
            "particle.radius_mm",
            "give the size of the sphere of equal volume as radius_mm, radius_um or diameter_mm",
        )),
        [_, (key, value, _), ..] => Err(SceneError::invalid(
            key,
            value,
            "the size is given twice; keep one of radius_mm, radius_um, diameter_mm",
        )),
    }
}

fn plain_radius(radius_mm: f64) -> Result<(), String> {
    if RADII_MM.contains(&radius_mm) {
        return Ok(());
    }
    Err(format!("a radius must be {} to {} mm", RADII_MM.start(), RADII_MM.end()))
}

fn raindrop_radius(model: RaindropModel, radius_mm: f64) -> Result<(), String> {
    let range_mm = |model: RaindropModel| {
        let (from, to) = model.radius_range();
        (from * 1e3, to * 1e3)
    };
    let (from, to) = range_mm(model);
    if (from..=to).contains(&radius_mm) {
        return Ok(());
    }
    let mut message =
        format!("the raindrop model {} holds for radii of {from} to {to} mm", model.name());
    for (name, wider) in RaindropModel::NAMES {
        let (from, to) = range_mm(*wider);
        if (from..=to).contains(&radius_mm) {
            message += &format!("; model = \"{name}\" reaches {to} mm");
        }
    }
    Err(message)
}

/// Largest deviation of axes, degrees: beyond, tilts are no small angles.
const CANTINGS: std::ops::RangeInclusive<f64> = 0.0..=20.0;

/// Standard deviation of the axis, radians; 0 of spheres, which have none.
pub(super) fn canting(keys: &ParticleKeys) -> Result<f64, SceneError> {
    let Some(CantingKeys { deviation_deg }) = keys.canting else { return Ok(0.0) };
    if !CANTINGS.contains(&deviation_deg) {
        let accepted = format!(
            "a standard deviation of {} to {} degrees is accepted",
            CANTINGS.start(),
            CANTINGS.end()
        );
        return Err(SceneError::invalid("particle.canting", deviation_deg, accepted));
    }
    let sphere = keys.shape == Some(Choice(ShapeName::Sphere));
    Ok(if sphere { 0.0 } else { deviation_deg.to_radians() })
}

fn axis_ratio(ratio: Option<AxisRatioKey>) -> Result<f64, SceneError> {
    const KEY: &str = "particle.axis_ratio";
    let accepted = format!(
        "vertical over horizontal diameter of the spheroid, {} to {}",
        AXIS_RATIOS.start(),
        AXIS_RATIOS.end()
    );
    match ratio {
        None => Err(SceneError::missing(KEY, accepted)),
        Some(AxisRatioKey::Number(ratio)) if AXIS_RATIOS.contains(&ratio) => Ok(ratio),
        Some(ratio) => Err(SceneError::invalid(KEY, ratio, accepted)),
    }
}

/// The medium inside, which must have an index at every wavelength.
pub(super) fn medium_of(
    keys: &ParticleKeys,
    folder: &Path,
    wavelengths: &[f64],
) -> Result<Medium, SceneError> {
    const KEY: &str = "particle.medium";
    let medium =
        spec_of(keys)?.resolve(folder).map_err(|source| SceneError::medium(KEY, source))?;
    for wavelength in wavelengths {
        let index = medium.index(*wavelength).map_err(|source| SceneError::medium(KEY, source))?;
        if !(index.re > 0.0 && index.im >= 0.0 && index.is_finite()) {
            let accepted = "an index n + ik needs n > 0 and k ≥ 0";
            return Err(SceneError::invalid(KEY, index, accepted));
        }
        if (index - 1.0).norm() < 1e-9 {
            return Err(SceneError::invalid(KEY, index, "an index of 1 scatters no light"));
        }
    }
    Ok(medium)
}

/// The medium as written, with the temperature that may stand beside it.
fn spec_of(keys: &ParticleKeys) -> Result<MediumSpec, SceneError> {
    let mut spec = keys.medium.clone().unwrap_or_default();
    match (&mut spec, keys.temperature_c) {
        (MediumSpec::Named(named), Some(celsius)) => {
            if let Some(own) = named.temperature_c.filter(|own| *own != celsius) {
                let accepted = format!("the medium itself says {own}; give one of the two");
                return Err(SceneError::invalid("particle.temperature_c", celsius, accepted));
            }
            named.temperature_c = Some(celsius);
        }
        (_, Some(celsius)) => {
            let accepted = "only a medium of the library has a temperature";
            return Err(SceneError::invalid("particle.temperature_c", celsius, accepted));
        }
        (_, None) => {}
    }
    Ok(spec)
}

/// Densities of the medium, kg/m³: from gases to osmium.
const DENSITIES: std::ops::RangeInclusive<f64> = 1e-3..=3e4;
/// A constant index that is water's within this at every wavelength is taken for water's.
const LIKE_WATER: f64 = 0.012;

/// The density of the medium: the one given, or the library's. A constant index that is that of water
/// stands for water, and the source says that this is assumed.
pub(super) fn density_of(
    keys: &ParticleKeys,
    wavelengths: &[f64],
) -> Result<Option<Density>, SceneError> {
    const KEY: &str = "particle.density_kg_m3";
    let spec = spec_of(keys)?;
    let given_with_medium = match &spec {
        MediumSpec::Named(named) => named.density_kg_m3,
        _ => None,
    };
    match (keys.density_kg_m3, given_with_medium) {
        (Some(density), _) if !DENSITIES.contains(&density) => {
            let accepted = format!("{} to {} kg/m³", DENSITIES.start(), DENSITIES.end());
            Err(SceneError::invalid(KEY, density, accepted))
        }
        (Some(density), Some(other)) if density != other => {
            let accepted = format!("the medium has density_kg_m3 = {other}; keep one of the two");
            Err(SceneError::invalid(KEY, density, accepted))
        }
        (Some(kg_m3), _) => Ok(Some(Density { kg_m3, source: "given".into() })),
        (None, _) => match &spec {
            MediumSpec::Index { n, k } if is_like_water(*n, *k, wavelengths) => {
                let source = format!("assumed: the index {n} is that of water");
                Ok(Some(Density { kg_m3: 1000.0, source }))
            }
            spec => spec.density().map_err(|error| SceneError::medium("particle.medium", error)),
        },
    }
}

fn is_like_water(n: f64, k: f64, wavelengths: &[f64]) -> bool {
    let water = Medium::Water { temperature: 293.15 };
    wavelengths.iter().all(|wavelength| {
        let close = |m: num_complex::Complex64| (m.re - n).hypot(m.im - k) <= LIKE_WATER;
        water.index(*wavelength).is_ok_and(close)
    })
}

/// Scenes of what no file can name: bodies and media that a program brings itself.
impl Scene {
    /// This scene with a body of one's own in place of its particle; `radius` is that of the sphere of
    /// equal volume, metres. The record of the scene ([`Scene::toml`]) names it; it is not a scene file
    /// that could be read again.
    ///
    /// ```
    /// use gonio::math::{jet::Jet, scalar::Scalar};
    /// use gonio::scene::{Scene, SceneFile};
    /// use gonio::shape::{Outline, OwnBody};
    ///
    /// #[derive(Debug)]
    /// struct Ball;
    /// impl Outline for Ball {
    ///     fn level<T: Scalar>(&self, q: Jet<T>, _depth: Jet<T>) -> Jet<T> {
    ///         q - 1.0
    ///     }
    /// }
    /// let scene = Scene::built_in(&SceneFile::default())?;
    /// let scene = scene.with_own_body(OwnBody::new("ball", Ball)?, 0.3e-3);
    /// assert!(scene.toml.contains("shape = \"ball\""));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_own_body(mut self, body: OwnBody, radius: f64) -> Scene {
        let struck =
            ["axis_ratio", "canting", "model", "radius_um", "diameter_mm", "size_distribution"];
        let keys = [("shape", body.name().into()), ("radius_mm", (radius * 1e3).into())];
        self.note_particle(&struck, keys);
        self.size_distribution = None;
        self.modes = Vec::new();
        (self.axis_ratio_law, self.canting) = (None, 0.0);
        self.particle = Particle::Own { radius, body };
        self
    }

    /// This scene with a medium of one's own; `density` where it is known. The record names it.
    #[must_use]
    pub fn with_own_medium(mut self, medium: Medium, density: Option<Density>) -> Scene {
        let density_key = density.as_ref().map(|density| ("density_kg_m3", density.kg_m3.into()));
        let keys = [Some(("medium", medium.name().into())), density_key].into_iter().flatten();
        self.note_particle(&["temperature_c", "density_kg_m3"], keys);
        (self.medium, self.density) = (medium, density);
        self
    }

    /// Strike keys of the particle from the record, and write others into it.
    fn note_particle<'k>(
        &mut self,
        struck: &[&str],
        keys: impl IntoIterator<Item = (&'k str, toml::Value)>,
    ) {
        // the record was written by this program
        let Ok(mut record) = self.toml.parse::<toml::Table>() else { return };
        if let Some(particle) = record.get_mut("particle").and_then(toml::Value::as_table_mut) {
            particle.retain(|name, _| !struck.contains(&name));
            particle.extend(keys.into_iter().map(|(name, value)| (name.to_string(), value)));
        }
        self.toml = record.to_string();
    }
}
