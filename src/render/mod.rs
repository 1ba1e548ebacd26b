//! Pictures of phase tables: a preview of the table itself, and rainbows in the sky.
//!
//! Reads nothing but [`PhaseTable`](crate::phase_table::PhaseTable)s, which `bow` has computed where a scene
//! of a picture names drops in place of tables. Stages of a rainbow:
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

#[cfg(feature = "hdf5")]
pub mod bow;
pub mod camera;
mod directions;
mod error;
#[cfg(feature = "hdf5")]
mod grid;
pub mod layer;
mod linear_picture;
pub mod photo;
mod picture;
#[cfg(feature = "pictures")]
pub(crate) mod plots;
#[cfg(feature = "pictures")]
mod ray_paths;
pub mod sky;
mod thinned;
mod tristimulus;

pub use error::RenderError;
pub use linear_picture::LinearPicture;
pub use picture::{Picture, write_complete};
#[cfg(feature = "pictures")]
pub use plots::color_diagram::ColorDiagram;
#[cfg(feature = "pictures")]
pub use plots::font::{FONT, ensure_font};
#[cfg(feature = "pictures")]
pub use plots::preview;
#[cfg(feature = "pictures")]
pub use ray_paths::{DrawnRay, draw_ray_paths};
pub use thinned::Thinned;
#[cfg(feature = "pictures")]
pub(crate) use tristimulus::rotational_xyz;
