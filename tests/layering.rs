//! The house has floors; a module imports only from floors below its own. This test holds the
//! table and reads the sources. Change the table when the design changes, in the same commit.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Floor, rooms on it. Top floor first. The program (`main.rs`, `cli/`) is the roof: it sees the
/// library by its name `gonio`, the library never sees it.
const FLOORS: [(u32, &[&str]); 13] = [
    (12, &["main", "cli"]),
    // The pages for people, built for the documentation and tests alone.
    (11, &["docs"]),
    (10, &["compare", "figures"]),
    // A picture's drops are sampled as those of a Lee diagram.
    (9, &["render"]),
    (8, &["lee", "batch", "scatter"]),
    (7, &["simulate"]),
    (6, &["plan", "tabulate"]),
    // Rain by its T-matrices.
    (5, &["farfield", "facets", "radar"]),
    // The export formats that are netCDF files use the writer of hdf5.
    (4, &["series", "export"]),
    (3, &["hdf5", "population", "transfer"]),
    (2, &["scene", "phase_table", "trace", "sun_disc"]),
    (1, &["optics", "medium", "shape", "color", "size_distribution", "cancel"]),
    (0, &["math", "pending_file", "fault"]),
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

/// The modules of the house by their paths, each with its file and the code in it.
struct Modules(BTreeMap<Vec<String>, (String, String)>);

impl Modules {
    fn read(src: &Path) -> Self {
        let module = |file: &PathBuf| {
            let relative = file.strip_prefix(src).unwrap();
            let words = relative.with_extension("");
            let words = words.components().map(|c| c.as_os_str().to_string_lossy().into_owned());
            let mut path: Vec<String> = words.collect();
            if path.last().is_some_and(|name| name == "mod") {
                path.pop();
            }
            // tests beside the code may look anywhere
            let text = fs::read_to_string(file).unwrap();
            let code = code_of(text.split("#[cfg(test)]").next().unwrap());
            (path, (relative.display().to_string(), code))
        };
        Self(sources(src).iter().map(module).collect())
    }

    /// The whole paths that a module's code names: `crate::…`, `super::…`, `self::…`, and those that
    /// begin with a child of it.
    fn paths_in(&self, module: &[String], code: &str) -> Vec<Vec<String>> {
        let parent = &module[..module.len().saturating_sub(1)];
        let mut starts: Vec<(String, Vec<String>)> = vec![
            ("crate::".into(), vec![]),
            ("super::".into(), parent.to_vec()),
            ("self::".into(), module.to_vec()),
        ];
        let children =
            self.0.keys().filter(|m| m.len() == module.len() + 1 && m.starts_with(module));
        starts
            .extend(children.map(|child| (format!("{}::", child[child.len() - 1]), child.clone())));
        let mut found = vec![];
        for (prefix, base) in starts {
            for (at, _) in code.match_indices(&prefix) {
                if !code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':') {
                    let rest = full_paths(&code[at + prefix.len()..]);
                    found.extend(rest.into_iter().map(|path| [base.clone(), path].concat()));
                }
            }
        }
        found
    }

    /// The module that defines what a path names, through the facades that hand it on.
    fn home(&self, path: &[String]) -> Option<&Vec<String>> {
        let deepest = (1..=path.len()).rev().find(|&n| self.0.contains_key(&path[..n]))?;
        let (module, (_, code)) = self.0.get_key_value(&path[..deepest]).unwrap();
        let Some(name) = path.get(deepest) else { return Some(module) };
        let handed_on = code.split("pub use ").skip(1).flat_map(|rest| {
            let line = format!("self::{}", rest.split(';').next().unwrap());
            let line = line.replace("self::crate::", "crate::").replace("self::self::", "self::");
            self.paths_in(module, &line)
        });
        let source = handed_on.into_iter().find(|path| path.last() == Some(name));
        match source.filter(|source| source != path) {
            Some(source) => self.home(&source),
            None => Some(module),
        }
    }
}

/// Every file by its path in `src`, and the files that define what it imports.
fn file_imports(src: &Path) -> BTreeMap<String, BTreeSet<String>> {
    let modules = Modules::read(src);
    let mut imports = BTreeMap::new();
    for (module, (name, code)) in &modules.0 {
        // what a facade hands on, it does not use
        let own: String = code
            .split_inclusive(';')
            .filter(|line| !without_attributes(line).starts_with("pub use "))
            .collect();
        let paths = modules.paths_in(module, &own);
        let files = paths.iter().filter_map(|path| Some(modules.0[modules.home(path)?].0.clone()));
        imports.insert(name.clone(), files.filter(|file| file != name).collect());
    }
    imports
}

/// A piece of code from behind the attributes that it begins with.
fn without_attributes(code: &str) -> &str {
    let code = code.trim_start();
    match code.strip_prefix("#[").and_then(|rest| rest.split_once('\n')) {
        Some((_, rest)) => without_attributes(rest),
        None => code,
    }
}

/// All paths of names that begin here, groups `a::{b, c::d}` taken apart.
fn full_paths(rest: &str) -> Vec<Vec<String>> {
    let word = |c: char| c.is_alphanumeric() || c == '_';
    let mut rest = rest.trim_start();
    let mut path = vec![];
    loop {
        let end = rest.find(|c| !word(c)).unwrap_or(rest.len());
        if end > 0 {
            path.push(rest[..end].to_string());
        }
        rest = &rest[end..];
        let Some(next) = rest.strip_prefix("::") else {
            if path.is_empty() && rest.starts_with('{') {
                return group(rest, &path);
            }
            return vec![path];
        };
        if next.starts_with('{') {
            return group(next, &path);
        }
        rest = next;
    }
}

/// The paths in a group `{…}`, behind a path.
fn group(text: &str, before: &[String]) -> Vec<Vec<String>> {
    let (mut depth, mut start, mut found) = (0, 1, vec![]);
    for (at, c) in text.char_indices() {
        match c {
            '{' => depth += 1,
            '}' | ',' if depth == 1 => {
                let inner = full_paths(&text[start..at]);
                found.extend(inner.into_iter().map(|path| [before, &path].concat()));
                start = at + 1;
                if c == '}' {
                    break;
                }
            }
            '}' => depth -= 1,
            _ => {}
        }
    }
    found
}

/// A circle in a graph, if there is one.
fn circle(graph: &BTreeMap<String, BTreeSet<String>>) -> Option<Vec<String>> {
    fn visit<'g>(
        node: &'g str,
        graph: &'g BTreeMap<String, BTreeSet<String>>,
        path: &mut Vec<&'g str>,
        done: &mut BTreeSet<&'g str>,
    ) -> Option<Vec<String>> {
        if let Some(k) = path.iter().position(|n| *n == node) {
            return Some(path[k..].iter().chain([&node]).map(ToString::to_string).collect());
        }
        if done.contains(node) {
            return None;
        }
        path.push(node);
        let next = graph.get(node).into_iter().flatten();
        let found = next.map(String::as_str).find_map(|n| visit(n, graph, path, done));
        path.pop();
        done.insert(node);
        found
    }
    let mut done = BTreeSet::new();
    graph.keys().find_map(|node| visit(node, graph, &mut vec![], &mut done))
}

/// The same imports, from folder to folder at a depth.
fn between_folders(
    imports: &BTreeMap<String, BTreeSet<String>>,
    depth: usize,
) -> BTreeMap<String, BTreeSet<String>> {
    let folder = |file: &String| -> String {
        let parts: Vec<&str> = file.split('/').collect();
        // inside a room the facade of a folder is a place of its own; `plan.rs` and `plan/` are one room
        let place = parts[..parts.len().min(depth)].join("/");
        if depth == 1 { place.trim_end_matches(".rs").into() } else { place }
    };
    let mut graph: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (from, used) in imports {
        let targets = used.iter().map(folder).filter(|to| *to != folder(from));
        graph.entry(folder(from)).or_default().extend(targets);
    }
    graph
}

/// Floors inside `farfield`, top first; a file imports only from floors below its own, or from its own
/// room.
const FARFIELD: [&[&str]; 13] = [
    &["mod.rs"],
    &["error_estimate.rs"],
    &["sphere_check.rs"],
    &["far_field.rs"],
    &["cross_check.rs"],
    &["fallback.rs"],
    &["azimuth", "partial_waves", "reference"],
    &["forward", "complex_wavefront", "patches"],
    &["impact_integral"],
    &["deflection"],
    &["branch"],
    &["assignment"],
    &["column.rs", "direction.rs", "settings.rs", "wave_field.rs"],
];

#[test]
fn rooms_of_the_far_field_are_on_floors() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let place = |file: &str| -> Option<String> {
        Some(file.strip_prefix("farfield/")?.split('/').next().unwrap().to_string())
    };
    let floor = |room: &str| FARFIELD.iter().position(|rooms| rooms.contains(&room));
    let mut edges = 0;
    for (file, used) in file_imports(&src) {
        let Some(from) = place(&file) else { continue };
        let above = floor(&from).unwrap_or_else(|| panic!("{from} is on no floor of farfield"));
        for to in used.iter().filter_map(|used| place(used)).filter(|to| *to != from) {
            let below = floor(&to).unwrap_or_else(|| panic!("{to} is on no floor of farfield"));
            assert!(below > above, "{file} imports {to}, which is not below {from}");
            edges += 1;
        }
    }
    assert!(edges > 20, "the scan finds the imports inside farfield");
}

#[test]
fn no_circle_between_files_or_folders() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut imports = file_imports(&src);
    assert!(imports.values().map(BTreeSet::len).sum::<usize>() > 100);
    let mut circles = vec![];
    while let Some(found) = circle(&imports) {
        imports.get_mut(&found[0]).unwrap().remove(&found[1]);
        circles.push(found.join(" → "));
    }
    assert!(circles.is_empty(), "circles between files:\n{}", circles.join("\n"));
    for depth in 1..=4 {
        assert_eq!(circle(&between_folders(&imports, depth)), None, "at depth {depth}");
    }
}

#[test]
fn no_folder_holds_more_than_twelve_files() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut counts: BTreeMap<PathBuf, usize> = BTreeMap::new();
    for file in sources(&src) {
        *counts.entry(file.parent().unwrap().to_path_buf()).or_default() += 1;
    }
    for (folder, count) in counts {
        assert!(count <= 12, "{} holds {count} files", folder.display());
    }
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
    let paths = full_paths("a::{self, b::{C, d::e}, f}; x::y");
    let joined: Vec<String> = paths.iter().map(|path| path.join("/")).collect();
    assert_eq!(joined, ["a/self", "a/b/C", "a/b/d/e", "a/f"]);
    let graph = |edges: &[(&str, &str)]| {
        let mut graph: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for (a, b) in edges {
            graph.entry(a.to_string()).or_default().insert(b.to_string());
        }
        graph
    };
    assert!(circle(&graph(&[("a", "b"), ("b", "c"), ("c", "a")])).is_some());
    assert!(circle(&graph(&[("a", "b"), ("a", "c"), ("b", "c")])).is_none());
    assert_eq!(code_of("a // use crate::x"), "a ");
}
