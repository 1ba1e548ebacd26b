//! Notes to the user about what was read, on stderr, each once in a run.

use std::collections::HashSet;
use std::sync::Mutex;

/// Prints those notes that have not been printed yet.
pub fn tell(notes: impl IntoIterator<Item = String>) {
    static TOLD: Mutex<Option<HashSet<String>>> = Mutex::new(None);
    let mut told = TOLD.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let told = told.get_or_insert_default();
    for note in notes {
        if told.insert(note.clone()) {
            eprintln!("note: {note}");
        }
    }
}
