//! The section `[particle]` of a scene: what scatters, how large it is, what it is made of.

use super::Particle;
use super::choice::{Named, ShapeName, chosen};
use super::error::SceneError;
use super::file::ParticleKeys;
use crate::medium::{Medium, MediumSpec, radial};
use crate::shape::RaindropModel;
use crate::size_distribution::SizeDistribution;
use std::path::Path;

/// Axis ratios beyond these are needles and discs, for which neither rays nor drops are meant.
const AXIS_RATIOS: std::ops::RangeInclusive<f64> = 0.1..=10.0;
/// Radii of spheres and spheroids, millimetres: from a nanometre to a centimetre.
const RADII_MM: std::ops::RangeInclusive<f64> = 1e-6..=10.0;

/// Shape, size and what goes with the shape.
pub(super) fn particle_of(keys: &ParticleKeys) -> Result<Particle, SceneError> {
    let shape = chosen(keys.shape, "particle.shape")?;
    let sizes = size_distribution(keys)?;
    if let (Some(ratio), true) = (keys.axis_ratio, shape != ShapeName::Spheroid) {
        let accepted = format!("only a spheroid has an axis ratio; the shape is {}", shape.name());
        return Err(SceneError::invalid("particle.axis_ratio", ratio, accepted));
    }
    if let (Some(model), true) = (keys.model, shape != ShapeName::Raindrop) {
        let accepted = format!("only a raindrop has a shape model; the shape is {}", shape.name());
        return Err(SceneError::invalid("particle.model", model.0.name(), accepted));
    }
    match shape {
        ShapeName::Sphere => {
            let radius = match sizes {
                Some(sizes) => sizes.effective_radius(),
                None => radius(keys, plain_radius)?,
            };
            Ok(Particle::Sphere { radius })
        }
        ShapeName::Spheroid => Ok(Particle::Spheroid {
            radius: radius(keys, plain_radius)?,
            axis_ratio: axis_ratio(keys.axis_ratio)?,
        }),
        ShapeName::Raindrop => {
            let model = chosen(keys.model, "particle.model")?;
            let radius = radius(keys, |radius_mm| raindrop_radius(model, radius_mm))?;
            Ok(Particle::Raindrop { radius, model })
        }
    }
}

/// Many spheres in place of one.
pub(super) fn size_distribution(
    keys: &ParticleKeys,
) -> Result<Option<SizeDistribution>, SceneError> {
    const KEY: &str = "particle.size_distribution";
    let Some(sizes) = &keys.size_distribution else { return Ok(None) };
    let shape = chosen(keys.shape, "particle.shape")?;
    if shape != ShapeName::Sphere {
        let accepted = format!("only spheres have one; the shape is {}", shape.name());
        return Err(SceneError::invalid(KEY, sizes, accepted));
    }
    if keys.radius_mm.or(keys.radius_um).or(keys.diameter_mm).is_some() {
        let accepted = "the size is given twice; leave out radius_mm, radius_um and diameter_mm";
        return Err(SceneError::invalid(KEY, sizes, accepted));
    }
    sizes.checked().map(Some).map_err(|accepted| SceneError::invalid(KEY, sizes, accepted))
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

fn axis_ratio(ratio: Option<f64>) -> Result<f64, SceneError> {
    const KEY: &str = "particle.axis_ratio";
    let accepted = format!(
        "vertical over horizontal diameter of the spheroid, {} to {}",
        AXIS_RATIOS.start(),
        AXIS_RATIOS.end()
    );
    match ratio {
        None => Err(SceneError::missing(KEY, accepted)),
        Some(ratio) if AXIS_RATIOS.contains(&ratio) => Ok(ratio),
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
    let mut spec = keys.medium.clone().unwrap_or_default();
    match (&mut spec, keys.temperature_c) {
        (MediumSpec::Named(named), Some(celsius)) => named.temperature_c = Some(celsius),
        (_, Some(celsius)) => {
            let accepted = "only a medium of the library has a temperature";
            return Err(SceneError::invalid("particle.temperature_c", celsius, accepted));
        }
        (_, None) => {}
    }
    let wrong = |source| SceneError::medium(KEY, source);
    let inside = spec.resolve(folder).map_err(wrong)?;
    let medium = surrounded(keys, inside, folder)?;
    let radius = particle_of(keys)?.radius();
    for wavelength in wavelengths {
        let seen = medium
            .seen_outside(*wavelength)
            .map_err(|source| SceneError::medium("particle.outside", source))?;
        let index = medium.surface_index(seen, radius).map_err(wrong)?;
        if !(index.re > 0.0 && index.im >= 0.0 && index.is_finite()) {
            let accepted = "an index n + ik needs n > 0 and k ≥ 0";
            return Err(SceneError::invalid(KEY, index, accepted));
        }
        if (index - 1.0).norm() < 1e-9 && medium.radial().is_none() {
            return Err(SceneError::invalid(KEY, index, "an index of 1 scatters no light"));
        }
    }
    Ok(medium)
}

/// The medium with its films and in its surroundings.
fn surrounded(keys: &ParticleKeys, inside: Medium, folder: &Path) -> Result<Medium, SceneError> {
    let films = keys.coating.as_deref().unwrap_or_default();
    let coated = radial::coated(inside, films, folder)
        .map_err(|source| SceneError::medium("particle.coating", source))?;
    match &keys.outside {
        None => Ok(coated),
        Some(outside) => radial::immersed(coated, outside, folder)
            .map_err(|source| SceneError::medium("particle.outside", source)),
    }
}
