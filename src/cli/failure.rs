//! Why a command ends: words for people, an exit code for programs.

use gonio::fault::{Blame, FAILED, WRONG_INPUT, in_words};
use std::fmt::Display;

/// What a command returns.
pub type Result<T, E = Failure> = std::result::Result<T, E>;

/// The end of a command. Any error of the library becomes one, with the exit code that its fault has.
#[derive(Debug)]
pub struct Failure {
    words: String,
    code: u8,
}

impl Failure {
    /// Wrong input that only the command line knows of.
    pub fn usage(words: impl Into<String>) -> Self {
        Self { words: words.into(), code: WRONG_INPUT }
    }

    /// Something that failed while running.
    pub fn run(words: impl Into<String>) -> Self {
        Self { words: words.into(), code: FAILED }
    }

    /// What was being done.
    pub fn while_doing(mut self, what: impl Display) -> Self {
        self.words = format!("{what}: {}", self.words);
        self
    }

    /// For people.
    pub fn words(&self) -> &str {
        &self.words
    }

    /// For the shell.
    pub fn code(&self) -> u8 {
        self.code
    }
}

impl<E: Blame> From<E> for Failure {
    fn from(error: E) -> Self {
        Self { words: in_words(&error), code: error.exit_code() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio::fault::Fault;

    #[derive(Debug, thiserror::Error)]
    #[error("{words}")]
    struct Wrong {
        words: &'static str,
        source: std::io::Error,
    }

    impl Blame for Wrong {
        fn fault(&self) -> Fault {
            Fault::Input
        }
    }

    /// A cause is told once, and the code is that of the fault, wherever the error comes from.
    #[test]
    fn words_and_codes() {
        let of = |words| Failure::from(Wrong { words, source: std::io::Error::other("disk") });
        assert_eq!((of("table").words(), of("table").code()), ("table: disk", 2));
        assert_eq!(of("disk of table").words(), "disk of table");
        let failure = Failure::from(std::io::Error::other("full")).while_doing("cannot write x");
        assert_eq!((failure.words(), failure.code()), ("cannot write x: full", 1));
    }
}
