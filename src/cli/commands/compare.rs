//! `gonio compare`: how far a result is from Lorenz–Mie, or one table from another.

use crate::cli::args::output::Output;
use crate::cli::command_line::command_line;
use crate::cli::failure::{Failure, Result};
use crate::cli::show::{notes, progress};
use clap::Args;
use gonio::compare::against_mie::SphereRuns;
use gonio::compare::{Case, Entry, measure, page, worst};
use gonio::render::write_complete;
use std::path::{Path, PathBuf};

/// Report of rays against Lorenz–Mie, or of two tables: HTML page and JSON
#[derive(Args)]
#[command(after_help = "Examples: gonio compare -o report.html --json report.json
          gonio compare --table mine.h5 --reference exact.h5 -o report.html

Without a case: spheres of 0.1 and 0.3 mm at 550 nm. A case gives the sphere, its light and the
angles; its method is not used. Exit code 1 when an L2 error is above --fail-above in any band.")]
pub struct CompareArgs {
    /// Scene of a sphere to compute by rays and by Lorenz–Mie (repeatable)
    #[arg(long, value_name = "CASE.toml")]
    case: Vec<PathBuf>,
    /// Table to compare with --reference
    #[arg(long, value_name = "TABLE.h5", requires = "reference", conflicts_with = "case")]
    table: Option<PathBuf>,
    /// Table that counts as the truth
    #[arg(long, value_name = "TABLE.h5", requires = "table")]
    reference: Option<PathBuf>,
    /// HTML page to write
    #[arg(short, long, value_name = "REPORT.html")]
    output: PathBuf,
    /// JSON of every number to write
    #[arg(long, value_name = "REPORT.json")]
    json: Option<PathBuf>,
    /// Fail (exit code 1) if the L2 error of any band is above this
    #[arg(long, value_name = "ERROR")]
    fail_above: Option<f64>,
}

pub fn run(args: CompareArgs) -> Result<()> {
    for (flag, path) in [("--output", Some(&args.output)), ("--json", args.json.as_ref())] {
        if let Some(path) = path {
            Output { flag, path, kind: "a report", endings: &[] }.check()?;
        }
    }
    let cases = match (&args.table, &args.reference) {
        (Some(table), Some(reference)) => vec![Case {
            name: format!("{} against {}", table.display(), reference.display()),
            reference: read(reference)?,
            tests: vec![read(table)?],
            orders: Vec::new(),
        }],
        _ => against_mie(&args.case)?,
    };
    let reports = cases.iter().map(measure).collect::<Result<Vec<_>, _>>()?;
    for test in reports.iter().flat_map(|report| &report.tests) {
        if !test.differences.is_empty() {
            let differ = test.differences.join("; ");
            notes::tell([format!("{}: not of the reference's particles: {differ}", test.name)]);
        }
    }
    write_complete(&args.output, page::html(&cases, &reports, &command_line()).as_bytes())?;
    notes::wrote(&args.output);
    if let Some(path) = &args.json {
        write_complete(path, serde_json::to_string_pretty(&reports)?.as_bytes())?;
        notes::wrote(path);
    }
    let worst = worst(&reports);
    match args.fail_above {
        Some(limit) if worst.is_nan() || worst > limit => {
            let message = format!("the largest L2 error of a band is {worst:.4}, above {limit}");
            Err(Failure::run(message))
        }
        _ => Ok(()),
    }
}

/// The cases of these files, or the built-in ones.
fn against_mie(files: &[PathBuf]) -> Result<Vec<Case>> {
    let runs = match files {
        [] => SphereRuns::built_in()?,
        files => files.iter().map(|path| SphereRuns::of_file(path)).collect::<Result<_, _>>()?,
    };
    notes::tell(runs.iter().flat_map(SphereRuns::notes));
    let bar = progress::bar(runs.iter().map(SphereRuns::count).sum(), "runs");
    let cases = runs.iter().map(|runs| runs.compute(|| bar.inc(1))).collect::<Result<_, _>>();
    bar.finish_and_clear();
    notes::step(|| "runs computed".into());
    Ok(cases?)
}

fn read(path: &Path) -> Result<Entry> {
    let table = gonio::hdf5::read(path)?;
    Ok(Entry { name: path.display().to_string(), table, seconds: None })
}
