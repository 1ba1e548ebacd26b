//! Exports: what other programs read has the numbers and signs that they expect.

use crate::support::{header, mie_table, table};
use gonio::hdf5::{self, WriteOptions};
use gonio::phase_table::Quantity;
use std::fs;
use std::path::Path;
use std::process::Command;

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
        let lines = text.lines().filter(|line| !line.starts_with('#')).skip(1);
        lines.map(|l| l.split(',').map(|v| v.parse().unwrap()).collect()).collect()
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
        (vec!["export", "drop.h5", "--to", "csv", "--azimuth-deg", "20"], "only strip"),
        (vec!["export", "drop.h5", "--to", "csv", "--polarisation", "parallel"], "only strip, exr"),
        (vec!["export", "drop.h5", "--to", "mitsuba", "--density-kg-m3", "900"], "only eradiate"),
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

/// Run the program in a folder; its exit code, and what it says on stderr.
fn gonio(folder: &Path, arguments: &[&str]) -> (i32, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_gonio"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap();
    (output.status.code().unwrap(), String::from_utf8_lossy(&output.stderr).into_owned())
}

/// Extinction per mass (km⁻¹ per g/m³) that libRadtran's layout gets of one wavelength of spheres.
fn per_mass(folder: &Path, particle: &str, more: &[&str]) -> (f64, String) {
    let scene = format!(
        "[particle]\nshape = \"sphere\"\n{particle}\n[light]\nwavelengths_nm = [550]\n[table]\n\
         theta_deg = {{ from = 0, to = 180, count = 1801 }}\nazimuth_deg = [0]\n[model]\n\
         method = \"mie\"\ntolerance = 1e-4\n"
    );
    fs::write(folder.join("m.toml"), scene).unwrap();
    let table = ["table", "m.toml", "-o", "m.h5", "--no-preview", "--overwrite"];
    assert_eq!(gonio(folder, &table), (0, String::new()));
    let export = ["export", "m.h5", "--to", "libradtran", "--cap-deg", "0", "-o", "m.cdf"];
    let (code, told) = gonio(folder, &[&export[..], &["--overwrite"], more].concat());
    assert_eq!(code, 0, "{told}");
    (values(&folder.join("m.cdf"), "ext")[0], told)
}

/// Numbers of scatrs (C_ext) over ρ 4/3 π ⟨r³⟩: 28 % more than with the effective radius for ⟨r³⟩ of a
/// gamma distribution; ice weighs 0.917.
#[test]
fn extinction_per_mass_is_of_the_mean_volume_and_the_medium() {
    let keep = tempfile::tempdir().unwrap();
    let folder = keep.path();
    let gamma = "size_distribution = { kind = \"gamma\", effective_radius_um = 10, \
                 effective_variance = 0.1 }\nmedium = { index = [1.333, 0.0] }";
    let (ext, told) = per_mass(folder, gamma, &[]);
    assert!((ext / 156.74 - 1.0).abs() < 1e-3, "{ext}");
    assert!(
        told.contains("density 1000 kg/m³, assumed: the index 1.333 is that of water"),
        "{told}"
    );
    let (ext, _) = per_mass(folder, "radius_um = 10\nmedium = { index = [1.333, 0.0] }", &[]);
    assert!((ext / 152.149 - 1.0).abs() < 1e-4, "{ext}");
    let (ext, told) = per_mass(folder, "radius_um = 10\nmedium = \"ice\"", &[]);
    assert!((ext / 166.0 - 1.0).abs() < 5e-4 && !told.contains("density"), "{ext} {told}");
    assert!((values(&folder.join("m.cdf"), "rho")[0] - 0.917).abs() < 1e-12);
    // The key and the flag say the same, and the flag wins.
    let glass = "radius_um = 10\nmedium = { index = [1.5, 0.0] }\n";
    let (by_key, _) = per_mass(folder, &format!("{glass}density_kg_m3 = 2500.0"), &[]);
    let (by_flag, _) = per_mass(folder, glass, &["--density-kg-m3", "2500"]);
    assert_eq!(by_key, by_flag);
    let (code, told) = gonio(folder, &["export", "m.h5", "--to", "libradtran", "-o", "no.cdf"]);
    assert_eq!(code, 2, "{told}");
    assert!(told.contains("particle.density_kg_m3") && told.contains("--density-kg-m3"), "{told}");
    assert!(!folder.join("no.cdf").exists());
}

/// A particle that is no sphere: six elements, in the order in which the programs count them.
#[test]
fn six_elements_of_particles_that_are_no_spheres() {
    let keep = tempfile::tempdir().unwrap();
    let folder = keep.path();
    let mut table = table(header(2, 181, 5, Quantity::Mueller));
    for slab in &mut table.slabs {
        slab.values.index_axis_mut(ndarray::Axis(0), 5).mapv_inplace(|v| 0.7 * v);
        slab.values.index_axis_mut(ndarray::Axis(0), 15).mapv_inplace(|v| 0.5 * v);
    }
    table.header.shape = "spheroid".into();
    hdf5::write(&folder.join("s.h5"), &table, WriteOptions::default()).unwrap();
    for (format, per_line) in [("eradiate", 2), ("libradtran", 1)] {
        export(folder, "s.h5", &["--to", format, "--cap-deg", "0", "--moments", "8", "-o", "s.nc"]);
        let path = folder.join("s.nc");
        let file = ::hdf5::File::open(&path).unwrap();
        let names = file.dataset("phamat").unwrap();
        let names: Vec<::hdf5::types::VarLenUnicode> = names.read_raw().unwrap();
        let names: Vec<&str> = names.iter().map(|name| name.as_str()).collect();
        assert_eq!(names, ["11", "12", "33", "34", "22", "44"], "{format}");
        let phase = values(&path, "phase");
        let line = phase.len() / (6 * 2);
        // Eradiate: element first, then wavelength; libRadtran: wavelength first.
        let at = |element: usize| phase[element * per_line * line + line / 3];
        for (element, of, ratio) in [(4, 0, 0.7), (5, 2, 0.5)] {
            assert!((at(element) / at(of) - ratio).abs() < 1e-5, "{format} {element}");
        }
        fs::remove_file(path).unwrap();
    }
    let csv = fs::read_to_string(folder.join(export(folder, "s.h5", &["--to", "csv"]))).unwrap();
    assert!(csv.contains("# spheroid: mean over azimuth"), "{}", &csv[..300]);
    let (_, told) = gonio(folder, &["export", "s.h5", "--to", "mitsuba", "-o", "m"]);
    assert!(told.contains("note: spheroid: a mean over azimuth, unpolarised"), "{told}");
    assert!(told.contains("is not met at 1 of 2 wavelengths"), "{told}");
}

/// Effective radii and variances of a merged sweep in one file.
#[test]
fn a_sweep_of_distributions_makes_one_file() {
    let keep = tempfile::tempdir().unwrap();
    let folder = keep.path();
    let sweep = |variances: &str| {
        format!(
            "[particle]\nshape = \"sphere\"\nmedium = \"water\"\nsize_distribution = {{ kind = \"gamma\", \
             effective_radius_um = [4, 6], effective_variance = {variances} }}\n[light]\n\
             wavelengths_nm = [800]\n[table]\ntheta_deg = {{ from = 0, to = 180, count = 721 }}\n\
             [model]\nmethod = \"mie\"\ntolerance = 0.004\n"
        )
    };
    for (name, variances) in [("pairs", "[0.05, 0.1]"), ("radii", "0.1")] {
        fs::write(folder.join("s.toml"), sweep(variances)).unwrap();
        let (plan, merged) = (format!("{name}.jsonl"), format!("{name}.h5"));
        for arguments in [
            vec!["batch", "plan", "s.toml", "-o", &plan],
            vec!["batch", "run", "--plan", &plan],
            vec!["batch", "merge", "--plan", &plan, "-o", &merged],
            vec!["validate", &merged],
        ] {
            let (code, told) = gonio(folder, &arguments);
            assert_eq!(code, 0, "{arguments:?}: {told}");
        }
    }
    let small = ["--cap-deg", "0", "--moments", "16", "--overwrite", "-o", "o.nc"];
    let path = folder.join("o.nc");
    export(folder, "pairs.h5", &[&["--to", "eradiate"], &small[..]].concat());
    let close = |found: &[f64], expected: &[f64]| {
        assert_eq!(found.len(), expected.len(), "{found:?}");
        let fits = found.iter().zip(expected).all(|(a, b)| (a / b - 1.0).abs() < 1e-3);
        assert!(fits, "{found:?} {expected:?}");
    };
    close(&values(&path, "reff"), &[4.0, 6.0]);
    close(&values(&path, "veff"), &[0.05, 0.1]);
    let ext = values(&path, "ext");
    let shadow = |reff: f64, v: f64| {
        2.2e-12 * std::f64::consts::PI * reff * reff * (1.0 - v) * (1.0 - 2.0 * v)
    };
    for (i, (reff, v)) in [(4.0, 0.05), (4.0, 0.1), (6.0, 0.05), (6.0, 0.1)].into_iter().enumerate()
    {
        assert!((ext[i] / shadow(reff, v) - 1.0).abs() < 0.05, "{ext:?}");
    }
    export(folder, "radii.h5", &[&["--to", "libradtran"], &small[..]].concat());
    close(&values(&path, "reff"), &[4.0, 6.0]);
    let masses = [4.0f64, 6.0].map(|reff| 998.2 * 4.18879e-18 * reff.powi(3) * 0.72);
    close(&values(&path, "ext"), &[ext[1] / masses[0], ext[3] / masses[1]]);
    export(folder, "pairs.h5", &[&["--to", "sasktran2"], &small[..]].concat());
    assert_eq!(values(&path, "effective_radius_um"), [4.0, 6.0]);
    assert_eq!(values(&path, "xs_total").len(), 4);
    let (code, told) = gonio(folder, &["export", "pairs.h5", "--to", "libradtran", "-o", "x.cdf"]);
    assert!(code == 2 && told.contains("one effective variance"), "{told}");
}

/// A table over the sun's disc says so, and a picture of it is the same with the disc or without.
#[test]
fn the_sun_s_disc_is_never_applied_twice() {
    let keep = tempfile::tempdir().unwrap();
    let folder = keep.path();
    let table = [
        "table",
        "-o",
        "t.h5",
        "--no-preview",
        "--shape",
        "sphere",
        "--radius-um",
        "40",
        "--method",
        "mie",
        "--sun-disc",
        "limb-darkened",
        "--wavelengths-nm",
        "400:700:7",
        "--theta-deg",
        "0:180:721",
    ];
    assert_eq!(gonio(folder, &table), (0, String::new()));
    let info = Command::new(env!("CARGO_BIN_EXE_gonio"))
        .args(["info", "t.h5"])
        .current_dir(folder)
        .output()
        .unwrap();
    let info = String::from_utf8(info.stdout).unwrap();
    assert!(info.contains("the sun's disc (limb-darkened)"), "{info}");
    let picture = |disc: bool| {
        fs::write(folder.join("p.toml"), format!("[sun]\nelevation_deg = 20\ndisc = {disc}\n"))
            .unwrap();
        let render = [
            "render",
            "p.toml",
            "--table",
            "t.h5",
            "-o",
            "p.png",
            "--overwrite",
            "--width",
            "64",
            "--height",
            "48",
        ];
        let (code, told) = gonio(folder, &render);
        assert!(code == 0 && told.contains("the sun's disc is in the table already"), "{told}");
        // what is seen: the file also says which scene it is of
        let file = std::io::BufReader::new(fs::File::open(folder.join("p.png")).unwrap());
        let mut reader = png::Decoder::new(file).read_info().unwrap();
        let mut seen = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut seen).unwrap();
        seen
    };
    assert!(picture(true) == picture(false));
}

/// The size parameter that moments are counted by is that in the surroundings, which the table records.
#[test]
fn moments_are_counted_in_the_surroundings() {
    let (_keep, folder) = tables();
    let scene = "[particle]\nshape = \"sphere\"\nradius_um = 10\nmedium = 1.0\noutside = 1.5\n[light]\n\
                 wavelengths_nm = [628.3185307]\n[table]\ntheta_deg = { from = 0, to = 180, count = 721 }\n\
                 azimuth_deg = [0]\nquantity = \"mueller\"\n[model]\nmethod = \"mie\"\n";
    fs::write(folder.join("bubble.toml"), scene).unwrap();
    let table = ["table", "bubble.toml", "-o", "bubble.h5", "--no-preview"];
    let (code, message) = gonio(&folder, &table);
    assert_eq!(code, 0, "{message}");
    assert_eq!(values(&folder.join("bubble.h5"), "outside_index"), [1.5]);
    let export = ["export", "bubble.h5", "--to", "sasktran2", "--moments", "240", "-o", "b.nc"];
    let (code, message) = gonio(&folder, &export);
    assert_eq!(code, 0, "{message}");
    // x = 100 in vacuum, 150 outside
    assert!(message.contains("size parameter 150 has about 316"), "{message}");
}
