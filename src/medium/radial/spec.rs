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

use super::gradient::Gradient;
use super::profile::Profile;
use super::profile_table;
use super::varied::{Inside, Radial};
use crate::medium::error::{MediumError, invalid};
use crate::medium::solution::Host;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// As it is written down; `S` is how media are written down.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RadialSpec<S> {
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
    layers: Option<Vec<LayerSpec<S>>>,
}

/// One layer; the last one reaches the surface and needs no radius.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct LayerSpec<S> {
    #[serde(skip_serializing_if = "Option::is_none")]
    radius_fraction: Option<f64>,
    medium: S,
}

/// The keys of which one says that a medium varies along the radius.
const KINDS: [&str; 3] = ["layers", "profile", "core"];

/// Whether a table of keys is meant for this.
pub(in crate::medium) fn is_meant(table: &toml::Table) -> bool {
    KINDS.iter().any(|key| table.contains_key(*key))
}

impl<S: Serialize> RadialSpec<S> {
    /// Look up names by `plain`, read files, check values.
    pub(in crate::medium) fn resolve<M: Host>(
        &self,
        folder: &Path,
        plain: impl Fn(&S) -> Result<M, MediumError>,
    ) -> Result<Radial<M>, MediumError> {
        let kinds = [self.layers.is_some(), self.profile.is_some(), self.core.is_some()];
        if kinds.iter().filter(|given| **given).count() != 1 {
            let accepted = "one of layers, profile and core";
            return Err(invalid("medium", "several kinds at once", accepted));
        }
        let inside = if let Some(layers) = &self.layers {
            self.only(&["layers"])?;
            Inside::Layers(layers_of(layers, plain)?)
        } else if let Some(profile) = &self.profile {
            Inside::Profile(self.profile_of(profile, folder)?)
        } else {
            Inside::Gradient(self.gradient()?)
        };
        Ok(Radial::bare(inside))
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

fn layers_of<S, M>(
    specs: &[LayerSpec<S>],
    plain: impl Fn(&S) -> Result<M, MediumError>,
) -> Result<Vec<(f64, M)>, MediumError> {
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
        layers.push((radius, plain(&spec.medium)?));
    }
    Ok(layers)
}
