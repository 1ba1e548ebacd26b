//! One table of a batch: compute it unless it is there.

use super::BatchError;
use super::plan::{BatchPlan, PlannedTable};
use crate::hdf5::{TableError, TableReader, TableWriter, WriteOptions};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::simulate::{self, SimulateError};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What is found under a shard's name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ShardStatus {
    /// Whole, and of this id.
    Done,
    /// There is no such file.
    Missing,
    /// There, but not whole or not of this id: it will be computed again.
    Invalid,
}

/// What [`compute`] did.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// Computed now.
    Computed,
    /// A valid file was there.
    Skipped,
}

/// The result of one shard.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Shard {
    /// Digest of the physics: the table's name in the plan.
    pub id: String,
    /// What was done.
    pub status: Outcome,
    /// Time that it took.
    pub seconds: f64,
    /// Size of the file.
    pub bytes: u64,
    /// Where it lies.
    pub file: PathBuf,
}

impl PlannedTable {
    /// Look at the file of this table: it is valid if it opens, bears the id, and was written to
    /// the end. Its age does not matter.
    pub fn status(&self, folder: &Path) -> ShardStatus {
        let path = self.file(folder);
        match TableReader::open(&path) {
            Ok(reader) => match reader.attribute("shard_id") {
                Ok(Some(id)) if id == self.id => ShardStatus::Done,
                _ => ShardStatus::Invalid,
            },
            Err(TableError::Io { source, .. }) if source.kind() == std::io::ErrorKind::NotFound => {
                ShardStatus::Missing
            }
            Err(_) => ShardStatus::Invalid,
        }
    }
}

/// Compute the table of a line into `folder`, unless it is there already; `memory` is the limit of
/// what it may take, bytes.
///
/// # Errors
/// When the scene cannot be computed, needs more memory, or the file cannot be written; nothing
/// half-written is left.
pub fn compute(
    plan: &BatchPlan,
    table: &PlannedTable,
    folder: &Path,
    memory: Option<u64>,
) -> Result<Shard, BatchError> {
    let start = Instant::now();
    table.check_files()?;
    let path = table.file(folder);
    let status = table.status(folder);
    let outcome = if status == ShardStatus::Done {
        Outcome::Skipped
    } else {
        if let Some(parent) = path.parent() {
            std::fs::create_dir_all(parent)
                .map_err(|source| BatchError::Io { path: parent.to_path_buf(), source })?;
        }
        let scene = table.scene()?;
        let cores = rayon::current_num_threads();
        let needed = Plan::new(&scene).map_err(SimulateError::from)?.cost(&scene, cores).memory;
        if let Some(limit) = memory.filter(|limit| needed > *limit) {
            return Err(BatchError::Memory { id: table.id.clone(), needed, limit });
        }
        match write(plan, (table, &scene), &path, status == ShardStatus::Invalid) {
            // Another process was faster; its file is the same.
            Err(BatchError::Table(TableError::Exists { .. }))
                if table.status(folder) == ShardStatus::Done =>
            {
                Outcome::Skipped
            }
            result => result.map(|()| Outcome::Computed)?,
        }
    };
    let bytes = std::fs::metadata(&path).map_or(0, |data| data.len());
    let seconds = start.elapsed().as_secs_f64();
    Ok(Shard { id: table.id.clone(), status: outcome, seconds, bytes, file: path })
}

fn write(
    plan: &BatchPlan,
    (table, scene): (&PlannedTable, &Scene),
    path: &Path,
    overwrite: bool,
) -> Result<(), BatchError> {
    // The content of a file named by its content must not depend on the way it came about.
    let header = simulate::header(scene, String::new())?;
    let options = WriteOptions {
        bit_round: scene.bit_round,
        overwrite,
        dated: false,
        attributes: vec![
            ("shard_id".into(), table.id.clone()),
            ("plan_digest".into(), plan.digest.clone()),
        ],
        ..WriteOptions::default()
    };
    let mut writer = TableWriter::create(path, &header, options)?;
    simulate::simulate(scene, |index, slab| {
        if slab.values.iter().any(|value| !value.is_finite()) {
            let wavelength_nm = slab.wavelength * 1e9;
            return Err(BatchError::Numerical { id: table.id.clone(), wavelength_nm });
        }
        Ok(writer.write_slab(index, &slab)?)
    })?;
    Ok(writer.finish()?)
}
