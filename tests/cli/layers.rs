//! Layers, profiles, films and surroundings from a user's side: `gonio scatter`, scene files, and what
//! is refused with which words.

use assert_cmd::Command;
use gonio::scene::{Scene, SceneText};
use gonio::series::lorenz_mie::Sphere;
use gonio::simulate;
use num_complex::Complex64;
use serde_json::Value;
use std::path::Path;

fn gonio(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output =
        Command::cargo_bin("gonio").unwrap().current_dir(folder).args(arguments).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code().unwrap_or(-1), text(&output.stdout), text(&output.stderr))
}

fn scatter(arguments: &[&str]) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let all: Vec<&str> = ["scatter", "--theta", "0,90,180", "--json"]
        .into_iter()
        .chain(arguments.iter().copied())
        .collect();
    let (code, out, error) = gonio(folder.path(), &all);
    assert_eq!(code, 0, "{error}");
    serde_json::from_str(&out).unwrap()
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap()
}

/// Polystyrene of 1 µm diameter in water at 632.8 nm: x in the medium, m relative, as any program
/// for Lorenz–Mie agrees on.
#[test]
fn hydrosols_and_bubbles() {
    let sphere = ["--method", "mie", "--radius-um", "0.5", "--wavelength-nm", "632.8"];
    let at = |more: &[&str]| scatter(&[&sphere[..], more].concat());
    let answer = at(&["--index", "1.587", "--outside", "1.3317"]);
    let x = std::f64::consts::TAU * 0.5 * 1.3317 / 0.6328;
    assert!((number(&answer, "size_parameter") - x).abs() < 1e-9);
    assert!((answer["relative_index"][0].as_f64().unwrap() - 1.587 / 1.3317).abs() < 1e-12);
    assert!((answer["index"][0].as_f64().unwrap() - 1.587).abs() < 1e-12);
    let alone = Sphere::new(x, Complex64::new(1.587 / 1.3317, 0.0)).unwrap().efficiencies();
    assert!((number(&answer, "q_ext") - alone.q_ext).abs() < 1e-9);
    // By names from the library.
    let named = at(&["--medium", "polystyrene", "--outside", "water"]);
    assert!((number(&named, "q_ext") / alone.q_ext - 1.0).abs() < 0.02, "{named}");

    // An air bubble of 10 µm radius in water at 650 nm, against the textbook's recurrences (Bohren &
    // Huffman 1983, app. A, in double precision), and by rays.
    let bubble = ["--radius-um", "10", "--wavelength-nm", "650", "--index", "1"];
    let bubble = [&bubble[..], &["--outside", "1.33167"]].concat();
    let exact = scatter(&[&["--method", "mie"][..], &bubble].concat());
    assert!((number(&exact, "q_ext") - 1.967_060_831).abs() < 5e-9, "{exact}");
    let rays = scatter(&[&["--method", "rays"][..], &bubble].concat());
    assert!((number(&rays, "q_ext") / 1.967_060_831 - 1.0).abs() < 0.01, "{rays}");
    assert_eq!(rays["relative_index"], exact["relative_index"]);
    let water = ["--method", "mie", "--radius-um", "10", "--wavelength-nm", "650"];
    let bubble = scatter(&[&water[..], &["--index", "1", "--outside", "water"]].concat());
    let n = 1.0 / bubble["relative_index"][0].as_f64().unwrap();
    assert!((n - 1.33167).abs() < 1e-4, "{n}");
    let x = std::f64::consts::TAU * 10.0 * n / 0.65;
    assert!((number(&bubble, "size_parameter") / x - 1.0).abs() < 1e-12);
}

/// A sphere in vacuum and one in a medium of index 1 are the same.
#[test]
fn surroundings_of_index_one_change_nothing() {
    let sphere =
        ["--method", "debye", "--radius-um", "10", "--wavelength-nm", "500", "--medium", "ice"];
    let (vacuum, one) = (scatter(&sphere), scatter(&[&sphere[..], &["--outside", "1"]].concat()));
    for key in ["s1", "s2", "q_ext", "size_parameter", "index"] {
        assert_eq!(vacuum[key], one[key], "{key}");
    }
}

/// A film is a layer; a film of the particle's own medium is no film.
#[test]
fn films_are_layers() {
    let sphere = ["--method", "mie", "--radius-um", "5", "--wavelength-nm", "500"];
    let film = scatter(
        &[
            &sphere[..],
            &["--index", "1.333", "--coating", "[{ medium = 1.47, thickness_nm = 50 }]"],
        ]
        .concat(),
    );
    let layers = "{ layers = [ { radius_fraction = 0.99, medium = 1.333 }, { medium = 1.47 } ] }";
    let layers = scatter(&[&sphere[..], &["--medium", layers]].concat());
    let own = scatter(
        &[&sphere[..], &["--index", "1.47", "--coating", "[{ medium = 1.47, thickness_nm = 50 }]"]]
            .concat(),
    );
    let bare = scatter(&[&sphere[..], &["--index", "1.47"]].concat());
    assert!((number(&film, "q_ext") - number(&layers, "q_ext")).abs() < 1e-9);
    assert!((number(&own, "q_ext") - number(&bare, "q_ext")).abs() < 1e-11);
    assert!((number(&film, "q_back") / number(&bare, "q_back") - 1.0).abs() > 0.1);
}

/// Converged digits through the command line, with the defaults.
#[test]
fn luneburg_lens_from_the_command_line() {
    let lens = "{ profile = \"luneburg\", c = 2.0 }";
    let answer = scatter(&["--method", "mie", "--size-parameter", "100", "--medium", lens]);
    assert!((number(&answer, "q_ext") - 1.96265520).abs() < 1e-8, "{answer}");
    assert!((answer["s1"][1][0].as_f64().unwrap() - 5.47193).abs() < 6e-6);
    // A gradient from 20 °C to 20 °C is water.
    let sphere = ["--method", "mie", "--radius-um", "8", "--wavelength-nm", "600"];
    let gradient = "{ core = \"temperature\", centre_c = 20, surface_c = 20 }";
    let gradient = scatter(&[&sphere[..], &["--medium", gradient]].concat());
    let water = scatter(&[&sphere[..], &["--medium", "water"]].concat());
    assert!((number(&gradient, "q_ext") - number(&water, "q_ext")).abs() < 1e-8);
}

/// Tables by scene files: `auto` takes the exact series, P sums to 1, a distribution of sizes too.
#[test]
fn tables_of_radial_media() {
    let table = |particle: &str| {
        let text = format!(
            "[particle]\nshape = \"sphere\"\n{particle}\n[light]\nwavelengths_nm = [500, 600]\n\
             [table]\ntheta_deg = {{ from = 0, to = 180, count = 721 }}\n\
             azimuth_deg = {{ from = 0, to = 0, count = 1 }}\n[model]\ntolerance = 0.02\n"
        );
        let scene =
            Scene::from_text(SceneText::parse("test", text).unwrap(), &Default::default()).unwrap();
        simulate::table(&scene).unwrap()
    };
    for particle in [
        "radius_um = 3\nmedium = { layers = [ { radius_fraction = 0.5, medium = \"gold\" }, \
         { medium = \"water\" } ] }",
        "radius_um = 3\nmedium = { profile = \"fish-eye\" }\noutside = 1.05",
        "radius_um = 3\nmedium = \"water\"\ncoating = [ { medium = \"ethanol\", thickness_nm = 80 } ]",
        "size_distribution = { kind = \"gamma\", effective_radius_um = 1.5, \
         effective_variance = 0.05, from_radius_um = 0.1 }\nmedium = \"water\"\n\
         coating = [ { medium = \"soot-diesel\", thickness_nm = 20 } ]",
    ] {
        let table = table(particle);
        for slab in &table.slabs {
            let axes = gonio::phase_table::Axes {
                wavelength: vec![slab.wavelength],
                ..table.header.axes.clone()
            };
            let sum = slab.sum(&axes);
            assert!((sum - 1.0).abs() < 2e-3, "{particle}: {sum}");
            let absorbed = slab.extinction_cross_section - slab.scattering_cross_section;
            let absorbing = particle.contains("gold") || particle.contains("soot");
            assert!(
                absorbed >= 0.0 && (!absorbing || absorbed > 0.02 * slab.extinction_cross_section)
            );
        }
        assert!((table.slabs[1].wavelength - 600e-9).abs() < 1e-15);
    }
}

/// What is refused names the field, the value and what is accepted; exit code 2.
#[test]
fn refusals_in_words() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("bad.csv"), "r,n\n0,1.4\n0.7,1.3\n0.6,1.2\n1,1.1\n").unwrap();
    let cases: [(&str, &str, &str); 11] = [
        ("--medium", "{ profile = \"luneburg\", c = 0.9 }", "n above 0"),
        ("--medium", "{ profile = \"luneburg\" }", "needs c"),
        ("--medium", "{ profile = \"lens\" }", "luneburg, fish-eye, gaussian"),
        ("--medium", "{ profile = \"fish-eye\", c = 2 }", "does not go with profile"),
        ("--medium", "{ profile = \"table\", file = \"bad.csv\" }", "r = 0.6 follows 0.7"),
        ("--medium", "{ profile = \"inverse\", k = 1.5 }", "no regular solution"),
        ("--medium", "{ layers = [ { radius_fraction = 0.8, medium = \"water\" } ] }", "surface"),
        ("--medium", "{ core = \"temperature\", centre_c = 500, surface_c = 20 }", "temperature_c"),
        ("--coating", "[{ medium = \"water\", thickness_nm = 2e4 }]", "thinner than the radius"),
        ("--coating", "[{ medium = \"water\" }]", "thickness_nm"),
        ("--outside", "{ index = [1.33, 0.01] }", "surroundings may take at most"),
    ];
    for (flag, value, message) in cases {
        let arguments = [
            "scatter",
            "--method",
            "mie",
            "--radius-um",
            "10",
            "--wavelength-nm",
            "600",
            "--theta",
            "90",
            flag,
            value,
        ];
        let (code, out, error) = gonio(folder.path(), &arguments);
        assert_eq!(code, 2, "{value}: {error}");
        assert!(error.contains(message) && out.is_empty(), "{value}: {error}");
    }
    // Rays and other shapes say that they follow one index.
    for (method, shape) in [("rays", "sphere"), ("debye", "sphere"), ("rays", "raindrop")] {
        let arguments = [
            "scatter",
            "--method",
            method,
            "--shape",
            shape,
            "--radius-um",
            "500",
            "--wavelength-nm",
            "600",
            "--theta",
            "90",
            "--medium",
            "{ profile = \"fish-eye\" }",
        ];
        let (code, _, error) = gonio(folder.path(), &arguments);
        assert!(code == 2 && error.contains("one index"), "{method} {shape}: {error}");
    }
}

/// Rays in profiles: the lens of Luneburg focuses at θ = asin b, a gradient moves the bow, spirals say
/// where they end.
#[test]
fn rays_in_profiles() {
    let folder = tempfile::tempdir().unwrap();
    let rays = |medium: &str, order: &str| -> Value {
        let arguments = ["rays", "--medium", medium, "--order", order, "--count", "9", "--json"];
        let (code, out, error) = gonio(folder.path(), &arguments);
        assert_eq!(code, 0, "{error}");
        serde_json::from_str(&out).unwrap()
    };
    let lens = rays("{ profile = \"luneburg\", c = 2.0 }", "1");
    for ray in lens["rays"].as_array().unwrap() {
        let (b, theta) = (number(ray, "impact"), number(ray, "deviation_deg").to_radians());
        // the outermost rays turn a hair below the surface, where n r hardly changes
        let bound = if b.abs() > 0.99 { 2e-7 } else { 1e-9 };
        assert!((theta - b.abs().asin()).abs() < bound, "{ray}");
        let path = 0.5 * std::f64::consts::PI - (1.0 - b * b).sqrt();
        assert!((number(ray, "optical_path") - path).abs() < bound, "{ray}");
    }
    let drop = "{ profile = \"polynomial\", coefficients = [1.334, -1e-3] }";
    for (order, theta) in [("2", 138.09144), ("3", 128.85131)] {
        let bows = rays(drop, order)["rainbows"].clone();
        assert_eq!(bows.as_array().unwrap().len(), 2, "{bows}");
        assert!((number(&bows[1], "deviation_deg") - theta).abs() < 1e-4, "{bows}");
    }
    let spiral = rays("{ profile = \"inverse\", k = 1.5 }", "1");
    assert!(spiral["rays"].as_array().unwrap().iter().all(|ray| ray["fate"] == "centre"));
}
