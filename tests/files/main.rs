//! Tables on disk: written and read back, exported, damaged, on full disks, by killed programs. One
//! module per subject: `cargo test --release --test files hdf5_table::`.
#![cfg(all(feature = "cli", feature = "hdf5"))]

mod support;

mod assignment;
mod fuzz_readers;
mod hdf5_table;
mod reliability_disk;
mod reliability_tables;
mod table_export;
