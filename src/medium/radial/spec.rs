//! What a scene file says about a medium that varies along the radius.
//!
//! ```toml
//! medium = { layers = [ { radius_fraction = 0.8, medium = "water" }, { medium = "ice" } ] }
//! medium = { profile = "luneburg", c = 3.0 }                # √(c - r²)
//! medium = { profile = "fish-eye" }                         # 2/(1 + r²)
//! medium = { profile = "gaussian", a = 1.4 }                # a exp(-b r²), b = ln a unless given
//! medium = { profile = "inverse", k = 1.0 }                 # k/r
//! medium = { profile = "polynomial", coefficients = [1.34, -0.01] }    # in r²
//! medium = { profile = "linear", centre = 1.34, surface = 1.33 }
//! medium = { profile = "table", file = "profile.csv" }      # r, n, k
//! medium = { core = "temperature", centre_c = 5, surface_c = 20 }
//! medium = { core = "salinity", centre_g_kg = 0, surface_g_kg = 35, temperature_c = 15 }
//! ```

use super::super::{Medium, MediumError, MediumSpec, invalid};
use super::{Film, Gradient, Profile, Radial, profile_table};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// As it is written down.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RadialSpec {
    #[serde(skip_serializing_if = "Option::is_none")]
    profile: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    c: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    a: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    b: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    k: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    centre: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    surface: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<PathBuf>,
    #[serde(skip_serializing_if = "Option::is_none")]
    core: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    centre_c: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    surface_c: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    centre_g_kg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    surface_g_kg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    temperature_c: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    coefficients: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    layers: Option<Vec<LayerSpec>>,
}

/// One layer; the last one reaches the surface and needs no radius.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct LayerSpec {
    #[serde(skip_serializing_if = "Option::is_none")]
    radius_fraction: Option<f64>,
    medium: MediumSpec,
}

/// One film of a coating, as it is written down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FilmSpec {
    pub medium: MediumSpec,
    pub thickness_nm: f64,
}

/// The keys of which one says that a medium varies along the radius.
const KINDS: [&str; 3] = ["layers", "profile", "core"];

impl RadialSpec {
    /// Whether a table is meant for this.
    pub(in crate::medium) fn is_meant(table: &toml::Table) -> bool {
        KINDS.iter().any(|key| table.contains_key(*key))
    }

    /// Look up names, read files, check values.
    pub(in crate::medium) fn resolve(&self, folder: &Path) -> Result<Medium, MediumError> {
        let kinds = [self.layers.is_some(), self.profile.is_some(), self.core.is_some()];
        if kinds.iter().filter(|given| **given).count() != 1 {
            let accepted = "one of layers, profile and core";
            return Err(invalid("medium", "several kinds at once", accepted));
        }
        let radial = if let Some(layers) = &self.layers {
            self.only(&["layers"])?;
            Radial::Layers(layers_of(layers, folder)?)
        } else if let Some(profile) = &self.profile {
            Radial::Profile(self.profile_of(profile, folder)?)
        } else {
            Radial::Gradient(self.gradient()?)
        };
        Ok(Medium::Radial(Arc::new(radial)))
    }

    /// Refuses keys of other kinds.
    fn only(&self, known: &[&str]) -> Result<(), MediumError> {
        let table = toml::Table::try_from(self).unwrap_or_default();
        match table.keys().find(|key| !known.contains(&key.as_str())) {
            Some(key) => {
                let accepted = format!("it does not go with {}", known[0]);
                Err(invalid(&format!("medium: {key}"), &table[key], &accepted))
            }
            None => Ok(()),
        }
    }

    fn profile_of(&self, name: &str, folder: &Path) -> Result<Profile, MediumError> {
        let needed = |key: &str, value: Option<f64>| {
            let accepted = format!("profile \"{name}\" needs {key}");
            value.ok_or_else(|| invalid("medium", format!("{key} is missing"), &accepted))
        };
        let profile = match name {
            "luneburg" => {
                self.only(&["profile", "c"])?;
                Profile::Luneburg { c: needed("c", self.c)? }
            }
            "fish-eye" => {
                self.only(&["profile"])?;
                Profile::FishEye
            }
            "gaussian" => {
                self.only(&["profile", "a", "b"])?;
                let a = needed("a", self.a)?;
                Profile::Gaussian { a, b: self.b.unwrap_or_else(|| a.ln()) }
            }
            "inverse" => {
                self.only(&["profile", "k"])?;
                Profile::Inverse { k: needed("k", self.k)? }
            }
            "linear" => {
                self.only(&["profile", "centre", "surface"])?;
                let centre = needed("centre", self.centre)?;
                Profile::Linear { centre, surface: needed("surface", self.surface)? }
            }
            "polynomial" => {
                self.only(&["profile", "coefficients"])?;
                let coefficients = self.coefficients.clone().unwrap_or_default();
                if coefficients.is_empty() {
                    let accepted = "coefficients of 1, r², r⁴, … (at least one)";
                    return Err(invalid("medium: coefficients", "none", accepted));
                }
                Profile::Polynomial(coefficients)
            }
            "table" => {
                self.only(&["profile", "file"])?;
                let Some(file) = &self.file else {
                    let accepted = "profile \"table\" needs file = \"FILE.csv\" (r, n, k)";
                    return Err(invalid("medium", "file is missing", accepted));
                };
                return profile_table::read(&folder.join(file));
            }
            other => {
                let accepted = "luneburg, fish-eye, gaussian, inverse, polynomial, linear or table";
                return Err(invalid("medium: profile", other, accepted));
            }
        };
        profile.checked()
    }

    fn gradient(&self) -> Result<Gradient, MediumError> {
        let core = self.core.as_deref().unwrap_or_default();
        let needed = |key: &str, value: Option<f64>| {
            let accepted = format!("core = \"{core}\" needs {key}");
            value.ok_or_else(|| invalid("medium", format!("{key} is missing"), &accepted))
        };
        let kelvin = |celsius: f64| celsius + 273.15;
        match core {
            "temperature" => {
                self.only(&["core", "centre_c", "surface_c"])?;
                let centre = kelvin(needed("centre_c", self.centre_c)?);
                let surface = kelvin(needed("surface_c", self.surface_c)?);
                Gradient::Temperature { centre, surface }.checked()
            }
            "salinity" => {
                self.only(&["core", "centre_g_kg", "surface_g_kg", "temperature_c"])?;
                let temperature = kelvin(self.temperature_c.unwrap_or(20.0));
                let centre = needed("centre_g_kg", self.centre_g_kg)?;
                let surface = needed("surface_g_kg", self.surface_g_kg)?;
                Gradient::Salinity { centre, surface, temperature }.checked()
            }
            other => Err(invalid("medium: core", other, "temperature or salinity")),
        }
    }
}

fn layers_of(specs: &[LayerSpec], folder: &Path) -> Result<Vec<(f64, Medium)>, MediumError> {
    const KEY: &str = "medium: layers: radius_fraction";
    if specs.is_empty() {
        return Err(invalid("medium: layers", "none", "at least one layer"));
    }
    let mut layers = Vec::with_capacity(specs.len());
    let mut inside = 0.0;
    for (i, spec) in specs.iter().enumerate() {
        let last = i + 1 == specs.len();
        let radius = match spec.radius_fraction {
            Some(radius) => radius,
            None if last => 1.0,
            None => return Err(invalid(KEY, "missing", "every layer but the last needs one")),
        };
        if !(radius > inside && radius <= 1.0) {
            let value = format!("{radius} after {inside}");
            return Err(invalid(KEY, value, "outer radii in units of the particle's, ascending"));
        }
        if last && radius != 1.0 {
            return Err(invalid(KEY, radius, "1 for the last layer: it reaches the surface"));
        }
        inside = radius;
        layers.push((radius, homogeneous(&spec.medium, folder, "medium: layers: medium")?));
    }
    Ok(layers)
}

/// A medium that is the same everywhere.
fn homogeneous(spec: &MediumSpec, folder: &Path, field: &str) -> Result<Medium, MediumError> {
    let medium = spec.resolve(folder)?;
    match medium.radial() {
        Some(radial) => Err(invalid(field, radial.name(), "a medium that is the same everywhere")),
        None => Ok(medium),
    }
}

/// A medium with films on it, from inside out.
///
/// # Errors
/// A film without thickness, or of a medium that itself varies.
pub fn coated(inside: Medium, films: &[FilmSpec], folder: &Path) -> Result<Medium, MediumError> {
    if films.is_empty() {
        return Ok(inside);
    }
    let mut resolved = Vec::with_capacity(films.len());
    for film in films {
        if !(film.thickness_nm > 0.0 && film.thickness_nm.is_finite()) {
            let accepted = "a thickness above 0 nm";
            return Err(invalid("coating: thickness_nm", film.thickness_nm, accepted));
        }
        let medium = homogeneous(&film.medium, folder, "coating: medium")?;
        resolved.push(Film { medium, thickness: film.thickness_nm * 1e-9 });
    }
    Ok(Medium::Radial(Arc::new(Radial::Coated { inside, films: resolved })))
}

/// A medium inside another one.
///
/// # Errors
/// Surroundings that vary.
pub fn immersed(
    inside: Medium,
    outside: &MediumSpec,
    folder: &Path,
) -> Result<Medium, MediumError> {
    let outside = homogeneous(outside, folder, "outside")?;
    Ok(Medium::Immersed(Arc::new(super::Immersed { inside, outside })))
}
