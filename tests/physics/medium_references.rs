//! Media against published numbers and independent programs.

use gonio::medium::{Abbe, AbbeLines, Formula, Medium, MediumSpec, list};
use serde_json::Value;
use std::path::Path;

fn json(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/medium").join(name);
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn medium(text: &str) -> Medium {
    MediumSpec::parse(text).unwrap().resolve(Path::new(".")).unwrap()
}

fn n(medium: &Medium, um: f64) -> f64 {
    medium.index(um / 1e6).unwrap().re
}

fn water(temperature: f64, density: f64) -> Medium {
    Medium::WaterOfDensity { temperature, density }
}

/// IAPWS R9-97, Table 3 (eight values to seven or eight digits), and two more values by the
/// program `iapws`, at the densities of IAPWS-95.
#[test]
fn water_meets_every_check_value_of_the_release() {
    let checks = json("iapws97_checks.json");
    let checks = checks["published_check"].as_array().unwrap();
    assert_eq!(checks.len(), 10);
    for check in checks {
        let get = |key: &str| check[key].as_f64();
        let medium = water(get("T_K").unwrap(), get("rho_kg_m3").unwrap());
        let found = n(&medium, get("lambda_um").unwrap());
        let published = get("n_published_table3").or(get("n_docstring_iapws_pkg")).unwrap();
        let text = check["n_published_table3"].as_f64().or(check["n_docstring_iapws_pkg"].as_f64());
        let digits = text.unwrap().to_string().split('.').nth(1).unwrap().len().max(6);
        // The index with the printed number of digits is the printed number.
        let rounded = format!("{found:.digits$}").parse::<f64>().unwrap();
        assert_eq!(rounded, published, "{check}: {found}");
    }
}

/// The liquid at 1 atm, density by IAPWS SR6-08, against a grid made with IAPWS-95 densities.
#[test]
fn liquid_water_by_temperature() {
    let checks = json("iapws97_checks.json");
    let grid = checks["computed_grid_1atm"].as_array().unwrap();
    assert_eq!(grid.len(), 60);
    let mut worst = 0.0_f64;
    for row in grid {
        let medium = Medium::Water { temperature: row["T_K"].as_f64().unwrap() };
        let found = n(&medium, row["lambda_um"].as_f64().unwrap());
        worst = worst.max((found - row["n"].as_f64().unwrap()).abs());
    }
    // The grid is printed to 1e-7; measured 6e-8.
    assert!(worst < 1e-7, "{worst:e}");
}

/// Two independent publications: Daimon & Masumura measured what IAPWS computes.
#[test]
fn daimon_and_masumura_agree_with_iapws() {
    for celsius in [19.0, 20.0, 20.7, 21.5, 23.0, 24.0] {
        let daimon = medium(&format!("{{ name = \"water-daimon\", temperature_c = {celsius} }}"));
        let iapws = medium(&format!("{{ name = \"water\", temperature_c = {celsius} }}"));
        for nm in (400..=700).step_by(10) {
            let um = f64::from(nm) / 1e3;
            let difference = (n(&daimon, um) - n(&iapws, um)).abs();
            assert!(difference < 4e-6, "{celsius} °C, {nm} nm: {difference:e}");
        }
    }
    let exact = medium("water-daimon-21.5");
    let between = medium("{ name = \"water-daimon\", temperature_c = 21.5 }");
    assert!((n(&exact, 0.5) - n(&between, 0.5)).abs() < 1e-14);
}

/// Sea water without salt is water: Quan & Fry (brought to vacuum) against IAPWS.
#[test]
fn sea_water_without_salt_is_water() {
    for celsius in [5.0, 20.0, 30.0] {
        let text =
            format!("{{ name = \"sea-water\", temperature_c = {celsius}, salinity_g_kg = 0 }}");
        let sea = medium(&text);
        let fresh = medium(&format!("{{ name = \"water\", temperature_c = {celsius} }}"));
        for um in [0.4, 0.5, 0.5893, 0.7] {
            let difference = (n(&sea, um) - n(&fresh, um)).abs();
            assert!(difference < 7e-5, "{celsius} °C, {um} µm: {difference:e}");
        }
    }
    // Dispersion and salt raise n by what the paper's formula says relative to air.
    let salty = n(&medium("sea-water"), 0.5893);
    assert!((salty / 1.000276 - 1.339406).abs() < 1e-5, "{salty}");
}

/// All 41 materials at 14 spectral lines against an independent evaluation of the coefficients.
#[test]
fn the_catalogue_at_fourteen_lines() {
    let reference = json("n_at_lines.json");
    let materials = reference["materials"].as_object().unwrap();
    assert_eq!(materials.len(), 41);
    let mut compared = 0;
    for (name, values) in materials {
        let medium = medium(name);
        for (line, index) in values["n_at_lines"].as_object().unwrap() {
            let Some(index) = index.as_f64() else { continue };
            let um = reference["lines_um"][line].as_f64().unwrap();
            let found = n(&medium, um);
            assert!((found - index).abs() < 6e-9, "{name} at {line}: {found}, not {index}");
            compared += 1;
        }
        for (key, lines) in [("vd", AbbeLines::HeliumD), ("ve", AbbeLines::MercuryE)] {
            if let Some(expected) = values[key].as_f64() {
                let found = medium.abbe(lines).unwrap().number;
                assert!((found - expected).abs() < 1e-4, "{name} {key}: {found}");
            }
        }
    }
    assert!(compared > 500, "{compared}");
}

/// n_d and V_d of the 22 Schott glasses round to what the catalogue prints.
#[test]
fn schott_glasses_to_catalogue_digits() {
    let glasses: Vec<_> = list().unwrap().into_iter().filter(|e| e.catalogue.is_some()).collect();
    assert_eq!(glasses.len(), 22);
    for glass in glasses {
        let (nd, vd) = glass.catalogue.unwrap();
        let found = medium(&glass.name).abbe(AbbeLines::HeliumD).unwrap();
        assert!((found.index - nd).abs() <= 0.5e-5 + 1e-9, "{}: {}", glass.name, found.index);
        assert!((found.number - vd).abs() <= 0.5e-2 + 1e-9, "{}: {}", glass.name, found.number);
    }
}

/// Cauchy A and B from (n_d, V_d) of six materials, as printed beside the catalogue's numbers.
#[test]
fn cauchy_from_index_and_abbe_number() {
    let table = [
        ("N-BK7", 1.504583, 0.004218),
        ("SF10", 1.689368, 0.013423),
        ("N-SF11", 1.738368, 0.016002),
        ("fused-silica", 1.448210, 0.003540),
        ("diamond", 2.378605, 0.013423),
        ("sapphire-o", 1.752058, 0.005563),
    ];
    for (name, a, b) in table {
        let abbe = medium(name).abbe(AbbeLines::HeliumD).unwrap();
        let found = abbe.to_cauchy(AbbeLines::HeliumD).unwrap();
        assert!((found[0] - a).abs() < 1e-6, "{name}: A = {}, not {a}", found[0]);
        assert!((found[1] - b).abs() < 1e-6, "{name}: B = {}, not {b}", found[1]);
    }
}

/// The fire of diamond: n(430.8) − n(686.7), published as 0.044.
#[test]
fn the_fire_of_diamond() {
    let diamond = medium("diamond");
    let fire = n(&diamond, 0.4308) - n(&diamond, 0.6867);
    assert!((fire - 0.0444).abs() < 0.5e-4, "{fire}");
}

/// A many-term Cauchy fit keeps a Sellmeier glass to 3e-5 in the visible (what is left is the
/// infrared term, which powers of 1/λ² cannot follow), and its Abbe number to 0.1.
#[test]
fn sellmeier_to_cauchy() {
    let glass = medium("N-BK7");
    let law = |um: f64| Ok(n(&glass, um));
    let (terms, error) = gonio::medium::fit_cauchy(5, (0.38, 0.78), law).unwrap();
    assert!(error < 3e-5, "{error:e}");
    let formula = Formula::cauchy(&terms).unwrap();
    let (a, b) = (Abbe::of(AbbeLines::HeliumD, |um| formula.index(um)), 64.1673);
    assert!((a.number - b).abs() < 0.1, "{}", a.number);
}

/// k of water: Pope & Fry in the visible, continuous at the joins, positive everywhere.
#[test]
fn extinction_of_water() {
    let water = medium("water");
    let k = |nm: f64| water.index(nm / 1e9).unwrap().im;
    // a(λ) of Pope & Fry, Table 3: 0.00663, 0.0204, 0.340, 0.624 per metre.
    for (nm, per_metre) in [(400.0, 0.00663), (500.0, 0.0204), (650.0, 0.340), (700.0, 0.624)] {
        let found = 4.0 * std::f64::consts::PI * k(nm) / (nm * 1e-9);
        // k is scaled by the density at 20 °C over that at 22 °C.
        assert!((found / per_metre - 1.0).abs() < 1e-3, "{nm} nm: {found}");
    }
    let mut before = k(200.0);
    for i in 1..=17000 {
        let nm = 200.0 + f64::from(i) * 0.1;
        let here = k(nm);
        assert!(here > 0.0 && (here / before).ln().abs() < 0.05, "{nm}: {before} to {here}");
        before = here;
    }
}
