//! Files that should be scenes, read whatever they are.

use std::io::Read;
use std::path::Path;

/// Scene files are a few hundred bytes; a larger one was not meant to be one.
const MAX_BYTES: u64 = 4 << 20;

/// The text of a file that should be a scene or a sweep, whatever it is.
pub(crate) fn read_limited(path: &Path) -> std::io::Result<String> {
    let mut text = String::new();
    std::fs::File::open(path)?.take(MAX_BYTES + 1).read_to_string(&mut text)?;
    if text.len() as u64 > MAX_BYTES {
        let message = format!("larger than {} MiB, so not a scene file", MAX_BYTES >> 20);
        return Err(std::io::Error::other(message));
    }
    Ok(text)
}
