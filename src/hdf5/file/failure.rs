//! What the HDF5 library says went wrong, as an error that names the file.
//!
//! On reading a refusal means a damaged file; on writing it is the disk that refuses.

use crate::hdf5::{TableError, damaged};
use std::io::ErrorKind;
use std::path::Path;

/// The failure of reading `path`.
pub fn unreadable(path: &Path, error: &hdf5::Error) -> TableError {
    damaged(path, &Reason::of(error).message)
}

/// The failure of writing `path`: a full disk is told from others.
pub fn unwritable(path: &Path, error: &hdf5::Error) -> TableError {
    let Reason { message, system } = Reason::of(error);
    let path = path.to_path_buf();
    match system {
        Some(ErrorKind::StorageFull | ErrorKind::QuotaExceeded) => {
            TableError::DiskFull { path, message }
        }
        _ => TableError::Write { path, message },
    }
}

/// The library's words, with the system's reason (`No space left on device`) where it knows one.
struct Reason {
    message: String,
    system: Option<ErrorKind>,
}

impl Reason {
    fn of(error: &hdf5::Error) -> Reason {
        let Some(stack) = error.stack() else {
            return Reason { message: error.to_string(), system: None };
        };
        let message = match stack.detail() {
            Some(detail) if !detail.is_empty() => format!("{} ({detail})", stack.description()),
            _ => stack.description().to_string(),
        };
        let system = stack.iter().rev().find_map(|frame| system_reason(frame.desc()));
        Reason { message, system }
    }
}

/// The system's error in a line of the library: `…, errno = 28, error message = '…'`.
fn system_reason(line: &str) -> Option<ErrorKind> {
    let (_, rest) = line.split_once("errno = ")?;
    let digits = rest.split(|c: char| !c.is_ascii_digit()).next()?;
    Some(std::io::Error::from_raw_os_error(digits.parse().ok()?).kind())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn full_disks_are_known_by_the_systems_number() {
        let line = "file write failed: time = Sat, filename = 'errno', file descriptor = 5, errno = \
                    28, error message = 'No space left on device', buf = 0x7f";
        assert_eq!(system_reason(line), Some(ErrorKind::StorageFull));
        assert_eq!(
            system_reason("errno = 122, error message = ''"),
            Some(ErrorKind::QuotaExceeded)
        );
        assert_eq!(system_reason("unable to flush file"), None);
        assert_eq!(system_reason("errno = , error"), None);
    }

    #[test]
    fn the_library_is_quoted() {
        let missing = hdf5::File::open("/there/is/no/such/file.h5").unwrap_err();
        let path = Path::new("table.h5");
        let message = unwritable(path, &missing).to_string();
        assert!(message.starts_with("table.h5: cannot be written: H5Fopen()"), "{message}");
        assert!(message.contains("No such file or directory"), "{message}");
        assert!(matches!(unreadable(path, &missing), TableError::Damaged { .. }));
        let own = unwritable(path, &hdf5::Error::Internal("own words".into()));
        assert_eq!(own.to_string(), "table.h5: cannot be written: own words");
    }
}
