//! `gonio batch`: many tables, on one machine or many.

use crate::cli::args::memory::MemoryFlag;
use crate::cli::failure::{Failure, Result};
use crate::cli::show::progress;
use clap::{Args, Subcommand};
use gonio::batch::{BatchPlan, Event, PlannedTable, Selection, ShardStatus, Sweep};
use gonio::fault::Blame;
use indicatif::ProgressBar;
use serde_json::json;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Many tables: plan, run, resume, merge
#[derive(Args)]
#[command(after_help = "Example:
  gonio batch plan sweep.toml -o plan.jsonl
  gonio batch run --plan plan.jsonl --dir shards
  gonio batch merge --plan plan.jsonl --dir shards -o table.h5

On many machines, run on each (a Slurm array, GNU parallel, tools/gonio_dask.py):
  gonio batch shard --plan plan.jsonl --dir shards --slice 3/100 --threads 1

Exit codes: 0 done, 1 tables missing or failed, 2 wrong input, 4 input or output failed,
5 numerical failure (do not retry), 75 temporary (retry).")]
pub struct BatchArgs {
    #[command(subcommand)]
    command: BatchCommand,
}

#[derive(Subcommand)]
enum BatchCommand {
    /// List the tables of a sweep, one line each
    Plan(PlanArgs),
    /// Compute one table, or one slice of all
    Shard(ShardArgs),
    /// Tell what is computed and what is missing
    Status(StatusArgs),
    /// Put all tables into one file
    Merge(MergeArgs),
    /// Compute what is missing on this machine
    Run(RunArgs),
}

#[derive(Args)]
struct PlanArgs {
    /// Scene file with lists or ranges for values
    #[arg(value_name = "SWEEP.toml")]
    sweep: PathBuf,
    /// Plan to write
    #[arg(short, long, value_name = "plan.jsonl")]
    output: PathBuf,
    /// Replace a plan of that name
    #[arg(long)]
    overwrite: bool,
    /// Print a JSON object
    #[arg(long)]
    json: bool,
}

#[derive(Args)]
struct Place {
    /// Plan of the batch
    #[arg(long, value_name = "plan.jsonl")]
    plan: PathBuf,
    /// Folder of the tables
    #[arg(long, value_name = "DIR", default_value = ".")]
    dir: PathBuf,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

#[derive(Args)]
struct ShardArgs {
    #[command(flatten)]
    place: Place,
    /// Table to compute
    #[arg(long, required_unless_present = "slice", conflicts_with = "slice")]
    id: Option<String>,
    /// Every N-th table beginning with number I (from 0)
    #[arg(long, value_name = "I/N", value_parser = parse_slice)]
    slice: Option<(usize, usize)>,
    /// End when the parent process ends
    #[arg(long)]
    die_with_parent: bool,
    #[command(flatten)]
    memory: MemoryFlag,
}

#[derive(Args)]
struct StatusArgs {
    #[command(flatten)]
    place: Place,
}

#[derive(Args)]
struct MergeArgs {
    #[command(flatten)]
    place: Place,
    /// File to write
    #[arg(short, long, value_name = "table.h5")]
    output: PathBuf,
    /// Leave gaps (NaN) where tables are missing
    #[arg(long)]
    allow_missing: bool,
    /// Replace a file of that name
    #[arg(long)]
    overwrite: bool,
}

#[derive(Args)]
struct RunArgs {
    #[command(flatten)]
    place: Place,
    #[command(flatten)]
    memory: MemoryFlag,
}

pub fn run(args: BatchArgs) -> Result<()> {
    match args.command {
        BatchCommand::Plan(args) => plan(&args),
        BatchCommand::Shard(args) => shard(&args),
        BatchCommand::Status(args) => status(&args),
        BatchCommand::Merge(args) => merge(&args),
        BatchCommand::Run(args) => run_all(&args),
    }
}

fn plan(args: &PlanArgs) -> Result<()> {
    let sweep = Sweep::load(&args.sweep)?;
    let plan = BatchPlan::from_sweep(&sweep)?;
    plan.write(&args.output, args.overwrite)?;
    if args.json {
        let axes = sweep.axes.iter().map(|axis| json!({ "keys": axis.keys, "count": axis.len() }));
        let axes: Vec<_> = axes.collect();
        println!("{}", json!({ "tables": sweep.points(), "digest": plan.digest, "axes": axes }));
    } else {
        let axes =
            sweep.axes.iter().map(|axis| format!("{} × {}", axis.len(), axis.keys.join("+")));
        let axes: Vec<_> = axes.collect();
        println!("{}: {} tables ({})", args.output.display(), sweep.points(), axes.join(", "));
    }
    Ok(())
}

fn shard(args: &ShardArgs) -> Result<()> {
    if args.die_with_parent {
        die_with_parent()?;
    }
    let selection = match (&args.id, args.slice) {
        (Some(id), _) => Selection::Id(id),
        (None, Some((number, parts))) => Selection::Slice { number, parts },
        (None, None) => return Err(Failure::usage("give --id or --slice")),
    };
    let plan = read_plan(&args.place.plan, selection)?;
    let limit = args.memory.limit();
    for table in &plan.tables {
        let shard = gonio::batch::compute(&plan, table, &args.place.dir, limit)?;
        if args.place.json {
            println!("{}", serde_json::to_string(&shard)?);
        } else {
            let word = serde_json::to_value(shard.status)?;
            println!("{} {}", shard.id, word.as_str().unwrap_or_default());
        }
    }
    Ok(())
}

fn status(args: &StatusArgs) -> Result<()> {
    let plan = read_plan(&args.place.plan, Selection::All)?;
    let found: Vec<(&PlannedTable, ShardStatus)> =
        plan.tables.iter().map(|table| (table, table.status(&args.place.dir))).collect();
    let of = |wanted: ShardStatus| -> Vec<&str> {
        let ids = found.iter().filter(|(_, status)| *status == wanted);
        ids.map(|(table, _)| table.id.as_str()).collect()
    };
    let (done, missing) = (of(ShardStatus::Done), of(ShardStatus::Missing));
    let invalid = of(ShardStatus::Invalid);
    if args.place.json {
        let status = json!({
            "total": plan.tables.len(),
            "done": done.len(),
            "missing": missing.len(),
            "invalid": invalid.len(),
            "missing_ids": missing,
            "invalid_ids": invalid,
            "digest": plan.digest,
        });
        println!("{status}");
    } else {
        let (done, missing, invalid) = (done.len(), missing.len(), invalid.len());
        let total = plan.tables.len();
        println!("{done} of {total} tables done, {missing} missing, {invalid} invalid");
    }
    Ok(())
}

fn merge(args: &MergeArgs) -> Result<()> {
    let plan = read_plan(&args.place.plan, Selection::All)?;
    let (dir, output) = (&args.place.dir, &args.output);
    gonio::batch::merge(&plan, dir, output, args.allow_missing, args.overwrite)?;
    let bytes = std::fs::metadata(output)?.len();
    if args.place.json {
        println!("{}", json!({ "file": output, "tables": plan.tables.len(), "bytes": bytes }));
    } else {
        let size = gonio::hdf5::decimal_bytes(bytes);
        println!("{}: {} tables, {size}", output.display(), plan.tables.len());
    }
    Ok(())
}

fn run_all(args: &RunArgs) -> Result<()> {
    let start = Instant::now();
    let plan = read_plan(&args.place.plan, Selection::All)?;
    let tables: Vec<&PlannedTable> = plan.tables.iter().collect();
    let bar = progress_bar(tables.len());
    let (mut done, mut skipped, mut first_error) = (0, 0, None);
    let mut failed = Vec::new();
    gonio::batch::run(&plan, &tables, &args.place.dir, args.memory.limit(), |event| {
        match event {
            Event::Done(shard) => {
                done += 1;
                skipped += usize::from(shard.status == gonio::batch::Outcome::Skipped);
            }
            Event::Failed { id, error } => {
                bar.println(format!("{id} failed: {error}"));
                eprintln_unless_bar(&bar, &format!("{id} failed: {error}"));
                failed.push(
                    json!({ "id": id, "error": error.to_string(), "code": error.exit_code() }),
                );
                first_error.get_or_insert(error);
            }
        }
        bar.set_message(format!("{} failed", failed.len()));
        bar.inc(1);
    })?;
    bar.finish_and_clear();
    let seconds = start.elapsed().as_secs_f64();
    if args.place.json {
        let result = json!({
            "total": tables.len(), "done": done, "skipped": skipped, "failed": failed,
            "seconds": seconds,
        });
        println!("{result}");
    } else {
        let computed = done - skipped;
        println!(
            "{computed} tables computed, {skipped} were there, {} failed, {seconds:.1} s",
            failed.len()
        );
    }
    match first_error {
        Some(error) => Err(error.into()),
        None => Ok(()),
    }
}

fn eprintln_unless_bar(bar: &ProgressBar, message: &str) {
    if bar.is_hidden() {
        eprintln!("{message}");
    }
}

/// Done, rate and time left on stderr, if that is a terminal.
fn progress_bar(tables: usize) -> ProgressBar {
    let template = "{bar:30} {pos}/{len} tables, {msg}, {per_sec}, {eta} left";
    let bar = progress::styled(tables, template);
    bar.set_message("0 failed");
    bar
}

fn read_plan(path: &Path, selection: Selection<'_>) -> Result<BatchPlan> {
    if !path.exists() {
        return Err(Failure::usage(format!("--plan {}: no such file", path.display())));
    }
    Ok(BatchPlan::read_selected(path, selection)?)
}

fn parse_slice(text: &str) -> Result<(usize, usize), String> {
    let wrong = || format!("{text:?} is no I/N with 0 <= I < N, such as 3/100");
    let (number, parts) = text.split_once('/').ok_or_else(wrong)?;
    let number = number.trim().parse().map_err(|_| wrong())?;
    let parts: usize = parts.trim().parse().map_err(|_| wrong())?;
    if number < parts { Ok((number, parts)) } else { Err(wrong()) }
}

/// Ask the system to end this process when its parent ends: a killed worker would orphan it.
#[cfg(target_os = "linux")]
fn die_with_parent() -> Result<()> {
    let parent = std::os::unix::process::parent_id();
    let signal = Some(rustix::process::Signal::TERM);
    if rustix::process::set_parent_process_death_signal(signal).is_err() {
        return Err(Failure::usage("--die-with-parent: refused by the system"));
    }
    // A parent that ended before the call sends no signal.
    if std::os::unix::process::parent_id() != parent {
        return Err(Failure::run("the parent process has ended (--die-with-parent)"));
    }
    Ok(())
}

#[cfg(not(target_os = "linux"))]
fn die_with_parent() -> Result<()> {
    Err(Failure::usage("--die-with-parent: only on Linux"))
}
