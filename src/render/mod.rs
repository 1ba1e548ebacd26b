//! Pictures of phase tables: a preview of the table itself, and rainbows in the sky.
//!
//! Reads nothing but [`PhaseTable`](crate::phase_table::PhaseTable)s, which `bow` has computed where a scene
//! of a picture names drops in place of tables. Stages of a rainbow:
//! table → XYZ per direction (`tristimulus`) → mixture of drops → what each pixel of the
//! `camera` sees of the sky, averaged over the sun's disc (`sky`) → sRGB → PNG.

#[cfg(feature = "hdf5")]
pub mod bow;
pub mod camera;
mod directions;
mod picture;
mod plots;
mod ray_paths;
pub mod sky;
mod thinned;
mod tristimulus;

pub use directions::DirectionGrid;
pub use picture::{Picture, write_complete};
pub use plots::color_diagram::ColorDiagram;
pub use plots::font::{FONT, ensure_font};
pub use plots::heat_map::{colour_bar, draw_pixels};
pub use plots::preview;
pub use ray_paths::draw_ray_paths;
pub use thinned::Thinned;
pub use tristimulus::{Tristimulus, rotational_xyz};

use crate::color::ColorError;
use crate::fault::{Blame, Fault};
use std::path::PathBuf;

/// Why a picture cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    #[error(transparent)]
    Color(#[from] ColorError),
    #[error("{}: {source}", path.display())]
    Write { path: PathBuf, source: std::io::Error },
    #[error("drawing failed: {0}")]
    Drawing(String),
    #[error("{field} = {value}: {accepted}")]
    Invalid { field: String, value: String, accepted: String },
}

impl Blame for RenderError {
    fn fault(&self) -> Fault {
        match self {
            RenderError::Color(_) | RenderError::Invalid { .. } => Fault::Input,
            RenderError::Write { .. } | RenderError::Drawing(_) => Fault::Run,
        }
    }
}

impl<E: std::error::Error + Send + Sync> From<plotters::drawing::DrawingAreaErrorKind<E>>
    for RenderError
{
    fn from(error: plotters::drawing::DrawingAreaErrorKind<E>) -> Self {
        RenderError::Drawing(error.to_string())
    }
}
