//! How tests of the command line call the program.

use assert_cmd::Command;
use std::path::Path;
use std::time::Duration;

/// Exit code (-1 where a signal ended it) and standard error of the program run in `folder`; it is
/// ended after two minutes.
pub fn gonio(folder: &Path, arguments: &[&str]) -> (i32, String) {
    let output = Command::cargo_bin("gonio")
        .unwrap()
        .args(arguments)
        .current_dir(folder)
        .timeout(Duration::from_secs(120))
        .output()
        .unwrap();
    (output.status.code().unwrap_or(-1), String::from_utf8_lossy(&output.stderr).into_owned())
}
