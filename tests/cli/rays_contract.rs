//! What rays promise: extinction from the whole amplitude straight ahead, refusals where the phase shift
//! is too small, the published method normalised like Lorenz–Mie, memory that was announced.

use assert_cmd::Command;
use gonio::scene::{Scene, SceneFile, SceneText};
use gonio::simulate;
use serde_json::Value;

fn gonio(line: &str) -> Command {
    let mut command = Command::cargo_bin("gonio").unwrap();
    command.args(line.split_whitespace());
    command
}

fn scatter(line: &str) -> Value {
    let output = gonio(&format!("scatter --json {line}")).assert().success().get_output().clone();
    serde_json::from_slice(&output.stdout).unwrap()
}

/// `2/x² Re(S1 + S2)` of the first direction.
fn theorem(answer: &Value) -> f64 {
    let x = answer["size_parameter"].as_f64().unwrap();
    let re = |name: &str| answer[name][0][0].as_f64().unwrap();
    2.0 / (x * x) * (re("s1") + re("s2"))
}

fn scene(text: &str) -> Scene {
    let text = SceneText::parse("contract", text.to_string()).unwrap();
    Scene::from_text(text, &SceneFile::default()).unwrap()
}

/// Partial waves, meridians, beams, patches; axis ratios, suns, azimuths.
#[test]
fn extinction_is_what_the_wave_straight_ahead_lacks() {
    for line in [
        "--shape sphere --size-parameter 25 --index 1.333",
        "--shape sphere --size-parameter 4000 --index 0.75",
        "--shape spheroid --axis-ratio 0.999 --size-parameter 20 --index 1.333",
        "--shape spheroid --axis-ratio 0.9 --size-parameter 60 --index 1.5 --azimuth-deg 70",
        "--shape spheroid --axis-ratio 1.2 --size-parameter 150 --index 1.333 --sun-elevation-deg 40",
        "--shape spheroid --axis-ratio 0.8 --size-parameter 700 --index 1.333 --sun-elevation-deg 20",
        "--shape spheroid --axis-ratio 0.8 --size-parameter 700 --index 1.333 --tolerance 0.05",
        "--shape spheroid --axis-ratio 0.7 --size-parameter 5000 --index 1.333+0.0001 --azimuth-deg 33",
        "--shape spheroid --axis-ratio 0.6 --size-parameter 2000 --index 1.333 --sun-elevation-deg 90",
        "--shape raindrop --radius-um 1000 --size-parameter 3000 --index 1.333 --sun-elevation-deg 20",
    ] {
        let answer = scatter(&format!("--method rays --theta 0 {line}"));
        let (found, expected) = (answer["q_ext"].as_f64().unwrap(), theorem(&answer));
        println!("{line}: q_ext {found:.5}, theorem {expected:.5}");
        assert!((found / expected - 1.0).abs() < 3e-4, "{line}: {found} {expected}");
    }
}

/// The same number in tables; it was 10 % off when orders of small particles were left out.
#[test]
fn tables_have_the_extinction_of_single_directions() {
    for (ratio, x, sun) in [(0.999, 40.0, 0.0), (0.9, 60.0, 20.0), (0.85, 900.0, 20.0)] {
        let radius = x * 0.65 / std::f64::consts::TAU;
        let table = simulate::table(&scene(&format!(
            "[particle]\nshape = \"spheroid\"\naxis_ratio = {ratio}\nradius_um = {radius}\n\
             medium = {{ index = [1.333, 0.0] }}\n[light]\nsun_elevation_deg = {sun}\n\
             wavelengths_nm = [650]\n[table]\ntheta_deg = {{ from = 0, to = 180, count = 91 }}\n\
             azimuth_deg = [0, 90, 180]\n[model]\nmethod = \"rays\"\n"
        )))
        .unwrap();
        let q_table = table.slabs[0].extinction_cross_section * 1e12
            / (std::f64::consts::PI * radius * radius);
        let answer = scatter(&format!(
            "--method rays --shape spheroid --axis-ratio {ratio} --size-parameter {x} --index 1.333 \
             --sun-elevation-deg {sun} --theta 0"
        ));
        println!(
            "axis ratio {ratio}, x = {x}: table {q_table:.5}, theorem {:.5}",
            theorem(&answer)
        );
        assert!((q_table / theorem(&answer) - 1.0).abs() < 3e-4);
    }
}

/// The T-matrix of spheroids that are nearly spheres (scatrs 0.3; two sizes, two axis ratios).
#[test]
fn small_spheroids_have_the_extinction_of_the_t_matrix() {
    for (ratio, x, exact, bound) in [
        (0.999, 20.0, 2.0998, 0.03),
        (0.999, 40.0, 1.9584, 0.005),
        (1.0 / 1.01, 40.0, 1.9626, 0.01),
    ] {
        let answer = scatter(&format!(
            "--method rays --shape spheroid --axis-ratio {ratio} --size-parameter {x} --index 1.333 --theta 0"
        ));
        let found = answer["q_ext"].as_f64().unwrap();
        println!("axis ratio {ratio}, x = {x}: {found:.4}, T-matrix {exact}");
        assert!((found / exact - 1.0).abs() < bound);
    }
}

#[test]
fn soft_particles_are_refused_by_both_commands_alike() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("soft.h5");
    for (index, x, refused) in [
        (1.0, 100.0, true),
        (1.001, 100.0, true),
        (1.002, 228.0, true),
        (0.99, 200.0, true),
        (1.02, 124.0, true),
        (1.02, 126.0, false),
        (1.1, 26.0, false),
    ] {
        let radius = x * 0.55 / std::f64::consts::TAU;
        let table = gonio(&format!(
            "table --shape spheroid --axis-ratio 0.99 --radius-um {radius} --index {index} \
             --wavelengths-nm 550 --theta-deg 0:180:19 --azimuth-deg 0,90,180 --method rays \
             --no-preview --overwrite -o {}",
            output.display()
        ))
        .output()
        .unwrap();
        let scatter = gonio(&format!(
            "scatter --method rays --shape spheroid --axis-ratio 0.99 --size-parameter {x} \
             --index {index} --theta 0"
        ))
        .output()
        .unwrap();
        for (name, found) in [("table", &table), ("scatter", &scatter)] {
            let message = String::from_utf8_lossy(&found.stderr);
            let code = if refused { Some(2) } else { Some(0) };
            assert_eq!(found.status.code(), code, "{name}, index {index}, x = {x}: {message}");
            // the words of scenes for an index of 1, whatever the method
            let unlit = name == "table" && message.contains("an index of 1 scatters no light");
            let soft = message.contains("phase shift through the particle, 2x|n - 1| = ")
                && message.contains("accepted from 5 on");
            assert_eq!(refused, soft || unlit, "{name}: {message}");
        }
        let note = String::from_utf8_lossy(&scatter.stderr).contains("is small for rays");
        assert_eq!(note, !refused, "index {index}, x = {x}");
    }
}

/// The published method on a sphere, a list of orders: P of the bow is that of Lorenz–Mie, not twice it;
/// the sum lacks what the list leaves out; the stated error is the true one.
#[test]
fn a_list_of_orders_is_normalised_like_the_whole() {
    let table = |method: &str, model: &str| {
        let text = format!(
            "[particle]\nshape = \"sphere\"\nradius_mm = 0.2\nmedium = {{ index = [1.333, 0.0] }}\n\
             [light]\nwavelengths_nm = [650]\n[table]\ntheta_deg = {{ from = 0, to = 180, count = 1801 }}\n\
             azimuth_deg = [0]\n[model]\nmethod = \"{method}\"\n{model}"
        );
        simulate::table(&scene(&text)).unwrap()
    };
    let exact = table("mie", "").slabs.remove(0);
    let mean = |slab: &gonio::phase_table::Slab, from: usize, to: usize| {
        (from..to).map(|i| f64::from(slab.values[(0, i, 0)])).sum::<f64>() / (to - from) as f64
    };
    for diffraction in ["gaussian", "airy", "none"] {
        let model = format!("diffraction = \"{diffraction}\"\norders = [0, 1, 2, 3]\n");
        let found = table("rays", &model);
        found.validate().unwrap();
        let slab = &found.slabs[0];
        assert!(slab.left_out > 1e-4 && slab.left_out < 0.02, "{diffraction}: {}", slab.left_out);
        for (from, to) in [(200, 600), (600, 1000), (1385, 1500)] {
            let ratio = mean(slab, from, to) / mean(&exact, from, to);
            println!("{diffraction}, {from}–{to}: {ratio:.3} of Lorenz–Mie");
            assert!((ratio - 1.0).abs() < 0.12, "{diffraction}, {from}: {ratio}");
        }
    }
    // one order alone keeps its place: the bow is as bright as in the whole
    let alone = table("rays", "diffraction = \"airy\"\norders = [2]\n");
    alone.validate().unwrap();
    let ratio = mean(&alone.slabs[0], 1385, 1450) / mean(&exact, 1385, 1450);
    println!("order 2 alone: {ratio:.3} of Lorenz–Mie");
    assert!((0.75..1.05).contains(&ratio), "{ratio}");
}

/// The filter acts near the bow: it takes the peak down and lights the dark side, and leaves the rest.
#[test]
fn scatter_applies_the_gaussian_filter() {
    let line = "--method rays --radius-um 200 --wavelength-nm 650 --index 1.333 --theta 100,137.5,138.0,160";
    let s11 = |diffraction: &str| -> Vec<f64> {
        let answer = scatter(&format!("{line} --orders 2 --diffraction {diffraction}"));
        let part = |name: &str, i: usize| {
            let pair = &answer[name][i];
            pair[0].as_f64().unwrap().powi(2) + pair[1].as_f64().unwrap().powi(2)
        };
        (0..4).map(|i| 0.5 * (part("s1", i) + part("s2", i))).collect()
    };
    let (none, filtered) = (s11("none"), s11("gaussian"));
    println!("none {none:?}, gaussian {filtered:?}");
    assert_eq!((none[0], none[1]), (0.0, 0.0));
    assert_eq!(filtered[0], 0.0);
    assert!(filtered[1] > 0.0, "light in the dark");
    assert!((filtered[2] / none[2] - 1.0).abs() > 0.05, "{} {}", filtered[2], none[2]);
    assert!((filtered[3] / none[3] - 1.0).abs() < 1e-9);
}

#[test]
fn memory_of_many_rays_is_announced_and_refused() {
    let folder = tempfile::tempdir().unwrap();
    let line = format!(
        "table --shape raindrop --radius-mm 0.5 --method rays --diffraction gaussian --orders 0,1,2,3 \
         --rays-across 1000 --wavelengths-nm 550 --theta-deg 0:180:181 --azimuth-deg 0,90,180 \
         --no-preview --memory-limit 0.5 -o {}",
        folder.path().join("large.h5").display()
    );
    let output = gonio(&line).assert().code(2).get_output().clone();
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(message.contains("rays_across = 1000") && message.contains("GiB"), "{message}");
}

/// What `scatter` says of intensities by rays, against Lorenz–Mie: over all angles, and straight back, where the
/// glory of n = 2 is fifty times too bright.
#[test]
fn single_directions_say_what_they_are_worth() {
    for index in [1.1, 1.3314, 1.5, 1.7, 2.0, 2.42, 0.75] {
        let line = format!("--size-parameter 600 --index {index} --theta 10:170:0.4");
        let found = scatter(&format!("--method rays {line}"));
        let exact = scatter(&format!("--method mie {line}"));
        let s11 = |answer: &Value, i: usize| -> f64 {
            let part = |name: &str, k: usize| answer[name][i][k].as_f64().unwrap().powi(2);
            let square = |name: &str| part(name, 0) + part(name, 1);
            0.5 * (square("s1") + square("s2") + square("s3") + square("s4"))
        };
        let (mut off, mut told) = (0.0, 0.0);
        for i in 0..found["theta_deg"].as_array().unwrap().len() {
            off += (s11(&found, i) - s11(&exact, i)).powi(2);
            let stated = found["error_estimate_by_theta"][i].as_f64().unwrap();
            told += (stated * s11(&exact, i)).powi(2);
        }
        let back = |answer: &Value| answer["q_back"].as_f64().unwrap();
        let off_back = (back(&found) / back(&exact) - 1.0).abs();
        let told_back = found["error_estimate_q_back"].as_f64().unwrap();
        let ratio = (off / told).sqrt();
        println!("n = {index}: true over stated {ratio:.2}; back {off_back:.3} ({told_back:.3})");
        assert!((0.5..2.0).contains(&ratio), "n = {index}: {ratio}");
        assert!((off_back - told_back).abs() < 1e-6 * (1.0 + off_back), "n = {index}: {told_back}");
        assert!(exact["error_estimate_by_theta"].is_null());
    }
}

/// With the peak apart a table sums to what is not in the peak, whose share is the shadow's but for its edge, and
/// beyond the peak it is what it is with the peak inside.
#[test]
fn a_peak_apart_leaves_the_rest_as_it_is() {
    for (particle, angles) in [
        ("shape = \"sphere\"\nradius_mm = 0.05", 181),
        ("shape = \"sphere\"\nradius_mm = 0.5", 1801),
        ("shape = \"raindrop\"\nradius_mm = 0.5", 181),
        ("shape = \"raindrop\"\nradius_mm = 1.0", 361),
        ("shape = \"spheroid\"\naxis_ratio = 0.9\nradius_mm = 0.1", 181),
        ("shape = \"spheroid\"\naxis_ratio = 0.9\nradius_mm = 0.02", 361),
    ] {
        let table = |peak: &str| {
            let scene = scene(&format!(
                "[particle]\n{particle}\nmedium = {{ index = [1.333, 0.0] }}\n[light]\n\
                 wavelengths_nm = [650]\n[table]\n\
                 theta_deg = {{ from = 0, to = 180, count = {angles} }}\n\
                 azimuth_deg = {{ from = 0, to = 360, count = 37 }}\nforward_peak = \"{peak}\"\n\
                 [model]\nmethod = \"rays\"\n"
            ));
            simulate::table(&scene).unwrap()
        };
        let (apart, whole) = (table("separate"), table("cell_average"));
        let (slab, other) = (&apart.slabs[0], &whole.slabs[0]);
        let sum = slab.sum(&apart.header.axes);
        println!("{particle}, {angles}: share {:.5}, sum {sum:.5}", slab.peak_share);
        assert!((sum + slab.peak_share - 1.0).abs() < 1e-3);
        // a table of 1° has the fringes of such drops by chance
        assert!((slab.peak_share - 0.5).abs() < 0.025, "{}", slab.peak_share);
        let beyond = ndarray::s![0, angles / 3.., ..];
        let (rest, all) = (slab.values.slice(beyond), other.values.slice(beyond));
        let off = (&rest - &all).mapv(|d| d * d).sum() / all.mapv(|v| v * v).sum();
        println!("beyond 60 degrees the peak is {:.1e} of the intensity", off.sqrt());
        assert!(off.sqrt() < 0.03, "{off}");
    }
}
