//! Numbers as they are printed: a conversion of units leaves noise in the last digits, which does
//! not belong into tables, names and hashes.

/// `value` rounded to so many significant decimal digits.
pub fn to_digits(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits - 1).parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::to_digits;

    #[test]
    fn noise_goes_and_the_rest_stays() {
        assert_eq!(to_digits(0.1 + 0.2, 13), 0.3);
        assert_eq!(to_digits(1.0 / 3.0, 5), 0.33333);
        assert!(to_digits(f64::NAN, 5).is_nan());
        assert_eq!(to_digits(f64::INFINITY, 5), f64::INFINITY);
    }
}
