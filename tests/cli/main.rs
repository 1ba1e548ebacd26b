//! The program from outside: what it accepts, refuses, prints and leaves behind. One module per
//! subject: `cargo test --release --test cli batch_resume::`.
#![cfg(all(feature = "cli", feature = "hdf5"))]

mod support;

mod batch_contract;
mod batch_resume;
mod cli_bad_input;
mod figures;
mod hostile_input;
mod layers;
mod medium_cli;
mod populations;
mod promises;
mod rays_contract;
mod series_bad_input;
mod tmatrix_contract;
