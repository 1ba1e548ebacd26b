//! The commands, one file or folder each: parse, call the library, print.

pub mod batch;
pub mod bench;
pub mod compare;
pub mod export;
pub mod figure;
pub mod info;
pub mod lee;
pub mod material;
pub mod plan;
pub mod radar;
pub mod rays;
pub mod render;
pub mod scatter;
pub mod scenes;
pub mod shell;
pub mod table;
pub mod validate;
