//! The keys of a medium in a scene file: from text to a [`MediumSpec`] and back.
//!
//! One flat table of keys serves all kinds, so that a key of another kind is named in the error
//! rather than ignored.

use crate::medium::dispersion::abbe::AbbeLines;
use crate::medium::radial::spec::{RadialSpec, is_meant};
use crate::medium::spec::{MediumSpec, NamedSpec};
use serde::de::{self, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::path::PathBuf;

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
    glass: Option<String>,
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
const KINDS: &str =
    "name, index, file, sellmeier, cauchy, abbe, solute, absorbance, layers, profile or core";

impl MediumSpec {
    /// The keys that stand for this medium.
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
            Self::File { path, glass, extrapolate } => Keys {
                file: Some(path),
                glass,
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
            // It has keys of its own.
            Self::Radial(_) => Keys::default(),
        }
    }
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
        return Ok(MediumSpec::File { path, glass: keys.glass.take(), extrapolate });
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
        ("glass", keys.glass.is_some()),
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
                write!(
                    f,
                    "a medium: a name such as \"water\", a number (n), or a table with one of {KINDS}"
                )
            }

            fn visit_str<E: de::Error>(self, name: &str) -> Result<MediumSpec, E> {
                Ok(MediumSpec::name(name))
            }

            fn visit_f64<E: de::Error>(self, n: f64) -> Result<MediumSpec, E> {
                Ok(MediumSpec::Index { n, k: 0.0 })
            }

            fn visit_i64<E: de::Error>(self, n: i64) -> Result<MediumSpec, E> {
                Ok(MediumSpec::Index { n: n as f64, k: 0.0 })
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MediumSpec, A::Error> {
                let table = toml::Table::deserialize(de::value::MapAccessDeserializer::new(map))?;
                let plain = |error: toml::de::Error| de::Error::custom(error.message());
                if is_meant(&table) {
                    let spec = RadialSpec::deserialize(table).map_err(plain)?;
                    return Ok(MediumSpec::Radial(Box::new(spec)));
                }
                let keys = Keys::deserialize(table).map_err(plain)?;
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
            Self::Radial(spec) => spec.serialize(serializer),
            _ => self.keys().serialize(serializer),
        }
    }
}
