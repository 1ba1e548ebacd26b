//! How a particle stands, as a scene writes it: a word, or a table with what goes with the word.

use super::Orientation;
use super::choice::Named;
use super::error::SceneError;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// An orientation in a scene file: `"random"`, or a table such as `{ kind = "random", count = 1024 }`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrientationKey {
    /// The word.
    pub kind: Orientation,
    /// Of `fixed`: the axis from the vertical, degrees.
    pub zenith_deg: Option<f64>,
    /// Of `fixed`: the azimuth of that tilt, degrees; 0 is away from the sun.
    pub azimuth_deg: Option<f64>,
    /// Of `fixed`: a turn about the axis, degrees.
    pub spin_deg: Option<f64>,
    /// Orientations in a mean, where there is one.
    pub count: Option<u32>,
}

/// The same as a table.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    kind: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    zenith_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    azimuth_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    spin_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    count: Option<u32>,
}

/// Orientations in a mean: of every replica some, and no more than a day's work.
const COUNTS: std::ops::RangeInclusive<u32> = 16..=1_000_000;

impl From<Orientation> for OrientationKey {
    fn from(kind: Orientation) -> Self {
        Self { kind, zenith_deg: None, azimuth_deg: None, spin_deg: None, count: None }
    }
}

impl OrientationKey {
    /// From a word, or the table of a scene file with or without its braces, as in a flag.
    ///
    /// # Errors
    /// A word or key that is not known, with those that are.
    pub fn parse(text: &str) -> Result<Self, String> {
        if !text.contains('=') {
            return Orientation::from_name(text).map(Self::from);
        }
        let bare = text.trim().trim_start_matches('{').trim_end_matches('}').replace(',', "\n");
        let written: Written =
            toml::from_str(&bare).map_err(|error| error.message().trim().replace('\n', ", "))?;
        Self::of(written)
    }

    fn of(written: Written) -> Result<Self, String> {
        let Written { kind, zenith_deg, azimuth_deg, spin_deg, count } = written;
        Ok(Self { kind: Orientation::from_name(&kind)?, zenith_deg, azimuth_deg, spin_deg, count })
    }

    fn is_plain(&self) -> bool {
        *self == Self::from(self.kind)
    }

    /// Angles in radians, where they are fixed, and the number of orientations.
    pub(super) fn checked(&self) -> Result<([f64; 3], Option<u32>), SceneError> {
        const KEY: &str = "particle.orientation";
        let angles = [
            ("zenith_deg", self.zenith_deg),
            ("azimuth_deg", self.azimuth_deg),
            ("spin_deg", self.spin_deg),
        ];
        for (name, angle) in angles {
            let Some(angle) = angle else { continue };
            let value = format!("{{ {name} = {angle} }}");
            if self.kind != Orientation::Fixed {
                let accepted = "angles go with kind = \"fixed\"";
                return Err(SceneError::invalid(KEY, value, accepted));
            }
            if !(-360.0..=360.0).contains(&angle) {
                return Err(SceneError::invalid(KEY, value, "-360 to 360 degrees"));
            }
        }
        if let Some(count) = self.count {
            let value = format!("{{ count = {count} }}");
            if self.kind == Orientation::Fixed {
                return Err(SceneError::invalid(KEY, value, "\"fixed\" is one orientation"));
            }
            if !COUNTS.contains(&count) {
                let accepted = format!("{} to {} orientations", COUNTS.start(), COUNTS.end());
                return Err(SceneError::invalid(KEY, value, accepted));
            }
        }
        let radians = angles.map(|(_, angle)| angle.unwrap_or_default().to_radians());
        Ok((radians, self.count))
    }
}

impl Serialize for OrientationKey {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if self.is_plain() {
            return serializer.serialize_str(self.kind.name());
        }
        let Self { kind, zenith_deg, azimuth_deg, spin_deg, count } = *self;
        let kind = kind.name().to_string();
        Written { kind, zenith_deg, azimuth_deg, spin_deg, count }.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for OrientationKey {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match toml::Value::deserialize(deserializer)? {
            toml::Value::String(word) => {
                Orientation::from_name(&word).map(Self::from).map_err(D::Error::custom)
            }
            toml::Value::Table(table) => {
                let written: Written = table.try_into().map_err(D::Error::custom)?;
                Self::of(written).map_err(D::Error::custom)
            }
            other => Err(D::Error::custom(format!(
                "{other} is no orientation; accepted: \"upright\", \"random\", \"horizontal\", \
                 {{ kind = \"random\", count = 1024 }}, {{ kind = \"fixed\", zenith_deg = 90, azimuth_deg = 0, \
                 spin_deg = 30 }}"
            ))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Serialize, Deserialize)]
    struct Holder {
        orientation: OrientationKey,
    }

    #[test]
    fn words_and_tables_are_read_and_written() {
        for text in [
            "orientation = \"random\"",
            "orientation = { kind = \"random\" }",
            "orientation = { kind = \"random\", count = 64 }",
            "orientation = { kind = \"fixed\", zenith_deg = 90.0, spin_deg = 30.0 }",
        ] {
            let read: Holder = toml::from_str(text).unwrap();
            let again: Holder = toml::from_str(&toml::to_string(&read).unwrap()).unwrap();
            assert_eq!(read.orientation, again.orientation, "{text}");
            assert!(read.orientation.checked().is_ok());
        }
        let flag = OrientationKey::parse("{ kind = \"random\", count = 64 }").unwrap();
        assert_eq!(flag.count, Some(64));
        assert!(OrientationKey::parse("sideways").is_err());
        assert!(OrientationKey::parse("kind = \"random\", cont = 64").is_err());
    }

    #[test]
    fn what_does_not_go_together_is_refused() {
        let random = OrientationKey::from(Orientation::Random);
        for wrong in [
            OrientationKey { count: Some(1), ..random },
            OrientationKey { zenith_deg: Some(3.0), ..random },
            OrientationKey { count: Some(64), ..OrientationKey::from(Orientation::Fixed) },
            OrientationKey { spin_deg: Some(f64::NAN), ..OrientationKey::from(Orientation::Fixed) },
        ] {
            assert!(wrong.checked().is_err(), "{wrong:?}");
        }
    }
}
