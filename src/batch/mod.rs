//! Batches: one table per point of a sweep, on one machine or many.
//!
//! A sweep file is a scene file in which any value under `[particle]`, the sun's elevation under
//! `[light]` or any value under `[model]` may be a list or a range. [`BatchPlan`] turns it into one
//! line per table; each line is all that a machine needs to compute that table (`shard`), and its
//! id is a hash of the physics and of the file format, so that equal work has equal names. Shards
//! are complete files or none, which makes resuming the same as running again; [`merge`] puts them
//! into one file in the order of the plan, whatever the order in which they were computed.
//!
//! ```
//! use gonio::batch::{BatchPlan, Sweep};
//!
//! let sweep = "
//! [particle]
//! shape = \"sphere\"
//! radius_um = [5, 10, 20]
//! [light]
//! sun_elevation_deg = [0, 30]
//! ";
//! let plan = BatchPlan::from_sweep(&Sweep::parse(sweep)?)?;
//! assert_eq!(plan.tables.len(), 6);
//! # Ok::<(), gonio::batch::BatchError>(())
//! ```

mod merge;
mod plan;
mod range;
mod run;
mod shard;
mod sweep;

pub use merge::merge;
pub use plan::{BatchPlan, PlannedTable, Selection};
pub use run::{Event, run};
pub use shard::{Outcome, Shard, ShardStatus, compute};
pub use sweep::{Axis, Sweep};

use crate::fault::{Blame, FAILED, Fault, WRONG_INPUT};
use crate::hdf5::TableError;
use crate::scene::{SceneError, human_bytes};
use crate::series::mean::MeanError;
use crate::simulate::SimulateError;
use std::path::PathBuf;

/// What went wrong with a batch.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum BatchError {
    #[error("{}: {message}", path.display())]
    Plan { path: PathBuf, message: String },
    #[error("{field} = {value}: {accepted}")]
    Invalid { field: String, value: String, accepted: String },
    #[error(
        "{missing} of {total} tables are not computed yet (first missing: {first}); run the batch \
         again, or merge with --allow-missing"
    )]
    Missing { missing: usize, total: usize, first: String },
    #[error(
        "{id}: needs about {} of memory, the limit is {}; take fewer angles, or raise --memory-limit",
        human_bytes(*needed), human_bytes(*limit)
    )]
    Memory { id: String, needed: u64, limit: u64 },
    #[error("{id}: {files} changed since the plan was made; make the plan again")]
    Changed { id: String, files: String },
    #[error("{id}: not a finite number in the phase function at {wavelength_nm} nm")]
    Numerical { id: String, wavelength_nm: f64 },
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Simulate(#[from] SimulateError),
    #[error(transparent)]
    Table(#[from] TableError),
    #[error("{}: {source}", path.display())]
    Io { path: PathBuf, source: std::io::Error },
}

/// Exit codes for drivers of batches, beside those of the whole program.
mod code {
    /// Input or output failed.
    pub const DISK: u8 = 4;
    /// Numerical failure: it would fail again.
    pub const NUMERICAL: u8 = 5;
    /// Try again later (`EX_TEMPFAIL` of `sysexits.h`).
    pub const TEMPORARY: u8 = 75;
}

impl Blame for BatchError {
    fn fault(&self) -> Fault {
        match self {
            BatchError::Plan { .. }
            | BatchError::Invalid { .. }
            | BatchError::Memory { .. }
            | BatchError::Changed { .. }
            | BatchError::Scene(_) => Fault::Input,
            BatchError::Simulate(error) => error.fault(),
            BatchError::Table(error) => error.fault(),
            BatchError::Missing { .. } | BatchError::Numerical { .. } | BatchError::Io { .. } => {
                Fault::Run
            }
        }
    }

    /// For drivers: 2 wrong input, 4 input or output failed, 5 numerical failure (do not retry), 75
    /// temporary (retry), 1 else.
    fn exit_code(&self) -> u8 {
        match self {
            // A disk may be cleared; elsewhere it is a table that is too large.
            BatchError::Table(TableError::NoSpace { .. } | TableError::DiskFull { .. }) => {
                code::TEMPORARY
            }
            BatchError::Table(TableError::Io { source, .. }) | BatchError::Io { source, .. }
                if is_temporary(source) =>
            {
                code::TEMPORARY
            }
            _ if self.fault() == Fault::Input => WRONG_INPUT,
            BatchError::Numerical { .. }
            | BatchError::Simulate(
                SimulateError::Energy { .. }
                | SimulateError::Wrong(_)
                | SimulateError::Mean(MeanError::NotMet { .. }),
            )
            | BatchError::Table(TableError::Table(_)) => code::NUMERICAL,
            BatchError::Table(_) | BatchError::Io { .. } => code::DISK,
            _ => FAILED,
        }
    }
}

fn is_temporary(error: &std::io::Error) -> bool {
    use std::io::ErrorKind::{
        Interrupted, QuotaExceeded, StaleNetworkFileHandle, StorageFull, TimedOut, WouldBlock,
    };
    let kinds =
        [Interrupted, QuotaExceeded, StaleNetworkFileHandle, StorageFull, TimedOut, WouldBlock];
    kinds.contains(&error.kind())
}

fn invalid(field: &str, value: impl ToString, accepted: &str) -> BatchError {
    let value = crate::scene::shown(&value.to_string());
    BatchError::Invalid { field: field.into(), value, accepted: accepted.into() }
}
