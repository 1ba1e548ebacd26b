//! Corners and facets as a file has them, how many are taken, and what can be wrong with a mesh.

use crate::shape::polyhedron::check::BodyError;
use glam::DVec3;

/// Largest file, bytes: it is held in memory, and what is read of it beside it.
pub(super) const LARGEST_FILE: u64 = 32 << 20;
/// Most facets and corners of facets in a file, before those of one plane are joined.
pub(super) const MOST_FACETS: usize = 200_000;
pub(super) const MOST_CORNERS: usize = 1_000_000;
/// Most corners of one facet.
const MOST_CORNERS_OF_ONE: usize = 1000;
/// What reading and joining takes for each facet, bytes: measured, for the message.
const BYTES_PER_FACET: f64 = 500.0;

/// Why a file makes no body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum MeshError {
    #[error("{0}")]
    Unreadable(String),
    #[error("no mesh by its ending; accepted: .obj, .stl, .ply")]
    Ending,
    #[error("a file of at least {bytes} bytes; accepted: up to 33554432")]
    TooLong { bytes: u64 },
    #[error(
        "{facets} facets, for which {:.1} GB would be taken; accepted: up to 200000, of which at most 1000 are left \
         when those of one plane are joined",
        *facets as f64 * BYTES_PER_FACET / 1e9
    )]
    TooMany { facets: usize },
    #[error("facet {facet}: {corners} corners; accepted: 3 to 1000")]
    Corners { facet: usize, corners: usize },
    #[error("facet {facet}: it names corner {corner}, and there are {corners}")]
    NoCorner { facet: usize, corner: usize, corners: usize },
    #[error(
        "facet {facet}: it has no area (two of its corners are one place, or all are on a line)"
    )]
    NoArea { facet: usize },
    #[error("facet {facet}: {what}")]
    Facet { facet: usize, what: String },
    #[error("{facets} flat facets after those of one plane were joined; accepted: 4 to 1000")]
    Joined { facets: usize },
    #[error(transparent)]
    Body(#[from] BodyError),
}

/// Corners and facets as a file has them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Soup {
    pub corners: Vec<DVec3>,
    pub facets: Vec<Vec<usize>>,
}

/// What is too much to be looked at.
pub(super) fn within_limits(soup: &Soup) -> Result<(), MeshError> {
    let facets = soup.facets.len();
    let corners: usize = soup.facets.iter().map(Vec::len).sum();
    if facets > MOST_FACETS || corners > MOST_CORNERS {
        return Err(MeshError::TooMany { facets });
    }
    if facets < 4 {
        return Err(MeshError::Joined { facets });
    }
    let limits = 3..=MOST_CORNERS_OF_ONE;
    for (place, facet) in soup.facets.iter().enumerate() {
        if !limits.contains(&facet.len()) {
            return Err(MeshError::Corners { facet: place + 1, corners: facet.len() });
        }
        let corners = soup.corners.len();
        if let Some(&corner) = facet.iter().find(|corner| **corner >= corners) {
            return Err(MeshError::NoCorner {
                facet: place + 1,
                corner: corner.wrapping_add(1),
                corners,
            });
        }
    }
    Ok(())
}
