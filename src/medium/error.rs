//! What went wrong with a medium, and the words of such messages.

use crate::fault::{Blame, Fault};
use crate::math::digits::to_digits;
use num_complex::Complex64;
use std::path::{Path, PathBuf};

/// What went wrong with a medium: the field or file, the value, and what is accepted.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum MediumError {
    /// Numbers are nanometres with as many digits as tell them apart.
    #[error("wavelength {wavelength} nm is outside the data of {name} ({range}){hint}")]
    OutOfRange { name: String, wavelength: String, range: String, hint: String },
    #[error("{field} = {value}: {accepted}")]
    Invalid { field: String, value: String, accepted: String },
    #[error("{}{}: {message}", path.display(), line.map(|l| format!(", line {l}")).unwrap_or_default())]
    File { path: PathBuf, line: Option<usize>, message: String },
    /// Data of the extinction coefficient alone make no medium.
    #[error("{}: the file holds no n (only k): give n by another file or a host medium", path.display())]
    OnlyExtinction { path: PathBuf },
    #[error(
        "unknown medium \"{name}\"{}; gonio material --list shows all names",
        nearest.as_ref().map(|n| format!(", did you mean \"{n}\"?")).unwrap_or_default()
    )]
    Unknown { name: String, nearest: Option<String> },
}

impl Blame for MediumError {
    fn fault(&self) -> Fault {
        Fault::Input
    }
}

pub(super) fn invalid(field: &str, value: impl ToString, accepted: &str) -> MediumError {
    MediumError::Invalid {
        field: field.into(),
        value: value.to_string(),
        accepted: accepted.into(),
    }
}

/// An error about a file.
pub(super) fn file_error(
    path: &Path,
    line: Option<usize>,
    message: impl Into<String>,
) -> MediumError {
    MediumError::File { path: path.to_path_buf(), line, message: message.into() }
}

/// Refuses wavelengths (metres) outside a range, with a slack of a part in 10¹² for rounding.
pub(super) fn check_range(
    name: &str,
    wavelength: f64,
    range: (f64, f64),
) -> Result<(), MediumError> {
    if wavelength >= range.0 * (1.0 - 1e-12) && wavelength <= range.1 * (1.0 + 1e-12) {
        return Ok(());
    }
    Err(MediumError::OutOfRange {
        name: name.into(),
        wavelength: nanometres(wavelength),
        range: range_text(range),
        hint: String::new(),
    })
}

/// A range of wavelengths (metres) for messages; one row is a range of its own.
pub(super) fn range_text((from, to): (f64, f64)) -> String {
    match from == to {
        true => format!("one row, at {} nm", nanometres(from)),
        false => format!("{} to {} nm", nanometres(from), nanometres(to)),
    }
}

/// What [`is_plausible`] accepts, in words.
pub const PLAUSIBLE_INDEX: &str = "n from 1e-4 to 1e4, k from 0 to 1e4";

/// The index with a k so small that its square is lost in `f64` taken for none: such a k changes nothing,
/// and quotients of its powers would be no numbers.
pub(crate) fn without_trace(index: Complex64) -> Complex64 {
    const TRACE: f64 = 1e-150;
    if index.im < TRACE { index.re.into() } else { index }
}

/// True for an index that any material may have between X-rays and microwaves (metals reach some
/// hundreds in the far infrared). Beyond, squares and powers of it overflow.
pub fn is_plausible(index: Complex64) -> bool {
    (1e-4..=1e4).contains(&index.re) && (0.0..=1e4).contains(&index.im)
}

/// Metres as nanometres for messages: 400 reads better than 400.00000000000006.
pub(super) fn nanometres(metres: f64) -> String {
    digits(metres * 1e9)
}

/// A number for messages, to 13 digits: rounding does not show, and values that differ do.
pub(super) fn digits(value: f64) -> String {
    let rounded = to_digits(value, 13);
    match rounded.abs() {
        size if size == 0.0 || (1e-5..1e15).contains(&size) => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two numbers that differ enough to be refused never read alike.
    #[test]
    fn messages_show_the_digits_that_differ() {
        let message = check_range("x", 700.0000001e-9, (300e-9, 700e-9)).unwrap_err().to_string();
        assert_eq!(message, "wavelength 700.0000001 nm is outside the data of x (300 to 700 nm)");
        assert_eq!(nanometres(400e-9), "400");
        assert_eq!(digits(1.5e-9), "1.5e-9");
    }
}
