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
        Ok(medium) => medium.index(550e-9).unwrap_err().to_string(),
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
        (table("        0.4 1.5 0\n        0.4 1.4 0\n"), "line 5: wavelength 0.4 µm again"),
        (table("        0.4 1.5 0\n        0.3 1.4 0\n"), "line 5: wavelength 0.3 µm after 0.4 µm"),
        (table("        0.4 1.5 0\n        0.5 1.4 -1\n"), "line 5: k = -1 must be 0 or more"),
        (table("        0.4 1.5 0\n        0.5 -1.4 0\n"), "line 5: n = -1.4 must be positive"),
        (table("        0.4 1.5 0\n        0.5 1.4\n"), "line 5: 2 numbers, expected 3"),
        (table("        0.4 1.5 zero\n"), "line 4: \"zero\" is not a finite number"),
        (table("        400 1.5 0\n        700 1.4 0\n"), "they look like nm"),
        (change("0.3 2.5", "300 2500"), "line 8: range 300 to 2500 µm"),
        (change("0.3 2.5", "2.5 0.3"), "line 8: range \"2.5 0.3\""),
        (change("0.0200179144", "0.25"), "line 9: pole of the formula = 0.5 µm"),
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
        assert!(found.contains("file.yml"), "{found}");
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
