//! What the ending of a file's name tells.

use std::path::Path;

/// Whether a path ends in one of these, in small letters or capitals.
pub(in crate::medium) fn has_ending(path: &Path, endings: &[&str]) -> bool {
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_lowercase();
    endings.contains(&ending.as_str())
}
