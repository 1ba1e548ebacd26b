//! Files of the refractiveindex.info database (YAML, wavelengths in micrometres): all nine formulas
//! and tabulated n, k, nk, also mixed in one file.
//!
//! The parser delivers events, one after another; nothing here recurses into what the file holds,
//! aliases are refused and depth is bounded, so a hostile file ends in a message.

use crate::medium::data::column::Column;
use crate::medium::data::extinction::Extinction;
use crate::medium::data::material::Material;
use crate::medium::data::samples::DataCurve;
use crate::medium::data::samples::Row;
use crate::medium::data::table::{Table, TableBuilder, name_of};
use crate::medium::data::unit::Unit;
use crate::medium::dispersion::formula::Formula;
use crate::medium::error::{MediumError, file_error};
use crate::medium::read::text;
use saphyr_parser::{Event, Parser};
use std::path::Path;

/// Deepest nesting that a file may have; the database needs five.
const DEEPEST: usize = 32;
/// Most elements of `DATA`; the database needs two.
const MOST_BLOCKS: usize = 16;

/// What a file of optical data holds.
pub(in crate::medium) enum Data {
    Material(Box<Material>),
    Extinction(Extinction),
}

/// One scalar of the file with the keys that lead to it.
struct Entry {
    /// Keys joined by dots; an item of a list is its number: `DATA.0.type`.
    path: String,
    value: String,
    /// Line of the value; for a block of text, of its first row.
    line: usize,
}

/// One element of the list `DATA`.
struct Block<'a> {
    kind: &'a Entry,
    entries: Vec<&'a Entry>,
    prefix: String,
}

/// Reads a material from a file.
pub fn read(path: &Path) -> Result<Material, MediumError> {
    match read_data(path)? {
        Data::Material(material) => Ok(*material),
        Data::Extinction(_) => Err(MediumError::OnlyExtinction { path: path.into() }),
    }
}

/// Reads a material, or k where there is no n.
pub(in crate::medium) fn read_data(path: &Path) -> Result<Data, MediumError> {
    let text = text::read(path)?;
    let mut data = parse(&text.text, path)?;
    match &mut data {
        Data::Material(material) => material.notes.splice(0..0, text.note),
        Data::Extinction(extinction) => extinction.notes.splice(0..0, text.note),
    };
    Ok(data)
}

/// Reads the data from text; `path` is for messages and, without its ending, the name.
fn parse(text: &str, path: &Path) -> Result<Data, MediumError> {
    let entries = flatten(text, path)?;
    let name = name_of(path);
    let source = entries
        .iter()
        .find(|e| e.path == "REFERENCES")
        .map(|e| e.value.split_whitespace().collect::<Vec<_>>().join(" "))
        .unwrap_or_else(|| "no reference in the file".into());
    let blocks = blocks(&entries, path)?;
    let mut real: Option<Material> = None;
    let mut extinction: Option<DataCurve> = None;
    let mut notes = Vec::new();
    for block in &blocks {
        match block.kind.value.split_whitespace().collect::<Vec<_>>().as_slice() {
            ["formula", number] if real.is_none() => {
                real = Some(formula(block, number, &name, &source, path)?);
            }
            ["tabulated", kind @ ("n" | "k" | "nk")] => {
                let table = tabulated(block, kind, path)?;
                notes.extend(table.notes);
                if !table.n.is_empty() && real.is_none() {
                    real = Some(Material::from_curve(&name, &source, table.n.curve()));
                }
                if !table.k.is_empty() && extinction.is_none() {
                    extinction = Some(table.k.curve());
                }
            }
            // The nonlinear index may stand beside the linear one, which alone is of use here.
            ["formula", _] | ["tabulated", "n2"] => {}
            _ => {
                let message = format!(
                    "type \"{}\": expected \"formula 1\" to \"formula 9\", \"tabulated n\", \
                     \"tabulated k\" or \"tabulated nk\"",
                    block.kind.value
                );
                return Err(file_error(path, Some(block.kind.line), message));
            }
        }
    }
    let Some(mut real) = real else {
        return match extinction {
            Some(curve) => Ok(Data::Extinction(Extinction::new(name, source, notes, curve))),
            None => {
                Err(file_error(path, None, "the file holds no n (only the nonlinear index n2)"))
            }
        };
    };
    real.unit = Some(Unit::Micrometre);
    real.notes = notes;
    Ok(Data::Material(Box::new(match extinction {
        Some(curve) => real.with_extinction(curve),
        None => real,
    })))
}

/// A list or a table that the parser is in.
enum Level {
    /// With the number of elements so far.
    List(usize),
    /// With the key that waits for its value.
    Map(Option<String>),
}

impl Level {
    /// What leads to the present value.
    fn key(&self) -> String {
        match self {
            Level::List(count) => (count - 1).to_string(),
            Level::Map(key) => key.clone().unwrap_or_default(),
        }
    }
}

/// All scalars of the document with their paths.
fn flatten(text: &str, path: &Path) -> Result<Vec<Entry>, MediumError> {
    let mut levels: Vec<Level> = Vec::new();
    let mut entries = Vec::new();
    let mut parser = Parser::new_from_str(text);
    while let Some(event) = parser.next_event() {
        let (event, span) = event.map_err(|e| {
            file_error(path, Some(e.marker().line()), format!("broken YAML: {}", e.info()))
        })?;
        let line = span.start.line();
        // A value inside a list or after a key takes its place before it is entered.
        let value_comes = !matches!(
            event,
            Event::SequenceEnd | Event::MappingEnd | Event::StreamEnd | Event::DocumentEnd
        );
        if value_comes && let Some(Level::List(count)) = levels.last_mut() {
            *count += 1;
        }
        match event {
            Event::SequenceStart(..) | Event::MappingStart(..) if levels.len() >= DEEPEST => {
                let message = format!("nested deeper than {DEEPEST} levels");
                return Err(file_error(path, Some(line), message));
            }
            Event::SequenceStart(..) => levels.push(Level::List(0)),
            Event::MappingStart(..) => levels.push(Level::Map(None)),
            Event::SequenceEnd | Event::MappingEnd => {
                levels.pop();
                if let Some(Level::Map(key)) = levels.last_mut() {
                    *key = None;
                }
            }
            Event::Alias(_) => {
                return Err(file_error(path, Some(line), "YAML aliases are not accepted"));
            }
            Event::Scalar(value, ..) => {
                if let Some(Level::Map(key @ None)) = levels.last_mut() {
                    *key = Some(value.into_owned());
                    continue;
                }
                let keys: Vec<String> = levels.iter().map(Level::key).collect();
                entries.push(Entry { path: keys.join("."), value: value.into_owned(), line });
                if let Some(Level::Map(key)) = levels.last_mut() {
                    *key = None;
                }
            }
            _ => {}
        }
    }
    Ok(entries)
}

/// The elements of `DATA`, in order.
fn blocks<'a>(entries: &'a [Entry], path: &Path) -> Result<Vec<Block<'a>>, MediumError> {
    let mut blocks = Vec::new();
    for index in 0..=MOST_BLOCKS {
        let prefix = format!("DATA.{index}.");
        let inside: Vec<&Entry> = entries.iter().filter(|e| e.path.starts_with(&prefix)).collect();
        let Some(first) = inside.first() else { break };
        let Some(kind) = inside.iter().find(|e| e.path == format!("{prefix}type")) else {
            return Err(file_error(path, Some(first.line), "an element of DATA without a type"));
        };
        blocks.push(Block { kind, entries: inside.clone(), prefix });
    }
    if blocks.len() > MOST_BLOCKS {
        return Err(file_error(path, None, format!("DATA has more than {MOST_BLOCKS} elements")));
    }
    if blocks.is_empty() {
        return Err(file_error(path, None, "no list DATA: not a refractiveindex.info file"));
    }
    Ok(blocks)
}

impl Block<'_> {
    fn field(&self, names: &[&str], path: &Path) -> Result<&Entry, MediumError> {
        let wanted = |e: &&&Entry| names.iter().any(|n| e.path == format!("{}{n}", self.prefix));
        self.entries.iter().find(wanted).copied().ok_or_else(|| {
            let message = format!("\"{}\" needs the field {}", self.kind.value, names[0]);
            file_error(path, Some(self.kind.line), message)
        })
    }
}

fn numbers(entry: &Entry, path: &Path) -> Result<Vec<f64>, MediumError> {
    let parse = |word: &str| number(word).map_err(|e| file_error(path, Some(entry.line), e));
    entry.value.split_whitespace().map(parse).collect()
}

fn formula(
    block: &Block,
    number: &str,
    name: &str,
    source: &str,
    path: &Path,
) -> Result<Material, MediumError> {
    let at = |line: usize| move |e: MediumError| file_error(path, Some(line), e.to_string());
    let range_entry = block.field(&["wavelength_range", "range"], path)?;
    let range = match numbers(range_entry, path)?.as_slice() {
        &[from, to] if 0.0 < from && from < to => (from, to),
        _ => {
            let message = format!("range \"{}\": expected two ascending µm", range_entry.value);
            return Err(file_error(path, Some(range_entry.line), message));
        }
    };
    let coefficients = block.field(&["coefficients"], path)?;
    let number: u32 = number.parse().map_err(|_| {
        file_error(path, Some(block.kind.line), format!("formula \"{number}\": expected 1 to 9"))
    })?;
    let law = Formula::new(number, numbers(coefficients, path)?).map_err(at(coefficients.line))?;
    let range = (Unit::Micrometre.to_metres(range.0), Unit::Micrometre.to_metres(range.1));
    Ok(Material::from_formula(name, source, law, range))
}

fn tabulated(block: &Block, kind: &str, path: &Path) -> Result<Table, MediumError> {
    let columns = match kind {
        "n" => vec![Column::N],
        "k" => vec![Column::K],
        _ => vec![Column::N, Column::K],
    };
    let data = block.field(&["data"], path)?;
    let mut builder = TableBuilder::new(path);
    for (i, row) in data.value.lines().enumerate().filter(|(_, row)| !row.trim().is_empty()) {
        let line = data.line + i;
        let words: Vec<&str> = row.split_whitespace().collect();
        let expected = columns.len() + 1;
        let wavelength = number(words[0]).and_then(|um| match um > 0.0 {
            true => Ok(Unit::Micrometre.to_metres(um)),
            false => Err(format!("wavelength {um} µm must be positive")),
        });
        for (j, column) in columns.iter().enumerate() {
            let value = match words.get(j + 1) {
                Some(word) if words.len() <= expected => wavelength.clone().and(number(word)),
                _ => Err(format!("{} numbers, expected {expected}", words.len())),
            };
            builder.push(*column, Row { line, wavelength: wavelength.clone().ok(), value });
        }
    }
    builder.finish(String::new(), Unit::Micrometre)
}

/// A finite number.
fn number(word: &str) -> Result<f64, String> {
    let value = word.parse::<f64>().ok().filter(|v| v.is_finite());
    value.ok_or_else(|| format!("\"{word}\" is not a finite number"))
}
