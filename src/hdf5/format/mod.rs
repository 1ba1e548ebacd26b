//! What stands in a file: names, units and words, and how each is written and read.

pub mod circumstances;
pub mod dimensions;
pub mod methods;
pub mod record;
pub mod schema;
