//! Hands the git hash of the source to the compiler, for the record in every output, and the page of theory with
//! its picture in it, since rustdoc copies no files.

use std::path::Path;
use std::process::Command;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo:rerun-if-changed=build.rs");
    for name in ["HEAD", "logs/HEAD"] {
        let path = git(&["rev-parse", "--git-path", name]);
        if let Some(path) = path.filter(|path| Path::new(path).exists()) {
            println!("cargo:rerun-if-changed={path}");
        }
    }
    let hash = git(&["rev-parse", "--short=12", "HEAD"]).unwrap_or("unknown".into());
    println!("cargo:rustc-env=GONIO_GIT_HASH={hash}");
    theory_with_picture()
}

/// Write the page for rustdoc into the folder of outputs.
fn theory_with_picture() -> io::Result<()> {
    let [page, picture] = ["docs/theory.md", "docs/methods.svg"];
    println!("cargo:rerun-if-changed={page}\ncargo:rerun-if-changed={picture}");
    let Some(folder) = env::var_os("OUT_DIR") else { return Ok(()) };
    let (text, picture) = (fs::read_to_string(page)?, fs::read_to_string(picture)?);
    let drawn = |line: &str| line.starts_with("![") && line.ends_with("](methods.svg)");
    let lines: Vec<&str> =
        text.lines().map(|line| if drawn(line) { picture.trim_end() } else { line }).collect();
    fs::write(Path::new(&folder).join("theory.md"), lines.join("\n"))
}

/// What git answers; nothing outside a repository or without git.
fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_string())
}
