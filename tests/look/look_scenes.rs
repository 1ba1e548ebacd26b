//! The shipped scenes of rainbows, and what `gonio render` and `gonio lee` say to bad input.

use crate::{decoded, gonio, pixels};
use predicates::prelude::*;
use std::path::{Path, PathBuf};

fn scenes() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/scenes/bows");
    let mut found: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    found.retain(|path| path.extension().is_some_and(|e| e == "toml"));
    found.sort();
    found
}

/// A small sphere with few wavelengths, so that a picture takes no time.
fn scene(text: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, text).unwrap();
    (folder, path)
}

/// Every scene is read to its end: with a sun below the horizon laid over it, the sun is the first
/// thing that is wrong, before any drop is computed.
#[test]
fn every_shipped_scene_parses() {
    let scenes = scenes();
    assert!(scenes.len() >= 17, "{scenes:?}");
    let folder = tempfile::tempdir().unwrap();
    for path in scenes {
        gonio()
            .arg("render")
            .arg(&path)
            .args(["--sun-elevation-deg", "-1", "-o"])
            .arg(folder.path().join("bow.png"))
            .assert()
            .code(2)
            .stderr(predicate::str::contains("sun.elevation_deg = -1"));
    }
}

/// The paper's Fig. 13: at 0.4 mm its method and Lorenz–Mie give one picture, since the drop is round.
#[test]
fn a_raindrop_of_0_4_mm_looks_like_a_sphere() {
    let folder = tempfile::tempdir().unwrap();
    let picture = |kind: &str| {
        let png = folder.path().join(format!("{kind}.png"));
        let scene = format!("{}/data/scenes/bows/size_04_{kind}.toml", env!("CARGO_MANIFEST_DIR"));
        let mut command = gonio();
        command.args(["render", &scene, "--width", "64", "--height", "36", "-o"]).arg(&png);
        command.assert().success();
        pixels(&png)
    };
    assert!(picture("raindrop") == picture("sphere"));
}

#[test]
fn a_camera_that_sees_no_sky_is_refused() {
    let text = "[camera]\nfov_deg = 20\nelevation_deg = -60\nwidth = 32\nheight = 18\n[sky]\n\
                ground = [0, 0, 0]\n[[drops]]\nradius_mm = 0.01\n";
    let (folder, path) = scene(text);
    let picture = folder.path().join("bow.png");
    gonio().arg("render").arg(&path).arg("-o").arg(&picture).assert().code(2).stderr(
        predicate::str::contains("camera").and(predicate::str::contains("view of the sky")),
    );
    assert!(!picture.exists());
}

#[test]
fn an_unknown_key_names_its_line() {
    let (folder, path) = scene("[sun]\nelevation = 20\n");
    gonio()
        .arg("render")
        .arg(&path)
        .arg("-o")
        .arg(folder.path().join("bow.png"))
        .assert()
        .code(2)
        .stderr(predicate::str::contains("elevation").and(predicate::str::contains("line 2")));
}

/// A table of the given axes, then a picture from it.
fn picture_of(wavelengths: &str, theta: (f64, f64), camera: &[&str]) -> assert_cmd::assert::Assert {
    let (folder, path) = scene(&format!(
        "[particle]\nshape = \"sphere\"\nradius_mm = 0.01\n[light]\nwavelengths_nm = {wavelengths}\n\
         [table]\ntheta_deg = {{ from = {}, to = {}, count = 41 }}\n",
        theta.0, theta.1
    ));
    let table = folder.path().join("t.h5");
    gonio().arg("table").arg(&path).arg("-o").arg(&table).assert().success();
    gonio()
        .args(["render", "--width", "32", "--height", "18", "--table"])
        .arg(&table)
        .args(camera)
        .arg("-o")
        .arg(folder.path().join("bow.png"))
        .assert()
}

/// A population in the scene of a picture, in the scene of a table that it names, and in the finished table are one.
#[test]
fn a_population_is_drawn_as_it_is_tabulated() {
    let particle = "shape = \"sphere\"\nsize_distribution = { kind = \"gamma\", effective_radius_um = 6, \
                    effective_variance = 0.1 }\n";
    let view = "[camera]\nwidth = 48\nheight = 27\n[sun]\nelevation_deg = 10\n[[drops]]\n";
    let (folder, own) = scene(&format!("{view}wavelengths = 9\ntolerance = 0.05\n{particle}"));
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write(
        "population.toml",
        &format!("[particle]\n{particle}[light]\nwavelengths_nm = [400, 500]\n"),
    );
    write(
        "named.toml",
        &format!("{view}wavelengths = 9\ntolerance = 0.05\nscene = \"population.toml\"\n"),
    );
    write("finished.toml", &format!("{view}table = \"t.h5\"\n"));
    let table = ["table", "population.toml", "-o", "t.h5", "--no-preview"];
    let grid =
        ["--wavelengths-nm", "390:710:n9", "--theta-deg", "2:180:n1781", "--azimuth-deg", "0"];
    let asked = ["--tolerance", "0.05", "--allow-unmet-tolerance"];
    gonio().current_dir(folder.path()).args(table).args(grid).args(asked).assert().success();
    let drawn = |scene: &Path| {
        let png = folder.path().join("bow.png");
        gonio().arg("render").arg(scene).arg("--overwrite").arg("-o").arg(&png).assert().success();
        pixels(&png)
    };
    let known = drawn(&folder.path().join("finished.toml"));
    assert!(known.chunks_exact(3).any(|pixel| pixel != &known[..3]));
    assert!(drawn(&own) == known);
    assert!(drawn(&folder.path().join("named.toml")) == known);
}

/// A background comes out as it is stated, where no light of the drops is added.
#[test]
fn a_background_is_as_stated() {
    let (folder, path) = scene(
        "[sky]\nbackground = [107, 114, 118]\nbrightness = 1e-9\n[camera]\nwidth = 32\nheight = 18\n\
         [[drops]]\nradius_mm = 0.01\n",
    );
    let picture = folder.path().join("bow.png");
    gonio().arg("render").arg(&path).arg("-o").arg(&picture).assert().success();
    let (words, rgb) = decoded(&std::fs::read(&picture).unwrap());
    assert!(rgb.chunks_exact(3).all(|pixel| pixel == [107, 114, 118]), "{:?}", &rgb[..3]);
    // the picture tells what it is
    let told = |name: &str| words.iter().find(|(keyword, _)| keyword == name).unwrap().1.clone();
    assert!(told("Software").starts_with("gonio "));
    assert!(told("Comment").starts_with("gonio render ") && told("Scene").contains("[sky]"));
}

/// A table of a part of the angles draws that part, and says how much of the picture it is not.
#[test]
fn what_a_table_lacks_is_said() {
    let visible = "{ from = 400, to = 700, count = 13 }";
    picture_of(visible, (120.0, 150.0), &[]).success().stderr(
        predicate::str::contains("has scattering angles that not all tables have (120 to 150°)")
            .and(predicate::str::contains("only the background is drawn there")),
    );
    picture_of(visible, (60.0, 180.0), &[]).success().stderr(predicate::str::is_empty());
}

#[test]
fn a_table_that_makes_no_picture_is_refused_clearly() {
    let few = "[500.0, 600.0]";
    picture_of(few, (90.0, 180.0), &[])
        .code(2)
        .stderr(predicate::str::contains("do not cover the visible"));
    let visible = "{ from = 400, to = 700, count = 13 }";
    picture_of(visible, (10.0, 40.0), &[])
        .code(2)
        .stderr(predicate::str::contains("none of the scattering angles seen is in a table"));
    picture_of(visible, (90.0, 180.0), &["--polariser-deg", "0"])
        .code(2)
        .stderr(predicate::str::contains("mueller"));
    picture_of(visible, (90.0, 180.0), &["--lens", "pinhole"])
        .code(2)
        .stderr(predicate::str::contains("pinhole").and(predicate::str::contains("equal-area")));
    picture_of(visible, (90.0, 180.0), &[]).success();
}

/// The corona and the glory, with the sun's disc across the axis.
#[test]
fn diagrams_reach_both_ends_of_the_axis() {
    for theta in ["0:4:0.5", "176:180:0.5"] {
        gonio()
            .args(["lee", "--json", "--radius-mm", "0.005:0.01:3", "--theta", theta])
            .assert()
            .success();
    }
}

#[test]
fn a_diagram_that_makes_no_sense_is_refused_clearly() {
    for (flags, said) in [
        (["--radius-mm", "1:0.1:5"], "--radius-mm"),
        (["--theta", "150:120:0.1"], "--theta"),
        (["--illuminant", "moon"], "moon"),
        (["--size-spread", "2"], "size_spread"),
    ] {
        gonio()
            .args(["lee", "--json"])
            .args(flags)
            .assert()
            .code(2)
            .stderr(predicate::str::contains(said));
    }
}
