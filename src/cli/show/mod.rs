//! What is shown beside the result: notes, bars and plots.

pub mod notes;
pub mod plot;
pub mod progress;
pub mod verbosity;
