//! `gonio lee` from outside: where raindrops stop being spheres nothing jumps, and media are named
//! as in a scene.

use crate::{gonio, pixels};
use gonio::color::{
    Illuminant, Observer, delta_e_2000, illuminant_white, lab, srgb_to_xyz, to_srgb,
};
use predicates::prelude::*;
use serde_json::Value;

/// The colours of a diagram's columns, sRGB.
fn colours(flags: &[&str]) -> Vec<Vec<[u8; 3]>> {
    let output = gonio().args(["lee", "--json"]).args(flags).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let value: Value = serde_json::from_slice(&output.stdout).unwrap();
    serde_json::from_value(value["srgb"].clone()).unwrap()
}

fn difference(a: [u8; 3], b: [u8; 3]) -> f64 {
    let white = illuminant_white(Illuminant::D65, Observer::Cie1931);
    let colour = |rgb: [u8; 3]| lab(srgb_to_xyz(rgb.map(|v| f64::from(v) / 255.0)), white);
    delta_e_2000(colour(a), colour(b))
}

/// At 0.4 mm the diagram of raindrops changes from Lorenz–Mie, which holds all orders, to rays. Were
/// orders 4 to 7 left out, the dark band between the bows would lose a fifth of its light.
#[test]
fn rays_take_over_where_spheres_end_without_a_jump() {
    let radius = ["--shape", "raindrop", "--radius-mm", "0.3999:0.4001:2", "--linear"];
    for azimuth in ["180", "90"] {
        let flags = ["--theta", "122:148:0.1", "--azimuth-deg", azimuth];
        let columns = colours(&[&radius[..], &flags].concat());
        let (sphere, drop) = (&columns[0], &columns[1]);
        let mut off: Vec<f64> = sphere.iter().zip(drop).map(|(a, b)| difference(*a, *b)).collect();
        let dark: f64 = off[80..130].iter().fold(0.0, |most, d| d.max(most));
        off.sort_by(f64::total_cmp);
        let at = |q: f64| off[(q * (off.len() - 1) as f64) as usize];
        println!(
            "azimuth {azimuth}°: median {:.2}, 99 % {:.2}, dark band {dark:.2}",
            at(0.5),
            at(0.99)
        );
        assert!(dark < 2.0 && at(0.5) < 0.8 && at(0.99) < 2.0, "{dark} {} {}", at(0.5), at(0.99));
    }
}

#[test]
fn media_are_named_as_in_a_scene() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("n.csv");
    let rows = "wavelength_nm,n,k\n360,1.333,0\n500,1.333,0\n760,1.333,0\n";
    std::fs::write(&file, rows).unwrap();
    let with = |medium: &str| {
        colours(&["--radius-mm", "0.02:0.02:1", "--theta", "135:145:0.5", "--medium", medium])
    };
    let inline = with("{ index = 1.333 }");
    assert_eq!(inline, with(file.to_str().unwrap()));
    assert_ne!(inline, with("water"));

    for (medium, said) in
        [("wather", "water"), ("missing.csv", "missing.csv"), ("{ index = }", "medium")]
    {
        gonio()
            .args(["lee", "--json", "--medium", medium])
            .assert()
            .code(2)
            .stderr(predicate::str::contains(said));
    }

    // In the scene of a picture, beside which files are looked for.
    let scene = |medium: &str| {
        format!(
            "[camera]\nfov_deg = 60\nwidth = 32\nheight = 18\n[[drops]]\nradius_mm = 0.01\n\
             medium = {medium}\n"
        )
    };
    let picture = |name: &str, medium: &str| {
        let path = folder.path().join(format!("{name}.toml"));
        let png = path.with_extension("png");
        std::fs::write(&path, scene(medium)).unwrap();
        gonio().arg("render").arg(&path).arg("-o").arg(&png).assert().success();
        pixels(&png)
    };
    let table = picture("table", "{ index = 1.333 }");
    assert!(table == picture("file", "{ file = \"n.csv\" }"));
    assert!(table != picture("cauchy", "{ cauchy = [1.325, 0.003] }"));
}

/// A file that would be replaced is told before anything is computed: the default diagram takes far
/// longer than this test is given.
#[test]
fn an_existing_file_is_refused_before_computing() {
    let folder = tempfile::tempdir().unwrap();
    let data = folder.path().join("lee.h5");
    std::fs::write(&data, "mine").unwrap();
    let mut command = gonio();
    command.args(["lee", "--shape", "raindrop", "--data"]).arg(&data);
    command
        .timeout(std::time::Duration::from_secs(10))
        .assert()
        .code(2)
        .stderr(predicate::str::contains("lee.h5").and(predicate::str::contains("--overwrite")));
    assert_eq!(std::fs::read_to_string(&data).unwrap(), "mine");
}

/// The scale of the helper above: what is one step of eight bits apart is nearly the same.
#[test]
fn colours_read_back_are_those_written() {
    let xyz = [0.3, 0.32, 0.28];
    let rgb = to_srgb(xyz, 1.0);
    let white = illuminant_white(Illuminant::D65, Observer::Cie1931);
    let back = lab(srgb_to_xyz(rgb.map(|v| f64::from(v) / 255.0)), white);
    assert!(delta_e_2000(back, lab(xyz, white)) < 0.7);
}
