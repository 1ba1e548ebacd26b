//! A flag for every key of a scene file, of the same name; flags win over the file.

use crate::cli::show::notes;
use clap::Args;
use gonio::medium::MediumSpec;
use gonio::scene::{Scene, SceneError, SceneFile};
use std::path::Path;

/// All keys of a scene.
#[derive(Args, Clone, Debug, Default)]
pub struct SceneFlags {
    #[command(flatten)]
    keys: SceneFile,
}

impl SceneFlags {
    /// As keys of a scene; a constant index is a medium.
    pub fn keys(&self) -> SceneFile {
        let mut keys = self.keys.clone();
        if let Some([n, k]) = keys.particle.index.take() {
            keys.particle.medium = Some(MediumSpec::Index { n, k });
        }
        keys
    }

    /// The scene of a file, or the built-in one, with the flags laid over it.
    pub fn scene(&self, path: Option<&Path>) -> Result<Scene, SceneError> {
        let keys = self.keys();
        let scene = match path {
            Some(path) => Scene::load(path, &keys),
            None => Scene::built_in(&keys),
        }?;
        notes::tell(scene.medium.notes());
        Ok(scene)
    }
}
