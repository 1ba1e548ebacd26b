//! Hands the git hash of the source to the compiler, for the record in every output, and the page of theory with
//! its picture in it, since rustdoc copies no files.

use std::path::Path;
use std::process::Command;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo:rerun-if-changed=build.rs");
    if let Some(lacking) = without_cmake() {
        eprintln!("{lacking}");
        std::process::exit(1);
    }
    let hash = packaged_hash().or_else(repository_hash).unwrap_or("unknown".into());
    println!("cargo:rustc-env=GONIO_GIT_HASH={hash}");
    theory_with_picture()
}

/// What is to be said where HDF5 is to be built and there is no cmake to build it with.
fn without_cmake() -> Option<String> {
    println!("cargo:rerun-if-env-changed=CMAKE");
    env::var_os("CARGO_FEATURE_HDF5")?;
    let program = env::var_os("CMAKE").unwrap_or("cmake".into());
    if Command::new(&program).arg("--version").output().is_ok_and(|output| output.status.success())
    {
        return None;
    }
    Some(format!(
        "gonio writes HDF5 files, and builds that library with cmake; {} could not be run. Install cmake, or name one by \
         the environment variable CMAKE; in a clone of the repository tools/setup.sh brings one. The library alone, \
         without files: --no-default-features",
        Path::new(&program).display()
    ))
}

/// The hash that cargo has put into a package.
fn packaged_hash() -> Option<String> {
    const INFO: &str = ".cargo_vcs_info.json";
    println!("cargo:rerun-if-changed={}", if Path::new(INFO).exists() { INFO } else { "build.rs" });
    let text = fs::read_to_string(INFO).ok()?;
    let (_, rest) = text.split_once("\"sha1\"")?;
    let hash = rest.split('"').nth(1)?;
    (hash.len() >= HASH_DIGITS).then(|| hash[..HASH_DIGITS].to_string())
}

/// The hash of the repository whose top this folder is: another's, in which the source was unpacked, says nothing.
fn repository_hash() -> Option<String> {
    if !git(&["rev-parse", "--show-prefix"])?.is_empty() {
        return None;
    }
    for name in ["HEAD", "logs/HEAD"] {
        let path = git(&["rev-parse", "--git-path", name]);
        if let Some(path) = path.filter(|path| Path::new(path).exists()) {
            println!("cargo:rerun-if-changed={path}");
        }
    }
    git(&["rev-parse", &format!("--short={HASH_DIGITS}"), "HEAD"])
}

/// Digits of a hash in a file.
const HASH_DIGITS: usize = 12;

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
