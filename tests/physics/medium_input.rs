//! What a user may write for a medium: every form, and what is said about wrong ones.

use gonio::medium::{Medium, MediumError, MediumSpec, list};
use proptest::prelude::*;
use std::path::{Path, PathBuf};

fn write(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path
}

fn resolve(text: &str, folder: &Path) -> Result<Medium, MediumError> {
    MediumSpec::parse(text)?.resolve(folder)
}

fn message(text: &str, folder: &Path) -> String {
    match resolve(text, folder) {
        Ok(medium) => match medium.index(550e-9) {
            Ok(index) => format!("{index}, notes: {}", medium.notes().join("; ")),
            Err(error) => error.to_string(),
        },
        Err(error) => error.to_string(),
    }
}

#[test]
fn everything_in_the_library_answers_inside_its_range_only() {
    let entries = list().unwrap();
    assert!(entries.len() > 50, "{}", entries.len());
    for entry in entries.iter().filter(|e| !e.kind.contains("only solute")) {
        for name in std::iter::once(&entry.name).chain(&entry.aliases) {
            let medium = resolve(name, Path::new(".")).unwrap();
            let (from, to) = medium.valid_range();
            for i in 0..=50 {
                let wavelength = from * (to / from).powf(f64::from(i) / 50.0);
                let index = medium.index(wavelength).unwrap();
                assert!(index.re > 0.0 && index.im >= 0.0, "{name} at {wavelength}: {index}");
            }
            for outside in [0.99 * from, 1.01 * to] {
                let error = medium.index(outside).unwrap_err();
                assert!(matches!(error, MediumError::OutOfRange { .. }), "{name}: {error}");
            }
            assert!(!medium.source().is_empty());
        }
    }
}

/// Every form survives being written down in a table's record and read again.
#[test]
fn specs_go_through_toml_unchanged() {
    #[derive(serde::Serialize, serde::Deserialize, PartialEq, Debug)]
    struct Particle {
        radius_mm: f64,
        medium: MediumSpec,
    }
    let forms = [
        "\"water\"",
        "{ name = \"water\", temperature_c = 4.0, density_kg_m3 = 999.97 }",
        "{ name = \"sea-water\", salinity_g_kg = 30.0 }",
        "{ index = [1.333, 0.001] }",
        "{ index = 1.5 }",
        "{ file = \"a.yml\", extrapolate = true }",
        "{ file = \"a.agf\", glass = \"F2\" }",
        "{ sellmeier = { b = [1.0, 0.2], c_um2 = [0.006, 0.02] } }",
        "{ cauchy = [1.5, 0.004, 1e-4] }",
        "{ abbe = [1.5168, 64.17], line = \"e\" }",
        "{ solute = \"rhodamine6g\", fraction = 0.01, host = \"water\" }",
        "{ solute = \"fuchsine\", fraction = 0.1, host = { index = 1.36 }, dispersion = false }",
        "{ absorbance = \"a.csv\", path_mm = 10.0, host = { name = \"water\", temperature_c = 5.0 } }",
    ];
    for form in forms {
        let given: Particle = toml::from_str(&format!("radius_mm = 0.5\nmedium = {form}")).unwrap();
        let written = toml::to_string(&given).unwrap();
        let again: Particle = toml::from_str(&written).unwrap_or_else(|e| panic!("{written}: {e}"));
        assert_eq!(given, again);
    }
}

#[test]
fn wrong_specs_say_what_would_be_right() {
    let folder = tempfile::tempdir().unwrap();
    let cases = [
        ("watr", "did you mean \"water\""),
        ("n-bk8", "did you mean \"N-BK7\""),
        ("zzzzzzzzzz", "gonio material --list"),
        ("rose-bengal", "this is a dye"),
        ("{ index = [1.33, -0.1] }", "index: k = -0.1: 0 or more"),
        ("{ index = [0.0, 0.0] }", "index: n = 0: a positive number"),
        ("{ index = \"big\" }", "expected n (a number) or [n, k]"),
        ("{ indx = 1.3 }", "unknown field `indx`"),
        ("{ }", "expected a name or a table with one of"),
        ("{ index = 1.3, cauchy = [1.5] }", "cauchy does not go with the other keys"),
        ("{ name = \"water\", temperature_c = 120.0 }", "temperature_c = 120"),
        ("{ name = \"water\", density_kg_m3 = 2000.0 }", "density_kg_m3 = 2000: 0 to 1060"),
        ("{ name = \"N-BK7\", temperature_c = 20.0 }", "N-BK7 does not depend on it"),
        ("{ name = \"sea-water\", salinity_g_kg = 50.0 }", "salinity_g_kg = 50: 0 to 35"),
        ("{ solute = \"rhodamine6g\" }", "needs fraction"),
        ("{ solute = \"rhodamine6g\", fraction = 2.0 }", "fraction = 2: 0 to 1"),
        ("{ solute = \"ice\", fraction = 0.1 }", "solute = ice: rhodamine6g"),
        ("{ absorbance = \"a.csv\" }", "needs path_mm"),
        ("{ file = \"missing.yml\" }", "missing.yml"),
        ("{ abbe = [1.5, -64.0] }", "abbe: number = -64: a positive number"),
        ("{ sellmeier = { b = [1.0], c_um2 = [] } }", "1 values of b, 0 of c_um2"),
        ("{ sellmeier = { b = [1.0], c_um2 = [0.25] } }", "0.5 µm"),
        ("{ cauchy = [1.5, 0.01, -1.0] }", "index by the formula"),
    ];
    for (text, expected) in cases {
        let found = message(text, folder.path());
        assert!(found.contains(expected), "{text}: {found:?} lacks {expected:?}");
    }
}

const GLASS: &str = "# a comment
REFERENCES: \"A. Author, <i>Journal</i> 1, 2 (2000)\"
COMMENTS: |
  two lines: with a colon
  of comment
DATA:
  - type: formula 2
    wavelength_range: 0.3 2.5
    coefficients: 0 1.03961212 0.00600069867 0.231792344 0.0200179144 1.01046945 103.560653
  - type: tabulated k
    data: |
        0.300 2.8607E-06
        0.400 1.0E-08
        0.700 1.0E-08
        2.500 1.0E-05
SPECS:
    n_is_absolute: false
";

#[test]
fn files_of_the_database_are_read() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "glass.yml", GLASS);
    let glass = resolve("glass.yml", folder.path()).unwrap();
    let index = glass.index(0.5875618e-6).unwrap();
    assert!((index.re - 1.5168).abs() < 5e-6 && (index.im - 1e-8).abs() < 1e-12, "{index}");
    assert!(glass.source().starts_with("A. Author"));
    assert_eq!(glass.valid_range(), (0.3e-6, 2.5e-6));
    let table =
        "DATA:\n  - type: tabulated nk\n    data: |\n      0.4 1.5 0.1\n      0.5 1.4 0.2\n";
    write(folder.path(), "table.yml", table);
    let medium = resolve("table.yml", folder.path()).unwrap();
    assert_eq!(medium.index(0.5e-6).unwrap().im, 0.2);
    assert!(message("table.yml", folder.path()).contains("outside the data of table (400 to 500"));
    let beyond = resolve("{ file = \"table.yml\", extrapolate = true }", folder.path()).unwrap();
    assert_eq!(beyond.index(0.55e-6).unwrap().re, 1.4);
    assert!(beyond.source().contains("extrapolated beyond 400 to 500 nm"), "{}", beyond.source());
}

#[test]
fn wrong_files_are_named_with_their_line() {
    let folder = tempfile::tempdir().unwrap();
    let table = |rows: &str| format!("DATA:\n  - type: tabulated nk\n    data: |\n{rows}");
    let change = |from: &str, to: &str| GLASS.replace(from, to);
    let deep = |levels: usize| format!("DATA: {}{}\n", "[".repeat(levels), "]".repeat(levels));
    let cases = [
        (table("        0.4 1.5 0\n        0.4 1.4 0\n"), "of file (one row, at 400 nm)"),
        (table("        0.4 1.5 0\n        0.3 1.4 0\n"), "of file (300 to 400 nm)"),
        (table("        0.4 1.5 0\n        0.6 1.4 -1\n"), "line 5: k = -1 must be 0 or more"),
        (table("        0.4 1.5 0\n        0.5 -1.4 0\n"), "line 5: n = -1.4 must be positive"),
        (table("        0.4 1.5 0\n        0.6 1.4\n"), "line 5: 2 numbers, expected 3"),
        (table("        0.4 1.5 zero\n"), "line 4: \"zero\" is not a finite number"),
        (table("        400 1.5 0\n        700 1.4 0\n"), "they look like nm"),
        (change("0.3 2.5", "300 2500"), "declared in µm (they look like nm)"),
        (change("0.3 2.5", "2.5 0.3"), "line 8: range \"2.5 0.3\""),
        (change("0.0200179144", "0.3026"), "farther from the pole of the formula at 550.09"),
        (change("formula 2", "formula 12"), "formula = 12: a number from 1 to 9"),
        (change("formula 2", "sellmeier"), "line 7: type \"sellmeier\""),
        (change("coefficients:", "coeffs:"), "line 7: \"formula 2\" needs the field coefficients"),
        (change("0 1.03961212", "1.03961212"), "line 9: number of coefficients = 6"),
        (change("0 1.03961212", "0 1,03"), "line 9: \"1,03\" is not a finite number"),
        (change("DATA:", "DATUM:"), "no list DATA"),
        (change("COMMENTS: |", "COMMENTS: ["), "broken YAML"),
        ("DATA: &a [*a]\n".into(), "line 1: YAML aliases are not accepted"),
        (deep(40), "nested deeper than 32 levels"),
        (deep(100_000), "broken YAML: recursion limit exceeded"),
        ("\u{0}\u{1}".into(), "file.yml"),
        (String::new(), "no list DATA"),
    ];
    for (text, expected) in cases {
        write(folder.path(), "file.yml", &text);
        let found = message("file.yml", folder.path());
        let short: String = text.chars().take(400).collect();
        assert!(found.contains(expected), "{short}\n{found:?} lacks {expected:?}");
        assert!(found.contains("file"), "{found}");
    }
}

/// Real files are like this; the value at 550 nm, or what the message says.
#[test]
fn one_odd_row_does_not_condemn_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let nk = |rows: &str| format!("DATA:\n  - type: tabulated nk\n    data: |\n{rows}");
    let formula = |range: &str, c: &str, rest: &str| {
        format!(
            "DATA:\n  - type: {range}\n    coefficients: {c}\n{rest}",
            range = range.replacen(", ", "\n    wavelength_range: ", 1)
        )
    };
    let k = |rows: &str| format!("  - type: tabulated k\n    data: |\n{rows}");
    let glass = "3.50 -0.013 2 0.041 -2";
    let lead = (3.5 - 0.013 * 0.55_f64.powi(2) + 0.041 / 0.55_f64.powi(2)).sqrt();
    let sound = [
        (
            nk("      0.4 0.20 2\n      0.5 0.21 2\n      0.5 0.21 2\n      0.6 0.21 2\n"),
            0.21,
            2.0,
            "",
        ),
        (
            nk("      0.5 0.20 1\n      0.5 0.22 3\n      0.6 0.21 2\n"),
            0.21,
            2.0,
            "2 values of n at 500 nm (lines 4, 5): their mean 0.21",
        ),
        (nk("      0.6 1.48 0.1\n      0.5 1.50 0.1\n"), 1.49, 0.1, ""),
        (
            nk("      0.4 1.52 0.1\n      0.6 1.48 0.1\n      0.5 1.50 0.1\n"),
            1.49,
            0.1,
            "in no order: sorted",
        ),
        (
            nk("      0.4 1.5 0.02\n      0.5 1.5 -6e-19\n      0.6 1.5 -0.001\n"),
            1.5,
            0.0,
            "2 rows with k below 0 (lowest -1e-3)",
        ),
        (
            nk("      0.3 0 0\n      0.5 1.5 0\n      0.6 1.5 0\n"),
            1.5,
            0.0,
            "n = 0 must be positive",
        ),
        (
            formula("formula 3, 0.365 2.0", glass, &k("      0.28 -0.0\n      0.29 0\n")),
            lead,
            0.0,
            "taken as 0 throughout",
        ),
        (
            formula("formula 1, 0.3 12", "0 1.50 0.18 0.09 6.6", ""),
            (1.0 + 1.5 * 0.3025 / (0.3025 - 0.0324) + 0.09 * 0.3025 / (0.3025 - 43.56_f64)).sqrt(),
            0.0,
            "",
        ),
        (nk("      0.55 1.473 0.001\n"), 1.473, 0.001, ""),
    ];
    for (text, n, k, note) in sound {
        write(folder.path(), "f.yml", &text);
        let medium = resolve("f.yml", folder.path()).unwrap();
        let index = medium.index(550e-9).unwrap();
        assert!((index.re - n).abs() < 1e-12 && (index.im - k).abs() < 1e-12, "{text}: {index}");
        let notes = medium.notes().join("; ");
        assert!(notes.contains(note) && notes.is_empty() == note.is_empty(), "{text}: {notes}");
    }
    let short = formula("formula 3, 0.3 2.0", glass, &k("      0.31 1e-6\n      0.5 1e-8\n"));
    let unsound = [
        (short, "data of k of f (310 to 500 nm); its n, 1.905"),
        (nk("      0.5 1.5 0\n      0.56 -1.5 0\n      0.6 1.5 0\n"), "line 5: n = -1.5 must be"),
        (nk("      250 2.0 0.5\n      500 2.1 0.6\n"), "(250000 to 500000 nm)"),
        (nk("      0.5 1.5 -0.1\n      0.6 1.5 -0.2\n"), "k = -0.1 must be 0 or more"),
        (formula("formula 2, 0.3 13", "3.6 2.2 0.19 1.8", ""), "number of coefficients = 4"),
        (
            "DATA:\n  - type: tabulated n2\n    data: |\n      0.5 1e-20\n".into(),
            "nonlinear index n2",
        ),
        (format!("DATA:\n{}", k("      0.5 1e-3\n      0.6 1e-3\n")), "no n (only k)"),
    ];
    for (text, expected) in unsound {
        write(folder.path(), "f.yml", &text);
        let found = message("f.yml", folder.path());
        assert!(found.contains(expected), "{text}: {found:?} lacks {expected:?}");
    }
    // Far infrared data answer there.
    write(
        folder.path(),
        "f.yml",
        &nk("      250 2.0 0.5\n      500 2.1 0.6\n      2000 2.4 0.8\n"),
    );
    let index = resolve("f.yml", folder.path()).unwrap().index(500e-6).unwrap();
    assert_eq!((index.re, index.im), (2.1, 0.6));
}

/// Every dialect gives 1.49 + 0.002i at 500 nm.
#[test]
fn dialects_of_text_tables() {
    let folder = tempfile::tempdir().unwrap();
    let plain = "wavelength_nm,n,k\n400,1.50,0.001\n500,1.49,0.002\n600,1.48,0.003\n";
    let wide = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<u8>>();
    let latin = |text: &str| text.chars().map(|c| c as u32 as u8).collect::<Vec<u8>>();
    let bytes = |text: &str| text.as_bytes().to_vec();
    let cases: [(&str, Vec<u8>, &str); 16] = [
        ("plain.csv", bytes(plain), ""),
        (
            "site.csv",
            bytes("wl,n\n0.4,1.5\n0.5,1.49\n0.6,1.48\n\nwl,k\n0.4,0.001\n0.5,0.002\n"),
            "",
        ),
        ("site.txt", bytes("wl\tn\tk\n0.4\t1.5\t0.001\n0.5\t1.49\t0.002\n"), ""),
        ("quoted.csv", bytes("\"Wavelength, um\",n,k\n0.4,1.5,0.001\n0.5,1.49,0.002\n"), ""),
        (
            "all.csv",
            bytes(
                "\"wavelength_nm\",\"n\",\"k\"\n\"400\",\"1.5\",\"0\"\n\"500\",\"1.49\",\"0.002\"\n",
            ),
            "",
        ),
        ("comma.csv", bytes("wavelength_um;n;k\n0,40;1,50;0,001\n0,50;1,49;0,002\n"), ""),
        ("tab.tsv", bytes("wavelength_um\tn\tk\n0,40\t1,50\t0,001\n0,50\t1,49\t0,002\n"), ""),
        (
            "down.csv",
            bytes("wavelength_nm,n,k\n600,1.48,0.003\n500,1.49,0.002\n400,1.5,0.001\n"),
            "",
        ),
        ("d.csv", bytes("wavelength_nm,n,k\n4.0D+02,1.5D0,1.0D-03\n5.0D+02,1.49D0,2.0D-03\n"), ""),
        (
            "note.csv",
            bytes("! a\n% b\nwavelength_nm,n,k,\n400,1.5,0.001, # c\n500,1.49,0.002,\n"),
            "",
        ),
        ("mac.csv", bytes(&plain.replace('\n', "\r")), ""),
        ("utf16.csv", wide(plain), "UTF-16"),
        ("latin.csv", latin("wavelength (µm),n,k\n0.4,1.5,0.001\n0.5,1.49,0.002\n"), "Latin-1"),
        ("cm.csv", bytes("wavenumber_cm-1,n,k\n16666,1.48,0.003\n20000,1.49,0.002\n"), ""),
        (
            "ev.csv",
            bytes("Energy (eV),n,kappa\n2.479683968664,1.49,0.002\n3.0,1.5,0.001\n"),
            "kappa",
        ),
        ("eps.csv", bytes("wl,eps1,eps2\n0.4,2.25,0.003\n0.5,2.220096,0.00596\n"), ""),
    ];
    for (name, bytes, note) in cases {
        std::fs::write(folder.path().join(name), bytes).unwrap();
        let medium = resolve(name, folder.path()).unwrap();
        let index = medium.index(500e-9).unwrap();
        let error = (index.re - 1.49).abs().max((index.im - 0.002).abs());
        assert!(error < 1e-12, "{name}: {index}");
        let notes = medium.notes().join("; ");
        assert!(notes.contains(note) && notes.is_empty() == note.is_empty(), "{name}: {notes}");
    }
}

#[test]
fn absorbance_becomes_k() {
    let folder = tempfile::tempdir().unwrap();
    let rows: String = (0..=40)
        .map(|i| {
            let nm = 400.0 + 10.0 * f64::from(i);
            format!("{nm},{}\n", 2.0 * (-((nm - 550.0) / 30.0_f64).powi(2)).exp())
        })
        .collect();
    write(
        folder.path(),
        "dye.csv",
        &format!("# source: made up\nwavelength_nm,absorbance\n{rows}"),
    );
    let medium = resolve(
        "{ absorbance = \"dye.csv\", path_mm = 0.01, host = { index = 1.33 } }",
        folder.path(),
    )
    .unwrap();
    // A = 2 over 10 µm lets a hundredth through: exp(−4πkL/λ) = 0.01.
    let k = medium.index(550e-9).unwrap().im;
    let through = (-4.0 * std::f64::consts::PI * k * 1e-5 / 550e-9).exp();
    assert!((through - 0.01).abs() < 1e-12, "{through}");
    // n falls below the host's on the blue side of the band and rises above it on the red side.
    let n = |nm: f64| medium.index(nm / 1e9).unwrap().re;
    assert!(n(520.0) < 1.33 && n(580.0) > 1.33, "{} {}", n(520.0), n(580.0));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    /// Whatever the bytes, a file ends in a medium or a message.
    #[test]
    fn no_file_panics(bytes in proptest::collection::vec(any::<u8>(), 0..300), csv: bool) {
        let folder = tempfile::tempdir().unwrap();
        let name = if csv { "f.csv" } else { "f.yml" };
        std::fs::write(folder.path().join(name), &bytes).unwrap();
        let _ = resolve(name, folder.path());
        std::fs::write(folder.path().join("f.agf"), &bytes).unwrap();
        let _ = resolve("f.agf", folder.path());
    }

    /// Nor do broken copies of a sound file.
    #[test]
    fn no_mutation_panics(at in 0..GLASS.len(), text in "[-\\[\\]{}:|>&*!%@` \n\t0-9.eE+a]{0,6}") {
        let folder = tempfile::tempdir().unwrap();
        let cut = GLASS.char_indices().map(|(i, _)| i).rfind(|i| *i <= at).unwrap();
        let mutated = format!("{}{text}{}", &GLASS[..cut], &GLASS[cut..]);
        std::fs::write(folder.path().join("f.yml"), mutated).unwrap();
        if let Ok(medium) = resolve("f.yml", folder.path()) {
            let _ = medium.index(0.5e-6);
        }
    }
}
