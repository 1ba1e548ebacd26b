//! The pages against the program: a word that has rotted fails here.

use crate::scene::{Scene, SceneFile, SceneText};
use std::collections::BTreeSet;
use std::path::Path;

const THEORY: &str = include_str!("../../docs/theory.md");
const SCENE: &str = include_str!("../../docs/scene.md");
const BIBLIOGRAPHY: &str = include_str!("../../docs/bibliography.md");
const BIB: &str = include_str!("../../docs/references.bib");

/// Rows of the tables of a section: cells without blanks and quotes.
fn rows(section: &str) -> Vec<Vec<String>> {
    let lines = SCENE.split(&format!("## `[{section}]`")).nth(1).expect(section).lines().skip(1);
    let lines = lines.take_while(|line| !line.starts_with("## "));
    let rows = lines.filter(|line| line.starts_with("| `"));
    let cell = |cell: &str| cell.trim().replace('`', "");
    rows.map(|row| row.trim_matches('|').split('|').map(cell).collect()).collect()
}

/// A scene of a sphere (with whatever more a key needs) with one key set.
fn with(section: &str, key: &str, value: &str) -> Result<Scene, String> {
    let size = if section == "particle" && (key.contains("radius") || key.contains("diameter")) {
        ""
    } else {
        "radius_mm = 0.5"
    };
    let shape = match key {
        "axis_ratio" => "shape = \"spheroid\"",
        "model" => "shape = \"raindrop\"",
        "apex_deg" => "shape = \"bullet\"\naxis_ratio = 1",
        "coefficients" => "shape = \"harmonics\"",
        "exponent" => "shape = \"superellipsoid\"\naxis_ratio = 1",
        "shape" => "",
        _ => "shape = \"sphere\"",
    };
    let method = if key == "rays_across" || key == "orders" { "method = \"rays\"" } else { "" };
    let more = match value {
        "\"spheroid\"" => "axis_ratio = 0.9",
        _ => "",
    };
    let mut text = String::new();
    for (name, lines) in [
        ("particle", format!("{shape}\n{size}\n{more}\nmedium = {{ index = 1.333 }}\n")),
        ("light", String::new()),
        ("table", String::new()),
        ("model", format!("{method}\n")),
    ] {
        let lines: String = lines
            .lines()
            .filter(|line| !(name == section && line.starts_with(&format!("{key} "))))
            .map(|line| format!("{line}\n"))
            .collect();
        text += &format!("[{name}]\n{lines}");
        if name == section {
            text += &format!("{key} = {value}\n");
        }
    }
    let text = SceneText::parse("page", text).map_err(|error| error.to_string())?;
    Scene::from_text(text, &SceneFile::default()).map_err(|error| error.to_string())
}

/// Every key that the program knows is on the page, and none besides.
#[test]
fn the_page_has_the_keys_of_the_program() {
    let mut known = BTreeSet::new();
    for section in ["particle", "light", "table", "model"] {
        // an unknown key is answered with all that are known
        let answer = with(section, "no_such_key", "1").expect_err("refused");
        for row in rows(section) {
            assert!(answer.contains(&row[0]), "[{section}] {} is not in: {answer}", row[0]);
            known.insert(row[0].clone());
        }
        let list = answer.rsplit(':').next().unwrap_or_default();
        for key in list.split([',', ' ', '\n']).filter(|word| word.contains('_')) {
            let key = key.trim_matches(|c: char| !c.is_alphanumeric() && c != '_');
            assert!(known.contains(key) || key == "no_such_key", "{key} is not on the page");
        }
    }
    assert!(known.len() > 20);
}

/// Ends of ranges are accepted, and what lies beyond is refused; words are accepted.
#[test]
fn ranges_and_words_are_those_of_the_program() {
    let mut checked = 0;
    for section in ["particle", "light", "table", "model"] {
        for row in rows(section) {
            let (key, accepted) = (&row[0], &row[2]);
            let axis = ["wavelengths_nm", "frequencies_ghz", "theta_deg", "azimuth_deg"]
                .contains(&key.as_str());
            if let Some((from, to)) = accepted.split_once(" to ")
                && let (Ok(from), Ok(to)) = (from.parse::<f64>(), to.parse::<f64>())
            {
                let whole = key == "bit_round" || key == "rays_across";
                let number = |value: f64| match (whole, axis) {
                    (true, _) => format!("{}", value as i64),
                    (_, true) => format!("[{value:?}, {:?}]", 0.5 * (from + to)),
                    _ => format!("{value:?}"),
                };
                let beyond =
                    |end: f64, way: f64| end + way * if whole { 1.0 } else { 1e-6 * (to - from) };
                let list = |value: f64| {
                    if axis && value > 0.5 * (from + to) {
                        format!("[{:?}, {value:?}]", 0.5 * (from + to))
                    } else {
                        number(value)
                    }
                };
                for end in [from, to] {
                    if let Err(error) = with(section, key, &list(end)) {
                        assert!(!error.contains(&format!("{key} =")), "{key} = {end}: {error}");
                    }
                }
                for outside in [beyond(from, -1.0), beyond(to, 1.0)] {
                    assert!(with(section, key, &list(outside)).is_err(), "{key} = {outside}");
                }
                checked += 1;
            } else if row[1].is_empty() && accepted.contains(',') && !accepted.contains(" of ") {
                for word in accepted.split(", ").filter(|word| !word.contains(' ')) {
                    let quoted = format!("\"{word}\"");
                    let value = if word == "true" || word == "false" { word } else { &quoted };
                    if let Err(error) = with(section, key, value) {
                        assert!(!error.contains("did you mean"), "{key} = {word}: {error}");
                        assert!(!error.contains("unknown"), "{key} = {word}: {error}");
                    }
                }
                checked += 1;
            }
        }
    }
    assert!(checked > 14, "only {checked} rows say what is accepted");
}

/// Defaults on the page are those that a scene without the key is resolved with.
#[test]
fn defaults_are_those_of_the_program() {
    let scene = with("model", "tolerance", "0.01").expect("a plain sphere");
    let resolved: toml::Table = scene.toml.parse().expect("the record is TOML");
    let mut checked = 0;
    for section in ["light", "table", "model"] {
        for row in rows(section) {
            let Some(value) = resolved.get(section).and_then(|keys| keys.get(&row[0])) else {
                continue;
            };
            let text = match value {
                toml::Value::String(word) => word.clone(),
                toml::Value::Table(grid) => {
                    let end = |name: &str| grid[name].as_float().expect("a number");
                    format!("{}:{}:{}", end("from"), end("to"), grid["count"])
                }
                other => other.to_string().trim_end_matches(".0").to_string(),
            };
            assert_eq!(text, row[3], "{section}.{}", row[0]);
            checked += 1;
        }
    }
    assert!(checked >= 10, "only {checked} defaults compared");
}

/// One bibliography: the page has the keys of the file, and every citation is one of them.
#[test]
fn citations_are_in_the_bibliography() {
    let keys: BTreeSet<&str> = BIB
        .lines()
        .filter(|line| line.starts_with('@'))
        .filter_map(|line| line.split(['{', ',']).nth(1))
        .collect();
    let listed =
        BIBLIOGRAPHY.lines().filter_map(|line| line.strip_prefix("| `")?.split('`').next());
    assert_eq!(keys, listed.collect());
    let mut cited = BTreeSet::new();
    for group in THEORY.split('(').skip(1) {
        let group = group.split(')').next().unwrap_or_default();
        let keys: Vec<&str> = group.split(", ").collect();
        let is_key = |key: &&str| {
            let (name, year) =
                key.split_at_checked(key.len().saturating_sub(4)).unwrap_or_default();
            !name.is_empty()
                && name.chars().all(|c| c.is_ascii_lowercase())
                && year.chars().all(|c| c.is_ascii_digit())
        };
        if keys.iter().all(is_key) {
            cited.extend(keys);
        }
    }
    assert!(cited.len() > 10, "{cited:?}");
    assert!(cited.is_subset(&keys), "{:?}", cited.difference(&keys));
    assert_eq!(cited, keys, "what nobody cites does not belong there");
}

/// Places of the sources that pages name are there.
#[test]
fn places_that_pages_name_exist() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut places = 0;
    for page in [
        "README.md",
        "ARCHITECTURE.md",
        "CONTRIBUTING.md",
        "docs/theory.md",
        "docs/tutorials.md",
        "docs/scene.md",
    ] {
        let text = std::fs::read_to_string(root.join(page)).expect(page);
        for word in text.split(['`', '(', ')', '"', ' ', '\n']) {
            let place = word.trim_end_matches(['.', ',', ';', ':', '/']);
            let ours = ["src/", "docs/", "examples/", "tests/", "tools/", "data/", "validation/"];
            if ours.iter().any(|start| place.starts_with(start)) && !place.contains(['*', '…', '<'])
            {
                assert!(root.join(place).exists(), "{page} names {place}, which is not there");
                places += 1;
            }
        }
    }
    assert!(places > 20, "{places}");
}
