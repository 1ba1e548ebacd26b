//! Files of scenes: how they are read, and those that they name.

mod limited;
mod named;

pub(crate) use limited::read_limited;
pub use named::named_files;
