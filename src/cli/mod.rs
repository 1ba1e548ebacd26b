//! The program: its commands parse what is typed (`args`), call the library, and print (`show`). Only here
//! live terminal output, progress bars and exit codes.

mod args;
mod command_line;
mod commands;
mod cpu_time;
mod failure;
mod interrupt;
mod show;
mod units;

use clap::{CommandFactory, Parser, Subcommand};
use commands::{
    batch, bench, compare, export, figure, info, lee, material, plan, radar, rays, render, scatter,
    scenes, shell, table, validate,
};
use failure::{Failure, Result};
use std::process::ExitCode;

/// The virtual gonioreflectometer: how one particle scatters light.
#[derive(Parser)]
#[command(version, about, arg_required_else_help = true, after_help = AFTER_HELP)]
struct Cli {
    /// Threads to compute with (default: all cores)
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Say nothing but errors: no notes, no progress
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Say each step, with the seconds since the start
    #[arg(short, long, global = true)]
    verbose: bool,
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
    Radar(radar::RadarArgs),
    Plan(plan::PlanArgs),
    Info(info::InfoArgs),
    Validate(validate::ValidateArgs),
    Export(export::ExportArgs),
    Lee(lee::LeeArgs),
    Compare(compare::CompareArgs),
    Render(render::RenderArgs),
    Figure(figure::FigureArgs),
    Batch(batch::BatchArgs),
    Bench(bench::BenchArgs),
    Scenes(scenes::ScenesArgs),
    Scene(scenes::SceneArgs),
    Completions(shell::CompletionsArgs),
    Man(shell::ManArgs),
}

/// Parse the command line, run the command, map errors to exit codes.
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => units::named(error, &Cli::command()).exit(),
    };
    show::verbosity::set(cli.quiet, cli.verbose);
    show::notes::start();
    interrupt::install();
    match start_threads(cli.threads).and_then(|()| run(cli.command)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {}", error.words());
            ExitCode::from(error.code())
        }
    }
}

fn run(command: Command) -> Result<()> {
    match command {
        Command::Material(args) => material::run(args),
        Command::Table(args) => table::run(args),
        Command::Scatter(args) => scatter::run(args),
        Command::Rays(args) => rays::run(args),
        Command::Radar(args) => radar::run(args),
        Command::Plan(args) => plan::run(args),
        Command::Info(args) => info::run(args),
        Command::Validate(args) => validate::run(args),
        Command::Export(args) => export::run(args),
        Command::Lee(args) => lee::run(args),
        Command::Compare(args) => compare::run(args),
        Command::Render(args) => render::run(args),
        Command::Figure(args) => figure::run(args),
        Command::Batch(args) => batch::run(args),
        Command::Bench(args) => bench::run(args),
        Command::Scenes(args) => scenes::list(&args),
        Command::Scene(args) => scenes::example(&args),
        Command::Completions(args) => shell::completions(&args, Cli::command()),
        Command::Man(args) => shell::man(&args, Cli::command()),
    }
}

fn start_threads(threads: Option<u16>) -> Result<()> {
    if let Some(threads) = threads {
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads.into())
            .build_global()
            .map_err(|error| Failure::run(error.to_string()))?;
    }
    Ok(())
}
