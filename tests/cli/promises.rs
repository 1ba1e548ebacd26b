//! What is typed is what is done, or it is said why not: endings, folders, kinds of scenes, units, ranges.

use crate::support::gonio;
use assert_cmd::Command;
use std::path::Path;

/// Standard output of the program, which must succeed.
fn printed(folder: &Path, arguments: &[&str]) -> String {
    let output = Command::cargo_bin("gonio").unwrap().args(arguments).current_dir(folder).output();
    let output = output.unwrap();
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// A picture of one kind is not written under the name of another; a folder that is not there is named, and nothing is
/// computed first.
#[test]
fn names_of_files_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/data/scenes/bows/double.toml");
    for (arguments, told) in [
        (vec!["render", scene, "-o", "x.jpg"], "a PNG is written; give it the ending .png"),
        (vec!["render", scene, "-o", "none/x.png"], "there is no folder none"),
        (vec!["render", scene, "-o", "."], "--output"),
        (vec!["lee", "-o", "x.svg"], "a PNG is written"),
        (vec!["lee", "-o", "none/x.png"], "there is no folder none"),
        (vec!["lee", "--data", "none/x.h5"], "--data = none/x.h5: there is no folder none"),
        (vec!["rays", "-o", "x.png"], "an SVG is written; give it the ending .svg"),
        (vec!["table", "-o", "none/x.h5"], "there is no folder none"),
        (vec!["compare", "-o", "none/x.html"], "there is no folder none"),
        (vec!["bench", "-o", "x.pdf"], "give it the ending .png or .svg"),
        (
            vec!["radar", "--band", "X", "--diameter-mm", "1", "-o", "none/x.csv"],
            "there is no folder none",
        ),
    ] {
        let (code, message) = gonio(folder.path(), &arguments);
        assert_eq!(code, 2, "{arguments:?}: {message}");
        assert!(message.contains(told), "{arguments:?}: {message}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

/// Pictures are replaced only where that is asked for.
#[test]
fn pictures_are_not_replaced_unasked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bow.png");
    std::fs::write(&path, "mine").unwrap();
    std::fs::write(folder.path().join("s.toml"), "[[drops]]\nradius_mm = 0.01\n").unwrap();
    let render = ["render", "s.toml", "--width", "32", "--height", "18", "-o", "bow.png"];
    let lee = [
        "lee",
        "--radius-mm",
        "0.01:0.01:1",
        "--theta",
        "138:142:1",
        "--fineness",
        "0.3",
        "-o",
        "bow.png",
    ];
    for arguments in [&render[..], &lee[..]] {
        let (code, message) = gonio(folder.path(), arguments);
        assert!(
            code == 2 && message.contains("exists") && message.contains("--overwrite"),
            "{message}"
        );
        assert_eq!(std::fs::read(&path).unwrap(), b"mine");
    }
    let shown =
        printed(folder.path(), &[&render[..], &["--overwrite", "--lens", "fisheye"]].concat());
    assert!(shown.contains("bow.png: 32 × 18 pixels"), "{shown}");
    assert_eq!(std::fs::read(&path).unwrap()[1..4], *b"PNG");
}

/// Scenes of tables and of pictures are told apart.
#[test]
fn scenes_are_sent_to_their_command() {
    let folder = tempfile::tempdir().unwrap();
    let shipped = |name: &str| format!("{}/data/scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let (bow, drop) = (shipped("bows/double"), shipped("raindrop"));
    for (arguments, told) in [
        (vec!["table", &bow, "-o", "x.h5"], "scene of a picture, which `gonio render` draws"),
        (vec!["validate", &bow], "scene of a picture, which `gonio render` draws"),
        (vec!["render", &drop, "-o", "x.png"], "scene of a table, which `gonio table` computes"),
    ] {
        let (code, message) = gonio(folder.path(), &arguments);
        assert_eq!(code, 2, "{arguments:?}: {message}");
        assert!(message.contains(told), "{arguments:?}: {message}");
    }
}

/// A flag without its unit is answered with all that have one.
#[test]
fn units_are_named() {
    let here = Path::new(".");
    for (arguments, flags) in [
        (vec!["scatter", "--radius", "0.5"], vec!["--radius-um"]),
        (vec!["table", "--radius", "0.5"], vec!["--radius-mm", "--radius-um"]),
        (vec!["radar", "--frequency", "10"], vec!["--frequency-ghz"]),
        (vec!["table", "--sun-elevation=10"], vec!["--sun-elevation-deg"]),
    ] {
        let (code, message) = gonio(here, &arguments);
        assert_eq!(code, 2, "{message}");
        for flag in flags {
            assert!(message.contains(flag), "{arguments:?}: {message}");
        }
    }
    // a slip of another kind has clap's own answer
    let (_, message) = gonio(here, &["table", "--radios-mm", "0.5"]);
    assert!(message.contains("'--radius-mm'") && !message.contains("--radius-um"), "{message}");
}

/// One grammar of ranges: a letter says whether the third number counts or steps.
#[test]
fn ranges_are_the_same_everywhere() {
    let here = Path::new(".");
    let scatter = [
        "scatter",
        "--method",
        "mie",
        "--size-parameter",
        "3",
        "--index",
        "1.33",
        "--json",
        "--theta",
    ];
    let angles = |range: &str| {
        let text = printed(here, &[&scatter[..], &[range]].concat());
        serde_json::from_str::<serde_json::Value>(&text).unwrap()["theta_deg"].clone()
    };
    assert_eq!(angles("0:180:45"), angles("0:180:n5"));
    assert_eq!(angles("0:180:s45"), angles("0:180:45"));
    let material = |range: &str| printed(here, &["material", "water", "--wavelength-nm", range]);
    assert_eq!(material("400:700:100"), material("400:700:n4"));
    let radar = |range: &str| {
        printed(here, &["radar", "--band", "X", "--shape", "sphere", "--diameter-mm", range])
    };
    assert_eq!(radar("1:2:3"), radar("1:2:s0.5"));
    let folder = tempfile::tempdir().unwrap();
    let scene = "[particle]\nshape = \"sphere\"\nradius_um = 1\n[light]\nwavelengths_nm = [500]\n\
                 [table]\nazimuth_deg = [0]\ntheta_deg = { from = 0, to = 180, step = 60 }\n";
    std::fs::write(folder.path().join("s.toml"), scene).unwrap();
    let wrong = scene.replace("step = 60", "step = 60, count = 4");
    std::fs::write(folder.path().join("wrong.toml"), wrong).unwrap();
    for (name, more) in [("step", &[][..]), ("typed", &["--theta-deg", "0:180:s60"][..])] {
        let file = format!("{name}.h5");
        printed(folder.path(), &[&["table", "s.toml", "--no-preview", "-o", &file], more].concat());
        let table = gonio::hdf5::read(&folder.path().join(&file)).unwrap();
        assert_eq!(table.header.axes.theta.len(), 4);
    }
    let (code, message) = gonio(folder.path(), &["table", "wrong.toml", "-o", "x.h5"]);
    assert!(code == 2 && message.contains("one of `count` and `step`"), "{message}");
}

/// What ships with the program is listed, and printed with every key; and it is a scene.
#[test]
fn shipped_scenes_can_be_started_from() {
    let folder = tempfile::tempdir().unwrap();
    let list = printed(folder.path(), &["scenes"]);
    for word in ["Scenes of tables", "raindrop", "Scenes of pictures", "supernumerary"] {
        assert!(list.contains(word), "{list}");
    }
    let json: serde_json::Value =
        serde_json::from_str(&printed(folder.path(), &["scenes", "--json"])).unwrap();
    assert!(json.as_array().unwrap().len() > 30);
    for (name, key) in
        [("raindrop", "# coating = …"), ("rain", "# [particle]"), ("double", "# polariser_deg")]
    {
        let text = printed(folder.path(), &["scene", "--example", name]);
        assert_eq!(text.contains(key), name != "rain", "{text}");
        std::fs::write(folder.path().join(format!("{name}.toml")), text).unwrap();
    }
    printed(folder.path(), &["validate", "raindrop.toml"]);
    let small = [
        "render",
        "double.toml",
        "--width",
        "32",
        "--height",
        "18",
        "-o",
        "x.png",
        "--sun-elevation-deg",
        "-1",
    ];
    let (code, message) = gonio(folder.path(), &small);
    assert!(code == 2 && message.contains("sun.elevation_deg = -1"), "{message}");
    let (code, message) = gonio(folder.path(), &["scene", "--example", "raindrops"]);
    assert!(code == 2 && message.contains("raindrop, rain"), "{message}");
}

/// `--quiet` leaves errors alone, `--verbose` tells the steps.
#[test]
fn as_much_is_said_as_is_asked() {
    let folder = tempfile::tempdir().unwrap();
    let note = [
        "scatter",
        "--method",
        "rays",
        "--size-parameter",
        "100",
        "--index",
        "1.04",
        "--theta",
        "90",
    ];
    let (code, usual) = gonio(folder.path(), &note);
    assert!(code == 0 && usual.contains("note: "), "{usual}");
    assert_eq!(gonio(folder.path(), &[&note[..], &["--quiet"]].concat()), (0, String::new()));
    let (code, message) = gonio(folder.path(), &["-q", "scene", "--example", "none"]);
    assert!(code == 2 && message.contains("--example none"), "{message}");
    let table = [
        "table",
        "-v",
        "--shape",
        "sphere",
        "--radius-um",
        "1",
        "--wavelengths-nm",
        "500",
        "--theta-deg",
        "0:180:19",
        "--azimuth-deg",
        "0",
        "--method",
        "mie",
        "-o",
        "t.h5",
    ];
    let (code, message) = gonio(folder.path(), &table);
    assert_eq!(code, 0, "{message}");
    for step in ["19 scattering angles", "500.000 nm", "wrote t.h5", "wrote t.png"] {
        assert!(message.contains(step), "{message}");
    }
    assert_eq!(gonio(folder.path(), &["-q", "-v", "scenes"]).0, 2);
}
