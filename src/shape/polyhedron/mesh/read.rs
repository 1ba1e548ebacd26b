//! Readers of OBJ, STL and PLY: what the crates for these formats make of the bytes, as corners and facets.
//! Numbers that would make them ask for memory or run on without end are looked at first.

use super::soup::{LARGEST_FILE, MOST_CORNERS, MOST_FACETS, MeshError, Soup};
use glam::DVec3;
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{ElementDef, Property, PropertyAccess, PropertyAccessResult};
use std::io::Cursor;
use std::path::Path;

/// Formats of meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Wavefront OBJ: text, facets of any number of corners.
    Obj,
    /// Stereolithography, text or binary: triangles with seven digits.
    Stl,
    /// The Stanford polygon format, text or binary.
    Ply,
}

impl Format {
    /// By the ending of a file's name.
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "obj" => Some(Self::Obj),
            "stl" => Some(Self::Stl),
            "ply" => Some(Self::Ply),
            _ => None,
        }
    }
}

/// Corners and facets of a file; indices of facets may still be none.
pub(super) fn read(format: Format, bytes: &[u8]) -> Result<Soup, MeshError> {
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(MeshError::TooLong { bytes: bytes.len() as u64 });
    }
    match format {
        Format::Obj => obj(bytes),
        Format::Stl => stl(bytes),
        Format::Ply => ply(bytes),
    }
}

/// The first line of a message.
fn unreadable(format: &str, error: impl std::fmt::Display) -> MeshError {
    let text = error.to_string();
    let first: String = text.lines().next().unwrap_or_default().chars().take(200).collect();
    MeshError::Unreadable(format!("not read as {format}: {first}"))
}

/// Most digits of an index: longer ones are beyond any number of corners.
const DIGITS: usize = 9;

fn obj(bytes: &[u8]) -> Result<Soup, MeshError> {
    let text = std::str::from_utf8(bytes).map_err(|error| unreadable("OBJ", error))?;
    let mut facets = 0;
    for (place, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("f") => facets += 1,
            Some("l" | "p") => {}
            _ => continue,
        }
        let sound = |part: &str| {
            let digits = part.trim_start_matches(['-', '+']);
            digits.is_empty() && part.is_empty()
                || digits.len() <= DIGITS && digits.bytes().any(|c| c != b'0')
        };
        if let Some(word) = words.find(|word| !word.split('/').all(sound)) {
            let shown: String = word.chars().take(40).collect();
            let line = place + 1;
            return Err(unreadable(
                "OBJ",
                format!("line {line}: \"{shown}\" is no corner, counted from 1"),
            ));
        }
    }
    if facets > MOST_FACETS {
        return Err(MeshError::TooMany { facets });
    }
    let options =
        tobj::LoadOptions { ignore_points: true, ignore_lines: true, ..Default::default() };
    // materials are none of a shape's business
    let nothing = |_: &Path| Ok(Default::default());
    let (models, _) = tobj::load_obj_buf(&mut Cursor::new(bytes), &options, nothing)
        .map_err(|error| unreadable("OBJ", error))?;
    let mut soup = Soup::default();
    for model in models {
        let mesh = model.mesh;
        let base = soup.corners.len();
        soup.corners.extend(mesh.positions.chunks_exact(3).map(DVec3::from_slice));
        let mut indices = mesh.indices.iter().map(|&i| base + i as usize);
        let triangles = mesh.indices.len() / 3;
        let counts = match mesh.face_arities.is_empty() {
            true => vec![3; triangles],
            false => mesh.face_arities,
        };
        for count in counts {
            soup.facets.push(indices.by_ref().take(count as usize).collect());
        }
    }
    Ok(soup)
}

/// Bytes of a binary STL file before its facets, and of each facet.
const STL_HEADER: usize = 84;
const STL_FACET: usize = 50;

fn stl(bytes: &[u8]) -> Result<Soup, MeshError> {
    // some programs begin binary files with the word of text
    let announced = bytes
        .get(80..84)
        .map_or(0, |count| u32::from_le_bytes([count[0], count[1], count[2], count[3]]) as usize);
    let binary = announced.checked_mul(STL_FACET).and_then(|all| all.checked_add(STL_HEADER));
    let binary = binary == Some(bytes.len());
    let facets = if binary { announced } else { bytes.len() / STL_FACET };
    if facets > MOST_FACETS && (binary || !bytes.starts_with(b"solid")) {
        return Err(MeshError::TooMany { facets });
    }
    let mut soup = Soup::default();
    let mut push = |facet: stl_io::Triangle| -> Result<(), MeshError> {
        let base = soup.corners.len();
        soup.corners.extend(facet.vertices.iter().map(|v| DVec3::from_array(v.0.map(f64::from))));
        soup.facets.push((base..base + 3).collect());
        match soup.facets.len() > MOST_FACETS {
            true => Err(MeshError::TooMany { facets: soup.facets.len() }),
            false => Ok(()),
        }
    };
    // a header of one's own for binary files that begin like text
    let plain: Vec<u8>;
    let bytes = match binary && bytes.starts_with(b"solid ") {
        true => {
            plain = [&[b' '; 80], &bytes[80..]].concat();
            &plain
        }
        false => bytes,
    };
    let mut cursor = Cursor::new(bytes);
    for facet in stl_io::create_stl_reader(&mut cursor).map_err(|error| unreadable("STL", error))? {
        push(facet.map_err(|error| unreadable("STL", error))?)?;
    }
    Ok(soup)
}

/// One row of a PLY file: a corner or a facet.
#[derive(Default)]
struct Row {
    at: [f64; 3],
    corners: Vec<usize>,
}

impl PropertyAccess for Row {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        if let Some(axis) = ["x", "y", "z"].iter().position(|axis| *axis == name) {
            let Some(value) = scalar(&value) else { return PropertyAccessResult::UnsupportedType };
            self.at[axis] = value;
        } else if CORNERS.contains(&name) {
            let Some(list) = list(&value) else { return PropertyAccessResult::UnsupportedType };
            self.corners = list;
        } else {
            return PropertyAccessResult::Ignored;
        }
        PropertyAccessResult::Set
    }
}

/// Both names are about.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

fn scalar(value: &Property) -> Option<f64> {
    match *value {
        Property::Char(x) => Some(x.into()),
        Property::UChar(x) => Some(x.into()),
        Property::Short(x) => Some(x.into()),
        Property::UShort(x) => Some(x.into()),
        Property::Int(x) => Some(x.into()),
        Property::UInt(x) => Some(x.into()),
        Property::Float(x) => Some(x.into()),
        Property::Double(x) => Some(x),
        _ => None,
    }
}

/// Indices; negative ones become such that no corner has.
fn list(value: &Property) -> Option<Vec<usize>> {
    fn of<T: Copy + TryInto<usize>>(list: &[T]) -> Vec<usize> {
        list.iter().map(|&i| i.try_into().unwrap_or(usize::MAX)).collect()
    }
    match value {
        Property::ListChar(list) => Some(of(list)),
        Property::ListUChar(list) => Some(of(list)),
        Property::ListShort(list) => Some(of(list)),
        Property::ListUShort(list) => Some(of(list)),
        Property::ListInt(list) => Some(of(list)),
        Property::ListUInt(list) => Some(of(list)),
        _ => None,
    }
}

fn ply(bytes: &[u8]) -> Result<Soup, MeshError> {
    let refuse = |error| unreadable("PLY", error);
    let mut reader = Reader::new(bytes);
    let parser = Parser::<Row>::new();
    let header = parser.read_header(&mut reader).map_err(refuse)?;
    let lacks = |what: &str| MeshError::Unreadable(format!("not read as PLY: {what}"));
    let has = |element: &ElementDef, name: &str| element.properties.contains_key(name);
    let mut soup = Soup::default();
    for (name, element) in &header.elements {
        match name.as_str() {
            "vertex" if element.count > MOST_CORNERS => {
                return Err(MeshError::TooMany { facets: element.count / 3 });
            }
            "face" if element.count > MOST_FACETS => {
                return Err(MeshError::TooMany { facets: element.count });
            }
            "vertex" if ["x", "y", "z"].iter().any(|axis| !has(element, axis)) => {
                return Err(lacks("element vertex has no x, y, z"));
            }
            "face" if CORNERS.iter().all(|name| !has(element, name)) => {
                return Err(lacks("element face has no list vertex_indices"));
            }
            // rows of other elements are read over, each of a byte at least
            _ if element.count > bytes.len().min(MOST_CORNERS) || element.properties.is_empty() => {
                return Err(lacks(&format!("element {name} has {} rows", element.count)));
            }
            _ => {}
        }
    }
    for (name, element) in &header.elements {
        let rows =
            parser.read_payload_for_element(&mut reader, element, &header).map_err(refuse)?;
        match name.as_str() {
            "vertex" => soup.corners = rows.iter().map(|row| row.at.into()).collect(),
            "face" => soup.facets = rows.into_iter().map(|row| row.corners).collect(),
            _ => {}
        }
    }
    Ok(soup)
}
