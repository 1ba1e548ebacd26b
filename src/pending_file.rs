//! Files that appear only when they are whole.
//!
//! A result is written beside its final place under a temporary name, flushed to the disk and
//! renamed. Whatever happens before the rename (an error, Ctrl-C, a killed process, a full disk),
//! nothing lies under the final name. All pending files of the process are registered, so that a
//! handler of signals can remove them.
//!
//! ```
//! use gonio::pending_file::{PendingFile, write_whole};
//!
//! let folder = std::env::temp_dir();
//! let path = folder.join(format!("pending-{}.txt", std::process::id()));
//! let pending = PendingFile::create(&path)?;
//! std::fs::write(pending.path(), "half of it")?;
//! drop(pending);
//! assert!(!path.exists());
//! write_whole(&path, b"all of it")?;
//! assert_eq!(std::fs::read(&path)?, b"all of it");
//! std::fs::remove_file(&path)?;
//! # Ok::<(), std::io::Error>(())
//! ```

use std::ffi::OsString;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU32, Ordering};

/// Whether there are files at all: browsers have none. Whoever reads one asks first, so that what would make sense
/// of it is left out where nothing can be read.
pub(crate) const FILES: bool = !cfg!(all(target_family = "wasm", target_os = "unknown"));

static PENDING: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());
static COUNTER: AtomicU32 = AtomicU32::new(0);

/// A file under its temporary name; removed when dropped without [`PendingFile::commit`].
#[derive(Debug)]
pub struct PendingFile {
    temporary: PathBuf,
    target: PathBuf,
}

impl PendingFile {
    /// Reserve a temporary name beside `target` and create it, empty.
    ///
    /// # Errors
    /// Those of creating a file in the folder of `target`.
    pub fn create(target: &Path) -> io::Result<PendingFile> {
        let temporary = temporary_name(target)?;
        register(temporary.clone());
        let pending = PendingFile { temporary, target: target.to_path_buf() };
        File::create(&pending.temporary)?;
        Ok(pending)
    }

    /// Where to write.
    pub fn path(&self) -> &Path {
        &self.temporary
    }

    /// Flush to the disk and rename to the final name.
    ///
    /// # Errors
    /// Those of flushing and renaming; the temporary file is then removed.
    pub fn commit(self) -> io::Result<()> {
        File::open(&self.temporary)?.sync_all()?;
        fs::rename(&self.temporary, &self.target)?;
        unregister(&self.temporary);
        // The rename itself must survive a power cut; folders cannot be flushed everywhere.
        if let Ok(folder) = File::open(folder_of(&self.target)) {
            let _ = folder.sync_all();
        }
        Ok(())
    }
}

impl Drop for PendingFile {
    fn drop(&mut self) {
        if unregister(&self.temporary) {
            let _ = fs::remove_file(&self.temporary);
        }
    }
}

/// Write `bytes` to `target`, whole or not at all.
///
/// # Errors
/// Those of creating, writing, flushing and renaming.
pub fn write_whole(target: &Path, bytes: &[u8]) -> io::Result<()> {
    let pending = PendingFile::create(target)?;
    fs::write(pending.path(), bytes)?;
    pending.commit()
}

/// Remove every pending file of this process; for handlers of signals, just before exit.
pub fn remove_all_pending() {
    // A panic while the lock was held leaves the list itself intact.
    let mut pending = PENDING.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    for path in pending.drain(..) {
        let _ = fs::remove_file(path);
    }
}

fn register(path: PathBuf) {
    PENDING.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).push(path);
}

/// True if the path was still registered.
fn unregister(path: &Path) -> bool {
    let mut pending = PENDING.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let before = pending.len();
    pending.retain(|other| other != path);
    pending.len() < before
}

fn folder_of(target: &Path) -> &Path {
    match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// `.NAME.PID-COUNT.tmp` in the folder of the target: unique in the process and between processes.
fn temporary_name(target: &Path) -> io::Result<PathBuf> {
    let name = target.file_name().ok_or_else(|| {
        io::Error::new(io::ErrorKind::InvalidInput, "the path does not name a file")
    })?;
    let count = COUNTER.fetch_add(1, Ordering::Relaxed);
    let mut temporary = OsString::from(".");
    temporary.push(name);
    temporary.push(format!(".{}-{count}.tmp", std::process::id()));
    Ok(folder_of(target).join(temporary))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<OsString> {
        let mut names: Vec<_> =
            fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        names
    }

    #[test]
    fn nothing_under_the_final_name_until_commit() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("out.bin");
        let pending = PendingFile::create(&target).unwrap();
        fs::write(pending.path(), b"half").unwrap();
        assert!(!target.exists() && pending.path().exists());
        pending.commit().unwrap();
        assert_eq!(fs::read(&target).unwrap(), b"half");
        assert_eq!(names(folder.path()), ["out.bin"]);
    }

    #[test]
    fn dropped_file_is_removed_and_an_older_one_stays() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("out.bin");
        write_whole(&target, b"old").unwrap();
        drop(PendingFile::create(&target).unwrap());
        assert_eq!(names(folder.path()), ["out.bin"]);
        assert_eq!(fs::read(&target).unwrap(), b"old");
    }

    #[test]
    fn a_folder_that_is_missing_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        assert!(PendingFile::create(&folder.path().join("no/where.bin")).is_err());
        assert!(PendingFile::create(Path::new("/")).is_err());
    }
}
