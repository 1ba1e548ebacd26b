//! The house has floors; a module imports only from floors below its own. This test holds the
//! table and reads the sources. Change the table when the design changes, in the same commit.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Floor, rooms on it. Top floor first. The program (`main.rs`, `cli/`) is the roof: it sees the
/// library by its name `gonio`, the library never sees it.
const FLOORS: [(u32, &[&str]); 9] = [
    (8, &["main", "cli"]),
    (7, &["lee", "batch"]),
    (6, &["simulate"]),
    (5, &["farfield"]),
    // The export formats that are netCDF files use the writer of hdf5.
    (4, &["trace", "export"]),
    (3, &["plan", "series", "hdf5", "compare", "render"]),
    (2, &["scene", "phase_table"]),
    (1, &["optics", "medium", "shape", "color", "size_distribution"]),
    (0, &["math", "pending_file"]),
];

/// Edges that the table forbids and the design allows, each with its reason.
const DECLARED: [(&str, &str, &str); 2] = [
    ("main", "cli", "the entry point of the program"),
    // A scene says which quantities the table of its result shall hold.
    ("scene", "phase_table", "a scene names the quantity and the treatment of the forward peak"),
];

fn floor(room: &str) -> Option<u32> {
    FLOORS.iter().find(|(_, rooms)| rooms.contains(&room)).map(|(floor, _)| *floor)
}

/// Every Rust source below a folder.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = vec![];
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
    found
}

/// The room a source file belongs to: `trace/ray.rs` → `trace`, `simulate.rs` → `simulate`.
fn room_of(file: &Path, src: &Path) -> String {
    let relative = file.strip_prefix(src).unwrap();
    let first = relative.components().next().unwrap().as_os_str();
    Path::new(first).file_stem().unwrap().to_string_lossy().into_owned()
}

/// Source code without comments, strings left in place.
fn code_of(text: &str) -> String {
    text.lines().map(|line| line.split("//").next().unwrap_or("")).collect::<Vec<_>>().join("\n")
}

/// Rooms named after `crate::` or `gonio::`, also in groups `crate::{a::B, c}`.
fn rooms_used(code: &str) -> BTreeSet<String> {
    let mut rooms = BTreeSet::new();
    for prefix in ["crate::", "gonio::"] {
        for (at, _) in code.match_indices(prefix) {
            let whole_word = !code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_');
            if whole_word {
                rooms.extend(first_names(&code[at + prefix.len()..]));
            }
        }
    }
    rooms
}

/// The first name of each path that begins here.
fn first_names(rest: &str) -> Vec<String> {
    let name = |text: &str| -> String {
        text.trim_start().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
    };
    let Some(group) = rest.strip_prefix('{') else { return vec![name(rest)] };
    let (mut depth, mut start, mut names) = (0, 0, vec![]);
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => {
                names.push(name(&group[start..at]));
                break;
            }
            '}' => depth -= 1,
            ',' if depth == 0 => {
                names.push(name(&group[start..at]));
                start = at + 1;
            }
            _ => {}
        }
    }
    names.retain(|name| !name.is_empty());
    names
}

/// What is wrong with an edge, if anything.
fn fault(from: &str, to: &str) -> Option<String> {
    if from == to || DECLARED.iter().any(|(a, b, _)| (*a, *b) == (from, to)) {
        return None;
    }
    match (floor(from), floor(to)) {
        (None, _) => Some(format!("room `{from}` is on no floor of the table")),
        // A macro or a re-export of the crate root is no room.
        (_, None) => Some(format!("`{from}` uses `{to}`, which is on no floor of the table")),
        (Some(above), Some(below)) if above <= below => {
            Some(format!("`{from}` (floor {above}) imports `{to}` (floor {below})"))
        }
        _ => None,
    }
}

#[test]
fn imports_go_downwards_only() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut faults = BTreeSet::new();
    let mut edges = BTreeSet::new();
    for file in sources(&src) {
        let room = room_of(&file, &src);
        if room == "lib" {
            continue;
        }
        for used in rooms_used(&code_of(&fs::read_to_string(&file).unwrap())) {
            if let Some(fault) = fault(&room, &used) {
                faults.insert(format!("{}: {fault}", file.display()));
            }
            edges.insert((room.clone(), used));
        }
    }
    assert!(edges.len() > 5, "the scan finds the imports: {edges:?}");
    assert!(faults.is_empty(), "{}", faults.into_iter().collect::<Vec<_>>().join("\n"));
}

#[test]
fn every_room_is_on_one_floor() {
    let mut seen = BTreeSet::new();
    for room in FLOORS.iter().flat_map(|(_, rooms)| rooms.iter()) {
        assert!(seen.insert(room), "{room} is on two floors");
    }
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for file in sources(&src) {
        let room = room_of(&file, &src);
        assert!(room == "lib" || floor(&room).is_some(), "{room} is on no floor");
    }
}

#[test]
fn the_scan_sees_what_it_should() {
    let code = "use crate::scene::{Scene, size};\nuse crate::{math, trace::Ray};\nlet x = \
                gonio::hdf5::read();\nmy_crate::other::x();";
    let rooms: Vec<_> = rooms_used(code).into_iter().collect();
    assert_eq!(rooms, ["hdf5", "math", "scene", "trace"]);
    assert!(fault("trace", "simulate").is_some(), "upward");
    assert!(fault("hdf5", "render").is_some(), "sibling");
    assert!(fault("trace", "attic").is_some(), "undeclared");
    assert!(fault("simulate", "trace").is_none());
    assert_eq!(code_of("a // use crate::x"), "a ");
}
