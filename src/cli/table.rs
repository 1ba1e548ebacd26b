//! `gonio table`: from a scene to a tabulated phase function.

use super::UsageError;
use super::scene_flags::SceneFlags;
use clap::Args;
use std::path::PathBuf;

/// Tabulate the phase function of a scene (the main job)
#[derive(Args)]
#[command(after_help = "Example: gonio table data/scenes/raindrop.toml -o raindrop.h5

Without a scene: a raindrop of 0.5 mm, the sun at 20 degrees.")]
pub struct TableArgs {
    /// Scene file; without one, the built-in raindrop
    #[arg(value_name = "SCENE.toml")]
    scene: Option<PathBuf>,
    /// HDF5 file to write
    #[arg(short, long, value_name = "OUT.h5")]
    output: PathBuf,
    /// Replace files of the same names
    #[arg(long)]
    overwrite: bool,
    /// No picture beside the table
    #[arg(long)]
    no_preview: bool,
    #[command(flatten)]
    flags: SceneFlags,
}

pub fn run(args: TableArgs) -> anyhow::Result<()> {
    let scene = args.flags.scene(args.scene.as_deref())?;
    Err(UsageError(format!("{} {scene:?}: the main path is not wired yet", args.output.display()))
        .into())
}
