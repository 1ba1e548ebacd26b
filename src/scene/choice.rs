//! Words that stand for one of a closed set of values, in scene files and flags alike.

use super::error::{SceneError, nearest};
use super::{Diffraction, Interference, Method, Orientation, SunDisc};
use crate::phase_table::{ForwardPeak, Quantity};
use crate::shape::{AxisRatioLaw, RaindropModel};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A closed set of values, each with its word.
pub trait Named: Copy + PartialEq + 'static {
    /// All words and what they stand for.
    const NAMES: &'static [(&'static str, Self)];

    /// The word for this value.
    fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, value)| *value == self).map_or("", |(name, _)| name)
    }

    /// The value for a word.
    ///
    /// # Errors
    /// A message with all accepted words, and the nearest one where there is one.
    fn from_name(word: &str) -> Result<Self, String> {
        known(word)
    }
}

/// The value that a word of the set stands for.
fn known<T: Named>(word: &str) -> Result<T, String> {
    if let Some((_, value)) = T::NAMES.iter().find(|(name, _)| *name == word) {
        return Ok(*value);
    }
    let names: Vec<&str> = T::NAMES.iter().map(|(name, _)| *name).collect();
    let hint = nearest(word, names.iter().copied())
        .map(|name| format!(" (did you mean \"{name}\"?)"))
        .unwrap_or_default();
    Err(format!("\"{word}\" is not known{hint}; accepted: {}", names.join(", ")))
}

/// A [`Named`] value in a scene file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice<T>(pub T);

impl<T: Named> Serialize for Choice<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.0.name())
    }
}

impl<'de, T: Named> Deserialize<'de> for Choice<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let word = String::deserialize(deserializer)?;
        T::from_name(&word).map(Choice).map_err(D::Error::custom)
    }
}

/// The value that was chosen under `key`; an error with all words where none was.
pub(super) fn chosen<T: Named>(choice: Option<Choice<T>>, key: &str) -> Result<T, SceneError> {
    choice.map(|choice| choice.0).ok_or_else(|| {
        let names: Vec<&str> = T::NAMES.iter().map(|(name, _)| *name).collect();
        SceneError::missing(key, format!("accepted: {}", names.join(", ")))
    })
}

/// The kinds of particles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShapeName {
    /// A sphere.
    Sphere,
    /// A spheroid.
    Spheroid,
    /// A falling raindrop.
    Raindrop,
    /// A hexagonal column or plate.
    HexagonalColumn,
    /// A prism over a triangle.
    TriangularPrism,
    /// A cuboid on a square base.
    Cuboid,
    /// A regular octahedron.
    Octahedron,
    /// A hexagonal column with two pyramids.
    PyramidalCrystal,
    /// A hexagonal column with one.
    Bullet,
    /// A hexagonal column that narrows upwards.
    TaperedColumn,
    /// A round brilliant.
    Brilliant,
    /// A closed convex mesh of a file.
    Mesh,
    /// A body of revolution by the cosine series of its outline.
    Harmonics,
    /// A body of revolution between an ellipsoid and a cylinder.
    Superellipsoid,
}

impl ShapeName {
    /// Whether it has flat facets.
    pub fn is_crystal(self) -> bool {
        !matches!(
            self,
            ShapeName::Sphere
                | ShapeName::Spheroid
                | ShapeName::Raindrop
                | ShapeName::Harmonics
                | ShapeName::Superellipsoid
        )
    }

    /// Whether its proportions are fixed.
    pub(super) fn is_regular(self) -> bool {
        matches!(self, ShapeName::Octahedron | ShapeName::Brilliant | ShapeName::Mesh)
    }

    /// Whether an angle goes with it.
    pub(super) fn has_apex(self) -> bool {
        matches!(
            self,
            ShapeName::TriangularPrism
                | ShapeName::PyramidalCrystal
                | ShapeName::Bullet
                | ShapeName::TaperedColumn
        )
    }
}

impl Named for ShapeName {
    fn from_name(word: &str) -> Result<Self, String> {
        match word.starts_with("hollow") {
            true => Err(format!(
                "\"{word}\": hollow crystals are not convex, and light that has left one may enter it again, which \
                 no beam here does; accepted: convex bodies, such as \"hexagonal-column\", \"tapered-column\" or a \
                 \"mesh\""
            )),
            false => known(word),
        }
    }

    const NAMES: &'static [(&'static str, Self)] = &[
        ("sphere", ShapeName::Sphere),
        ("spheroid", ShapeName::Spheroid),
        ("raindrop", ShapeName::Raindrop),
        ("hexagonal-column", ShapeName::HexagonalColumn),
        ("triangular-prism", ShapeName::TriangularPrism),
        ("cuboid", ShapeName::Cuboid),
        ("octahedron", ShapeName::Octahedron),
        ("pyramidal-crystal", ShapeName::PyramidalCrystal),
        ("bullet", ShapeName::Bullet),
        ("tapered-column", ShapeName::TaperedColumn),
        ("brilliant", ShapeName::Brilliant),
        ("mesh", ShapeName::Mesh),
        ("harmonics", ShapeName::Harmonics),
        ("superellipsoid", ShapeName::Superellipsoid),
    ];
}

/// Units of a mesh's coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LengthUnit {
    /// Nanometres.
    Nanometre,
    /// Micrometres.
    Micrometre,
    /// Millimetres.
    Millimetre,
    /// Metres.
    Metre,
}

impl LengthUnit {
    /// In millimetres.
    pub(super) fn millimetres(self) -> f64 {
        match self {
            Self::Nanometre => 1e-6,
            Self::Micrometre => 1e-3,
            Self::Millimetre => 1.0,
            Self::Metre => 1e3,
        }
    }
}

impl Named for LengthUnit {
    const NAMES: &'static [(&'static str, Self)] = &[
        ("nm", LengthUnit::Nanometre),
        ("um", LengthUnit::Micrometre),
        ("mm", LengthUnit::Millimetre),
        ("m", LengthUnit::Metre),
    ];
}

impl Named for Orientation {
    const NAMES: &'static [(&'static str, Self)] = &[
        ("upright", Orientation::Upright),
        ("random", Orientation::Random),
        ("horizontal", Orientation::Horizontal),
        ("fixed", Orientation::Fixed),
    ];
}

impl Named for AxisRatioLaw {
    const NAMES: &'static [(&'static str, Self)] = &AxisRatioLaw::NAMES;
}

/// An axis ratio: a number, or a law by the size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AxisRatioKey {
    /// Vertical over horizontal diameter.
    Number(f64),
    /// By the diameter of equal volume.
    Law(AxisRatioLaw),
}

impl std::fmt::Display for AxisRatioKey {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number(ratio) => write!(f, "{ratio}"),
            Self::Law(law) => write!(f, "\"{}\"", law.name()),
        }
    }
}

impl std::str::FromStr for AxisRatioKey {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.parse() {
            Ok(ratio) => Ok(Self::Number(ratio)),
            Err(_) => AxisRatioLaw::from_name(text).map(Self::Law),
        }
    }
}

impl Serialize for AxisRatioKey {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(ratio) => serializer.serialize_f64(*ratio),
            Self::Law(law) => serializer.serialize_str(law.name()),
        }
    }
}

impl<'de> Deserialize<'de> for AxisRatioKey {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match toml::Value::deserialize(deserializer)? {
            toml::Value::Float(ratio) => Ok(Self::Number(ratio)),
            toml::Value::Integer(ratio) => Ok(Self::Number(ratio as f64)),
            toml::Value::String(word) => {
                AxisRatioLaw::from_name(&word).map(Self::Law).map_err(D::Error::custom)
            }
            other => Err(D::Error::custom(format!(
                "{other} is no axis ratio; accepted: a number, or a law such as \"thurai-2007\""
            ))),
        }
    }
}

/// Canting in a scene file or flag: `{ deviation_deg = 7 }`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CantingKeys {
    /// Standard deviation of the axis about the vertical, in each of two planes, degrees.
    pub deviation_deg: f64,
}

/// As on the command line: degrees, or the table of the scene file with or without its braces.
impl std::str::FromStr for CantingKeys {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if let Ok(deviation_deg) = text.parse() {
            return Ok(Self { deviation_deg });
        }
        let bare = text.trim().trim_start_matches('{').trim_end_matches('}');
        toml::from_str(bare).map_err(|error| {
            let message = error.message().trim().replace('\n', ", ");
            format!("{message}; accepted: deviation_deg = 7")
        })
    }
}

impl Named for RaindropModel {
    const NAMES: &'static [(&'static str, Self)] = &[
        (RaindropModel::BeardChuang1987.name(), RaindropModel::BeardChuang1987),
        (RaindropModel::ChuangBeard1990.name(), RaindropModel::ChuangBeard1990),
    ];
}

impl Named for Quantity {
    const NAMES: &'static [(&'static str, Self)] = &Quantity::WORDS;
}

impl Named for ForwardPeak {
    const NAMES: &'static [(&'static str, Self)] = &ForwardPeak::WORDS;
}

impl Named for SunDisc {
    const NAMES: &'static [(&'static str, Self)] = &[
        ("none", SunDisc::None),
        ("uniform", SunDisc::Uniform),
        ("limb-darkened", SunDisc::LimbDarkened),
    ];
}

impl Named for Method {
    const NAMES: &'static [(&'static str, Self)] = &[
        ("auto", Method::Auto),
        ("rays", Method::Rays),
        ("mie", Method::Mie),
        ("debye", Method::Debye),
        ("tmatrix", Method::TMatrix),
        ("facets", Method::Facets),
    ];
}

impl Named for Interference {
    const NAMES: &'static [(&'static str, Self)] = &[
        ("true", Interference::Waves),
        ("false", Interference::Powers),
        ("within-orders", Interference::WithinOrders),
    ];
}

/// `true`, `false` and words, in a scene file and as a flag.
impl Serialize for Interference {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Interference::Waves => serializer.serialize_bool(true),
            Interference::Powers => serializer.serialize_bool(false),
            Interference::WithinOrders => serializer.serialize_str(self.name()),
        }
    }
}

impl<'de> Deserialize<'de> for Interference {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match toml::Value::deserialize(deserializer)? {
            toml::Value::Boolean(true) => Ok(Interference::Waves),
            toml::Value::Boolean(false) => Ok(Interference::Powers),
            toml::Value::String(word) => Self::from_name(&word).map_err(D::Error::custom),
            other => Err(D::Error::custom(format!(
                "{other} is no kind of interference; accepted: true, false, \"within-orders\""
            ))),
        }
    }
}

impl std::str::FromStr for Interference {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        Self::from_name(word)
    }
}

impl Named for Diffraction {
    const NAMES: &'static [(&'static str, Self)] = &[
        ("none", Diffraction::None),
        ("gaussian", Diffraction::Gaussian),
        ("airy", Diffraction::Airy),
    ];
}
