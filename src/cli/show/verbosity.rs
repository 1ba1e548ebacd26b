//! How much a command says beside its result: `--quiet` nothing but errors, `--verbose` each step too.

use std::sync::atomic::{AtomicU8, Ordering};

/// From the least to the most.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verbosity {
    /// Errors alone.
    Quiet,
    /// Notes, and bars where a terminal shows them.
    Usual,
    /// Steps with their times, too.
    Verbose,
}

static SAID: AtomicU8 = AtomicU8::new(Verbosity::Usual as u8);

/// For the rest of the run.
pub fn set(quiet: bool, verbose: bool) {
    let verbosity = match (quiet, verbose) {
        (true, _) => Verbosity::Quiet,
        (_, true) => Verbosity::Verbose,
        _ => Verbosity::Usual,
    };
    SAID.store(verbosity as u8, Ordering::Relaxed);
}

/// Whether so much is to be said.
pub fn says(what: Verbosity) -> bool {
    SAID.load(Ordering::Relaxed) >= what as u8
}
