//! `gonio completions` and `gonio man`: what shells and readers of manuals want, from the program's own words.

use crate::cli::failure::{Failure, Result};
use clap::{Args, Command};
use clap_complete::Shell;
use std::path::PathBuf;

/// Completions for a shell, on standard output
#[derive(Args)]
#[command(
    after_help = "Example: gonio completions bash > ~/.local/share/bash-completion/completions/gonio"
)]
pub struct CompletionsArgs {
    /// Which shell
    #[arg(value_enum)]
    shell: Shell,
}

/// Manual pages, one per command
#[derive(Args)]
#[command(after_help = "Example: gonio man ~/.local/share/man/man1")]
pub struct ManArgs {
    /// Folder to write them into
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
}

/// Print the completions.
pub fn completions(args: &CompletionsArgs, mut program: Command) -> Result<()> {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut program, "gonio", &mut text);
    print!("{}", String::from_utf8_lossy(&text));
    Ok(())
}

/// Write the pages.
pub fn man(args: &ManArgs, program: Command) -> Result<()> {
    let failed = |error: std::io::Error| {
        Failure::from(error).while_doing(format!("cannot write into {}", args.folder.display()))
    };
    std::fs::create_dir_all(&args.folder).map_err(failed)?;
    clap_mangen::generate_to(program, &args.folder).map_err(failed)
}
