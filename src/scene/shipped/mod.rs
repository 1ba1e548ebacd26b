//! The scenes that come with the program, by name.

mod kind;

pub use kind::SceneKind;

/// A scene that comes with the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shipped {
    /// As its file is called in `data/scenes`, without ending and folder.
    pub name: &'static str,
    /// The file.
    pub text: &'static str,
}

macro_rules! shipped {
    ($($folder:literal: $($name:literal)*;)*) => {
        /// All of them: those of tables first.
        pub const SHIPPED: &[Shipped] = &[$($(
            Shipped {
                name: $name,
                text: include_str!(concat!("../../../data/scenes/", $folder, $name, ".toml")),
            },
        )*)*];
    };
}

shipped! {
    "": "raindrop" "rain" "drizzle" "fog" "cloud_c1" "cloud_gamma" "spray" "aerosol_continental_polluted"
        "large_drop" "spheroid" "sphere_mie" "small_drop_tmatrix" "dyed_drop" "ice_column_halo" "prism" "paper_sadeghi_2012";
    "bows/": "every_key" "double" "heavy_shower" "supernumerary" "cloud" "red" "twinned" "twinned_05" "filter_horizontal" "filter_vertical"
        "size_04_raindrop" "size_04_sphere" "size_06_raindrop" "size_06_sphere" "size_08_raindrop"
        "size_08_sphere" "rain_bow" "one_drop_bow" "twin_showers" "fog_bow" "cloud_c1_bow" "halo" "sun_00" "sun_20" "sun_40" "sun_60";
}

impl Shipped {
    /// That of a name; `bows/` before it is no matter.
    pub fn named(name: &str) -> Option<&'static Self> {
        let bare = name.strip_prefix("bows/").unwrap_or(name);
        let bare = bare.strip_suffix(".toml").unwrap_or(bare);
        SHIPPED.iter().find(|scene| scene.name == bare)
    }

    /// What it shows: the comment that it begins with.
    pub fn about(&self) -> String {
        let lines = self.text.lines().map_while(|line| line.strip_prefix('#'));
        lines.map(str::trim).collect::<Vec<_>>().join(" ")
    }

    /// Of what.
    pub fn kind(&self) -> Option<SceneKind> {
        SceneKind::of(self.text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every file of the folders is in the list, says what it is, and is of a kind.
    #[test]
    fn all_files_are_listed() {
        let mut files = 0;
        for folder in ["data/scenes", "data/scenes/bows"] {
            for entry in std::fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.extension().is_some_and(|ending| ending == "toml") {
                    let name = path.file_stem().unwrap().to_str().unwrap();
                    let scene = Shipped::named(name).unwrap_or_else(|| panic!("{name}"));
                    assert_eq!(scene.text, std::fs::read_to_string(&path).unwrap());
                    assert!(scene.about().len() > 20 && scene.kind().is_some(), "{name}");
                    files += 1;
                }
            }
        }
        assert_eq!(files, SHIPPED.len());
        assert_eq!(Shipped::named("bows/double.toml").unwrap().kind(), Some(SceneKind::Picture));
        assert_eq!(SHIPPED[0].text, crate::scene::BUILT_IN);
    }
}
