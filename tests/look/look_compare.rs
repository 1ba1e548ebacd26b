//! `gonio compare` on scene files: what the report holds, what is refused, and the exit codes.

use crate::gonio;
use predicates::prelude::*;
use serde_json::Value;
use std::path::PathBuf;

/// A small drop of water with few angles; `light` and `size` are lines of its scene.
fn case(size: &str, light: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("case.toml");
    let text = format!(
        "[particle]\nshape = \"sphere\"\n{size}\nmedium = \"water\"\n[light]\n\
         wavelengths_nm = [500.0, 600.0]\n{light}\n[table]\nquantity = \"mueller\"\n\
         theta_deg = {{ from = 0, to = 180, count = 1801 }}\n"
    );
    std::fs::write(&path, text).unwrap();
    (folder, path)
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

#[test]
fn the_report_holds_scene_energy_orders_and_maxima() {
    let (folder, path) = case("radius_mm = 0.1", "");
    let (page, json) = (folder.path().join("r.html"), folder.path().join("r.json"));
    let mut command = gonio();
    command.arg("compare").arg("--case").arg(&path).arg("-o").arg(&page).arg("--json").arg(&json);
    command.assert().success();
    let report: Value = serde_json::from_slice(&std::fs::read(&json).unwrap()).unwrap();
    let report = &report[0];
    for scene in [&report["scene"], &report["tests"][1]["scene"]] {
        let scene = scene.as_str().unwrap();
        assert!(scene.contains("radius_mm = 0.1") && scene.contains("tolerance"), "{scene}");
    }
    let scene = report["tests"][1]["scene"].as_str().unwrap();
    assert!(scene.replace(' ', "").contains("orders=[0,1,2,3"), "the run's own keys: {scene}");

    // Light is neither lost nor made: the fates add up to what came in, for rays. Water takes
    // nearly nothing, and Q tends to 2 (Bohren & Huffman 1983, section 4.4.3).
    let rays = &report["tests"][0];
    assert_eq!(rays["name"], "rays");
    assert_eq!(rays["wavelengths"], 2);
    let fates = &rays["energy"]["fates"];
    let rest = ["absorbed", "totally_reflected", "truncated", "residual"];
    let sum: f64 = numbers(&fates["left_by_order"]).iter().sum::<f64>()
        + rest.iter().map(|key| fates[key].as_f64().unwrap()).sum::<f64>();
    assert!((sum - 1.0).abs() < 1e-9, "{sum}");
    for energy in [&report["reference_energy"], &rays["energy"]] {
        let q = energy["q_sca"].as_f64().unwrap();
        assert!((1.99..2.04).contains(&q), "{q}");
    }

    // Every order up to 7 against its Debye term: the bows' orders agree where their bows are.
    let orders = report["orders"].as_array().unwrap();
    assert_eq!(orders.len(), 8);
    for (order, from, most) in [(2, 137.5, 0.01), (3, 120.0, 0.01)] {
        let bands = orders[order]["bands"].as_array().unwrap();
        let bow = |b: &&Value| b["from_deg"] == from && b["polarisation"] == "unpolarised";
        let l2 = bands.iter().find(bow).unwrap()["l2"].as_f64().unwrap();
        assert!(l2 < most, "order {order}: {l2}");
    }

    // Without order 2 there is no primary bow to be shifted, and nothing is paired with it.
    let named = |run: usize, name: &str| {
        let maxima = report["tests"][run]["maxima"].as_array().unwrap();
        maxima.iter().find(|m| m["name"] == name).map(|m| m["shift_deg"].as_f64().unwrap())
    };
    assert!(named(0, "primary").unwrap().abs() < 0.05);
    assert_eq!(report["tests"][2]["name"], "rays, without order 2");
    assert_eq!(named(2, "primary"), None);
    assert!(
        numbers(&report["tests"][2]["maxima_missing_deg"])
            .iter()
            .any(|t| (138.0..140.0).contains(t))
    );
    for test in report["tests"].as_array().unwrap() {
        for m in test["maxima"].as_array().unwrap() {
            assert!(m["shift_deg"].as_f64().unwrap().abs() < 1.0, "no neighbour: {m}");
        }
    }

    let page = std::fs::read_to_string(page).unwrap();
    for heading in
        ["Order by order", "Energy", "The scene", "All around", "run time", "perpendicular"]
    {
        assert!(page.contains(heading), "{heading}");
    }
}

#[test]
fn what_rays_cannot_honour_is_refused_by_name() {
    for (size, light, field) in [
        (
            "size_distribution = { kind = \"gamma\", effective_radius_um = 10, effective_variance = 0.1 }",
            "",
            "particle.size_distribution",
        ),
        ("radius_mm = 0.01", "bandwidth_nm = 10", "light.bandwidth_nm = 10"),
        ("radius_mm = 0.01", "sun_disc = \"uniform\"", "light.sun_disc = uniform"),
    ] {
        let (folder, path) = case(size, light);
        let page = folder.path().join("r.html");
        let mut command = gonio();
        command.arg("compare").arg("--case").arg(&path).arg("-o").arg(&page);
        command.assert().code(2).stderr(
            predicate::str::contains(field)
                .and(predicate::str::contains("case.toml"))
                .and(predicate::str::contains("--table")),
        );
        assert!(!page.exists());
    }
}

#[test]
fn fail_above_decides_the_exit_code() {
    let (folder, path) = case("radius_mm = 0.05", "");
    let page = folder.path().join("r.html");
    for (limit, code) in [("1e-4", 1), ("0.9", 0)] {
        let mut command = gonio();
        command.arg("compare").arg("--case").arg(&path).arg("-o").arg(&page);
        command.args(["--fail-above", limit]).assert().code(code);
        assert!(page.exists(), "the report is written either way");
    }
}

/// Tables of different drops are compared, and that they are is said: on the page, in the numbers, and to who asked.
#[test]
fn tables_of_different_drops_are_told() {
    let folder = tempfile::tempdir().unwrap();
    for (name, radius) in [("one", "2"), ("other", "3")] {
        let arguments = [
            "table",
            "--shape",
            "sphere",
            "--radius-um",
            radius,
            "--wavelengths-nm",
            "500",
            "--theta-deg",
            "0:180:181",
            "--azimuth-deg",
            "0",
            "--method",
            "mie",
            "--no-preview",
            "-o",
        ];
        gonio().args(arguments).arg(format!("{name}.h5")).current_dir(&folder).assert().success();
    }
    let compare = |reference: &str| {
        let arguments = [
            "compare",
            "--table",
            "one.h5",
            "--reference",
            reference,
            "-o",
            "r.html",
            "--json",
            "r.json",
        ];
        let done = gonio().args(arguments).current_dir(&folder).assert().success();
        let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
        let report: Value = serde_json::from_str(&read("r.json")).unwrap();
        let told = String::from_utf8(done.get_output().stderr.clone()).unwrap();
        (told, read("r.html"), report[0]["tests"][0]["differences"].clone())
    };
    let differ = "particle.radius_um = 2.0 against 3.0";
    let (told, page, numbers) = compare("other.h5");
    assert!(told.contains("not of the reference's particles") && told.contains(differ), "{told}");
    assert!(page.contains(differ) && numbers.as_array().unwrap().len() == 1, "{numbers}");
    let (told, _, numbers) = compare("one.h5");
    assert!(told.is_empty() && numbers.as_array().unwrap().is_empty(), "{told}");
}
