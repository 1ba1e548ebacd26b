//! Whose fault an error is: the input's, which can be put right, or the run's.
//!
//! Every error of this library says so itself, so that a program or a binding need not know the kinds
//! of errors to tell wrong input from a full disk.
//!
//! ```
//! use gonio::fault::{Blame, Fault};
//! use gonio::medium::MediumSpec;
//!
//! let error = MediumSpec::parse("watr").and_then(|spec| spec.resolve(".".as_ref())).unwrap_err();
//! assert_eq!((error.fault(), error.exit_code()), (Fault::Input, 2));
//! ```

use std::error::Error;

/// Who is to blame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// What was asked for: it fails until the input is changed.
    Input,
    /// What happened while it was done: a disk, memory, numbers.
    Run,
}

/// Errors that know whose fault they are.
pub trait Blame: Error {
    /// Whether the input or the run is at fault.
    fn fault(&self) -> Fault;

    /// Exit code for a program that ends with this error: 2 for wrong input, 1 for the run; errors of
    /// batches tell more.
    fn exit_code(&self) -> u8 {
        match self.fault() {
            Fault::Input => WRONG_INPUT,
            Fault::Run => FAILED,
        }
    }
}

/// Exit code: failed while running.
pub const FAILED: u8 = 1;
/// Exit code: the input was wrong (clap's own, too).
pub const WRONG_INPUT: u8 = 2;

/// The error and its causes as one line, without those that the message tells already.
///
/// ```
/// #[derive(Debug, thiserror::Error)]
/// #[error("cannot read t.h5")]
/// struct Unread(#[source] std::io::Error);
///
/// let error = Unread(std::io::Error::other("disk"));
/// assert_eq!(gonio::fault::in_words(&error), "cannot read t.h5: disk");
/// ```
pub fn in_words(error: &dyn Error) -> String {
    let mut told = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        let words = error.to_string();
        if !told.contains(&words) {
            told = format!("{told}: {words}");
        }
        cause = error.source();
    }
    told
}

impl Blame for std::io::Error {
    fn fault(&self) -> Fault {
        Fault::Run
    }
}

impl Blame for serde_json::Error {
    fn fault(&self) -> Fault {
        Fault::Run
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_follow_the_fault() {
        #[derive(Debug, thiserror::Error)]
        #[error("wrong")]
        struct Wrong;
        impl Blame for Wrong {
            fn fault(&self) -> Fault {
                Fault::Input
            }
        }
        assert_eq!(Wrong.exit_code(), WRONG_INPUT);
        assert_eq!(std::io::Error::other("disk").exit_code(), FAILED);
    }
}
