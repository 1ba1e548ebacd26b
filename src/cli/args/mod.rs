//! What is typed: flags that several commands share, and the grammar of their values.

pub mod medium;
pub mod memory;
pub mod output;
pub mod particle;
pub mod polarisation;
pub mod ranges;
pub mod scene_flags;
