//! `gonio table`: from a scene to a tabulated phase function.

use super::UsageError;
use clap::Args;
use std::path::PathBuf;

/// Tabulate the phase function of a scene (the main job)
#[derive(Args)]
#[command(after_help = "Example: gonio table data/scenes/raindrop.toml -o raindrop.h5")]
pub struct TableArgs {
    /// Scene file; without one, the built-in raindrop
    scene: Option<PathBuf>,
    /// HDF5 file to write
    #[arg(short, long, value_name = "OUT.h5")]
    output: PathBuf,
}

pub fn run(args: TableArgs) -> anyhow::Result<()> {
    let scene = args.scene.unwrap_or_default();
    Err(UsageError(format!(
        "{} -> {}: the main path is not wired to the command line yet",
        scene.display(),
        args.output.display()
    ))
    .into())
}
