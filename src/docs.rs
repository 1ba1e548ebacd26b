//! The pages for people, as they stand in `docs/`: their links and their code are checked with the program.

/// [scene]: crate::docs::scene
/// [file]: crate::docs::file
#[doc = include_str!("../docs/tutorials.md")]
pub mod tutorials {}

#[doc = include_str!(concat!(env!("OUT_DIR"), "/theory.md"))]
pub mod theory {}

#[doc = include_str!("../docs/glossary.md")]
pub mod glossary {}

#[doc = include_str!("../docs/scene.md")]
pub mod scene {}

#[doc = include_str!("../docs/file.md")]
pub mod file {}

#[doc = include_str!("../docs/bibliography.md")]
pub mod bibliography {}

#[cfg(test)]
mod tests;
