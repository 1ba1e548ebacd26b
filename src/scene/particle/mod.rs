//! The section `[particle]` of a scene: what scatters, how large it is, what it is made of.

pub(super) mod medium;
mod own;
mod smooth;

use crate::scene::choice::{AxisRatioKey, CantingKeys, Choice, Named, ShapeName, chosen};
use crate::scene::error::SceneError;
use crate::scene::file::ParticleKeys;
use crate::scene::{Method, Particle};
use crate::shape::{Crystal, Mesh, RaindropModel};
use crate::size_distribution::SizeDistribution;
use std::path::Path;
use std::sync::Arc;

/// Axis ratios beyond these are needles and discs, for which neither rays nor drops are meant.
const AXIS_RATIOS: std::ops::RangeInclusive<f64> = 0.1..=10.0;
/// The same of crystals.
const CRYSTAL_RATIOS: std::ops::RangeInclusive<f64> = 0.02..=50.0;
/// Radii of spheres and spheroids, millimetres: from a nanometre to a centimetre.
const RADII_MM: std::ops::RangeInclusive<f64> = 1e-6..=10.0;

/// Whether rays serve a particle: any that is no sphere and has no facets, or what is asked for.
pub(in crate::scene) fn is_by_rays(keys: &ParticleKeys, method: Method) -> bool {
    let sphere = keys.shape == Some(Choice(ShapeName::Sphere));
    let crystal = keys.shape.is_some_and(|shape| shape.0.is_crystal());
    method == Method::Rays || method == Method::Auto && !sphere && !crystal
}

/// Shape, size and what goes with the shape.
pub(in crate::scene) fn particle_of(
    keys: &ParticleKeys,
    sizes: Option<&SizeDistribution>,
    folder: &Path,
) -> Result<Particle, SceneError> {
    let shape = chosen(keys.shape, "particle.shape")?;
    only_of_meshes(keys, shape)?;
    smooth::only_of_outlines(keys, shape)?;
    let radius = |accept: &dyn Fn(f64) -> Result<(), String>| match sizes {
        Some(sizes) => Ok(sizes.effective_radius()),
        None => radius(keys, accept),
    };
    let proportioned =
        matches!(shape, ShapeName::Spheroid | ShapeName::Superellipsoid) || shape.is_crystal();
    if let (Some(ratio), true) = (keys.axis_ratio, !proportioned || shape.is_regular()) {
        let accepted = format!(
            "only a spheroid, a superellipsoid or a crystal with a length has an axis ratio; the shape is {}",
            shape.name()
        );
        return Err(SceneError::invalid("particle.axis_ratio", ratio, accepted));
    }
    if let (Some(model), true) = (keys.model, shape != ShapeName::Raindrop) {
        let accepted = format!("only a raindrop has a shape model; the shape is {}", shape.name());
        return Err(SceneError::invalid("particle.model", model.0.name(), accepted));
    }
    if let (Some(apex), false) = (keys.apex_deg, shape.has_apex()) {
        let accepted = format!(
            "only a triangular-prism, a pyramidal-crystal, a bullet and a tapered-column have an apex; the shape is {}",
            shape.name()
        );
        return Err(SceneError::invalid("particle.apex_deg", apex, accepted));
    }
    match shape {
        ShapeName::Mesh => mesh(keys, sizes, folder),
        ShapeName::Harmonics | ShapeName::Superellipsoid => Ok(Particle::Own {
            radius: radius(&plain_radius)?,
            body: smooth::outline(keys, shape)?,
        }),
        crystal if crystal.is_crystal() => Ok(Particle::Crystal {
            radius: radius(&plain_radius)?,
            crystal: self::crystal(crystal, keys)?,
        }),
        ShapeName::Sphere => Ok(Particle::Sphere { radius: radius(&plain_radius)? }),
        ShapeName::Spheroid => Ok(Particle::Spheroid {
            radius: radius(&plain_radius)?,
            axis_ratio: match keys.axis_ratio {
                Some(AxisRatioKey::Law(law)) => law.axis_ratio(2.0 * radius(&plain_radius)?),
                other => axis_ratio_of(
                    other,
                    "vertical over horizontal diameter of the spheroid",
                    AXIS_RATIOS,
                )?,
            },
        }),
        // the last kind that is no crystal
        _ => {
            let model = chosen(keys.model, "particle.model")?;
            if let Some((_, to)) = sizes.map(SizeDistribution::bounds) {
                raindrop_limit(model, to * 1e3).map_err(|accepted| sizes_error(keys, accepted))?;
            }
            let radius = radius(&|radius_mm| raindrop_radius(model, radius_mm))?;
            Ok(Particle::Raindrop { radius, model })
        }
    }
}

/// Angles of wedges and tips, degrees.
const APEXES: std::ops::RangeInclusive<f64> = 2.0..=178.0;

/// A crystal's proportions.
fn crystal(shape: ShapeName, keys: &ParticleKeys) -> Result<Crystal, SceneError> {
    let axis_ratio = || match keys.axis_ratio {
        Some(AxisRatioKey::Law(law)) => {
            let accepted = "a law is for drops; a crystal takes a number, length over width";
            Err(SceneError::invalid("particle.axis_ratio", law.name(), accepted))
        }
        other => axis_ratio_of(other, "length over width of the crystal", CRYSTAL_RATIOS),
    };
    let apex = || -> Result<f64, SceneError> {
        let accepted = format!(
            "angle of the wedge, or between opposite facets of a pyramid, {} to {} degrees",
            APEXES.start(),
            APEXES.end()
        );
        match keys.apex_deg {
            None => Err(SceneError::missing("particle.apex_deg", accepted)),
            Some(apex) if APEXES.contains(&apex) => Ok(apex.to_radians()),
            Some(apex) => Err(SceneError::invalid("particle.apex_deg", apex, accepted)),
        }
    };
    Ok(match shape {
        ShapeName::TriangularPrism => {
            Crystal::TriangularPrism { axis_ratio: axis_ratio()?, apex: apex()? }
        }
        ShapeName::Cuboid => Crystal::Cuboid { axis_ratio: axis_ratio()? },
        ShapeName::Octahedron => Crystal::Octahedron,
        ShapeName::Brilliant => Crystal::Brilliant,
        ShapeName::TaperedColumn => {
            Crystal::TaperedColumn { axis_ratio: axis_ratio()?, apex: apex()? }
        }
        ShapeName::PyramidalCrystal => {
            Crystal::PyramidalCrystal { axis_ratio: axis_ratio()?, apex: apex()? }
        }
        ShapeName::Bullet => Crystal::Bullet { axis_ratio: axis_ratio()?, apex: apex()? },
        _ => Crystal::HexagonalColumn { axis_ratio: axis_ratio()? },
    })
}

/// Keys that say of a mesh where it is, and how large.
fn only_of_meshes(keys: &ParticleKeys, shape: ShapeName) -> Result<(), SceneError> {
    if shape == ShapeName::Mesh {
        return Ok(());
    }
    let file = keys.file.as_ref().map(|file| ("particle.file", file.display().to_string()));
    let unit = keys.file_unit.map(|unit| ("particle.file_unit", unit.0.name().to_string()));
    match file.or(unit) {
        None => Ok(()),
        Some((key, value)) => {
            let accepted =
                format!("only shape = \"mesh\" has a file; the shape is {}", shape.name());
            Err(SceneError::invalid(key, value, accepted))
        }
    }
}

/// The closed convex body of a file in `folder`.
fn mesh(
    keys: &ParticleKeys,
    sizes: Option<&SizeDistribution>,
    folder: &Path,
) -> Result<Particle, SceneError> {
    const KEY: &str = "particle.file";
    let Some(file) = &keys.file else {
        let accepted = "the mesh of a closed convex body, such as \"gem.obj\" (.obj, .stl, .ply)";
        return Err(SceneError::missing(KEY, accepted));
    };
    let mesh = Mesh::load(&folder.join(file))
        .map_err(|error| SceneError::invalid(KEY, file.display(), error.to_string()))?;
    let radius = match (keys.file_unit, sizes) {
        (Some(unit), None) if !has_size(keys) => {
            let radius_mm = mesh.radius() * unit.0.millimetres();
            plain_radius(radius_mm).map_err(|accepted| {
                let value =
                    format!("{} (a radius of equal volume of {radius_mm} mm)", unit.0.name());
                SceneError::invalid("particle.file_unit", value, accepted)
            })?;
            radius_mm * 1e-3
        }
        (Some(unit), _) => {
            let accepted = "the size is given twice; keep file_unit, or the radius of equal volume";
            return Err(SceneError::invalid("particle.file_unit", unit.0.name(), accepted));
        }
        (None, Some(sizes)) => sizes.effective_radius(),
        (None, None) => radius(keys, plain_radius)?,
    };
    Ok(Particle::Crystal { radius, crystal: Crystal::Mesh(Arc::new(mesh)) })
}

fn has_size(keys: &ParticleKeys) -> bool {
    keys.radius_mm.or(keys.radius_um).or(keys.diameter_mm).is_some()
}

/// What is wrong with a distribution of sizes.
fn sizes_error(keys: &ParticleKeys, accepted: impl Into<String>) -> SceneError {
    let written = keys.size_distribution.as_ref().map(ToString::to_string).unwrap_or_default();
    SceneError::invalid("particle.size_distribution", written, accepted)
}

/// Many sizes in place of one; files that it names are looked for in `folder`.
pub(in crate::scene) fn size_distribution(
    keys: &ParticleKeys,
    folder: &Path,
) -> Result<Option<SizeDistribution>, SceneError> {
    let Some(sizes) = &keys.size_distribution else { return Ok(None) };
    if has_size(keys) {
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
pub(in crate::scene) fn canting(keys: &ParticleKeys) -> Result<f64, SceneError> {
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

fn axis_ratio_of(
    ratio: Option<AxisRatioKey>,
    meaning: &str,
    ratios: std::ops::RangeInclusive<f64>,
) -> Result<f64, SceneError> {
    const KEY: &str = "particle.axis_ratio";
    let accepted = format!("{meaning}, {} to {}", ratios.start(), ratios.end());
    match ratio {
        None => Err(SceneError::missing(KEY, accepted)),
        Some(AxisRatioKey::Number(ratio)) if ratios.contains(&ratio) => Ok(ratio),
        Some(ratio) => Err(SceneError::invalid(KEY, ratio, accepted)),
    }
}
