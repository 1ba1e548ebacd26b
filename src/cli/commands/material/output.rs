//! Where the result of `gonio material` goes.

use super::args::MaterialArgs;
use crate::cli::failure::{Failure, Result};
use crate::cli::show::plot;
use serde_json::Value;
use std::path::Path;

/// Prints the result, or writes it to the file asked for.
pub(super) fn emit(args: &MaterialArgs, text: String, value: Value) -> Result<()> {
    let text = if args.json { format!("{value}\n") } else { text };
    match &args.output {
        Some(path) if is_plot(path) => {
            Err(Failure::usage("a plot (.png, .svg) is drawn of a NAME only"))
        }
        Some(path) => plot::write_whole(path, text.as_bytes()),
        None => {
            use std::io::Write;
            match std::io::stdout().write_all(text.as_bytes()) {
                // A reader that has seen enough (`| head`) is no failure.
                Err(e) if e.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
                other => Ok(other?),
            }
        }
    }
}

pub(super) fn is_plot(path: &Path) -> bool {
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_lowercase();
    ["png", "svg"].contains(&ending.as_str())
}
