//! Bad input from a user's side: the message, the exit code, and nothing half-written.
#![cfg(all(feature = "cli", feature = "hdf5"))]

use assert_cmd::Command;
use std::path::Path;

fn gonio(arguments: &[&str]) -> (i32, String) {
    let output = Command::cargo_bin("gonio").unwrap().args(arguments).output().unwrap();
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    (output.status.code().unwrap_or(-1), text)
}

fn files_in(folder: &Path) -> usize {
    std::fs::read_dir(folder).unwrap().count()
}

/// A scene file with one wrong value: exit code 2, the key named, no file left.
#[test]
fn wrong_scenes_are_refused() {
    let cases = [
        ("[particle]\nshape = \"sphere\"\nradius_mm = -1\n", "radius_mm"),
        ("[particle]\nshape = \"sphere\"\nradius_m = 1\n", "radius_m"),
        ("[particle]\nshape = \"raindrop\"\nradius_mm = 9\n", "radius_mm"),
        (
            "[particle]\nshape = \"sphere\"\nradius_mm = 0.1\nmedium = { index = [1.3, -0.1] }\n",
            "medium",
        ),
        (
            "[particle]\nshape = \"sphere\"\nradius_mm = 0.1\n[light]\nwavelengths_nm = []\n",
            "wavelengths_nm",
        ),
        ("[particle]\nshape = \"sphere\"\nradius_mm = nan\n", "radius_mm"),
        ("[particle\n", "line"),
    ];
    for (text, word) in cases {
        let folder = tempfile::tempdir().unwrap();
        let scene = folder.path().join("scene.toml");
        std::fs::write(&scene, text).unwrap();
        let out = folder.path().join("out.h5");
        let (code, message) =
            gonio(&["table", scene.to_str().unwrap(), "-o", out.to_str().unwrap()]);
        assert_eq!(code, 2, "{text}: {message}");
        assert!(message.contains(word), "{text}: {message}");
        assert_eq!(files_in(folder.path()), 1, "{text}");
    }
}

const SMALL: [&str; 8] = [
    "--wavelengths-nm",
    "600",
    "--theta-deg",
    "0:180:181",
    "--azimuth-deg",
    "0:360:13",
    "--no-preview",
    "--radius-mm=0.1",
];

/// An output that exists, or cannot be written, is told before anything is computed.
#[test]
fn outputs_are_checked_first() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out.h5");
    let mut arguments = vec!["table", "-o", out.to_str().unwrap()];
    arguments.extend(SMALL);
    let (code, message) = gonio(&arguments);
    assert_eq!(code, 0, "{message}");
    let before = std::fs::read(&out).unwrap();
    let (code, message) = gonio(&arguments);
    assert_eq!(code, 2, "{message}");
    assert!(message.contains("exists"), "{message}");
    assert_eq!(std::fs::read(&out).unwrap(), before);
    arguments[2] = "/no/such/folder/out.h5";
    let (code, message) = gonio(&arguments);
    assert!(code == 1 || code == 2, "{message}");
    assert_eq!(files_in(folder.path()), 1);
}

#[test]
fn scatter_words_are_checked() {
    for (words, told) in [
        ("--method mie --size-parameter -1 --theta 10", "size-parameter"),
        ("--method rays --size-parameter 1e300 --index 1.33 --theta 10", "accepted from 1 to 1e9"),
        ("--method rays --size-parameter 0.01 --index 1.33 --theta 10", "use --method mie"),
        ("--method mie --size-parameter 10 --index 1.3-0.1 --theta 10", "index"),
        ("--method mie --size-parameter 10 --index 1.3 --theta 200", "theta"),
        ("--method mie --shape raindrop --size-parameter 10 --index 1.3 --theta 20", "sphere"),
    ] {
        let arguments: Vec<&str> = ["scatter"].into_iter().chain(words.split(' ')).collect();
        let (code, message) = gonio(&arguments);
        assert_eq!(code, 2, "{words}: {message}");
        assert!(message.contains(told), "{words}: {message}");
    }
}
