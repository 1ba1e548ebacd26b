//! What figures are made with: scenes by name, drops that several of them show, and somebody to tell.

use super::error::FigureError;
use super::scenes::SCENES;
use crate::render::Picture;
use crate::render::bow::{BowScene, DropStore};
use crate::scene::SceneFile;
use std::path::Path;

/// Keeps what one figure has computed and another needs too.
pub struct Workshop {
    drops: DropStore,
    tell: Option<Box<dyn Fn(String)>>,
}

/// No picture of a figure sees scattering angles below this, degrees.
const LEAST_ANGLE: f64 = 80.0;

impl Default for Workshop {
    fn default() -> Self {
        Self { drops: DropStore::looking_from(LEAST_ANGLE.to_radians()), tell: None }
    }
}

impl Workshop {
    /// A workshop in which `tell` hears what the user should know.
    pub fn telling(tell: impl Fn(String) + 'static) -> Self {
        Self { tell: Some(Box::new(tell)), ..Self::default() }
    }

    /// The scene of a sky.
    pub(super) fn sky(&self, name: &str) -> Result<BowScene, FigureError> {
        text(name)?.parse().map_err(|error| wrong(name, &error))
    }

    /// The scene of a table, as it is written.
    pub(super) fn table(&self, name: &str) -> Result<SceneFile, FigureError> {
        toml::from_str(text(name)?).map_err(|error| wrong(name, &error))
    }

    /// The picture of a sky.
    pub(super) fn draw(&self, scene: &BowScene) -> Result<Picture, FigureError> {
        let tell = |note: String| self.tell.iter().for_each(|tell| tell(note.clone()));
        Ok(scene.draw_sharing(&self.drops, Path::new("."), &tell)?)
    }
}

fn text(name: &str) -> Result<&'static str, FigureError> {
    let found = SCENES.iter().find(|scene| scene.name == name);
    let unknown = || FigureError::Scene { name: name.into(), words: "there is none".into() };
    found.map(|scene| scene.text).ok_or_else(unknown)
}

fn wrong(name: &str, error: &dyn std::error::Error) -> FigureError {
    FigureError::Scene { name: name.into(), words: error.to_string() }
}
