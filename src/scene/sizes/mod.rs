//! Distributions of sizes as they are written in a scene file or a flag.
//!
//! ```toml
//! size_distribution = { kind = "gamma", effective_radius_um = 10, effective_variance = 0.1 }
//! size_distribution = { kind = "log-normal", median_radius_um = 5, spread = 0.3 }
//! size_distribution = { kind = "marshall-palmer", rain_rate_mm_h = 5, from_radius_mm = 0.1, to_radius_mm = 1.5 }
//! size_distribution = { kind = "histogram", edges_diameter_mm = [0.2, 0.5, 1, 2], number = [310, 90, 12] }
//! ```
//! A length is a radius or a diameter, in nm, µm or mm: its name says which (`median_radius_um`,
//! `median_diameter_mm`). Numbers of particles are per size; `spread` is the standard deviation of ln(radius).
//! Every kind but `delta` takes limits, `from_…` and `to_…`. What is written is kept as written.

mod columns;
mod kind;
mod law;

use kind::Kind;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};
use std::fmt;
use std::str::FromStr;

/// A distribution as written: its kind and the keys of that kind.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(transparent)]
pub struct SizeKeys {
    keys: toml::Table,
}

/// What a length key is worth.
#[derive(Clone, Debug, PartialEq)]
struct Length {
    key: String,
    /// As written.
    value: f64,
    /// Metres of radius per unit.
    unit: f64,
}

impl Length {
    fn radius(&self) -> f64 {
        self.value * self.unit
    }
}

impl SizeKeys {
    /// # Errors
    /// A kind or a key that is not known.
    fn of_table(keys: toml::Table) -> Result<Self, String> {
        let kind = Kind::of_table(&keys)?;
        if let Some(unknown) = keys.keys().find(|key| *key != "kind" && !kind.knows(key)) {
            return Err(format!("unknown field `{unknown}`, expected {}", kind.words()));
        }
        Ok(Self { keys })
    }

    fn kind(&self) -> Result<&'static Kind, String> {
        Kind::of_table(&self.keys)
    }

    /// Whether all are of one size.
    pub(super) fn is_delta(&self) -> bool {
        self.kind().is_ok_and(|kind| kind.name == "delta")
    }

    /// The number of a key, if it is there.
    fn number(&self, key: &str) -> Result<Option<f64>, String> {
        match self.keys.get(key) {
            None => Ok(None),
            Some(toml::Value::Float(value)) => Ok(Some(*value)),
            Some(toml::Value::Integer(value)) => Ok(Some(*value as f64)),
            Some(other) => Err(format!("{key} = {other}: a number is accepted")),
        }
    }

    /// A number that has to be there, within what is accepted.
    fn needed(&self, key: &str, range: (f64, f64)) -> Result<f64, String> {
        let value = self.number(key)?.ok_or_else(|| format!("missing field `{key}`"))?;
        within(key, value, range)
    }

    /// The length of a base name such as `median_{}`, in whichever way it is spelled.
    fn length(&self, base: &str) -> Result<Option<Length>, String> {
        let mut found: Option<Length> = None;
        for (key, unit) in kind::spellings(base) {
            let Some(value) = self.number(&key)? else { continue };
            if let Some(first) = found {
                return Err(format!("{key} = {value}: {} is given too; keep one", first.key));
            }
            found = Some(Length { key, value, unit });
        }
        Ok(found)
    }

    /// A radius that has to be there.
    fn radius(&self, base: &str) -> Result<Length, String> {
        let missing = || format!("missing field `{}`", base.replace("{}", "radius") + "_um");
        let length = self.length(base)?.ok_or_else(missing)?;
        length.checked()
    }

    /// The words of a key, if it is there.
    fn text(&self, key: &str) -> Result<Option<&str>, String> {
        match self.keys.get(key) {
            None => Ok(None),
            Some(toml::Value::String(text)) => Ok(Some(text)),
            Some(other) => Err(format!("{key} = {other}: words in quotes are accepted")),
        }
    }

    /// The numbers of a list, if it is there.
    fn list(&self, key: &str) -> Result<Option<Vec<f64>>, String> {
        let wrong = |value: &toml::Value| format!("{key} = {value}: a list of numbers is accepted");
        let number = |value: &toml::Value| match value {
            toml::Value::Float(value) => Ok(*value),
            toml::Value::Integer(value) => Ok(*value as f64),
            other => Err(wrong(other)),
        };
        match self.keys.get(key) {
            None => Ok(None),
            Some(toml::Value::Array(list)) => {
                list.iter().map(number).collect::<Result<_, _>>().map(Some)
            }
            Some(other) => Err(wrong(other)),
        }
    }
}

/// Radii, micrometres: from a nanometre to a centimetre.
const RADII_UM: (f64, f64) = (1e-3, 1e4);

impl Length {
    fn checked(self) -> Result<Self, String> {
        // In the unit it is written in, as people write it.
        let end = |um: f64| crate::math::digits::to_digits(um * 1e-6 / self.unit, 12);
        within(&self.key, self.value, (end(RADII_UM.0), end(RADII_UM.1)))?;
        Ok(self)
    }
}

fn within(name: &str, value: f64, (from, to): (f64, f64)) -> Result<f64, String> {
    if value >= from && value <= to {
        return Ok(value);
    }
    Err(format!("{name} = {value}: {from} to {to} is accepted"))
}

impl<'de> Deserialize<'de> for SizeKeys {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Self::of_table(toml::Table::deserialize(deserializer)?).map_err(D::Error::custom)
    }
}

impl fmt::Display for SizeKeys {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&toml::Value::Table(self.keys.clone()).to_string())
    }
}

/// As on the command line: the table of the scene file, with or without its braces.
impl FromStr for SizeKeys {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        #[derive(Deserialize)]
        struct Holder {
            sizes: SizeKeys,
        }
        let bare = text.trim();
        let table = if bare.starts_with('{') { bare.into() } else { format!("{{ {bare} }}") };
        let holder: Result<Holder, _> = toml::from_str(&format!("sizes = {table}"));
        holder.map(|holder| holder.sizes).map_err(|error| {
            format!(
                "{}; accepted: kind = \"gamma\", effective_radius_um = 10, effective_variance = \
                 0.1 (or {})",
                error.message().trim().replace('\n', ", "),
                kind::others("gamma")
            )
        })
    }
}

#[cfg(test)]
mod tests;
