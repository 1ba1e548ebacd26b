//! Notes to the user on stderr: about what was read, each once in a run; and, with `--verbose`, each step.

use super::verbosity::{Verbosity, says};
use std::collections::HashSet;
use std::path::Path;
use std::sync::{LazyLock, Mutex};
use std::time::Instant;

/// Prints those notes that have not been printed yet.
pub fn tell(notes: impl IntoIterator<Item = String>) {
    static TOLD: Mutex<Option<HashSet<String>>> = Mutex::new(None);
    if !says(Verbosity::Usual) {
        return;
    }
    let mut told = TOLD.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let told = told.get_or_insert_default();
    for note in notes {
        if told.insert(note.clone()) {
            eprintln!("note: {note}");
        }
    }
}

static START: LazyLock<Instant> = LazyLock::new(Instant::now);

/// Seconds of steps are counted from here.
pub fn start() {
    LazyLock::force(&START);
}

/// Prints what is done now, with the seconds since the start of the run.
pub fn step(what: impl FnOnce() -> String) {
    if says(Verbosity::Verbose) {
        eprintln!("{:8.2} s  {}", START.elapsed().as_secs_f64(), what());
    }
}

/// Prints that a file is written.
pub fn wrote(path: &Path) {
    step(|| format!("wrote {}", path.display()));
}
