//! All tables of a plan on this machine.
//!
//! One lane per core takes table after table from a common queue; within a table the work is
//! spread over all cores as well. So a sweep of many small tables and one of few large ones both
//! keep every core busy to the end.

use super::BatchError;
use super::plan::{BatchPlan, PlannedTable};
use super::shard::{Shard, compute};
use crate::plan::Plan;
use crate::simulate::SimulateError;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::time::{Duration, SystemTime};

/// News while a batch runs.
#[derive(Debug)]
pub enum Event {
    /// A table is there.
    Done(Shard),
    /// A table failed; the others go on.
    Failed {
        /// Digest of the physics: the table's name in the plan.
        id: String,
        /// Why.
        error: BatchError,
    },
}

/// Compute what is missing of `tables` into `folder`; `report` hears of each table as it ends.
/// Tables that together would take more than `memory` bytes are not computed at once.
///
/// # Errors
/// When the folder cannot be made. Failures of single tables are reported as events.
pub fn run(
    plan: &BatchPlan,
    tables: &[&PlannedTable],
    folder: &Path,
    memory: Option<u64>,
    mut report: impl FnMut(Event),
) -> Result<(), BatchError> {
    std::fs::create_dir_all(folder)
        .map_err(|source| BatchError::Io { path: folder.to_path_buf(), source })?;
    remove_leftovers(folder);
    let next = AtomicUsize::new(0);
    let lanes = lanes(tables, memory)?;
    let (sender, receiver) = mpsc::channel();
    std::thread::scope(|scope| {
        for _ in 0..lanes {
            let (sender, next) = (sender.clone(), &next);
            scope.spawn(move || {
                while let Some(table) = tables.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let event = match compute(plan, table, folder, memory) {
                        Ok(shard) => Event::Done(shard),
                        Err(error) => Event::Failed { id: table.id.clone(), error },
                    };
                    if sender.send(event).is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        receiver.into_iter().for_each(&mut report);
    });
    Ok(())
}

/// How many tables to compute at once: one per core, fewer where they are large. Tables of a sweep
/// have the same angles, so the first one speaks for all.
fn lanes(tables: &[&PlannedTable], memory: Option<u64>) -> Result<usize, BatchError> {
    let most = rayon::current_num_threads().clamp(1, tables.len().max(1));
    let (Some(first), Some(memory)) = (tables.first(), memory) else { return Ok(most) };
    let scene = first.scene()?;
    let needed = Plan::new(&scene).map_err(SimulateError::from)?.cost(&scene, most).memory;
    Ok(most.min((memory / needed).max(1) as usize))
}

/// Remove temporary files that killed processes left: those of shards, an hour old, whose process
/// is gone. (On a shared disk the process may live on another machine: hence the hour.)
fn remove_leftovers(folder: &Path) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let Some(process) = name.to_str().and_then(process_of_temporary) else { continue };
        let age = entry.metadata().and_then(|data| data.modified()).ok();
        let age = age.and_then(|time| SystemTime::now().duration_since(time).ok());
        let old = age.is_some_and(|age| age > Duration::from_secs(3600));
        let alive = Path::new("/proc").join(process.to_string()).exists();
        if old && !alive {
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

/// The process number in the temporary name of a shard, `.ID.h5.PROCESS-COUNT.tmp`.
fn process_of_temporary(name: &str) -> Option<u32> {
    let rest = name.strip_prefix('.')?.strip_suffix(".tmp")?;
    let (shard, process) = rest.rsplit_once('.')?;
    let (process, _) = process.split_once('-')?;
    shard.ends_with(".h5").then(|| process.parse().ok())?
}

#[cfg(test)]
mod tests {
    use super::process_of_temporary;

    #[test]
    fn only_temporary_shards_are_leftovers() {
        assert_eq!(process_of_temporary(".0a1b.h5.123-4.tmp"), Some(123));
        for other in ["0a1b.h5", ".0a1b.h5", ".notes.tmp", ".a.png.12-1.tmp", ".a.h5.x-1.tmp"] {
            assert_eq!(process_of_temporary(other), None, "{other}");
        }
    }
}
