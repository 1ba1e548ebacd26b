//! Numbers as they are printed: a conversion of units leaves noise in the last digits, which does
//! not belong into tables, names and hashes.
//!
//! ```
//! use gonio::math::digits::{nm, to_digits};
//!
//! assert_eq!(nm(550e-9), 550.0);
//! assert_eq!(to_digits(0.1 + 0.2, 12), 0.3);
//! ```

/// `value` rounded to so many significant decimal digits.
pub fn to_digits(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits - 1).parse().unwrap_or(value)
}

/// Metres to nanometres, free of the noise that the division leaves in the last digits.
pub fn nm(metres: f64) -> f64 {
    tidy(metres * 1e9)
}

/// Radians to degrees, tidied likewise.
pub fn degree(radians: f64) -> f64 {
    tidy(radians.to_degrees())
}

/// Round to 13 significant digits where that changes the last bits only.
pub fn tidy(value: f64) -> f64 {
    let rounded = to_digits(value, 13);
    if (rounded - value).abs() <= 4.0 * f64::EPSILON * value.abs() { rounded } else { value }
}

/// Keep `bits` bits of the mantissa, rounding half to even; NaN and infinities stay.
pub fn round_mantissa(value: f32, bits: u8) -> f32 {
    let drop = 23 - u32::from(bits.clamp(1, 23));
    if drop == 0 || !value.is_finite() {
        return value;
    }
    let raw = value.to_bits();
    let half = (1u32 << (drop - 1)) - 1 + ((raw >> drop) & 1);
    f32::from_bits((raw + half) & !((1u32 << drop) - 1))
}

#[cfg(test)]
mod tests {
    use super::{degree, nm, to_digits};

    #[test]
    fn tidied_degrees_are_exact_where_they_can_be() {
        for i in 0..=1800 {
            let exact = f64::from(i) / 10.0;
            assert!((degree(exact.to_radians()) - exact).abs() <= 1e-13 * exact);
        }
        assert_eq!(nm(550.0e-9), 550.0);
    }

    #[test]
    fn noise_goes_and_the_rest_stays() {
        assert_eq!(to_digits(0.1 + 0.2, 13), 0.3);
        assert_eq!(to_digits(1.0 / 3.0, 5), 0.33333);
        assert!(to_digits(f64::NAN, 5).is_nan());
        assert_eq!(to_digits(f64::INFINITY, 5), f64::INFINITY);
    }
}
