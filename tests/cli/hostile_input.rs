//! Scenes, sweeps, media and flags that mean harm or make no sense: exit code 2, a short message that
//! names what is wrong, at once, in little memory.

use crate::support::gonio;

/// Longest message: a value of a million digits need not be repeated.
const LONGEST_MESSAGE: usize = 1500;

fn scene(key: &str, value: &str) -> String {
    let line =
        |name: &str, usual: &str| format!("{name} = {}\n", if name == key { value } else { usual });
    [
        "[particle]\nshape = \"sphere\"\n".to_string(),
        line("radius_um", "30"),
        line("medium", "\"water\""),
        "[light]\n".into(),
        line("wavelengths_nm", "[500]"),
        "[table]\n".into(),
        line("theta_deg", "{ from = 0, to = 180, count = 181 }"),
        line("azimuth_deg", "[0, 90, 180]"),
        "[model]\n".into(),
        line("tolerance", "0.01"),
        line("orders", "\"auto\""),
    ]
    .concat()
}

fn nested(open: &str, close: &str, levels: usize) -> String {
    format!("{}1{}", open.repeat(levels), close.repeat(levels))
}

#[test]
fn scenes_and_sweeps() {
    let count = |count: &str| format!("{{ from = 0, to = 180, count = {count} }}");
    let many_orders =
        format!("[{}]", (0..2000).map(|order| order.to_string()).collect::<Vec<_>>().join(", "));
    let cases: [(&str, String, &str); 24] = [
        ("deep arrays", scene("medium", &nested("[", "]", 100_000)), "recurs"),
        ("deep tables", scene("medium", &nested("{ a = ", " }", 20_000)), "recurs"),
        ("deep keys", format!("particle{} = 1\n", ".a".repeat(100_000)), "recurs"),
        ("deep headers", format!("[a{}]\n", ".a".repeat(50_000)), "recurs"),
        ("a radius out of this world", scene("radius_um", "1e300"), "radius_um = 1e300"),
        ("a radius of nothing", scene("radius_um", "1e-300"), "radius_um = 1e-300"),
        ("no radius", scene("radius_um", "nan"), "radius_um = NaN"),
        ("an endless radius", scene("radius_um", "inf"), "radius_um = inf"),
        ("a number beyond 64 bits", scene("radius_um", "99999999999999999999999"), "999999"),
        ("1e9 angles", scene("theta_deg", &count("1000000000")), "theta_deg"),
        ("1e18 angles", scene("theta_deg", &count("1000000000000000000")), "theta_deg"),
        ("-5 angles", scene("theta_deg", &count("-5")), "-5"),
        ("1e9 azimuths", scene("azimuth_deg", &count("1000000000")), "azimuth_deg"),
        ("1e12 directions", scene("azimuth_deg", &count("10000000")), "per wavelength"),
        ("1e9 wavelengths", scene("wavelengths_nm", &count("1000000000")), "wavelengths_nm"),
        ("NaN as an angle", scene("theta_deg", "{ from = nan, to = 180, count = 9 }"), "theta_deg"),
        ("a wavelength beyond all", scene("wavelengths_nm", "[1e300]"), "wavelengths_nm"),
        ("no tolerance", scene("tolerance", "nan"), "tolerance = NaN"),
        ("order 1e9", scene("orders", "[1000000000]"), "orders"),
        ("2000 orders", scene("orders", &many_orders), "orders"),
        ("an index of NaN", scene("medium", "{ index = [nan, 0] }"), "NaN"),
        ("an index that overflows", scene("medium", "{ index = [1e300, 0] }"), "1e300"),
        ("an index of next to nothing", scene("medium", "{ index = [1e-300, 0] }"), "1e-300"),
        ("absorption that overflows", scene("medium", "{ index = [1.3, 1e300] }"), "1e300"),
    ];
    let folder = tempfile::tempdir().unwrap();
    for (what, text, expected) in cases {
        std::fs::write(folder.path().join("x.toml"), text).unwrap();
        for command in [
            &["table", "x.toml", "--no-preview", "-o", "x.h5"][..],
            &["validate", "x.toml"],
            &["batch", "plan", "x.toml", "-o", "x.jsonl"],
        ] {
            let (code, message) = gonio(folder.path(), command);
            assert_eq!(code, 2, "{what}, {command:?}: {message}");
            assert!(message.contains(expected), "{what}, {command:?}: {message}");
            assert!(message.len() < LONGEST_MESSAGE, "{what}: {} bytes", message.len());
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "{what}");
    }
}

#[test]
fn sweeps_without_end() {
    let folder = tempfile::tempdir().unwrap();
    for (radius, expected) in [
        ("{ from = 1, to = 2, count = 1000000000 }", "particle.radius_um"),
        ("{ from = 1, to = 2, step = 1e-300 }", "particle.radius_um"),
        ("{ from = 1, to = 2, step = nan }", "particle.radius_um"),
        ("{ from = 1, to = inf, count = 3 }", "particle.radius_um"),
        ("[1, 2, nan]", "radius_um = NaN"),
    ] {
        std::fs::write(folder.path().join("x.toml"), scene("radius_um", radius)).unwrap();
        let (code, message) = gonio(folder.path(), &["batch", "plan", "x.toml", "-o", "x.jsonl"]);
        assert_eq!(code, 2, "{radius}: {message}");
        assert!(message.contains(expected), "{radius}: {message}");
        assert!(!folder.path().join("x.jsonl").exists());
    }
}

#[test]
fn media() {
    let table = |rows: &str| format!("DATA:\n  - type: tabulated nk\n    data: |\n{rows}");
    let cases = [
        ("deep.yml", format!("DATA: {}", nested("[", "]", 100_000)), "recursion limit"),
        (
            "deep_maps.yml",
            format!("DATA: {}", nested("{ a: ", " }", 50_000)),
            "deeper than 32 levels",
        ),
        ("bomb.yml", "a: &a [x, x]\nb: &b [*a, *a]\nDATA: *b\n".into(), "aliases"),
        ("nan.yml", table("      0.4 nan 0.1\n      0.6 1.4 0.2\n"), "line 4: \"nan\""),
        ("huge.yml", table("      0.4 1e300 0\n      0.6 1e308 0\n"), "1e-4 to 1e4"),
        ("binary.yml", "\u{0}\u{1}\u{7f}".into(), "binary.yml"),
        ("huge.csv", "wavelength_nm,n,k\n400,1e300,0\n600,1e308,0\n".into(), "1e-4 to 1e4"),
        ("inf.csv", "wavelength_nm,n,k\n400,inf,0\n600,1.3,0\n".into(), "line 2"),
    ];
    let folder = tempfile::tempdir().unwrap();
    for (name, text, expected) in cases {
        std::fs::write(folder.path().join(name), text).unwrap();
        let (code, message) = gonio(folder.path(), &["material", name, "--wavelength-nm", "500"]);
        assert_eq!(code, 2, "{name}: {message}");
        assert!(message.contains(expected), "{name}: {message}");
        assert!(message.len() < LONGEST_MESSAGE, "{name}: {} bytes", message.len());
    }
}

/// Files without end, and what is no file.
#[cfg(target_os = "linux")]
#[test]
fn devices() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe.h5");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.unwrap().success());
    for (arguments, expected) in [
        (&["batch", "plan", "/dev/zero", "-o", "p"][..], "/dev/zero: larger than 4 MiB"),
        (&["plan", "/dev/zero"], "larger than 4 MiB"),
        (&["batch", "status", "--plan", "/dev/zero"], "line 1: longer than"),
        (&["info", "/dev/zero"], "no regular file"),
        (&["validate", "pipe.h5"], "no regular file"),
        (&["table", "--threads", "60000", "-o", "t.h5"], "1..=1024"),
        (
            &[
                "scatter",
                "--method",
                "rays",
                "--size-parameter",
                "1000",
                "--index",
                "1e300",
                "--theta",
                "1",
            ],
            "1e-4 to 1e4",
        ),
    ] {
        let (code, message) = gonio(folder.path(), arguments);
        assert_eq!(code, 2, "{arguments:?}: {message}");
        assert!(message.contains(expected), "{arguments:?}: {message}");
    }
}

/// Memory is estimated first; a limit that is given counts in place of what is free.
#[test]
fn memory_is_limited() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("x.toml"),
        scene("radius_um", "[5, 6]").replace("[0, 90, 180]", "[0]"),
    )
    .unwrap();
    let (code, message) = gonio(folder.path(), &["batch", "plan", "x.toml", "-o", "p.jsonl"]);
    assert_eq!(code, 0, "{message}");
    let run = ["batch", "run", "--plan", "p.jsonl", "--memory-limit"];
    let (code, message) = gonio(folder.path(), &[&run[..], &["0.01"]].concat());
    assert_eq!(code, 2, "{message}");
    assert!(
        message.contains("the limit is 10.2 MiB") && message.contains("--memory-limit"),
        "{message}"
    );
    let (code, message) = gonio(folder.path(), &[&run[..], &["0.5"]].concat());
    assert_eq!(code, 0, "{message}");
    let table = ["table", "--radius-mm", "0.1", "--no-preview", "-o", "t.h5", "--memory-limit"];
    let (code, message) = gonio(folder.path(), &[&table[..], &["0.01"]].concat());
    assert_eq!(code, 2, "{message}");
    assert!(message.contains("table.theta_deg") && message.contains("10.2 MiB"), "{message}");
    let (code, message) = gonio(folder.path(), &[&table[..], &["nan"]].concat());
    assert_eq!(code, 2, "{message}");
    assert!(message.contains("GiB"), "{message}");
}
