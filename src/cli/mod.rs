//! The command line: one file per command.

pub mod plot;

/// Wrong input: the program ends with exit code 2.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct UsageError(pub String);
