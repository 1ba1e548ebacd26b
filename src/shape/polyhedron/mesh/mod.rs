//! Closed convex meshes of files: OBJ, STL and PLY.
//!
//! What a file holds is judged before it is kept: its size, then its facets, each named as the file counts
//! them. Corners at one place become one corner ([`weld`]), facets in one plane one polygon ([`join`]); a body
//! is made of what is left.

mod join;
mod read;
#[cfg(test)]
mod samples;
mod soup;
mod weld;

use super::Body;
use super::check::{self, BodyError};
use crate::pending_file::FILES;
use glam::DVec3;
use soup::{LARGEST_FILE, Soup, within_limits};
use std::io::Read;
use std::path::Path;

pub use read::Format;
pub use soup::MeshError;

/// A closed convex mesh, as a body and with the size that its file gives it.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// What it is called: the name of its file.
    name: String,
    body: Body,
    radius: f64,
    facets: usize,
}

impl Mesh {
    /// Read a file; its ending says of which format.
    ///
    /// # Errors
    /// A file that cannot be read or is too long, and whatever [`Mesh::parse`] refuses.
    pub fn load(path: &Path) -> Result<Self, MeshError> {
        let format = Format::of(path).ok_or(MeshError::Ending)?;
        if !FILES {
            return Err(MeshError::Unreadable("there are no files in a browser".into()));
        }
        let unreadable = |error: std::io::Error| MeshError::Unreadable(error.to_string());
        let told = std::fs::metadata(path).map_err(unreadable)?.len();
        if told > LARGEST_FILE {
            return Err(MeshError::TooLong { bytes: told });
        }
        // a length that is told need not be so: devices say 0, and go on
        let mut bytes = Vec::new();
        let file = std::fs::File::open(path).map_err(unreadable)?;
        file.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(unreadable)?;
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        Self::parse(&name, format, &bytes)
    }

    /// The body of a file's bytes.
    ///
    /// ```
    /// use gonio::shape::{Mesh, MeshFormat};
    ///
    /// let corner = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    /// let mesh = Mesh::parse("corner", MeshFormat::Obj, corner.as_bytes())?;
    /// assert_eq!(mesh.body().facets().len(), 4);
    /// let open = corner.replace("f 2 3 4\n", "f 2 3 4\nf 2 4 3\n");
    /// assert!(Mesh::parse("corner", MeshFormat::Obj, open.as_bytes()).is_err());
    /// # Ok::<(), gonio::shape::MeshError>(())
    /// ```
    ///
    /// # Errors
    /// Bytes that are no such file, too many facets, and a surface that is open, turned inside out in part,
    /// without thickness or not convex; the message names the facet, counted from 1 as in the file.
    pub fn parse(name: &str, format: Format, bytes: &[u8]) -> Result<Self, MeshError> {
        let soup = read::read(format, bytes)?;
        Self::of(name, soup)
    }

    fn of(name: &str, soup: Soup) -> Result<Self, MeshError> {
        within_limits(&soup)?;
        check::coordinates(&soup.corners)?;
        let facets = soup.facets.len();
        let (welded, size) = weld::weld(&soup)?;
        check::closed(&welded.corners, &welded.facets)
            .map_err(|error| placed(error, &soup, &size))?;
        let joined = join::join(&welded);
        if !(4..=check::MOST_FACETS).contains(&joined.facets.len()) {
            return Err(MeshError::Joined { facets: joined.facets.len() });
        }
        let (body, relative) =
            Body::with_size(&joined.corners, &joined.facets).map_err(|error| {
                let error = match error {
                    BodyError::Hollow { facet, vertex } => {
                        let at = joined.corners[vertex - 1];
                        BodyError::Hollow {
                            facet: joined.of_file[facet - 1],
                            vertex: nearest(&welded.corners, at),
                        }
                    }
                    BodyError::NotFlat { facet } => {
                        BodyError::NotFlat { facet: joined.of_file[facet - 1] }
                    }
                    BodyError::NoArea { facet } => {
                        BodyError::NoArea { facet: joined.of_file[facet - 1] }
                    }
                    other => other,
                };
                placed(error, &soup, &size)
            })?;
        Ok(Self { name: name.into(), body, radius: relative * size.scale, facets })
    }

    /// The name of its file.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// As a body, scaled to the volume of the unit sphere.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// Radius of the sphere of equal volume, in units of the file's coordinates.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Facets of the file, before those of one plane were joined.
    pub fn facets_of_file(&self) -> usize {
        self.facets
    }
}

fn nearest(corners: &[DVec3], at: DVec3) -> usize {
    let mut places = 0..corners.len();
    places.find(|&i| corners[i] == at).map_or(0, |i| i + 1)
}

/// A fault with places in the file's coordinates: corners of STL files have no numbers.
fn placed(error: BodyError, soup: &Soup, size: &weld::Size) -> MeshError {
    let place = |vertex: usize| {
        let at = size.corners.get(vertex.wrapping_sub(1)).map_or(DVec3::NAN, |&i| soup.corners[i]);
        format!("({}, {}, {})", at.x, at.y, at.z)
    };
    match error {
        BodyError::Open { facet, from, to } => MeshError::Facet {
            facet,
            what: format!(
                "the surface is open at its edge from {} to {}: no other facet shares it",
                place(from),
                place(to)
            ),
        },
        BodyError::Flipped { facet, other, from, to } => MeshError::Facet {
            facet,
            what: format!(
                "turned inside out (corners run anticlockwise seen from outside): facet {other} runs the same way \
                 along the edge from {} to {}",
                place(from),
                place(to)
            ),
        },
        BodyError::Hollow { facet, vertex } => MeshError::Facet {
            facet,
            what: format!(
                "the corner {} is in front of it: the body is not convex, or crosses itself; accepted: convex bodies, \
                 for no beam that has left one enters it again",
                place(vertex)
            ),
        },
        BodyError::NoArea { facet } | BodyError::Corner { facet, .. } => {
            MeshError::NoArea { facet }
        }
        other => other.into(),
    }
}

#[cfg(test)]
mod tests;
