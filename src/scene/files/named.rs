//! Files that a scene names: what it means changes with them.

use std::path::PathBuf;
use toml::{Table, Value};

/// Keys that hold a path, in whatever section or table.
const PATHS: [&str; 2] = ["file", "absorbance"];

/// The files that the text of a scene names: data of media, sizes, profiles, meshes. Whoever keeps a result under
/// the name of a scene has to look at their content, too. Empty where the text is no TOML.
///
/// ```
/// let scene = "[particle]\nmedium = { file = \"glass.yml\" }";
/// assert_eq!(gonio::scene::named_files(scene), [std::path::Path::new("glass.yml")]);
/// ```
pub fn named_files(scene: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    if let Ok(table) = scene.parse::<Table>() {
        gather(&table, &mut found);
    }
    found.sort();
    found.dedup();
    found
}

fn gather(table: &Table, into: &mut Vec<PathBuf>) {
    for (key, value) in table {
        match value {
            Value::String(path) if PATHS.contains(&key.as_str()) => into.push(path.into()),
            other => gather_value(other, into),
        }
    }
}

fn gather_value(value: &Value, into: &mut Vec<PathBuf>) {
    match value {
        Value::Table(table) => gather(table, into),
        Value::Array(list) => list.iter().for_each(|value| gather_value(value, into)),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn files_are_found_wherever_they_stand() {
        let scene = r#"
            [[particles]]
            shape = "mesh"
            file = "gem.obj"
            medium = { layers = [{ radius_fraction = 0.5, medium = { file = "core.yml" } }, { medium = "ice" }] }
            [[particles]]
            coating = [{ medium = { file = "oil.csv" }, thickness_nm = 100 }]
            size_distribution = { kind = "table", file = "sizes.csv" }
            medium = { absorbance = "dye.csv", path_mm = 10 }
        "#;
        let found = named_files(scene);
        assert_eq!(
            found,
            ["core.yml", "dye.csv", "gem.obj", "oil.csv", "sizes.csv"].map(Path::new)
        );
    }

    #[test]
    fn words_that_are_no_paths_are_left_alone() {
        assert_eq!(
            named_files("[particle]\nmedium = \"water\"\nfile_unit = \"um\""),
            [""; 0].map(Path::new)
        );
        assert!(named_files("no toml at all =").is_empty());
    }
}
