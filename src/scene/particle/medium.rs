//! What a particle is made of: its medium with films and surroundings, and its density.

use crate::math::digits::to_digits;
use crate::medium::{Density, Medium, MediumSpec};
use crate::scene::error::SceneError;
use crate::scene::file::ParticleKeys;
use std::path::Path;

/// The medium of the particle with its films and its surroundings, which must have an index at every wavelength
/// (metres in vacuum). Films are thinner than the smallest of the particles.
pub(in crate::scene) fn medium_of(
    keys: &ParticleKeys,
    folder: &Path,
    radii: (f64, f64),
    wavelengths: &[f64],
) -> Result<Medium, SceneError> {
    const KEY: &str = "particle.medium";
    let wrong = |key| move |source| SceneError::medium(key, source);
    let inside = spec_of(keys)?.resolve(folder).map_err(wrong(KEY))?;
    let medium = surrounded(keys, inside, folder)?;
    let (smallest, radius) = radii;
    films_fit(keys, smallest)?;
    for wavelength in wavelengths {
        let seen = medium.seen_outside(*wavelength).map_err(wrong("particle.outside"))?;
        let index = match medium.body(seen, radius).map_err(wrong(KEY))? {
            Some(body) => body.surface(),
            None => medium.index(seen).map_err(wrong(KEY))?,
        };
        if !(index.re > 0.0 && index.im >= 0.0 && index.is_finite()) {
            let accepted = "an index n + ik needs n > 0 and k ≥ 0";
            return Err(SceneError::invalid(KEY, index, accepted));
        }
        if (index - 1.0).norm() < 1e-9 && medium.radial().is_none() {
            let accepted =
                "an index of 1 scatters no light (it counts relative to what is outside)";
            return Err(SceneError::invalid(KEY, index, accepted));
        }
    }
    Ok(medium)
}

/// The medium with its films and in its surroundings.
fn surrounded(keys: &ParticleKeys, inside: Medium, folder: &Path) -> Result<Medium, SceneError> {
    let films: Result<Vec<_>, _> =
        keys.coating.iter().flatten().map(|film| film.resolve(folder)).collect();
    let coated = films
        .and_then(|films| inside.coated(films))
        .map_err(|source| SceneError::medium("particle.coating", source))?;
    let Some(outside) = &keys.outside else { return Ok(coated) };
    outside
        .resolve(folder)
        .and_then(|outside| coated.immersed(outside))
        .map_err(|source| SceneError::medium("particle.outside", source))
}

/// Refuses films that leave nothing of the smallest particle.
fn films_fit(keys: &ParticleKeys, smallest: f64) -> Result<(), SceneError> {
    let total: f64 = keys.coating.iter().flatten().map(|film| film.thickness_nm).sum();
    if total == 0.0 || total < smallest * 1e9 {
        return Ok(());
    }
    let accepted = format!(
        "films thinner than the radius, which is {} nm here{}",
        to_digits(smallest * 1e9, 9),
        if keys.size_distribution.is_some() {
            " at least; from_radius_um gives the sizes a lower limit"
        } else {
            ""
        }
    );
    Err(SceneError::invalid("particle.coating", format!("{} nm", to_digits(total, 9)), accepted))
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
pub(in crate::scene) fn density_of(
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
        // what films weigh is not known
        (None, _) if keys.coating.as_ref().is_some_and(|films| !films.is_empty()) => Ok(None),
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
