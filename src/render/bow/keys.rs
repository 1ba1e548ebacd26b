//! The keys of a picture's scene.

use super::drops::DropKeys;
use super::error::BowError;
use crate::scene::SceneKind;
use crate::scene::read_limited;
use serde::Deserialize;
use std::path::Path;
use std::str::FromStr;

/// A picture's scene as written.
///
/// ```
/// use gonio::render::bow::BowScene;
/// let scene: BowScene = "[sun]\nelevation_deg = 10\n[[drops]]\nradius_mm = 0.3".parse().unwrap();
/// assert_eq!((scene.sun.elevation_deg, scene.drops.len()), (Some(10.0), 1));
/// assert!("[sun]\nheight = 10".parse::<BowScene>().is_err());
/// ```
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct BowScene {
    /// What shines.
    pub sun: SunKeys,
    /// Where the picture is taken.
    pub camera: CameraKeys,
    /// How much rain there is.
    pub rain: RainKeys,
    /// A layer with light scattered many times, in place of the rain.
    pub layer: LayerKeys,
    /// What is behind the rain.
    pub sky: SkyKeys,
    /// What is before the camera.
    pub filter: FilterKeys,
    /// Kinds of drops.
    pub drops: Vec<DropKeys>,
}

/// The sun.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SunKeys {
    /// Above the horizon, degrees.
    pub elevation_deg: Option<f64>,
    /// Whether its disc smooths the bow.
    pub disc: Option<bool>,
    /// Name of the illuminant.
    pub illuminant: Option<String>,
    /// Name of the observer.
    pub observer: Option<String>,
}

/// Where the picture is taken.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CameraKeys {
    /// Pixels across.
    pub width: Option<usize>,
    /// Pixels down.
    pub height: Option<usize>,
    /// Angle across the picture, degrees.
    pub fov_deg: Option<f64>,
    /// Name of the lens.
    pub lens: Option<String>,
    /// Of the optical axis above the horizon, degrees.
    pub elevation_deg: Option<f64>,
    /// Of the optical axis from the antisolar direction, to the right, degrees.
    pub azimuth_deg: Option<f64>,
    /// Draw circles of 42° and 51° about the antisolar point, it, and the horizon, with their names.
    pub grid: bool,
}

/// How much rain there is.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RainKeys {
    /// Along a line of sight.
    pub optical_depth: Option<f64>,
    /// `curtain` or `around`.
    pub shape: Option<String>,
}

/// A layer with light scattered many times.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields, default)]
pub struct LayerKeys {
    /// Along the normal.
    pub optical_depth: Option<f64>,
    /// Share of the light that the ground behind it throws back.
    pub ground_albedo: Option<f64>,
    /// `curtain`, `above` or `below`.
    pub place: Option<String>,
    /// `auto`, `single` or `multiple`.
    pub scattering: Option<String>,
    /// Directions per hemisphere.
    pub streams: Option<usize>,
}

/// What is behind the rain.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SkyKeys {
    /// Of what is seen through the rain, beside the bow: sRGB, 0 to 255.
    pub background: Option<[u8; 3]>,
    /// Colour below the horizon, sRGB, 0 to 255; absent: rain falls there too.
    pub ground: Option<[u8; 3]>,
    /// Luminance of the brightest bow pixel before the background is added.
    pub brightness: Option<f64>,
    /// Exposure given outright, in place of `brightness`.
    pub exposure: Option<f64>,
    /// Draw the horizon as a line.
    pub horizon_line: bool,
}

/// What is before the camera.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FilterKeys {
    /// Transmission axis, degrees from the horizontal, counter-clockwise.
    pub polariser_deg: Option<f64>,
}

impl BowScene {
    /// Read a scene from a file.
    ///
    /// # Errors
    /// A file that cannot be read, or that is no scene of a picture.
    pub fn load(path: &Path) -> Result<Self, BowError> {
        let text =
            read_limited(path).map_err(|source| BowError::Read { path: path.into(), source })?;
        if SceneKind::of(&text) == Some(SceneKind::Table) {
            return Err(BowError::OfTable { path: path.into() });
        }
        text.parse().map_err(|source| BowError::Syntax { path: path.into(), source })
    }
}

impl FromStr for BowScene {
    type Err = toml::de::Error;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        toml::from_str(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What tells a picture's scene from a table's are its sections.
    #[test]
    fn sections_are_those_known() {
        for name in SceneKind::PICTURE_SECTIONS {
            let head = if name == "drops" { "[[drops]]".into() } else { format!("[{name}]") };
            assert!(head.parse::<BowScene>().is_ok(), "{name}");
        }
        let message = "[none]".parse::<BowScene>().unwrap_err().to_string();
        assert_eq!(
            message.matches('`').count() / 2,
            1 + SceneKind::PICTURE_SECTIONS.len(),
            "{message}"
        );
    }
}
