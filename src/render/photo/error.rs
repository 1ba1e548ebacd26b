//! What is wrong with a photograph.

use crate::fault::{Blame, Fault};

/// Why a photograph cannot be used.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum PhotoError {
    #[error("the photograph cannot be read: {0}")]
    Unread(String),
    #[error(
        "the photograph's EXIF: {field} = {value}: accepted are {accepted}; {flag} says it in its place"
    )]
    Exif { field: &'static str, value: String, accepted: &'static str, flag: &'static str },
    #[error("the photograph does not tell its {what}: give {flag}")]
    Untold { what: &'static str, flag: &'static str },
    #[error("{field} = {value}: accepted are {accepted}")]
    Invalid { field: &'static str, value: String, accepted: &'static str },
    #[error("{0}")]
    NoFit(String),
}

impl Blame for PhotoError {
    fn fault(&self) -> Fault {
        Fault::Input
    }
}
