//! What a scene is of: a table, or a picture. Who gives one where the other is meant is told so.

use crate::scene::file::{KEYS, MODES};
use crate::scene::files::read_limited;
use std::path::Path;

/// What a scene is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SceneKind {
    /// A table: `gonio table`, `plan`, `validate`.
    Table,
    /// A picture: `gonio render`.
    Picture,
}

impl SceneKind {
    /// Sections of a picture's scene.
    pub const PICTURE_SECTIONS: [&str; 7] =
        ["camera", "drops", "filter", "layer", "rain", "sky", "sun"];

    /// Of a file; nothing where it cannot be read.
    pub fn of_file(path: &Path) -> Option<Self> {
        Self::of(&read_limited(path).ok()?)
    }

    /// By the sections that it has; nothing where they tell of neither kind, or of both.
    pub fn of(text: &str) -> Option<Self> {
        let sections = text.parse::<toml::Table>().ok()?;
        let has = |name: &str| sections.contains_key(name);
        let table = KEYS.iter().any(|(name, _)| has(name)) || has(MODES);
        match (table, Self::PICTURE_SECTIONS.into_iter().any(has)) {
            (true, false) => Some(SceneKind::Table),
            (false, true) => Some(SceneKind::Picture),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_tell() {
        assert_eq!(SceneKind::of(crate::scene::BUILT_IN), Some(SceneKind::Table));
        assert_eq!(SceneKind::of("[[particles]]\nshape = 'sphere'"), Some(SceneKind::Table));
        assert_eq!(SceneKind::of("[[drops]]\nradius_mm = 1"), Some(SceneKind::Picture));
        assert_eq!(SceneKind::of("[sun]\n[light]"), None);
        assert_eq!(SceneKind::of("[sunn]"), None);
        assert_eq!(SceneKind::of("="), None);
    }
}
