//! What the T-matrix promises on the command line: the same amplitudes in `scatter` and `table`, the method told,
//! refusals with what was reached, and what a radar sees.

use assert_cmd::Command;
use gonio::scene::{Scene, SceneFile, SceneText};
use gonio::simulate;
use serde_json::Value;
use std::f64::consts::PI;

fn gonio(line: &str) -> Command {
    let mut command = Command::cargo_bin("gonio").unwrap();
    command.args(line.split_whitespace());
    command
}

fn json(line: &str) -> Value {
    let output = gonio(line).assert().success().get_output().clone();
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Exit code and message of a refusal.
fn refused(line: &str) -> (Option<i32>, String) {
    let output = gonio(line).assert().failure().get_output().clone();
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

fn scene(model: &str) -> Scene {
    let text = format!(
        "[particle]\nshape = \"spheroid\"\nradius_um = 2\naxis_ratio = 0.8\nmedium = {{ index = [1.4, 0.01] }}\n\
         {model}"
    );
    let light = "[light]\nwavelengths_nm = [1000]\nsun_elevation_deg = 25\n[table]\ntheta_deg = { from = 0, to \
                 = 180, count = 181 }\nazimuth_deg = { from = 0, to = 360, count = 37 }\nquantity = \"mueller\"\n";
    let text = SceneText::parse("contract", format!("{text}{light}")).unwrap();
    Scene::from_text(text, &SceneFile::default()).unwrap()
}

/// A table of `auto` is the T-matrix's, says so, and holds what `scatter` gives in the same direction, in the
/// mirror image too.
#[test]
fn tables_hold_what_scatter_gives() {
    let table = simulate::table(&scene("")).unwrap();
    let (header, slab) = (&table.header, &table.slabs[0]);
    assert_eq!(header.method, "tmatrix");
    assert!(slab.methods[0].method.contains("T-matrix"), "{:?}", slab.methods);
    assert_eq!(slab.tolerance_met, Some(true));
    assert!((slab.sum(&header.axes) - 1.0).abs() < 1e-3);
    let lost = 1.0 - slab.scattering_cross_section / slab.extinction_cross_section;
    assert!(lost > 0.01, "{lost}");
    for (j, azimuth) in [(4, 40.0), (31, 310.0)] {
        let seen = json(&format!(
            "scatter --method tmatrix --shape spheroid --axis-ratio 0.8 --radius-um 2 --wavelength-nm 1000 \
             --index 1.4+0.01 --sun-elevation-deg 25 --azimuth-deg {azimuth} --theta 100 --json"
        ));
        let part = |name: &str| {
            let at = |k: usize| seen[name][0][k].as_f64().unwrap();
            num_complex::Complex64::new(at(0), at(1))
        };
        let amplitude = gonio::optics::AmplitudeMatrix {
            s1: part("s1"),
            s2: part("s2"),
            s3: part("s3"),
            s4: part("s4"),
        };
        let x = seen["size_parameter"].as_f64().unwrap();
        let scale = 1.0 / (std::f64::consts::PI * x * x * seen["q_sca"].as_f64().unwrap());
        for (e, element) in amplitude.mueller().iter().flatten().enumerate() {
            let stored = f64::from(slab.values[(e, 100, j)]);
            let off = (stored - element * scale).abs();
            assert!(off < 1e-5 * amplitude.s11() * scale, "{e} at {azimuth}: {stored} {element}");
        }
    }
}

/// Random orientation has one azimuth, keeps the sum, and is told; rays are refused for it.
#[test]
fn random_orientation_is_a_table_of_one_azimuth() {
    let scene = scene("orientation = \"random\"\n");
    let table = simulate::table(&scene).unwrap();
    assert_eq!(table.header.axes.phi.len(), 1);
    let slab = &table.slabs[0];
    assert!((slab.sum(&table.header.axes) - 1.0).abs() < 1e-3);
    assert!(slab.methods[0].reason.contains("mean over all orientations"));
    let line = "table --shape spheroid --axis-ratio 0.8 --radius-um 2 --wavelengths-nm 1000 --orientation random \
                --method rays -o never.h5";
    let (code, message) = refused(line);
    assert!(code == Some(2) && message.contains("tmatrix"), "{message}");
    let (code, message) = refused(&line.replace("random", "slanted"));
    assert!(code == Some(2) && message.contains("upright"), "{message}");
}

/// What no T-matrix serves is refused before it is tried (2), what does not converge afterwards (1), with what was
/// reached; no file is left.
#[test]
fn beyond_its_limits_nothing_is_left() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("t.h5");
    for (size, code, words) in [
        ("--axis-ratio 0.9 --radius-um 500", 2, "at most"),
        ("--axis-ratio 0.2 --radius-um 2", 1, "the best reached has error"),
    ] {
        let line = format!(
            "table --shape spheroid {size} --index 1.333 --wavelengths-nm 500 --method tmatrix --theta-deg 0,90,180 \
             --azimuth-deg 0,90 --forward-peak point --no-preview -o {}",
            output.display()
        );
        let (found, message) = refused(&line);
        assert!(found == Some(code) && message.contains(words), "{size}: {found:?} {message}");
        assert!(!output.exists());
    }
    let (code, message) = refused(
        "scatter --method tmatrix --shape spheroid --axis-ratio 0.9 --size-parameter 5 --index 1.3 --theta 0 \
         --orders 2",
    );
    assert!(code == Some(2) && message.contains("all orders at once"), "{message}");
}

/// `gonio plan` says who computes, at what cost, and what the other would err.
#[test]
fn the_plan_tells_of_both() {
    let line = "plan --method auto --shape spheroid --axis-ratio 0.9 --radius-um 2 --index 1.333 --wavelengths-nm 500 \
                --theta-deg 0:180:19 --azimuth-deg 0,90,180";
    let output = gonio(line).assert().success().get_output().clone();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("rays are skipped: the T-matrix converges (null field"), "{text}");
    assert!(
        text.contains("of one core per wavelength; amplitudes of rays would be about"),
        "{text}"
    );
    let larger = line.replace("--radius-um 2", "--radius-um 60");
    let output = gonio(&larger).assert().success().get_output().clone();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("the T-matrix is skipped: "), "{text}");
}

/// A drop of 4 mm in X band at 20 °C, as computed by two independent methods; frequencies stand for wavelengths
/// in other commands too.
#[test]
fn a_radar_sees_a_drop() {
    let seen = json("radar --frequency-ghz 10 --temperature-c 20 --diameter-mm 4 --json");
    let row = &seen["rows"][0];
    let number = |name: &str| row[name].as_f64().unwrap();
    assert!((number("z_dr_db") - 2.60).abs() < 5e-3, "{row}");
    assert!((number("k_dp_deg_km") - 0.127).abs() < 5e-4, "{row}");
    // the sphere of equal volume by Lorenz–Mie stands between the two polarisations
    let sphere = json(
        "scatter --method mie --radius-um 2000 --frequency-ghz 10 --index 8.0568+2.0306 --theta 180 --json",
    );
    let [wavelength, radius] = [29.979_245_8_f64, 2.0_f64];
    let area = sphere["q_back"].as_f64().unwrap() * PI * radius * radius;
    let z_of_sphere = wavelength.powi(4) / PI.powi(5) / 0.93 * area;
    let [z_h, z_v] = ["z_h_mm6_m3", "z_v_mm6_m3"].map(number);
    assert!(z_v < z_of_sphere && z_of_sphere < z_h, "{z_of_sphere}: {row}");
    assert!(
        ((z_h * z_v).sqrt() / z_of_sphere - 1.0).abs() < 0.1 && row["ldr_db"].is_null(),
        "{row}"
    );
    let single = json(
        "scatter --method tmatrix --shape raindrop --radius-um 2000 --frequency-ghz 10 --index 8.0568+2.0306 \
         --theta 180 --azimuth-deg 90 --json",
    );
    let norm = |name: &str| {
        let at = |k: usize| single[name][0][k].as_f64().unwrap();
        at(0).hypot(at(1))
    };
    let z_dr = 20.0 * (norm("s2") / norm("s1")).log10();
    assert!((z_dr - number("z_dr_db")).abs() < 1e-3, "{z_dr}");
    for (line, words) in [
        ("radar --band Q --diameter-mm 1", "S, C, X, Ku, Ka, W"),
        ("radar --band X", "--diameter-mm"),
        ("radar --diameter-mm 1", "--frequency-ghz"),
        ("radar --band X --diameter-mm 20", "drop model"),
        ("radar --band X --marshall-palmer-mm-h -1", "1e-3 to 1000"),
        ("radar --band X --diameter-mm 1 --shape sphere --axis-ratio 0.9", "only --shape spheroid"),
        ("radar --band X --diameter-mm 1 --temperature-c 90", "temperature"),
    ] {
        let (code, message) = refused(line);
        assert!(code == Some(2) && message.contains(words), "{line}: {code:?} {message}");
    }
}

/// Rays of water take a frequency where they take a wavelength.
#[test]
fn rays_have_frequencies_too() {
    let deviations = |flags: &str| json(&format!("rays --count 5 {flags} --json"))["rays"].clone();
    let ghz = 299_792.458 / 0.5;
    assert_eq!(deviations(&format!("--frequency-ghz {ghz}")), deviations("--wavelength-nm 500"));
    for (line, words) in [
        ("rays --frequency-ghz 6e5 --wavelength-nm 500", "cannot be used"),
        ("rays --frequency-ghz 6e5 --index 1.3", "cannot be used"),
        ("rays --frequency-ghz 0", "a positive number is accepted"),
    ] {
        let (code, message) = refused(line);
        assert!(code == Some(2) && message.contains(words), "{line}: {code:?} {message}");
    }
}

/// Flags of a radar that have no effect together, and a body without contrast.
#[test]
fn what_has_no_effect_is_refused() {
    for (line, words) in [
        ("radar --band X --diameter-mm 2 --from-diameter-mm 1", "cannot be used"),
        ("radar --band X --diameter-mm 2 --to-diameter-mm 3", "cannot be used"),
        ("radar --band X --marshall-palmer-mm-h 5 --number-per-m3 7", "its own numbers of drops"),
        ("radar --band X --diameter-mm 2 --index 1", "scatters nothing"),
        ("scatter --method tmatrix --size-parameter 10 --index 1 --theta 0", "scatters nothing"),
        ("radar --band X --diameter-mm 9.1", "radius 4.55 mm is outside"),
    ] {
        let output = gonio(line).assert().code(2).get_output().clone();
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(text.contains(words) && output.stdout.is_empty(), "{line}: {text}");
    }
}
