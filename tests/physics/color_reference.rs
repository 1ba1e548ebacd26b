//! Colours against published numbers and an independent program.
//!
//! `tests/data/cie_check_values.json`: colour-science 0.4.7 (values by the CIE and IEC 61966-2-1
//! where they are published); `tests/data/colorchecker_ohta_reflectance.csv`: Ohta 1997.

use gonio::color::{
    ColorError, ColorWeights, Illuminant, Observer, encode_srgb, illuminant_white, spectrum_to_xyz,
    srgb_to_xyz, xyz_to_linear_srgb, xyz_to_srgb,
};
use serde_json::Value;

fn checks() -> Value {
    let text = include_str!("../data/cie_check_values.json");
    serde_json::from_str::<Value>(text).unwrap()["checks"].clone()
}

fn triple(value: &Value) -> [f64; 3] {
    std::array::from_fn(|i| value[i].as_f64().unwrap())
}

fn assert_close(got: [f64; 3], expected: [f64; 3], bound: f64, what: &str) {
    for c in 0..3 {
        assert!((got[c] - expected[c]).abs() <= bound, "{what}: {got:?} is not {expected:?}");
    }
}

#[test]
fn matching_functions_sum_as_published() {
    let mut sum = [0.0; 3];
    for nm in 360..=830 {
        let m = Observer::Cie1931.matching(nm as f64 * 1e-9);
        (0..3).for_each(|c| sum[c] += m[c]);
    }
    assert_close(sum, triple(&checks()["sum_xyz_1nm_360_830"]), 1e-11, "sums at 1 nm");
}

#[test]
fn whites_are_those_of_the_reference() {
    let checks = checks();
    let white = illuminant_white(Illuminant::D65, Observer::Cie1931);
    let expected = triple(&checks["D65_1nm_linear_interp_360_780_XYZ_Y100"]);
    assert_close(white.map(|v| 100.0 * v), expected, 1e-10, "D65");
    let sum: f64 = white.iter().sum();
    for (c, name) in [(0, 0.3127), (1, 0.3290)] {
        let xy = white[c] / sum;
        assert!((xy - checks["xy"][c].as_f64().unwrap()).abs() < 1e-12);
        assert!((xy - name).abs() < 5e-5, "published chromaticity of D65");
    }
    for kelvin in ["2856", "5778", "6500"] {
        let temperature: f64 = kelvin.parse().unwrap();
        let expected = triple(&checks["blackbody_XYZ_Y1"][kelvin]);
        // The reference program has c2 = 1.4388e-2 m K: with it, every digit comes out.
        let axis: Vec<f64> = (360..=830).map(|nm| nm as f64 * 1e-9).collect();
        let planck = axis.iter().map(|w| w.powi(-5) / (1.4388e-2 / (w * temperature)).exp_m1());
        let weights = ColorWeights::with_step(&axis, Illuminant::EqualEnergy, Observer::Cie1931, 1);
        let xyz = weights.xyz(planck);
        assert_close(xyz.map(|v| v / xyz[1]), expected, 1e-12, kelvin);
        // This program's lamp has the exact SI value, 1.438776877e-2 m K.
        let got = illuminant_white(Illuminant::BlackBody { temperature }, Observer::Cie1931);
        assert_close(got, expected, 2e-5, kelvin);
    }
}

fn patch(name: &str) -> (Vec<f64>, Vec<f64>) {
    let text = include_str!("../data/colorchecker_ohta_reflectance.csv");
    let mut lines = text.lines().filter(|l| !l.starts_with('#'));
    let column = lines.next().unwrap().split(',').position(|c| c == name).unwrap();
    lines
        .map(|line| {
            let cells: Vec<f64> = line.split(',').map(|c| c.parse().unwrap()).collect();
            (cells[0] * 1e-9, cells[column])
        })
        .unzip()
}

#[test]
fn colour_checker_patches_come_out_to_the_last_digit() {
    let checks = checks();
    for name in ["dark skin", "blue sky", "red", "green", "blue", "white 9.5 (.05 D)"] {
        let expected = &checks[format!("ohta {name}")];
        let (wavelengths, values) = patch(name);
        let five = ColorWeights::with_step(&wavelengths, Illuminant::D65, Observer::Cie1931, 5);
        let xyz = five.xyz(values.iter().copied());
        assert_close(xyz, triple(&expected["XYZ_astm308"]), 1e-13, name);
        assert_close(xyz_to_srgb(xyz), triple(&expected["sRGB_gamma"]), 1e-12, name);

        // The 1 nm sum differs from the 5 nm sum by what linear interpolation does.
        let fine =
            spectrum_to_xyz(&wavelengths, &values, Illuminant::D65, Observer::Cie1931).unwrap();
        assert_close(fine, triple(&expected["XYZ_astm308"]), 5e-4, name);
    }
}

#[test]
fn srgb_is_that_of_the_standard() {
    let checks = checks();
    for c in 0..3 {
        let mut unit = [0.0; 3];
        unit[c] = 1.0;
        let (forward, back) = (xyz_to_linear_srgb(unit), srgb_to_xyz(unit));
        for r in 0..3 {
            assert_eq!(forward[r], checks["XYZ_to_sRGB_matrix"][r][c].as_f64().unwrap());
            assert_eq!(back[r], checks["sRGB_to_XYZ_matrix"][r][c].as_f64().unwrap());
        }
    }
    for (linear, encoded) in checks["sRGB_eotf_inverse"].as_object().unwrap() {
        let got = encode_srgb(linear.parse().unwrap());
        assert!((got - encoded.as_f64().unwrap()).abs() < 1e-12, "{linear}: {got}");
    }
    let expected = &checks["docstring_XYZ_to_sRGB [0.20654008,0.12197225,0.05136952]"];
    let got = xyz_to_srgb([0.20654008, 0.12197225, 0.05136952]);
    assert_close(got, triple(expected), 1e-12, "one colour");
}

#[test]
fn irregular_wavelengths_in_any_order_give_the_same_colour() {
    let line = |w: f64| 2.0 + (w - 550e-9) * 3e6;
    let regular: Vec<f64> = (0..69).map(|i| (380.0 + 5.0 * i as f64) * 1e-9).collect();
    let mut odd: Vec<f64> = [720.0, 380.0, 401.0, 437.5, 481.0, 533.3, 590.0, 611.0, 663.0]
        .map(|nm: f64| nm * 1e-9)
        .to_vec();
    let xyz = |axis: &[f64]| {
        let values: Vec<f64> = axis.iter().map(|&w| line(w)).collect();
        spectrum_to_xyz(axis, &values, Illuminant::D65, Observer::Cie1931).unwrap()
    };
    let expected = xyz(&regular);
    assert_close(xyz(&odd), expected, 1e-12, "irregular");
    odd.reverse();
    assert_close(xyz(&odd), expected, 1e-12, "reversed");
}

#[test]
fn spectra_that_say_too_little_are_refused() {
    let ask = |nm: &[f64]| {
        let axis: Vec<f64> = nm.iter().map(|v| v * 1e-9).collect();
        ColorWeights::new(&axis, Illuminant::D65, Observer::Cie1931).unwrap_err()
    };
    assert!(matches!(ask(&[500.0, 550.0, 600.0]), ColorError::NotVisible { .. }));
    assert!(matches!(ask(&[]), ColorError::NotVisible { .. }));
    assert!(matches!(ask(&[400.0, 700.0]), ColorError::Gap { .. }));
    let message = ask(&[500.0, 600.0]).to_string();
    assert!(message.contains("500") && message.contains("420"), "{message}");
    assert!("sun@95".parse::<Illuminant>().is_err());
    assert!("F2".parse::<Illuminant>().unwrap_err().to_string().contains("D65"));
    assert_eq!("D65".parse::<Illuminant>().unwrap(), Illuminant::D65);
}

#[test]
fn sunset_reddens() {
    let redness = |degrees: f64| {
        let sun = Illuminant::SunThroughAir { elevation: degrees.to_radians() };
        let rgb = xyz_to_linear_srgb(illuminant_white(sun, Observer::Cie1931));
        rgb[0] / rgb[2].max(1e-6)
    };
    assert!(redness(2.0) > redness(5.0) && redness(5.0) > redness(30.0));
    assert!(redness(30.0) > redness(90.0) && redness(1.0) > 5.0);
}
