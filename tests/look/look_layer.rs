//! Pictures of layers in which light is scattered many times.

use crate::{gonio, pixels};
use predicates::prelude::*;
use std::path::Path;

/// Droplets whose table takes a second.
const DROPS: &str = "[[drops]]\nsize_distribution = { kind = \"gamma\", effective_radius_um = 8, \
                     effective_variance = 0.05 }\nwavelengths = 9\ntolerance = 0.05\n";

fn written(folder: &Path, text: &str) -> std::path::PathBuf {
    let path = folder.join("scene.toml");
    std::fs::write(&path, text).unwrap();
    path
}

/// Pixels of a scene, and what was told.
fn drawn(text: &str, arguments: &[&str]) -> (Vec<u8>, String) {
    let folder = tempfile::tempdir().unwrap();
    let (scene, png) = (written(folder.path(), text), folder.path().join("bow.png"));
    let mut command = gonio();
    command.arg("render").arg(&scene).args(arguments).arg("-o").arg(&png);
    let told = command.assert().success().get_output().stderr.clone();
    (pixels(&png), String::from_utf8(told).unwrap())
}

#[test]
fn impossible_layers_are_told() {
    let folder = tempfile::tempdir().unwrap();
    for (text, words) in [
        (
            "[layer]\noptical_depth = inf\n",
            "layer.optical_depth = inf: numbers above 0, up to 1000, are accepted",
        ),
        ("[layer]\noptical_depth = nan\n", "layer.optical_depth = NaN"),
        ("[layer]\noptical_depth = -2\n", "layer.optical_depth = -2"),
        ("[layer]\noptical_depth = 0\n", "layer.optical_depth = 0"),
        (
            "[layer]\noptical_depth = 1\nground_albedo = 1.2\n",
            "layer.ground_albedo = 1.2: 0 to 1 are accepted",
        ),
        ("[layer]\noptical_depth = 1\nground_albedo = -0.1\n", "layer.ground_albedo = -0.1"),
        ("[layer]\noptical_depth = 1\nplace = \"beside\"\n", "layer.place = \"beside\": curtain"),
        (
            "[layer]\noptical_depth = 1\nscattering = \"twice\"\n",
            "layer.scattering = \"twice\": auto, single or multiple",
        ),
        ("[layer]\noptical_depth = 1\nstreams = 1000\n", "layer.streams = 1000: 4 to 64"),
        ("[layer]\nground_albedo = 0.2\n", "layer.optical_depth: none given"),
        (
            "[layer]\noptical_depth = 1\n[rain]\noptical_depth = 1\n",
            "rain.optical_depth = 1 with [layer]",
        ),
        (
            "[layer]\noptical_depth = 1\nplace = \"below\"\n[sun]\nelevation_deg = 0\n",
            "sun.elevation_deg = 0: a level layer needs the sun above",
        ),
        (
            "[layer]\noptical_depth = 1\n[sun]\nelevation_deg = 90\n",
            "sun.elevation_deg = 90: an upright layer",
        ),
        (
            "[layer]\noptical_depth = 1\n[sun]\nelevation_deg = -5\n",
            "sun.elevation_deg = -5: accepted are 0 to 90",
        ),
    ] {
        let scene = written(folder.path(), &format!("{text}{DROPS}"));
        let png = folder.path().join("bow.png");
        for command in ["render", "plan"] {
            let mut asked = gonio();
            asked.arg(command).arg(&scene);
            if command == "render" {
                asked.arg("-o").arg(&png);
            }
            asked.assert().code(2).stderr(predicate::str::contains(words));
        }
    }
}

/// Light scattered once in a layer is that in a curtain of rain; in a thin one there is nothing else to see, and the
/// choice is told.
#[test]
fn thin_layers_are_curtains_of_rain() {
    let view = "[camera]\nwidth = 48\nheight = 27\nfov_deg = 40\n[sky]\nbackground = [0, 0, 0]\n";
    let rain = drawn(&format!("{view}[rain]\noptical_depth = 0.7\n{DROPS}"), &[]).0;
    let layer = format!("{view}[layer]\noptical_depth = 0.7\nscattering = \"single\"\n{DROPS}");
    let (once, told) = drawn(&layer, &[]);
    assert!(rain == once);
    assert!(told.contains("is not enough") && told.contains("it alone is drawn"), "{told}");
    let thin = format!("{view}[layer]\noptical_depth = 1e-4\n{DROPS}");
    let (auto, told) = drawn(&thin, &[]);
    assert!(told.contains("light scattered once is enough"), "{told}");
    let (all, told) = drawn(&thin, &["--scattering", "multiple"]);
    assert!(told.contains("24 directions per hemisphere"), "{told}");
    let most = auto.iter().zip(&all).map(|(a, b)| a.abs_diff(*b)).max().unwrap();
    assert!(most <= 2, "{most}");
}

/// Deeper layers are less of a bow: the dark side fills with light scattered again, on all sides.
#[test]
fn contrast_falls_with_depth() {
    let contrast = |depth: f64, scattering: &str| {
        let text = format!(
            "[camera]\nwidth = 16\nheight = 120\nfov_deg = 5\nelevation_deg = 22\n[sky]\nexposure = 5\n\
             [layer]\noptical_depth = {depth}\nscattering = \"{scattering}\"\n{DROPS}"
        );
        let rgb = drawn(&text, &[]).0;
        let row = |y: usize| f64::from(rgb[3 * (16 * y + 8) + 1]);
        let rows: Vec<f64> = (0..120).map(row).collect();
        let least = rows.iter().copied().fold(f64::INFINITY, f64::min);
        rows.iter().copied().fold(0.0, f64::max) / least.max(1.0)
    };
    let (once, thin, thick) =
        (contrast(3.0, "single"), contrast(0.2, "multiple"), contrast(5.0, "multiple"));
    assert!(once.min(thin) > 1.3 * thick && thick > 1.0, "{once} {thin} {thick}");
}

/// From below, from above, through a filter: all are drawn, and the ground is lit by the layer.
#[test]
fn layers_are_seen_from_all_sides() {
    for (place, elevation) in [("above", 20), ("below", -30)] {
        let text = format!(
            "[camera]\nwidth = 32\nheight = 18\nelevation_deg = {elevation}\n[sun]\nelevation_deg = 15\n\
             [layer]\noptical_depth = 2\nground_albedo = 0.3\nplace = \"{place}\"\n[filter]\npolariser_deg = 0\n{DROPS}"
        );
        let rgb = drawn(&text, &[]).0;
        let lit = rgb.chunks_exact(3).filter(|pixel| pixel.iter().any(|v| *v > 10)).count();
        assert!(lit > 400, "{place}: {lit}");
    }
}
