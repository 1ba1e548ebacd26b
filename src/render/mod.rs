//! Pictures of phase tables: a preview of the table itself, and rainbows in the sky.
//!
//! Reads nothing but [`PhaseTable`](crate::phase_table::PhaseTable)s. Stages of a rainbow:
//! table → XYZ per direction (`tristimulus`) → mixture of drops → what each pixel of the
//! `camera` sees of the sky, averaged over the sun's disc (`sky`) → sRGB → PNG.
//!
//! ```
//! use gonio::render::camera::Lens;
//!
//! // the primary bow, 42° from the antisolar point, through a lens that keeps lines straight
//! let distance = Lens::Rectilinear.distance(42f64.to_radians()).expect("less than 90°");
//! assert!((distance - 0.9004).abs() < 1e-4);
//! ```

pub mod camera;
#[cfg(feature = "pictures")]
mod color_diagram;
mod directions;
#[cfg(feature = "pictures")]
mod error_strip;
#[cfg(feature = "pictures")]
mod font;
#[cfg(feature = "pictures")]
mod heat_map;
mod picture;
#[cfg(feature = "pictures")]
pub mod preview;
pub mod sky;
mod sun_smoothing;
#[cfg(feature = "pictures")]
mod ticks;
mod tristimulus;

#[cfg(feature = "pictures")]
pub use color_diagram::ColorDiagram;
pub use directions::DirectionGrid;
#[cfg(feature = "pictures")]
pub use font::{FONT, ensure_font};
#[cfg(feature = "pictures")]
pub use heat_map::{colour_bar, draw_pixels};
pub use picture::{Picture, write_complete};
pub use sun_smoothing::smooth_over_sun;
pub use tristimulus::{Tristimulus, rotational_xyz};

use crate::color::ColorError;
use std::path::PathBuf;

/// Why a picture cannot be made.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
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

#[cfg(feature = "pictures")]
impl<E: std::error::Error + Send + Sync> From<plotters::drawing::DrawingAreaErrorKind<E>>
    for RenderError
{
    fn from(error: plotters::drawing::DrawingAreaErrorKind<E>) -> Self {
        RenderError::Drawing(error.to_string())
    }
}
