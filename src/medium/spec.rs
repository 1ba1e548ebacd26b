//! What a scene file says about a medium: `medium = "water"` or one of the tables below.
//!
//! ```toml
//! medium = "N-BK7"                                       # a name in the library
//! medium = { name = "water", temperature_c = 4, density_kg_m3 = 999.97 }
//! medium = { name = "sea-water", temperature_c = 15, salinity_g_kg = 35 }
//! medium = { index = [1.333, 0.0] }                      # n and k; or index = 1.333
//! medium = { file = "glass.yml", extrapolate = true }    # refractiveindex.info YAML, or CSV
//! medium = { sellmeier = { b = [1.03961212, 0.231792344, 1.01046945], c_um2 = [0.00600069867, 0.0200179144, 103.560653] } }
//! medium = { cauchy = [1.5046, 0.00420] }                # A, B (µm²), C (µm⁴), …
//! medium = { abbe = [1.5168, 64.17], line = "d" }        # d (default), D or e
//! medium = { solute = "rhodamine6g", fraction = 0.01, host = "water" }
//! medium = { absorbance = "dye.csv", path_mm = 10, host = "water" }
//! ```
//! A solution also takes `dispersion = false`: the dye's k with the host's n. A solute may be a CSV
//! file with k. Files are looked for beside the scene file.

use super::kramers_kronig::{Absorption, Tails};
use super::{
    Abbe, AbbeLines, Daimon, Dye, Formula, Material, Medium, MediumError, Solution, csv_table,
    library, refractive_index_info,
};
use num_complex::Complex64;
use serde::de::{self, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A medium as it is written down; [`MediumSpec::resolve`] makes a [`Medium`] of it.
#[derive(Clone, Debug, PartialEq)]
pub enum MediumSpec {
    Named(NamedSpec),
    Index { n: f64, k: f64 },
    File { path: PathBuf, extrapolate: bool },
    Sellmeier { b: Vec<f64>, c_um2: Vec<f64> },
    Cauchy(Vec<f64>),
    Abbe { index: f64, number: f64, line: AbbeLines },
    Solution { solute: String, fraction: f64, host: Box<MediumSpec>, dispersion: bool },
    Absorbance { path: PathBuf, path_mm: f64, host: Box<MediumSpec>, dispersion: bool },
}

/// A name in the library with the conditions that go with it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NamedSpec {
    pub name: String,
    pub temperature_c: Option<f64>,
    pub density_kg_m3: Option<f64>,
    pub salinity_g_kg: Option<f64>,
    pub extrapolate: bool,
}

/// All keys of the table form.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Keys {
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    temperature_c: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    density_kg_m3: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    salinity_g_kg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    index: Option<IndexKey>,
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<PathBuf>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cauchy: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    abbe: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<AbbeLines>,
    #[serde(skip_serializing_if = "Option::is_none")]
    solute: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fraction: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    absorbance: Option<PathBuf>,
    #[serde(skip_serializing_if = "Option::is_none")]
    path_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    dispersion: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    extrapolate: Option<bool>,
    // Tables after values, as TOML wants them.
    #[serde(skip_serializing_if = "Option::is_none")]
    sellmeier: Option<SellmeierKeys>,
    #[serde(skip_serializing_if = "Option::is_none")]
    host: Option<Box<MediumSpec>>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(untagged, expecting = "index: expected n (a number) or [n, k]")]
enum IndexKey {
    Real(f64),
    Complex([f64; 2]),
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SellmeierKeys {
    b: Vec<f64>,
    c_um2: Vec<f64>,
}

/// The keys that say which kind of medium it is.
const KINDS: &str = "name, index, file, sellmeier, cauchy, abbe, solute or absorbance";

impl MediumSpec {
    /// A name of the library without conditions.
    pub fn name(name: impl Into<String>) -> Self {
        Self::Named(NamedSpec { name: name.into(), ..NamedSpec::default() })
    }

    /// Reads what a user typed: a name, a path of a `.yml`, `.yaml` or `.csv` file, or a TOML
    /// table in braces.
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
        if has_ending(Path::new(text), &["yml", "yaml", "csv"]) {
            return Ok(Self::File { path: text.into(), extrapolate: false });
        }
        Ok(Self::name(text))
    }

    /// The medium; files are looked for in `base_dir`.
    pub fn resolve(&self, base_dir: &Path) -> Result<Medium, MediumError> {
        match self {
            Self::Named(named) => named.resolve(),
            Self::Index { n, k } => constant(*n, *k),
            Self::File { path, extrapolate } => {
                let mut material = read_material(&base_dir.join(path))?;
                material.extrapolate = *extrapolate;
                Ok(Medium::Material(Arc::new(material)))
            }
            Self::Sellmeier { b, c_um2 } => {
                from_formula("Sellmeier", Formula::sellmeier(b, c_um2)?)
            }
            Self::Cauchy(coefficients) => from_formula("Cauchy", Formula::cauchy(coefficients)?),
            Self::Abbe { index, number, line } => {
                let abbe = Abbe { index: *index, number: *number };
                from_formula("Abbe", Formula::cauchy(&abbe.to_cauchy(*line)?)?)
            }
            Self::Solution { solute, fraction, host, dispersion } => {
                let dye = if has_ending(Path::new(solute), &["csv"]) {
                    dye_of_file(&base_dir.join(solute))?
                } else {
                    library::dye(&library::canonical(solute)?)?
                };
                solution(dye, *fraction, host.resolve(base_dir)?, *dispersion)
            }
            Self::Absorbance { path, path_mm, host, dispersion } => {
                let dye = dye_of_absorbance(&base_dir.join(path), *path_mm)?;
                solution(dye, 1.0, host.resolve(base_dir)?, *dispersion)
            }
        }
    }

    fn keys(&self) -> Keys {
        let host_key = |host: &MediumSpec| Some(Box::new(host.clone()));
        let only_false = |value: bool| (!value).then_some(false);
        match self.clone() {
            Self::Named(named) => Keys {
                name: Some(named.name),
                temperature_c: named.temperature_c,
                density_kg_m3: named.density_kg_m3,
                salinity_g_kg: named.salinity_g_kg,
                extrapolate: named.extrapolate.then_some(true),
                ..Keys::default()
            },
            Self::Index { n, k } => {
                Keys { index: Some(IndexKey::Complex([n, k])), ..Keys::default() }
            }
            Self::File { path, extrapolate } => Keys {
                file: Some(path),
                extrapolate: extrapolate.then_some(true),
                ..Keys::default()
            },
            Self::Sellmeier { b, c_um2 } => {
                Keys { sellmeier: Some(SellmeierKeys { b, c_um2 }), ..Keys::default() }
            }
            Self::Cauchy(coefficients) => Keys { cauchy: Some(coefficients), ..Keys::default() },
            Self::Abbe { index, number, line } => Keys {
                abbe: Some([index, number]),
                line: (line != AbbeLines::HeliumD).then_some(line),
                ..Keys::default()
            },
            Self::Solution { solute, fraction, host, dispersion } => Keys {
                solute: Some(solute),
                fraction: Some(fraction),
                host: host_key(&host),
                dispersion: only_false(dispersion),
                ..Keys::default()
            },
            Self::Absorbance { path, path_mm, host, dispersion } => Keys {
                absorbance: Some(path),
                path_mm: Some(path_mm),
                host: host_key(&host),
                dispersion: only_false(dispersion),
                ..Keys::default()
            },
        }
    }
}

impl NamedSpec {
    fn resolve(&self) -> Result<Medium, MediumError> {
        let name = library::canonical(&self.name)?;
        self.refuse_foreign_conditions(&name)?;
        let temperature = self.temperature_c.unwrap_or(20.0) + 273.15;
        let medium = match name.as_str() {
            "water" => match self.density_kg_m3 {
                Some(density) => Medium::WaterOfDensity { temperature, density },
                None => Medium::Water { temperature },
            },
            "sea-water" => {
                Medium::SeaWater { temperature, salinity: self.salinity_g_kg.unwrap_or(35.0) }
            }
            "water-daimon" => Medium::Daimon(Arc::new(Daimon::new(temperature)?)),
            model if super::BandModel::by_name(model).is_some() => {
                let accepted = format!(
                    "a medium; this is a dye: {{ solute = \"{model}\", fraction = 0.01, host = \
                     \"water\" }}"
                );
                return Err(invalid("medium", &self.name, &accepted));
            }
            other => {
                let mut material = library::material(other)?;
                material.extrapolate = self.extrapolate;
                Medium::Material(Arc::new(material))
            }
        };
        medium.check_conditions()?;
        Ok(medium)
    }

    /// Refuses a condition that the medium does not depend on, rather than ignore it.
    fn refuse_foreign_conditions(&self, name: &str) -> Result<(), MediumError> {
        let water = ["water", "sea-water", "water-daimon"].contains(&name);
        let foreign = [
            ("temperature_c", self.temperature_c, water),
            ("density_kg_m3", self.density_kg_m3, name == "water"),
            ("salinity_g_kg", self.salinity_g_kg, name == "sea-water"),
            ("extrapolate", self.extrapolate.then_some(1.0), !water),
        ];
        match foreign.into_iter().find(|(_, value, known)| value.is_some() && !known) {
            Some((field, value, _)) => {
                let value = value.unwrap_or_default().to_string();
                Err(invalid(field, &value, &format!("nothing: {name} does not depend on it")))
            }
            None => Ok(()),
        }
    }
}

fn constant(n: f64, k: f64) -> Result<Medium, MediumError> {
    if !(n > 0.0 && n.is_finite()) {
        return Err(invalid("index: n", &n.to_string(), "a positive number"));
    }
    if !(k >= 0.0 && k.is_finite()) {
        return Err(invalid("index: k", &k.to_string(), "0 or more (n + ik absorbs for k > 0)"));
    }
    let index = Complex64::new(n, k);
    if !super::is_plausible(index) {
        return Err(invalid("index", &format!("[{n:e}, {k:e}]"), super::PLAUSIBLE_INDEX));
    }
    Ok(Medium::Constant(index))
}

/// A medium by a formula of the user's: valid between the poles on either side of visible light.
fn from_formula(name: &str, formula: Formula) -> Result<Medium, MediumError> {
    let (from, to) = formula.interval_about(0.58);
    // Wavelengths that anyone may ask for, and a hair's breadth off the poles.
    let (from, to) = ((from * 1.000_001).max(0.1), (to * 0.999_999).min(20.0));
    // Visible light must be in it: a pole there is a slip of the pen, not a wish.
    formula.check_range(0.38, 0.78)?;
    let material = Material {
        name: name.into(),
        source: "given by its coefficients".into(),
        real: super::RealIndex::Formula(formula),
        extinction: None,
        range: (from / 1e6, to / 1e6),
        extrapolate: false,
    };
    Ok(Medium::Material(Arc::new(material)))
}

fn solution(
    dye: Dye,
    fraction: f64,
    host: Medium,
    dispersion: bool,
) -> Result<Medium, MediumError> {
    let solution = Solution::new(dye, fraction, host)?.with_dispersion(dispersion);
    Ok(Medium::Solution(Arc::new(solution)))
}

/// A material from a YAML or CSV file; a CSV file must have n.
fn read_material(path: &Path) -> Result<Material, MediumError> {
    if !has_ending(path, &["csv", "txt"]) {
        return refractive_index_info::read(path);
    }
    let table = csv_table::read(path)?;
    let name = path.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
    if table.n.is_empty() {
        return Err(MediumError::File {
            path: path.into(),
            line: None,
            message: "no column n; a dye's k goes with a host: { solute = \"FILE.csv\", … }".into(),
        });
    }
    let n = library::curve(&table.wavelength, &table.n)?;
    let k = match table.k.is_empty() {
        true => None,
        false => Some(library::curve(&table.wavelength, &table.k)?),
    };
    Material::from_tables(name, table.source, n, k)
}

fn dye_of_file(path: &Path) -> Result<Dye, MediumError> {
    let table = csv_table::read(path)?;
    dye(path, table.source, &table.wavelength, &table.k, "k")
}

/// k from decadic absorbance: `A = log10(I0/I)`, `I = I0 exp(−4πkL/λ)`, so `k = A ln(10) λ/4πL`.
fn dye_of_absorbance(path: &Path, path_mm: f64) -> Result<Dye, MediumError> {
    if !(path_mm > 0.0 && path_mm.is_finite()) {
        return Err(invalid("path_mm", &path_mm.to_string(), "a positive length"));
    }
    let table = csv_table::read(path)?;
    let per_wavelength = std::f64::consts::LN_10 / (4.0 * std::f64::consts::PI * path_mm * 1e-3);
    let rows = table.wavelength.iter().zip(&table.absorbance);
    let k: Vec<f64> = rows.map(|(w, a)| a * per_wavelength * w).collect();
    let source = format!("{} (absorbance over {path_mm} mm)", table.source);
    dye(path, source, &table.wavelength, &k, "absorbance")
}

fn dye(
    path: &Path,
    source: String,
    wavelength: &[f64],
    k: &[f64],
    column: &str,
) -> Result<Dye, MediumError> {
    if k.is_empty() {
        let message = format!("no column {column}");
        return Err(MediumError::File { path: path.into(), line: None, message });
    }
    let name = path.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
    Ok(Dye { name, source, absorption: Absorption::new(wavelength, k, Tails::Taper)? })
}

fn has_ending(path: &Path, endings: &[&str]) -> bool {
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_lowercase();
    endings.contains(&ending.as_str())
}

fn invalid(field: &str, value: &str, accepted: &str) -> MediumError {
    MediumError::Invalid { field: field.into(), value: value.into(), accepted: accepted.into() }
}

impl TryFrom<Keys> for MediumSpec {
    type Error = String;

    fn try_from(mut keys: Keys) -> Result<Self, String> {
        let spec = kind(&mut keys)?;
        match leftover(&keys) {
            Some(key) => Err(format!("medium: {key} does not go with the other keys")),
            None => Ok(spec),
        }
    }
}

/// Takes the keys of one kind of medium out of `keys`.
fn kind(keys: &mut Keys) -> Result<MediumSpec, String> {
    if let Some(name) = keys.name.take() {
        return Ok(MediumSpec::Named(NamedSpec {
            name,
            temperature_c: keys.temperature_c.take(),
            density_kg_m3: keys.density_kg_m3.take(),
            salinity_g_kg: keys.salinity_g_kg.take(),
            extrapolate: keys.extrapolate.take().unwrap_or(false),
        }));
    }
    if let Some(index) = keys.index.take() {
        let [n, k] = match index {
            IndexKey::Real(n) => [n, 0.0],
            IndexKey::Complex(pair) => pair,
        };
        return Ok(MediumSpec::Index { n, k });
    }
    if let Some(path) = keys.file.take() {
        let extrapolate = keys.extrapolate.take().unwrap_or(false);
        return Ok(MediumSpec::File { path, extrapolate });
    }
    if let Some(SellmeierKeys { b, c_um2 }) = keys.sellmeier.take() {
        return Ok(MediumSpec::Sellmeier { b, c_um2 });
    }
    if let Some(coefficients) = keys.cauchy.take() {
        return Ok(MediumSpec::Cauchy(coefficients));
    }
    if let Some([index, number]) = keys.abbe.take() {
        let line = keys.line.take().unwrap_or_default();
        return Ok(MediumSpec::Abbe { index, number, line });
    }
    dyed(keys)
}

fn dyed(keys: &mut Keys) -> Result<MediumSpec, String> {
    let host = keys.host.take().unwrap_or_else(|| Box::new(MediumSpec::name("water")));
    let dispersion = keys.dispersion.take().unwrap_or(true);
    if let Some(solute) = keys.solute.take() {
        let fraction = keys.fraction.take().ok_or("medium: solute needs fraction (0 to 1)")?;
        return Ok(MediumSpec::Solution { solute, fraction, host, dispersion });
    }
    if let Some(path) = keys.absorbance.take() {
        let path_mm = keys.path_mm.take().ok_or("medium: absorbance needs path_mm")?;
        return Ok(MediumSpec::Absorbance { path, path_mm, host, dispersion });
    }
    Err(format!("medium: expected a name or a table with one of {KINDS}"))
}

/// The first key that no kind has taken.
fn leftover(keys: &Keys) -> Option<&'static str> {
    let present = [
        ("name", keys.name.is_some()),
        ("temperature_c", keys.temperature_c.is_some()),
        ("density_kg_m3", keys.density_kg_m3.is_some()),
        ("salinity_g_kg", keys.salinity_g_kg.is_some()),
        ("index", keys.index.is_some()),
        ("file", keys.file.is_some()),
        ("sellmeier", keys.sellmeier.is_some()),
        ("cauchy", keys.cauchy.is_some()),
        ("abbe", keys.abbe.is_some()),
        ("line", keys.line.is_some()),
        ("solute", keys.solute.is_some()),
        ("fraction", keys.fraction.is_some()),
        ("absorbance", keys.absorbance.is_some()),
        ("path_mm", keys.path_mm.is_some()),
        ("dispersion", keys.dispersion.is_some()),
        ("extrapolate", keys.extrapolate.is_some()),
        ("host", keys.host.is_some()),
    ];
    present.into_iter().find(|(_, there)| *there).map(|(key, _)| key)
}

impl<'de> Deserialize<'de> for MediumSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct SpecVisitor;
        impl<'de> Visitor<'de> for SpecVisitor {
            type Value = MediumSpec;

            fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                write!(f, "a medium: a name such as \"water\", or a table with one of {KINDS}")
            }

            fn visit_str<E: de::Error>(self, name: &str) -> Result<MediumSpec, E> {
                Ok(MediumSpec::name(name))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MediumSpec, A::Error> {
                let keys = Keys::deserialize(de::value::MapAccessDeserializer::new(map))?;
                MediumSpec::try_from(keys).map_err(de::Error::custom)
            }
        }
        deserializer.deserialize_any(SpecVisitor)
    }
}

impl Serialize for MediumSpec {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Named(NamedSpec {
                name,
                temperature_c: None,
                density_kg_m3: None,
                salinity_g_kg: None,
                extrapolate: false,
            }) => serializer.serialize_str(name),
            _ => self.keys().serialize(serializer),
        }
    }
}

impl Default for MediumSpec {
    /// Water.
    fn default() -> Self {
        Self::name("water")
    }
}
