//! Exports: what other programs read has the numbers and signs that they expect.

mod table_support;

use gonio::hdf5::{self, WriteOptions};
use gonio::phase_table::Quantity;
use std::fs;
use std::path::Path;
use std::process::Command;
use table_support::mie_table;

fn export(folder: &Path, table: &str, arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_gonio"))
        .args([&["export", table], arguments].concat())
        .current_dir(folder)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap().trim().to_string()
}

/// Tables to export: a Rayleigh sphere, a cloud drop, a raindrop in all colours. They lie in
/// `GONIO_KEEP` if that is set, so that the programs themselves can be tried on them.
fn tables() -> (tempfile::TempDir, std::path::PathBuf) {
    let temporary = tempfile::tempdir().unwrap();
    let folder = std::env::var_os("GONIO_KEEP").map_or(temporary.path().to_path_buf(), Into::into);
    let options = || WriteOptions { overwrite: true, ..WriteOptions::default() };
    let write = |name: &str, table| hdf5::write(&folder.join(name), &table, options()).unwrap();
    write("rayleigh.h5", mie_table(1e-6, &[1e-3], 1.33, 721, Quantity::Mueller));
    write("drop.h5", mie_table(2e-5, &[4.5e-7, 5.5e-7, 6.5e-7], 1.333, 3601, Quantity::Mueller));
    if std::env::var_os("GONIO_KEEP").is_some() {
        let colours: Vec<f64> = (0..33).map(|i| (380.0 + 10.625 * f64::from(i)) * 1e-9).collect();
        write("bow.h5", mie_table(3e-4, &colours, 1.333, 3601, Quantity::PhaseFunction));
    }
    (temporary, folder)
}

fn values(path: &Path, name: &str) -> Vec<f64> {
    let file = ::hdf5::File::open(path).unwrap();
    file.dataset(name).unwrap().read_raw::<f64>().unwrap()
}

#[test]
fn sasktran2_gets_rayleigh_with_its_sign() {
    let (_keep, folder) = tables();
    let arguments =
        ["--to", "sasktran2", "--cap-deg", "0", "--moments", "8", "-o", "r.nc", "--overwrite"];
    export(&folder, "rayleigh.h5", &arguments);
    let path = folder.join("r.nc");
    let close = |name: &str, l: usize, expected: f64| {
        let found = values(&path, name)[l];
        assert!((found - expected).abs() < 1e-4, "{name}[{l}] = {found}, not {expected}");
    };
    close("lm_a1", 0, 1.0);
    close("lm_a1", 2, 0.5);
    close("lm_a2", 2, 3.0);
    close("lm_a4", 1, 1.5);
    close("lm_b1", 2, 1.5f64.sqrt());
    close("lm_b1", 1, 0.0);
    assert_eq!(values(&path, "wavelength_nm"), [1e6]);
}

#[test]
fn eradiate_gets_an_integral_of_two_and_ascending_cosines() {
    let (_keep, folder) = tables();
    export(
        &folder,
        "drop.h5",
        &["--to", "eradiate", "--moments", "64", "-o", "e.nc", "--overwrite"],
    );
    let path = folder.join("e.nc");
    let (mu, phase) = (values(&path, "mu"), values(&path, "phase"));
    for (mu, p11) in mu.chunks(3601).zip(phase.chunks(3601)) {
        assert!(mu.windows(2).all(|pair| pair[0] < pair[1]));
        let sum: f64 = (1..3601).map(|i| 0.5 * (p11[i] + p11[i - 1]) * (mu[i] - mu[i - 1])).sum();
        assert!((sum - 2.0).abs() < 1e-9);
    }
    // Element 12 at 90°-ish of a drop: the sign of B&H, as Eradiate documents it.
    assert_eq!(phase.len(), 4 * 3 * 3601);
}

#[test]
fn the_cut_peak_is_told_and_leaves_the_rest_alone() {
    let (_keep, folder) = tables();
    for (name, cap) in [("whole.csv", "0"), ("cut.csv", "3")] {
        export(&folder, "drop.h5", &["--to", "csv", "--cap-deg", cap, "-o", name, "--overwrite"]);
    }
    let rows = |name: &str| -> Vec<Vec<f64>> {
        let text = fs::read_to_string(folder.join(name)).unwrap();
        text.lines().skip(2).map(|l| l.split(',').map(|v| v.parse().unwrap()).collect()).collect()
    };
    let (whole, cut) = (rows("whole.csv"), rows("cut.csv"));
    assert_eq!(whole.len(), 3 * 3601);
    assert_eq!(whole[0][2], 0.0);
    let share = cut[0][2];
    assert!((0.3..0.6).contains(&share), "a drop diffracts about half its light: {share}");
    for (a, b) in whole.iter().zip(&cut).filter(|(a, _)| a[1] >= 3.0 && a[0] == 450.0) {
        assert!((b[3] * (1.0 - share) / a[3] - 1.0).abs() < 1e-9);
    }
}

#[test]
fn mitsuba_gets_a_folder_and_libradtran_a_file() {
    let (_keep, folder) = tables();
    let name = export(&folder, "drop.h5", &["--to", "mitsuba", "-o", "m", "--overwrite"]);
    assert_eq!(name, "m");
    let text = fs::read_to_string(folder.join("m/phase.csv")).unwrap();
    assert_eq!(text.lines().next().unwrap().split(',').count(), 4);
    let strings = fs::read_to_string(folder.join("m/tabphase.txt")).unwrap();
    for line in strings.lines().skip(1) {
        let values: Vec<f64> =
            line.split_once(": ").unwrap().1.split(", ").map(|v| v.parse().unwrap()).collect();
        assert_eq!(values.len(), 4096);
        let sum: f64 = values.windows(2).map(|v| 0.5 * (v[0] + v[1])).sum::<f64>() * 2.0 / 4095.0;
        assert!((sum * std::f64::consts::TAU - 1.0).abs() < 0.02, "{sum}");
    }
    export(&folder, "drop.h5", &["--to", "libradtran", "-o", "l.cdf", "--overwrite"]);
    let asymmetry = values(&folder.join("l.cdf"), "gg");
    assert!(asymmetry.iter().all(|g| (0.5..0.9).contains(g)), "{asymmetry:?}");
}

#[test]
fn wrong_requests_have_code_2() {
    let (_keep, folder) = tables();
    for (arguments, expected) in [
        (vec!["export", "none.h5", "--to", "csv"], "no such file"),
        (vec!["export", "drop.h5", "--to", "word"], "word"),
        (vec!["export", "drop.h5", "--to", "csv", "--cap-deg", "-1"], "--cap-deg = -1"),
        (vec!["export", "drop.h5", "--to", "csv", "-o", "drop.h5"], "the file exists"),
        (vec!["export", "drop.h5", "--to", "strip"], "wavelength"),
        (vec!["export", "drop.h5", "--to", "sasktran2", "--moments", "0"], "--moments 0"),
        (vec!["export", "drop.h5", "--to", "exr", "--radius-deg", "0"], "--radius-deg 0"),
        (vec!["info", "none.h5"], "no such file"),
        (vec!["validate", "none.h5"], "no such file"),
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_gonio"))
            .args(&arguments)
            .current_dir(&folder)
            .output()
            .unwrap();
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert!(message.contains(expected), "{arguments:?}: {message}");
    }
}

#[test]
fn too_few_moments_are_told() {
    let (_keep, folder) = tables();
    let note = |moments: &str| {
        let arguments = ["export", "drop.h5", "--to", "sasktran2", "--moments", moments];
        let output = Command::new(env!("CARGO_BIN_EXE_gonio"))
            .args([&arguments[..], &["-o", "m.nc", "--overwrite"]].concat())
            .current_dir(&folder)
            .output()
            .unwrap();
        assert!(output.status.success());
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    // 2 pi 20 um / 0.45 um = 279.3.
    let few = note("128");
    assert!(few.contains("128 Legendre moments; size parameter 279 has about 575"), "{few}");
    assert_eq!(note("600"), "");
}
