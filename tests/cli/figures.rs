//! `gonio figure`: what it lists, makes, prints and refuses.

use crate::support::gonio;
use assert_cmd::Command;
use serde_json::Value;
use std::path::Path;

/// Standard output of the program, which must succeed.
fn printed(folder: &Path, arguments: &[&str]) -> String {
    let output = Command::cargo_bin("gonio").unwrap().args(arguments).current_dir(folder).output();
    let output = output.unwrap();
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Every figure is listed, with what to compare.
#[test]
fn all_are_listed() {
    let here = Path::new(".");
    let listed: Value =
        serde_json::from_str(&printed(here, &["figure", "--list", "--json"])).unwrap();
    let listed = listed.as_array().unwrap();
    assert!(listed.len() >= 30);
    let plain = printed(here, &["figure", "--list"]);
    for figure in listed {
        let name = figure["name"].as_str().unwrap();
        assert!(plain.contains(name) && figure["compare"].as_str().unwrap().len() > 20, "{name}");
    }
    for name in [
        "sadeghi-3",
        "sadeghi-12",
        "sadeghi-table-2",
        "weidlich-2",
        "glass-abbe",
        "elhoni-28",
        "airy",
    ] {
        assert!(listed.iter().any(|figure| figure["name"] == name), "{name}");
    }
}

/// The paper's bows, Fig. 3, end to end: an SVG with its words, and numbers within the rounding of the print and what
/// water's index is uncertain by.
#[test]
fn bows_of_figure_3() {
    let folder = tempfile::tempdir().unwrap();
    let numbers = printed(folder.path(), &["figure", "sadeghi-3", "-o", "three.svg", "--json"]);
    let numbers: Value = serde_json::from_str(&numbers).unwrap();
    let bows: Vec<&Value> = numbers.as_array().unwrap().iter().take(4).collect();
    for (bow, paper) in bows.iter().zip([137.7, 139.6, 129.5, 126.1]) {
        assert_eq!(bow["paper"], paper);
        assert!(bow["difference"].as_f64().unwrap().abs() <= 0.06, "{bow}");
    }
    let svg = std::fs::read_to_string(folder.path().join("three.svg")).unwrap();
    assert!(
        svg.starts_with("<svg") && svg.contains("scattering angle (°)") && svg.contains("137.7")
    );
}

/// Table I is printed digit by digit, Table II is the engine's filter and within a fifth of what suits best.
#[test]
fn tables_of_the_paper() {
    let folder = tempfile::tempdir().unwrap();
    let of = |name: &str, file: &str| -> Vec<Value> {
        let printed = printed(folder.path(), &["figure", name, "-o", file, "--json"]);
        serde_json::from_str(&printed).unwrap()
    };
    let first = of("sadeghi-table-1", "one.png");
    assert_eq!(first.len(), 48);
    assert!(first.iter().all(|number| number["difference"].as_f64().unwrap().abs() < 1e-12));
    assert_eq!(std::fs::read(folder.path().join("one.png")).unwrap()[1..4], *b"PNG");
    let second = of("sadeghi-table-2", "two.png");
    for number in &second[..10] {
        let (paper, ours) = (number["paper"].as_f64().unwrap(), number["ours"].as_f64().unwrap());
        assert!((ours / paper - 1.0).abs() < 0.2, "{number}");
    }
    assert!(second[10]["ours"].as_f64().unwrap() < 1e-12);
}

/// Names, endings and files that are there: each is told before anything is computed.
#[test]
fn what_is_wrong_is_told() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("there.png"), "mine").unwrap();
    std::fs::create_dir(folder.path().join("some")).unwrap();
    std::fs::write(folder.path().join("some/sadeghi-6.png"), "mine").unwrap();
    for (arguments, told) in [
        (vec!["figure", "sadegi-5", "-o", "x.png"], "sadeghi-5"),
        (vec!["figure", "sadeghi-6", "-o", "x.svg"], "give it the ending .png"),
        (vec!["figure", "sadeghi-3", "-o", "x.pdf"], ".png or .svg"),
        (vec!["figure", "sadeghi-3", "-o", "none/x.png"], "there is no folder none"),
        (vec!["figure", "sadeghi-3", "-o", "there.png"], "--overwrite"),
        (vec!["figure", "sadeghi-3"], "give -o FILE, or --json"),
        (vec!["figure", "--all", "-o", "some"], "--overwrite"),
        (vec!["figure", "--all", "-o", "there.png"], "a file; --all writes a folder"),
        (vec!["figure"], "NAME"),
        (vec!["figure", "sadeghi-3", "--all", "-o", "x"], "--all"),
    ] {
        let (code, message) = gonio(folder.path(), &arguments);
        assert_eq!(code, 2, "{arguments:?}: {message}");
        assert!(message.contains(told), "{arguments:?}: {message}");
    }
    assert_eq!(std::fs::read(folder.path().join("there.png")).unwrap(), b"mine");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
}

/// All of them, which takes minutes: `GONIO_ALL_FIGURES=1`.
#[test]
fn all_at_once() {
    if std::env::var_os("GONIO_ALL_FIGURES").is_none() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let printed = printed(folder.path(), &["figure", "--all", "-o", "all", "--json"]);
    let numbers: Vec<Value> = serde_json::from_str(&printed).unwrap();
    assert!(numbers.len() > 100);
    assert!(numbers.iter().all(|number| number["ours"].as_f64().is_some_and(f64::is_finite)));
    let page = std::fs::read_to_string(folder.path().join("all/README.md")).unwrap();
    let files = std::fs::read_dir(folder.path().join("all")).unwrap().count();
    assert_eq!(page.matches("\n### ").count() + 1, files);
}
