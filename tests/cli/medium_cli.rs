//! `gonio material` as a user meets it.

use assert_cmd::Command;
use serde_json::Value;
use std::path::Path;

fn gonio() -> Command {
    let mut command = Command::cargo_bin("gonio").unwrap();
    command.arg("material");
    command
}

fn json(arguments: &[&str]) -> Value {
    let output = gonio().args(arguments).arg("--json").output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Exit code 2 and a message that holds `expected`.
fn refused(arguments: &[&str], expected: &str) {
    let output = gonio().args(arguments).output().unwrap();
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    assert!(message.contains(expected), "{arguments:?}: {message:?} lacks {expected:?}");
    assert!(output.stdout.is_empty());
}

#[test]
fn water_by_temperature() {
    let value = json(&["water", "--wavelength-nm", "400,589.3,700", "--temperature-c", "20"]);
    let n: Vec<f64> = value["n"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
    for (found, expected) in n.iter().zip([1.343560, 1.333349, 1.330519]) {
        assert!((found - expected).abs() < 1e-6, "{n:?}");
    }
    assert!((value["vd"].as_f64().unwrap() - 55.78).abs() < 5e-3);
    // Daimon & Masumura measured n_d = 1.33340334 at 20 °C.
    assert!((value["nd"].as_f64().unwrap() - 1.33340334).abs() < 1e-6);
    assert!(value["k"][2].as_f64().unwrap() > 3e-8);
    assert!(value["source"].as_str().unwrap().contains("IAPWS"));
    let dense = json(&["water", "--wavelength-nm", "589.3", "--density-kg-m3", "1000"]);
    assert!(dense["n"][0].as_f64().unwrap() > n[1]);
}

#[test]
fn conversions() {
    let value = json(&["--from-abbe", "1.5168,64.17"]);
    assert!((value["cauchy_a"].as_f64().unwrap() - 1.504583).abs() < 1e-6);
    assert!((value["cauchy_b"].as_f64().unwrap() - 0.004218).abs() < 1e-6);
    let fit = json(&["N-BK7", "--to-cauchy", "3"]);
    assert!(fit["max_error"].as_f64().unwrap() < 1e-4);
    refused(&["--from-abbe", "1.5168"], "as in 1.5168,64.17");
    refused(&["--from-abbe", "0.9,64"], "abbe: index = 0.9");
}

#[test]
fn list_and_comparison() {
    let list = json(&["--list"]);
    assert!(list.as_array().unwrap().len() > 50);
    let both = json(&["diamond", "--compare", "N-BK7", "--wavelength-nm", "430.8,686.7"]);
    let difference = both["n_difference"][0].as_f64().unwrap();
    assert!((difference - (1.5264 - 2.4514)).abs() < 1e-2, "{difference}");
}

#[test]
fn kramers_kronig_of_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("k.csv");
    let pair = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/medium/kk_lorentz_pair.csv");
    let mut rows = String::from("wavelength_um,k\n");
    let mut exact = Vec::new();
    for line in std::fs::read_to_string(pair).unwrap().lines().skip(2) {
        let v: Vec<&str> = line.split(',').collect();
        rows.push_str(&format!("{},{}\n", v[0], v[2]));
        exact.push(v[1].parse::<f64>().unwrap() - v[3].parse::<f64>().unwrap());
    }
    std::fs::write(&path, rows).unwrap();
    let file = path.to_str().unwrap();
    for (method, tails, bound) in [("analytic", "band", 1e-5), ("maclaurin", "taper", 1.7e-4)] {
        let value = json(&[
            "--kramers-kronig",
            file,
            "--background",
            "1.33",
            "--method",
            method,
            "--tails",
            tails,
        ]);
        let n = value["n"].as_array().unwrap();
        assert_eq!(n.len(), exact.len());
        for (n, change) in n.iter().zip(&exact) {
            let error = (n.as_f64().unwrap() - 1.33 - change).abs();
            assert!(error < bound, "{method}: {error:e}");
        }
    }
    // What the ends are worth is said: k ends a third down the band's wing here.
    let forward = json(&["--kramers-kronig", file, "--background", "1.33"]);
    assert!(forward["range_uncertainty"].as_array().unwrap().iter().all(|v| v.as_f64().is_some()));
    refused(&["--kramers-kronig", file], "--background");
    refused(&["--kramers-kronig", file, "--background", "1.33", "--inverse"], "no column n");
}

/// k from a short range of n: refused where it comes out below zero, with what the range is worth,
/// which holds the true error.
#[test]
fn a_short_range_of_n_says_what_it_is_worth() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("n.csv");
    let pair = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/medium/kk_lorentz_pair.csv");
    let text = std::fs::read_to_string(pair).unwrap();
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(2)
        .map(|line| line.split(',').map(|v| v.parse().unwrap()).collect())
        .collect();
    let written: String =
        rows.iter().map(|r| format!("{},{}\n", r[0], 1.33 + r[1] - r[3])).collect();
    std::fs::write(&path, format!("wavelength_um,n\n{written}")).unwrap();
    let file = path.to_str().unwrap();
    let arguments = ["--kramers-kronig", file, "--background", "1.33", "--inverse"];
    refused(&arguments, "k is below 0 in");
    refused(&arguments, "--allow-negative-k");
    let value = json(&[&arguments[..], &["--allow-negative-k"]].concat());
    let column = |name: &str| -> Vec<f64> {
        value[name].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
    };
    let (k, worth) = (column("k"), column("range_uncertainty"));
    assert!(k.iter().any(|k| *k < 0.0));
    let inner = 1..rows.len() - 1;
    for i in inner {
        let error = (k[i] - rows[i][2]).abs();
        assert!(error < 2.0 * worth[i] + 1e-6, "row {i}: {error:e} of {:e}", worth[i]);
    }
    let text = gonio().args(arguments).arg("--allow-negative-k").output().unwrap().stdout;
    assert!(String::from_utf8(text).unwrap().contains("what lies beyond may change k by"));
}

/// Files of k alone are shown, and make no medium; notes stand on stderr, once.
#[test]
fn notes_and_files_without_n() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("k.yml");
    let text = "DATA:\n  - type: tabulated k\n    data: |\n      0.5 1e-3\n      0.6 2e-3\n";
    std::fs::write(&path, text).unwrap();
    let file = path.to_str().unwrap();
    let value = json(&[file, "--wavelength-nm", "600"]);
    assert!(value["n"].is_null() && value["k"][0] == 2e-3, "{value}");
    refused(&[file, "--wavelength-nm", "700"], "outside the data of k (500 to 600 nm)");
    refused(&["water", "--compare", file], "the file holds no n (only k)");
    let path = folder.path().join("nk.csv");
    std::fs::write(&path, "wavelength_nm,n,k\n400,1.5,0.1\n500,1.5,-1e-9\n").unwrap();
    let file = path.to_str().unwrap();
    let output = gonio().args([file, "--compare", file]).output().unwrap();
    let notes = String::from_utf8(output.stderr).unwrap();
    assert_eq!(notes.matches("note: nk: 1 row with k below 0").count(), 1, "{notes}");
}

#[test]
fn plots_are_drawn_whole() {
    let folder = tempfile::tempdir().unwrap();
    let svg = folder.path().join("water.svg");
    gonio().args(["water", "--compare", "sea-water", "-o"]).arg(&svg).assert().success();
    let text = std::fs::read_to_string(&svg).unwrap();
    for expected in ["wavelength in vacuum (nm)", "index of refraction n", "Pope", "sea water"] {
        assert!(text.contains(expected), "{expected}");
    }
    let png = folder.path().join("bk7.png");
    gonio().args(["N-BK7", "-o"]).arg(&png).assert().success();
    assert!(std::fs::read(&png).unwrap().starts_with(b"\x89PNG"));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
fn wrong_input_ends_with_code_2() {
    refused(&["watr"], "did you mean \"water\"");
    refused(&["water", "--wavelength-nm", "150"], "outside the data of water (200 to 1900 nm)");
    refused(&["water", "--wavelength-nm", "red"], "expected a positive number");
    refused(&["water", "--wavelength-nm", "700:400:1"], "FROM below TO");
    refused(&["water", "--temperature-c", "150"], "temperature_c = 150");
    refused(&["missing.yml"], "missing.yml");
    refused(&["water", "--compare", "wather"], "did you mean \"water\"");
    refused(&["{ index = }"], "a TOML table");
    refused(&["N-BK7", "--temperature-c", "20"], "does not depend on it");
}
