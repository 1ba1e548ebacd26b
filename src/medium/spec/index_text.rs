//! An index as people type it: `1.333`, `1.333+0.001`, `1.5+0.01i`, `1.5+0.01j`, `1.5+i0.01`,
//! `(1.5+0.01j)`.
//!
//! The convention is n + ik with k > 0 for absorption; other programs write n − ik, which is told
//! rather than turned round.

use crate::medium::error::{MediumError, PLAUSIBLE_INDEX, invalid, is_plausible, without_trace};
use num_complex::Complex64;

/// Reads an index; errors say what is accepted.
///
/// ```
/// # use gonio::medium::parse_index;
/// assert_eq!(parse_index("1.5+0.01j")?.im, 0.01);
/// assert!(parse_index("1.5-0.01j").unwrap_err().to_string().contains("1.5+0.01"));
/// # Ok::<(), gonio::medium::MediumError>(())
/// ```
pub fn parse_index(text: &str) -> Result<Complex64, MediumError> {
    const ACCEPTED: &str = "N, N+K or N+Ki, as in 1.333+0.001 (n + ik, k > 0 absorbs)";
    let wrong = || invalid("index", format!("\"{text}\""), ACCEPTED);
    let bare = text.trim();
    let bare = bare.strip_prefix('(').and_then(|t| t.strip_suffix(')')).unwrap_or(bare);
    let bare: String = bare.chars().filter(|c| !c.is_whitespace()).collect();
    // A sign after the first character, unless it belongs to an exponent or to K itself (1.5+-2).
    let split = bare
        .char_indices()
        .skip(1)
        .find(|&(i, c)| (c == '+' || c == '-') && !bare[..i].ends_with(['e', 'E']))
        .map(|(i, _)| i);
    let number = |word: &str| word.parse::<f64>().ok().filter(|v| v.is_finite()).ok_or_else(wrong);
    let (n, k) = match split {
        None => (number(&bare)?, 0.0),
        Some(i) => {
            let (n, rest) = bare.split_at(i);
            let unit = ['i', 'j'];
            let (sign, size) = rest.split_at(1);
            let size = match size.strip_suffix(unit) {
                Some(size) => size,
                None => size.strip_prefix(unit).unwrap_or(size),
            };
            let k = number(size.strip_prefix('*').or(size.strip_suffix('*')).unwrap_or(size))?;
            (number(n)?, if sign == "-" { -k } else { k })
        }
    };
    if k < 0.0 {
        let accepted = format!(
            "n + ik with k of 0 or more; for an absorbing medium that others write n - ik give {n}+{}",
            -k
        );
        return Err(invalid("index", format!("\"{text}\""), &accepted));
    }
    let index = Complex64::new(n, k);
    if !is_plausible(index) {
        return Err(invalid("index", format!("\"{text}\""), PLAUSIBLE_INDEX));
    }
    Ok(without_trace(index))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spellings() {
        for (text, n, k) in [
            ("1.333", 1.333, 0.0),
            ("1.333+0.001", 1.333, 0.001),
            ("1.333+1e-300", 1.333, 0.0),
            (" 1.5 + 0.01i ", 1.5, 0.01),
            ("(1.5+0.01j)", 1.5, 0.01),
            ("1.5+i0.01", 1.5, 0.01),
            ("1.5+0.01*i", 1.5, 0.01),
            ("1.3e+0+1e-3", 1.3, 1e-3),
            ("1.3+1e-5", 1.3, 1e-5),
            ("1.5-0j", 1.5, 0.0),
        ] {
            assert_eq!(parse_index(text).unwrap(), Complex64::new(n, k), "{text}");
        }
        for (text, expected) in [
            ("1.5-0.01j", "others write n - ik give 1.5+0.01"),
            ("1.5+-0.01", "give 1.5+0.01"),
            ("0+1", "n from 1e-4 to 1e4"),
            ("-1.5", "n from 1e-4 to 1e4"),
            ("1e300", "n from 1e-4 to 1e4"),
            ("", "N, N+K or N+Ki"),
            ("+", "N, N+K or N+Ki"),
            ("1.3+", "N, N+K or N+Ki"),
            ("i", "N, N+K or N+Ki"),
            ("1.5i", "N, N+K or N+Ki"),
            ("nan", "N, N+K or N+Ki"),
            ("1.5+inf", "N, N+K or N+Ki"),
        ] {
            let found = parse_index(text).unwrap_err().to_string();
            assert!(found.contains(expected), "{text}: {found}");
        }
    }
}
