//! Phase tables as HDF5 files that are also netCDF-4; the schema follows.
//!
//! ```
//! use gonio::hdf5::{WriteOptions, read, write};
//! use gonio::scene::{Scene, SceneFile, SceneText};
//! use gonio::simulate;
//!
//! let text = r#"
//! [particle]
//! shape = "sphere"
//! radius_um = 5
//! [light]
//! wavelengths_nm = [550]
//! [table]
//! theta_deg = { from = 0, to = 180, count = 91 }
//! azimuth_deg = [0]
//! "#;
//! let text = SceneText::parse("example", text.into())?;
//! let scene = Scene::from_text(text, &SceneFile::default())?;
//! let table = simulate::table(&scene)?;
//! let path = std::env::temp_dir().join(format!("gonio-doc-{}.h5", std::process::id()));
//! write(&path, &table, WriteOptions::default())?;
//! assert_eq!(read(&path)?.slabs[0].values, table.slabs[0].values);
//! std::fs::remove_file(&path)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![doc = include_str!("../../docs/file.md")]

mod codec;
pub(crate) mod diagram;
mod ffi;
mod file;
pub(crate) mod format;
mod guard;
mod netcdf;
mod output;
mod read;
mod space;
mod sweep_axis;
mod write;

pub use netcdf::{NetcdfFile, NetcdfValues, NetcdfVariable, write_netcdf};
pub use output::WriteOptions;
pub use read::sweep::SweepReader;
pub use read::table::{TableReader, read};
pub use sweep_axis::{AxisValues, SweepAxis, SweepCoordinate, position_of};
pub use write::sweep::SweepWriter;
pub use write::table::{TableWriter, write};

use crate::fault::{Blame, Fault};
pub use crate::math::bytes::decimal_bytes;
use crate::phase_table::InvalidTable;
use std::path::{Path, PathBuf};

/// What went wrong with a table or its file: which one, what, and what would do.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum TableError {
    #[error("{}: the file exists; choose another name or ask to overwrite it (--overwrite)", path.display())]
    Exists { path: PathBuf },
    #[error("{}: the table needs up to {} but the disk has {} free; take fewer angles or wavelengths",
        path.display(), decimal_bytes(*needed), decimal_bytes(*available))]
    NoSpace { path: PathBuf, needed: u64, available: u64 },
    #[error("{}: {source}", path.display())]
    Io { path: PathBuf, source: std::io::Error },
    #[error("{}: cannot be written: {message}", path.display())]
    Write { path: PathBuf, message: String },
    /// The same, where the disk has no room or the quota none left.
    #[error("{}: cannot be written: {message}", path.display())]
    DiskFull { path: PathBuf, message: String },
    #[error("{}: not a phase table: {message}", path.display())]
    Foreign { path: PathBuf, message: String },
    #[error("{}: damaged: {message}", path.display())]
    Damaged { path: PathBuf, message: String },
    #[error("{field} = {value}: {accepted}")]
    Invalid { field: String, value: String, accepted: String },
    #[error(transparent)]
    Table(#[from] InvalidTable),
}

impl Blame for TableError {
    fn fault(&self) -> Fault {
        match self {
            TableError::Exists { .. }
            | TableError::NoSpace { .. }
            | TableError::Foreign { .. }
            | TableError::Invalid { .. } => Fault::Input,
            TableError::Io { .. }
            | TableError::Write { .. }
            | TableError::DiskFull { .. }
            | TableError::Damaged { .. }
            | TableError::Table(_) => Fault::Run,
        }
    }
}

fn damaged(path: &Path, message: &str) -> TableError {
    TableError::Damaged { path: path.to_path_buf(), message: message.into() }
}

fn foreign(path: &Path, message: &str) -> TableError {
    TableError::Foreign { path: path.to_path_buf(), message: message.into() }
}

fn invalid(field: &str, value: impl ToString, accepted: &str) -> TableError {
    TableError::Invalid { field: field.into(), value: value.to_string(), accepted: accepted.into() }
}
