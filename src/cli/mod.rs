//! The commands of `gonio`, one file each: parse, call the library, write. Only here live terminal
//! output, progress bars and `anyhow`.

mod batch;
mod bench;
mod compare;
mod cpu_time;
mod export;
mod info;
mod interrupt;
mod lee;
mod material;
mod memory;
mod notes;
mod plan;
mod plot;
mod polarisation;
mod progress;
mod rays;
mod render;
mod render_drops;
mod scatter;
mod scatter_input;
mod scene_flags;
mod table;
mod thinned;
mod validate;

use clap::{Parser, Subcommand};
use gonio::batch::BatchError;
use gonio::export::ExportError;
use gonio::hdf5::TableError;
use gonio::medium::MediumError;
use gonio::plan::PlanError;
use gonio::render::RenderError;
use gonio::scene::SceneError;
use gonio::series::SeriesError;
use gonio::series::mean::MeanError;
use gonio::shape::ShapeError;
use gonio::simulate::SimulateError;
use std::process::ExitCode;

/// Wrong input that only the command line knows of; ends the process with exit code 2.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct UsageError(pub String);

/// Exit code: the computation failed.
const FAILED: u8 = 1;
/// Exit code: the input was wrong. The same as clap's own.
const WRONG_INPUT: u8 = 2;

/// The virtual gonioreflectometer: how one particle scatters light.
#[derive(Parser)]
#[command(version, about, arg_required_else_help = true, after_help = AFTER_HELP)]
struct Cli {
    /// Threads to compute with (default: all cores)
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    #[command(subcommand)]
    command: Command,
}

const AFTER_HELP: &str = "Example: gonio table -o raindrop.h5

Exit codes: 0 done, 1 failed while running, 2 wrong input.";

#[derive(Subcommand)]
enum Command {
    Material(material::MaterialArgs),
    Table(table::TableArgs),
    Scatter(scatter::ScatterArgs),
    Rays(rays::RaysArgs),
    Plan(plan::PlanArgs),
    Info(info::InfoArgs),
    Validate(validate::ValidateArgs),
    Export(export::ExportArgs),
    Lee(lee::LeeArgs),
    Compare(compare::CompareArgs),
    Render(render::RenderArgs),
    Batch(batch::BatchArgs),
    Bench(bench::BenchArgs),
}

/// Parse the command line, run the command, map errors to exit codes.
pub fn main() -> ExitCode {
    let cli = Cli::parse();
    interrupt::install();
    match start_threads(cli.threads).and_then(|()| run(cli.command)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {}", in_words(&error));
            ExitCode::from(exit_code(&error))
        }
    }
}

/// The error and its causes, without those that the message tells already.
fn in_words(error: &anyhow::Error) -> String {
    error.chain().fold(String::new(), |told, cause| {
        let cause = cause.to_string();
        match told.is_empty() {
            true => cause,
            false if told.contains(&cause) => told,
            false => format!("{told}: {cause}"),
        }
    })
}

fn run(command: Command) -> anyhow::Result<()> {
    match command {
        Command::Material(args) => material::run(args),
        Command::Table(args) => table::run(args),
        Command::Scatter(args) => scatter::run(args),
        Command::Rays(args) => rays::run(args),
        Command::Plan(args) => plan::run(args),
        Command::Info(args) => info::run(args),
        Command::Validate(args) => validate::run(args),
        Command::Export(args) => export::run(args),
        Command::Lee(args) => lee::run(args),
        Command::Compare(args) => compare::run(args),
        Command::Render(args) => render::run(args),
        Command::Batch(args) => batch::run(args),
        Command::Bench(args) => bench::run(args),
    }
}

fn start_threads(threads: Option<u16>) -> anyhow::Result<()> {
    if let Some(threads) = threads {
        rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global()?;
    }
    Ok(())
}

/// Wrong input is told from failure by the kind of error anywhere in the chain of causes.
fn exit_code(error: &anyhow::Error) -> u8 {
    // The codes of a batch tell drivers whether to try again.
    if let Some(error) = error.downcast_ref::<BatchError>() {
        return error.exit_code();
    }
    if error.chain().any(is_wrong_input) { WRONG_INPUT } else { FAILED }
}

fn is_wrong_input(cause: &(dyn std::error::Error + 'static)) -> bool {
    // Raised by wrong input alone; the kinds below also by a full disk, by memory or by physics.
    let always = cause.is::<UsageError>()
        || cause.is::<SceneError>()
        || cause.is::<MediumError>()
        || cause.is::<ShapeError>()
        || cause.is::<PlanError>();
    always
        || cause.downcast_ref::<TableError>().is_some_and(TableError::is_wrong_input)
        || cause.downcast_ref::<ExportError>().is_some_and(ExportError::is_wrong_input)
        || cause
            .downcast_ref::<SeriesError>()
            .is_some_and(|e| !matches!(e, SeriesError::OutOfMemory { .. }))
        || matches!(cause.downcast_ref(), Some(RenderError::Invalid { .. }))
        || match cause.downcast_ref::<SimulateError>() {
            Some(SimulateError::Plan(_) | SimulateError::Medium(_)) => true,
            Some(SimulateError::Series(inner)) => is_wrong_input(inner),
            Some(SimulateError::Mean(MeanError::Series(inner))) => is_wrong_input(inner),
            Some(SimulateError::Mean(error)) => !matches!(error, MeanError::NotMet { .. }),
            _ => false,
        }
}
