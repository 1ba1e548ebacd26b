//! Flags carry their unit in their name; who leaves it out is told all of them.

use clap::error::{ContextKind, ContextValue};
use clap::{Command, Error};

/// The same error; where a flag is unknown for want of a unit, with every flag that has one.
pub fn named(mut error: Error, program: &Command) -> Error {
    let Some(ContextValue::String(given)) = error.get(ContextKind::InvalidArg) else {
        return error;
    };
    let Some(stem) = given.strip_prefix("--").map(|name| format!("{name}-")) else { return error };
    let words = std::env::args().skip(1);
    let command = words.filter_map(|word| program.find_subcommand(word)).next().unwrap_or(program);
    let flags: Vec<String> = (command.get_arguments().filter_map(|argument| argument.get_long()))
        .filter(|long| long.strip_prefix(&stem).is_some_and(|unit| UNITS.contains(&unit)))
        .map(|long| format!("--{long}"))
        .collect();
    if !flags.is_empty() {
        error.insert(ContextKind::SuggestedArg, ContextValue::Strings(flags));
    }
    error
}

/// Units in names of flags.
const UNITS: [&str; 10] = ["nm", "um", "mm", "deg", "ghz", "c", "kg-m3", "g-m3", "mm-h", "per-cm3"];
