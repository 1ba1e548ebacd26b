//! The library's media, listed.

use gonio::medium::LibraryEntry;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// One line each.
pub(super) fn text(entries: &[LibraryEntry]) -> String {
    let mut text = String::new();
    for entry in entries {
        let (from, to) = (entry.range.0 * 1e9, entry.range.1 * 1e9);
        let also = match entry.aliases.is_empty() {
            true => String::new(),
            false => format!(" (also {})", entry.aliases.join(", ")),
        };
        let _ =
            writeln!(text, "{:22} {from:>5.0} to {to:>6.0} nm  {}{also}", entry.name, entry.kind);
    }
    text
}

/// One object each.
pub(super) fn json(entries: &[LibraryEntry]) -> Value {
    let entry = |e: &LibraryEntry| {
        json!({
            "name": e.name,
            "aliases": e.aliases,
            "kind": e.kind,
            "source": e.source,
            "range_nm": [e.range.0 * 1e9, e.range.1 * 1e9],
            "catalogue_nd": e.catalogue.map(|c| c.0),
            "catalogue_vd": e.catalogue.map(|c| c.1),
        })
    };
    Value::Array(entries.iter().map(entry).collect())
}
