//! Bad input of the exact series and of media from a user's side: the message names the flag or
//! the file and line, the exit code is 2, nothing is written.

use crate::support::gonio;

/// NaN, x ≤ 0, k < 0, more terms than memory, for both series.
#[test]
fn sizes_and_indices_without_meaning() {
    let folder = tempfile::tempdir().unwrap();
    let cases = [
        ("--size-parameter", "nan", "--size-parameter NaN: a finite number above 0"),
        ("--size-parameter", "inf", "--size-parameter inf: a finite number above 0"),
        ("--size-parameter", "0", "--size-parameter 0: a finite number above 0"),
        ("--size-parameter", "-5", "--size-parameter -5: a finite number above 0"),
        ("--size-parameter", "1e-30", "accepted are finite numbers of at least 1e-25"),
        ("--size-parameter", "1e12", "terms: accepted are at most 20000000 (1.3 GB)"),
        ("--index", "1.333-0.1", "--index"),
        ("--index", "nan", "--index"),
        ("--index", "0", "--index"),
        ("--index", "1e9", "n from 1e-4 to 1e4, k from 0 to 1e4"),
        ("--theta", "181", "--theta 181"),
        ("--theta", "nan", "--theta"),
    ];
    for method in ["mie", "debye"] {
        for (flag, value, expected) in cases {
            let mut words = vec!["scatter", "--method", method];
            for (name, plain) in
                [("--size-parameter", "10"), ("--index", "1.333"), ("--theta", "10")]
            {
                words.extend([name, if name == flag { value } else { plain }]);
            }
            let (code, message) = gonio(folder.path(), &words);
            assert_eq!(code, 2, "{words:?}: {message}");
            assert!(message.contains(expected), "{words:?}: {message}");
        }
    }
}

/// Distributions of sizes, bands and the sun's disc.
#[test]
fn means_that_make_no_sense() {
    let folder = tempfile::tempdir().unwrap();
    let cases: [(&[&str], &str); 9] = [
        (&["--size-distribution", "kind=\"gama\""], "unknown variant `gama`"),
        (&["--size-distribution", "kind=\"gamma\""], "missing field `effective_radius_um`"),
        (
            &[
                "--size-distribution",
                "kind=\"gamma\", effective_radius_um=10, effective_variance=0.6",
            ],
            "effective_variance = 0.6: 0.000001 to 0.45 is accepted",
        ),
        (
            &["--size-distribution", "kind=\"normal\", mean_radius_um=-1, deviation_um=0.1"],
            "mean_radius_um = -1",
        ),
        (
            &["--size-distribution", "kind=\"log-normal\", median_radius_um=5, spread=nan"],
            "spread = NaN",
        ),
        (
            &[
                "--size-distribution",
                "kind=\"marshall-palmer\", rain_rate_mm_h=5",
                "--shape",
                "raindrop",
            ],
            "need both limits",
        ),
        (
            &[
                "--size-distribution",
                "kind=\"gamma\", effective_radius_um=10, effective_variance=0.1",
                "--method",
                "debye",
            ],
            "means over sizes, bands and the sun's disc need a sphere and method = \"mie\"",
        ),
        (&["--radius-um", "5", "--bandwidth-nm", "-3"], "--bandwidth-nm = -3"),
        (&["--radius-um", "5", "--sun-disc", "bright"], "limb-darkened"),
    ];
    for (words, expected) in cases {
        let mut all = vec!["table", "-o", "out.h5", "--wavelengths-nm", "550"];
        if !words.contains(&"--shape") {
            all.extend(["--shape", "sphere"]);
        }
        if !words.contains(&"--method") {
            all.extend(["--method", "mie"]);
        }
        all.extend(words);
        let (code, message) = gonio(folder.path(), &all);
        assert_eq!(code, 2, "{all:?}: {message}");
        assert!(message.contains(expected), "{all:?}: {message}");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}

/// Files of optical data with every fault that is likely: file and line are named.
#[test]
fn faulty_media() {
    let pole = "DATA:\n  - type: formula 2\n    wavelength_range: 0.3 2.5\n    \
                coefficients: 0 1.03 0.25 0.2 0.02 1.0 103.5\n";
    let cases = [
        (
            "a.csv",
            "wavelength_nm,n\n400,1.5\n700,1.4\n",
            800,
            "outside the data of a (400 to 700 nm)",
        ),
        ("a.csv", "wavelength_nm,n,k\n400,1.5,0\n700,1.4,-1\n", 650, "a.csv, line 3: k = -1"),
        // Unsorted and repeated rows are data: the range is that of all rows.
        (
            "a.csv",
            "wavelength_nm,n\n700,1.4\n400,1.5\n",
            800,
            "outside the data of a (400 to 700 nm)",
        ),
        ("a.csv", "wavelength_nm,n\n400,1.5\n400,1.4\n", 800, "of a (one row, at 400 nm)"),
        ("a.csv", "wavelength_um,n\n400,1.5\n700,1.4\n", 800, "of a (400000 to 700000 nm)"),
        ("a.csv", "wavelength_nm,n\n400,1.5\n700,x\n", 650, "a.csv, line 3"),
        ("a.yml", "DATA: [\n", 800, "a.yml"),
        ("a.yml", pole, 500, "the pole of the formula at 500 nm"),
    ];
    for (name, text, wavelength, expected) in cases {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(name), text).unwrap();
        let scene = format!(
            "[particle]\nshape = \"sphere\"\nradius_um = 1\nmedium = {{ file = \"{name}\" }}\n\
             [light]\nwavelengths_nm = [{wavelength}]\n[model]\nmethod = \"mie\"\n"
        );
        std::fs::write(folder.path().join("scene.toml"), scene).unwrap();
        for words in [
            vec!["material", name, "--wavelength-nm", &wavelength.to_string()],
            vec!["table", "scene.toml", "-o", "out.h5"],
        ] {
            let (code, message) = gonio(folder.path(), &words);
            assert_eq!(code, 2, "{words:?} {text}: {message}");
            assert!(message.contains(expected), "{words:?} {text}: {message}");
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2, "{text}");
    }
}

/// Every kind of medium makes a table, and the table records it.
#[test]
fn media_of_all_kinds_end_in_tables() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("dye.csv", "wavelength_nm,absorbance\n380,0\n500,0.5\n550,1\n600,0.4\n720,0\n");
    write(
        "glass.yml",
        "DATA:\n  - type: formula 2\n    wavelength_range: 0.5 0.6\n    \
         coefficients: 0 1.03961212 0.00600069867\n",
    );
    let media = [
        "{ solute = \"rhodamine6g\", fraction = 0.01, host = \"water\" }",
        "{ absorbance = \"dye.csv\", path_mm = 0.1, host = \"water\" }",
        "{ file = \"glass.yml\", extrapolate = true }",
        "{ cauchy = [1.5, 0.004] }",
        "{ abbe = [1.5168, 64.17] }",
        "{ name = \"water\", temperature_c = 5.0 }",
        "\"N-BK7\"",
    ];
    for medium in media {
        let scene = format!(
            "[particle]\nshape = \"sphere\"\nradius_um = 1\nmedium = {medium}\n[light]\n\
             wavelengths_nm = [450, 650]\n[table]\ntheta_deg = {{ from = 0, to = 180, count = 181 \
             }}\n[model]\nmethod = \"mie\"\n"
        );
        write("scene.toml", &scene);
        let words = ["table", "scene.toml", "-o", "out.h5", "--overwrite", "--no-preview"];
        let (code, message) = gonio(folder.path(), &words);
        assert_eq!(code, 0, "{medium}: {message}");
        let table = gonio::hdf5::read(&folder.path().join("out.h5")).unwrap();
        let header = &table.header;
        assert!(header.rotational_symmetry && header.axes.phi.len() == 1, "{medium}");
        // What the table records makes the same scene again.
        let keys: gonio::scene::SceneFile = toml::from_str(&header.scene_toml).unwrap();
        let given: gonio::scene::SceneFile = toml::from_str(&scene).unwrap();
        assert_eq!(keys.particle.medium, given.particle.medium, "{}", header.scene_toml);
    }
}
