//! Identifiers of the HDF5 C library, which close themselves, and what the library says went wrong.
//!
//! [`owned`], [`done`] and [`failure`] are for reading, where a refusal means a damaged file.
//! Writing has its own, for there it is the disk that refuses.

use super::{TableError, damaged};
use hdf5::sync::sync;
use hdf5_sys::h5::herr_t;
use hdf5_sys::h5i::hid_t;
use std::path::Path;

/// An open object of the library.
#[derive(Debug)]
pub(super) struct Id {
    pub id: hid_t,
    close: unsafe extern "C" fn(hid_t) -> herr_t,
}

impl Id {
    /// What the library returned; `None` where it refused. `close` is the call that closes it.
    pub fn new(id: hid_t, close: unsafe extern "C" fn(hid_t) -> herr_t) -> Option<Id> {
        (id >= 0).then_some(Id { id, close })
    }
}

impl Drop for Id {
    fn drop(&mut self) {
        // SAFETY: the identifier is valid until here and closed once.
        sync(|| unsafe { (self.close)(self.id) });
    }
}

/// The object that the library returned, to be closed by `close`.
pub(super) fn owned(
    path: &Path,
    id: hid_t,
    close: unsafe extern "C" fn(hid_t) -> herr_t,
) -> Result<Id, TableError> {
    Id::new(id, close).ok_or_else(|| failure(path))
}

pub(super) fn done(path: &Path, status: herr_t) -> Result<(), TableError> {
    if status < 0 { Err(failure(path)) } else { Ok(()) }
}

pub(super) fn failure(path: &Path) -> TableError {
    damaged(path, &last_reason())
}

/// The library's last error, with the system's reason where it gives one.
pub(super) fn last_reason() -> String {
    match hdf5::Error::query() {
        Ok(error) => library_message(&error),
        Err(_) => "the HDF5 library gives no reason".into(),
    }
}

/// What the HDF5 library says, with the system's reason (`No space left on device`) where it knows.
fn library_message(error: &hdf5::Error) -> String {
    match error.stack() {
        Some(stack) => match stack.detail() {
            Some(detail) if !detail.is_empty() => format!("{} ({detail})", stack.description()),
            _ => stack.description().to_string(),
        },
        None => error.to_string(),
    }
}
