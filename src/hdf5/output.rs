//! From a name that is wanted to a file that has it: options, the reserved name beside it, and the
//! last step, which makes the file appear whole or not at all.

use super::file::created::NewFile;
use super::space::available_bytes;
use super::{TableError, invalid};
use crate::pending_file::PendingFile;
use crate::phase_table::variables::schema::Root;
use std::fs::{self, File};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// How a table is stored.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WriteOptions {
    /// Bits of the mantissa to keep (1 … 23); the rest is rounded away and compresses. `None`
    /// keeps every value as computed.
    pub bit_round: Option<u8>,
    /// Replace a file of that name.
    pub overwrite: bool,
    /// Deflate level, 0 (store) … 9.
    pub deflate: u8,
    /// Record the time of creation. Files named by their content must not;
    /// `SOURCE_DATE_EPOCH` is recorded in any case.
    pub dated: bool,
    /// More root attributes.
    pub attributes: Vec<(String, String)>,
}

impl Default for WriteOptions {
    fn default() -> WriteOptions {
        WriteOptions {
            bit_round: None,
            overwrite: false,
            deflate: 1,
            dated: true,
            attributes: Vec::new(),
        }
    }
}

impl WriteOptions {
    /// What the attributes of the file tell of them.
    pub(super) fn root<'a>(&'a self, format: &'a str) -> Root<'a> {
        let Self { bit_round, dated, ref attributes, .. } = *self;
        Root { format, bit_round, dated, attributes }
    }
}

/// A file on its way to its final name.
#[derive(Debug)]
pub struct Output {
    pending: PendingFile,
    target: PathBuf,
    overwrite: bool,
}

impl Output {
    /// Check the name, the room on the disk and the options; reserve a name beside.
    pub fn start(target: &Path, bytes: u64, options: &WriteOptions) -> Result<Output, TableError> {
        if let Some(bits) = options.bit_round.filter(|bits| !(1..=23).contains(bits)) {
            return Err(invalid("bit_round", bits, "1 to 23 bits of the mantissa"));
        }
        if options.deflate > 9 {
            return Err(invalid("deflate", options.deflate, "0 (store) to 9 (smallest)"));
        }
        if !options.overwrite && target.exists() {
            return Err(TableError::Exists { path: target.to_path_buf() });
        }
        if let Some(available) = available_bytes(target.parent().unwrap_or(Path::new(".")))
            && bytes > available
        {
            return Err(TableError::NoSpace { path: target.into(), needed: bytes, available });
        }
        let pending = PendingFile::create(target).map_err(|source| io(target, source))?;
        Ok(Output { pending, target: target.to_path_buf(), overwrite: options.overwrite })
    }

    /// The empty file, under its reserved name.
    pub fn create(&self) -> Result<NewFile, TableError> {
        NewFile::create(self.pending.path(), &self.target)
    }

    /// Flush to the disk and give the file its name. Without `overwrite` a file that appeared
    /// meanwhile wins: a hard link fails where a rename would replace.
    pub fn publish(self) -> Result<(), TableError> {
        let Output { pending, target, overwrite } = self;
        if !overwrite {
            let sync = File::open(pending.path()).and_then(|file| file.sync_all());
            sync.map_err(|source| io(&target, source))?;
            match fs::hard_link(pending.path(), &target) {
                Ok(()) => return Ok(()),
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {
                    return Err(TableError::Exists { path: target });
                }
                // The disk knows no links; a look must do.
                Err(_) if target.exists() => return Err(TableError::Exists { path: target }),
                Err(_) => {}
            }
        }
        pending.commit().map_err(|source| io(&target, source))
    }
}

fn io(path: &Path, source: std::io::Error) -> TableError {
    TableError::Io { path: path.to_path_buf(), source }
}
