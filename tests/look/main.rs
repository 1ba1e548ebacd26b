//! What is looked at: Lee diagrams, pictures, comparisons and their reports. One module per subject:
//! `cargo test --release --test look look_bows::`.
#![cfg(all(feature = "cli", feature = "hdf5"))]

mod bows;
mod tables;

mod look_bows;
mod look_compare;
mod look_lee;
mod look_preview;
mod look_report;
mod look_sampling;
mod look_scenes;
mod look_twinned;

/// The program, ready for its arguments.
fn gonio() -> assert_cmd::Command {
    assert_cmd::Command::cargo_bin("gonio").unwrap()
}
