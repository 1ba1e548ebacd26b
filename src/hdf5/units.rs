//! Numbers of a file in its units: without the last bits that a conversion leaves.

use crate::math::digits::to_digits;

/// Radians to degrees, tidied.
pub(super) fn degree(radians: f64) -> f64 {
    tidy(radians.to_degrees())
}

/// Round to 13 significant digits where that changes the last bits only.
pub(super) fn tidy(value: f64) -> f64 {
    let rounded = to_digits(value, 13);
    if (rounded - value).abs() <= 4.0 * f64::EPSILON * value.abs() { rounded } else { value }
}
