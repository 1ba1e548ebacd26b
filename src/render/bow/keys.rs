//! The keys of a picture's scene.

use super::drops::DropKeys;
use super::error::BowError;
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
    pub sun: SunKeys,
    pub camera: CameraKeys,
    pub rain: RainKeys,
    pub sky: SkyKeys,
    pub filter: FilterKeys,
    pub drops: Vec<DropKeys>,
}

/// The sun.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SunKeys {
    pub elevation_deg: Option<f64>,
    pub disc: Option<bool>,
    pub illuminant: Option<String>,
    pub observer: Option<String>,
}

/// Where the picture is taken.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CameraKeys {
    pub width: Option<usize>,
    pub height: Option<usize>,
    pub fov_deg: Option<f64>,
    pub lens: Option<String>,
    pub elevation_deg: Option<f64>,
    pub azimuth_deg: Option<f64>,
}

/// How much rain there is.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RainKeys {
    pub optical_depth: Option<f64>,
    /// `curtain` or `around`.
    pub shape: Option<String>,
}

/// What is behind the rain.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SkyKeys {
    /// sRGB, 0 to 255.
    pub background: Option<[u8; 3]>,
    pub ground: Option<[u8; 3]>,
    pub brightness: Option<f64>,
    pub exposure: Option<f64>,
    pub horizon_line: bool,
}

/// What is before the camera.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FilterKeys {
    pub polariser_deg: Option<f64>,
}

impl BowScene {
    /// Read a scene from a file.
    ///
    /// # Errors
    /// A file that cannot be read, or that is no scene of a picture.
    pub fn load(path: &Path) -> Result<Self, BowError> {
        let text = std::fs::read_to_string(path)
            .map_err(|source| BowError::Read { path: path.into(), source })?;
        text.parse().map_err(|source| BowError::Syntax { path: path.into(), source })
    }
}

impl FromStr for BowScene {
    type Err = toml::de::Error;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        toml::from_str(text)
    }
}
