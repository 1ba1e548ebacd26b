//! What a scene file says about a medium: `medium = "water"` or one of the tables below.
//!
//! ```toml
//! medium = "N-BK7"                                       # a name in the library
//! medium = { name = "water", temperature_c = 4, density_kg_m3 = 999.97 }
//! medium = { name = "sea-water", temperature_c = 15, salinity_g_kg = 35 }
//! medium = { index = [1.333, 0.0] }                      # n and k; or index = 1.333
//! medium = { file = "glass.yml", extrapolate = true }    # refractiveindex.info YAML, or CSV
//! medium = { file = "schott.agf", glass = "N-BK7" }      # a glass of a Zemax catalogue
//! medium = { sellmeier = { b = [1.03961212, 0.231792344, 1.01046945], c_um2 = [0.00600069867, 0.0200179144, 103.560653] } }
//! medium = { cauchy = [1.5046, 0.00420] }                # A, B (µm²), C (µm⁴), …
//! medium = { abbe = [1.5168, 64.17], line = "d" }        # d (default), D or e
//! medium = { solute = "rhodamine6g", fraction = 0.01, host = "water" }
//! medium = { absorbance = "dye.csv", path_mm = 10, host = "water" }
//! medium = { layers = [ { radius_fraction = 0.8, medium = "water" }, { medium = "ice" } ] }
//! medium = { profile = "luneburg", c = 3.0 }             # these two and more: see `radial/spec.rs`
//! ```
//! A solution also takes `dispersion = false`: the dye's k with the host's n. A solute may be a CSV
//! file with k. Files are looked for beside the scene file.

pub(super) mod density;
pub(super) mod film;
pub(super) mod index_text;
mod keys;
mod resolve;

use crate::medium::dispersion::abbe::AbbeLines;
use crate::medium::error::{MediumError, invalid};
use crate::medium::radial::spec::RadialSpec;
use crate::medium::read::ending::has_ending;
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// A medium as it is written down; [`MediumSpec::resolve`] makes a [`Medium`](crate::medium::Medium) of it.
#[derive(Clone, Debug, PartialEq)]
pub enum MediumSpec {
    /// A medium of the library.
    Named(NamedSpec),
    /// The same index at every wavelength.
    Index {
        /// Real part.
        n: f64,
        /// Imaginary part; positive absorbs.
        k: f64,
    },
    /// A file of optical data; `glass` is the name in a catalogue of several.
    File {
        /// The file, relative to the scene's folder.
        path: PathBuf,
        /// Glass to take from a catalogue of many.
        glass: Option<String>,
        /// Go on beyond the data by the nearest value.
        extrapolate: bool,
    },
    /// Sellmeier's formula.
    Sellmeier {
        /// Strengths of the resonances.
        b: Vec<f64>,
        /// Squares of their wavelengths, µm².
        c_um2: Vec<f64>,
    },
    /// Cauchy's formula: coefficients of 1, λ⁻², λ⁻⁴, …, λ in µm.
    Cauchy(Vec<f64>),
    /// A glass by its index and Abbe number.
    Abbe {
        /// Index at the line.
        index: f64,
        /// Abbe number.
        number: f64,
        /// The line.
        line: AbbeLines,
    },
    /// A dye of the library in a host.
    Solution {
        /// Name of the dye.
        solute: String,
        /// Share of the host's volume that the dye fills.
        fraction: f64,
        /// What it is dissolved in.
        host: Box<MediumSpec>,
        /// Whether its absorption changes n too (Kramers–Kronig).
        dispersion: bool,
    },
    /// A solution by its measured absorbance.
    Absorbance {
        /// The file, relative to the scene's folder.
        path: PathBuf,
        /// Path in the cuvette.
        path_mm: f64,
        /// What it is dissolved in.
        host: Box<MediumSpec>,
        /// Whether its absorption changes n too (Kramers–Kronig).
        dispersion: bool,
    },
    /// What varies along the radius of a sphere.
    Radial(Box<RadialSpec<MediumSpec>>),
}

/// A name in the library with the conditions that go with it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NamedSpec {
    /// Name in the library.
    pub name: String,
    /// Temperature, where the index depends on it.
    pub temperature_c: Option<f64>,
    /// Density, in place of the library's.
    pub density_kg_m3: Option<f64>,
    /// Salinity, of sea water.
    pub salinity_g_kg: Option<f64>,
    /// Go on beyond the data by the nearest value.
    pub extrapolate: bool,
}

impl MediumSpec {
    /// A name of the library without conditions.
    pub fn name(name: impl Into<String>) -> Self {
        Self::Named(NamedSpec { name: name.into(), ..NamedSpec::default() })
    }

    /// Reads what a user typed: a name, a path of a file of optical data (`.yml`, `.yaml`, `.csv`,
    /// `.txt`, `.tsv`, `.agf`, or `CATALOGUE.agf:GLASS`), or a TOML table in braces.
    pub fn parse(text: &str) -> Result<Self, MediumError> {
        let text = text.trim();
        if text.starts_with('{') {
            #[derive(Deserialize)]
            struct Holder {
                medium: MediumSpec,
            }
            let holder: Holder = toml::from_str(&format!("medium = {text}"))
                .map_err(|e| invalid("medium", text, &format!("a TOML table: {}", e.message())))?;
            return Ok(holder.medium);
        }
        let file = |path: &str, glass: Option<&str>| Self::File {
            path: path.into(),
            glass: glass.map(str::to_string),
            extrapolate: false,
        };
        if has_ending(Path::new(text), &["yml", "yaml", "csv", "txt", "tsv", "agf"]) {
            return Ok(file(text, None));
        }
        if let Some((path, glass)) = text.rsplit_once(':')
            && has_ending(Path::new(path), &["agf"])
        {
            return Ok(file(path, Some(glass)));
        }
        Ok(Self::name(text))
    }
}

impl Default for MediumSpec {
    /// Water.
    fn default() -> Self {
        Self::name("water")
    }
}
