//! What several tests of physics need: angles, numbers from reference files, errors.

use num_complex::Complex64;
use serde_json::Value;

/// Angles in radians from limits and a step in degrees, both limits included.
pub fn angles(from: f64, to: f64, step: f64) -> Vec<f64> {
    let count = ((to - from) / step).round() as usize;
    (0..=count).map(|i| (from + i as f64 * step).to_radians()).collect()
}

/// The list of numbers `key` of a case of a reference file.
pub fn numbers(case: &Value, key: &str) -> Vec<f64> {
    case[key].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

/// Relative L2 error over pairs of found and exact values.
pub fn relative_l2(pairs: impl IntoIterator<Item = (Complex64, Complex64)>) -> f64 {
    let (mut error, mut norm) = (0.0, 0.0);
    for (found, exact) in pairs {
        error += (found - exact).norm_sqr();
        norm += exact.norm_sqr();
    }
    (error / norm).sqrt()
}
