//! The scenes of figures, compiled in.

/// A scene that a figure is made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SceneOfFigure {
    /// As its file is called in `data/scenes/figures`, without ending.
    pub name: &'static str,
    /// The file.
    pub text: &'static str,
}

macro_rules! scenes {
    ($($name:literal)*) => {
        /// All of them.
        pub const SCENES: &[SceneOfFigure] = &[$(
            SceneOfFigure {
                name: $name,
                text: include_str!(concat!("../../data/scenes/figures/", $name, ".toml")),
            },
        )*];
    };
}

scenes! {
    "sadeghi_1a" "sadeghi_1b" "sadeghi_1c" "sadeghi_1d" "sadeghi_1e" "sadeghi_9" "sadeghi_11"
    "sadeghi_12a" "sadeghi_12b" "sadeghi_12c" "sadeghi_12d" "sadeghi_12e" "sadeghi_12f"
    "sadeghi_13" "sadeghi_14" "sadeghi_15" "sadeghi_16" "sadeghi_17"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::Workshop;
    use crate::scene::SceneKind;

    /// Every file of the folder is in the list, says what it is, and can be read.
    #[test]
    fn all_files_are_listed_and_parse() {
        let workshop = Workshop::default();
        let mut files = 0;
        for entry in std::fs::read_dir("data/scenes/figures").unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_stem().unwrap().to_str().unwrap();
            let scene = SCENES.iter().find(|scene| scene.name == name);
            let scene = scene.unwrap_or_else(|| panic!("{name}"));
            assert!(scene.text.starts_with("# "), "{name}");
            match SceneKind::of(scene.text) {
                Some(SceneKind::Picture) => drop(workshop.sky(name).unwrap()),
                Some(SceneKind::Table) => drop(workshop.table(name).unwrap().validate().unwrap()),
                None => panic!("{name}"),
            }
            files += 1;
        }
        assert_eq!(files, SCENES.len());
    }
}
