//! Populations from scene to table: the program against independent truth, and what it refuses.

use crate::support;
use assert_cmd::Command;
use std::path::Path;

/// One number of the first wavelength, or of the particles, of a table.
fn number(info: &serde_json::Value, key: &str) -> f64 {
    let places = [&info["wavelengths"][0], &info["particles"], info];
    let found = places.into_iter().find_map(|place| place[key].as_f64());
    found.unwrap_or_else(|| panic!("{key} is not in {info}"))
}

/// Make a table of a scene and describe it.
fn described(folder: &Path, words: &[&str]) -> serde_json::Value {
    let table = folder.join("table.h5");
    let table = table.to_str().unwrap();
    let mut all = vec!["table", "-o", table, "--overwrite", "--no-preview"];
    all.extend(words);
    let (code, message) = support::gonio(folder, &all);
    assert_eq!(code, 0, "{message}");
    let described = Command::cargo_bin("gonio").unwrap().args(["info", table, "--json"]).output();
    serde_json::from_slice(&described.unwrap().stdout).unwrap()
}

fn scene(name: &str) -> String {
    format!("{}/data/scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

/// OPAC's polluted continental aerosol, three kinds: cross-sections and g of an independent sum
/// (tests/data/population_reference.json) to 1e-5.
#[test]
fn kinds_add_up_by_number() {
    let text = include_str!("../data/population_reference.json");
    let reference: serde_json::Value = serde_json::from_str(text).unwrap();
    let known = &reference["cases"]["opac_continental_polluted_dry"]["values"];
    let folder = tempfile::tempdir().unwrap();
    let file = scene("aerosol_continental_polluted");
    let info =
        described(folder.path(), &[&file, "--theta-deg", "0:180:181", "--tolerance", "1e-5"]);
    for (key, name, unit) in [
        ("extinction_cross_section_m2", "c_ext_um2", 1e-12),
        ("scattering_cross_section_m2", "c_sca_um2", 1e-12),
        ("asymmetry", "asymmetry", 1.0),
        ("effective_radius_um", "effective_radius_um", 1.0),
        ("effective_variance", "effective_variance", 1.0),
        ("mean_cubed_radius_um3", "mean_cubed_radius_um3", 1.0),
    ] {
        let (found, known) = (number(&info, key), unit * known[name].as_f64().unwrap());
        assert!((found / known - 1.0).abs() < 1e-5, "{key}: {found:e} {known:e}");
    }
    let per_length = 5e10 * number(&info, "extinction_cross_section_m2");
    assert!((number(&info, "extinction_per_m") / per_length - 1.0).abs() < 1e-9);
}

/// A small rain by rays at one azimuth: it adds up, scatters twice its shadow, and says how much falls.
#[test]
fn rain_makes_a_table() {
    let folder = tempfile::tempdir().unwrap();
    let file = scene("rain");
    let light = [
        "--wavelengths-nm",
        "550",
        "--azimuth-deg",
        "0",
        "--theta-deg",
        "0:180:901",
        "--sun-elevation-deg",
        "90",
    ];
    let mut words = vec![file.as_str(), "--tolerance", "0.3"];
    words.extend(light);
    let info = described(folder.path(), &words);
    assert!((number(&info, "rain_rate_mm_h") - 5.0).abs() < 1e-6);
    let q = number(&info, "extinction_cross_section_m2") / number(&info, "mean_projected_area_m2");
    assert!((1.95..2.1).contains(&q), "{q}");
    assert!((number(&info, "sum_before_peak") - 1.0).abs() < 0.04, "{info}");
    assert!((number(&info, "asymmetry") - 0.88).abs() < 0.01);
}

/// Populations that make no sense, each with its words.
#[test]
fn populations_that_make_no_sense() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    let sphere = "shape = 'sphere'\nradius_um = 1\n";
    let rain = "shape = 'raindrop'\nsize_distribution = { kind = 'marshall-palmer', rain_rate_mm_h = 5, \
                from_radius_mm = 0.1, to_radius_mm = 1 }\n";
    for (text, words) in [
        (
            format!(
                "[[particles]]\nnumber_fraction = 0.5\n{sphere}[[particles]]\nnumber_fraction = 0.4\n{sphere}"
            ),
            "they add up to 0.9",
        ),
        (format!("[[particles]]\n{sphere}"), "number_fraction is missing"),
        (
            format!("[particle]\n{sphere}[[particles]]\nnumber_fraction = 1\n{sphere}"),
            "leave out [particle]",
        ),
        (
            format!("[particle]\n{rain}canting = {{ deviation_deg = 40 }}\n"),
            "particle.canting = 40: a standard",
        ),
        (format!("[particle]\n{rain}[model]\ninterference = true\n"), "orders add as powers"),
        (format!("[particle]\n{rain}[model]\norders = [2]\n"), "all orders that matter"),
        (
            format!("[particle]\n{}", rain.replace("to_radius_mm = 1 ", "to_radius_mm = 4 ")),
            "holds for radii of",
        ),
        (format!("[particle]\n{}", rain.replace("from_radius_mm = 0.1, ", "")), "need both limits"),
        (
            format!("[particle]\n{}", rain.replace("from_radius_mm = 0.1", "from_radius_mm = 2")),
            "must be less than",
        ),
        (
            format!("[particle]\n{rain}[amount]\nrain_rate_mm_h = 5\nnumber_per_cm3 = 1\n"),
            "keep one of",
        ),
        (
            format!("[particle]\n{rain}[amount]\nrain_rate_mm_h = -5\n"),
            "amount.rain_rate_mm_h = -5",
        ),
        (
            "[particle]\nshape = 'spheroid'\naxis_ratio = 'thurai-2008'\nradius_mm = 1\n".into(),
            "did you mean \"thurai-2007\"",
        ),
    ] {
        std::fs::write(&file, format!("{text}[light]\nwavelengths_nm = [550]\n")).unwrap();
        let (code, message) = support::gonio(folder.path(), &["plan", file.to_str().unwrap()]);
        assert_eq!(code, 2, "{text}: {message}");
        assert!(message.contains(words), "{text}: {message}");
    }
}

/// Spheres by rays under the sun's disc, all angles, against the exact series with the same disc.
#[test]
fn the_disc_of_the_sun_over_many_drops() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.toml");
    std::fs::write(
        &path,
        "[particle]\nshape = 'sphere'\nmedium = { index = 1.3349 }\nsize_distribution = { kind = 'normal', \
         mean_radius_um = 87.5, deviation_um = 7, from_radius_um = 66, to_radius_um = 109 }\n[light]\n\
         wavelengths_nm = [550]\nsun_disc = 'uniform'\n[table]\ntheta_deg = { from = 0, to = 180, count = 361 }\n\
         azimuth_deg = [0]\n",
    )
    .unwrap();
    let curve = |method: &str| {
        let info = described(folder.path(), &[path.to_str().unwrap(), "--method", method]);
        let words = info["averaged_over"].to_string();
        assert!(words.contains("sun's disc (uniform)"), "{words}");
        assert!((number(&info, "sum") - 1.0).abs() < 1e-3);
        let table = gonio::hdf5::read(&folder.path().join("table.h5")).unwrap();
        let slab = table.slabs.into_iter().next().unwrap();
        (slab.values.index_axis(ndarray::Axis(0), 0).column(0).to_vec(), slab.error_by_band)
    };
    let ((rays, stated), (exact, _)) = (curve("rays"), curve("mie"));
    for (from, to, bound) in BANDS_OF_THE_DISC {
        let sum = |curve: &[f32]| -> f64 {
            (2 * from..2 * to)
                .map(|i| f64::from(curve[i]) * (i as f64 / 2.0).to_radians().sin())
                .sum()
        };
        let off = sum(&rays) / sum(&exact) - 1.0;
        println!("{from} to {to}: {:.2} %", 100.0 * off);
        assert!(off.abs() < bound, "{from} to {to}: {off}");
    }
    println!("stated by band: {stated}");
}

/// Degrees, and what rays of x = 1000 err by there.
const BANDS_OF_THE_DISC: [(usize, usize, f64); 5] =
    [(0, 3, 0.02), (3, 60, 0.01), (60, 120, 0.05), (120, 160, 0.02), (160, 180, 0.05)];
