//! Photographs of bows: the computed bow added to one as light, and the drops that fit it.
//!
//! [`Taken`] says how a photograph was taken, where its EXIF block tells; [`sun_position`] where the sun stood; [`aimed_by_horizon`] and
//! [`aimed_by_antisolar`] how the camera was held. [`cut`] averages the picture along cuts across the bow, and [`fit`] finds
//! the drops, the sun and the aim that make it.
//!
//! ```
//! use gonio::render::camera::{Camera, Lens};
//! use gonio::render::photo::aimed_by_horizon;
//!
//! let camera = Camera {
//!     lens: Lens::Rectilinear, field_of_view: 1.2, elevation: 0.0, azimuth: 0.0, width: 300, height: 200,
//! };
//! assert_eq!(aimed_by_horizon(&camera, 100.0)?.elevation, 0.0);
//! # Ok::<(), gonio::render::photo::PhotoError>(())
//! ```

mod aim;
mod cut;
mod error;
mod fit;
mod sun_position;
#[cfg(feature = "pictures")]
mod taken;

pub use super::linear_picture::LinearPicture;
pub use aim::{aimed_by_antisolar, aimed_by_horizon};
pub use cut::{Cell, CutPlan, cut};
pub use error::PhotoError;
pub use fit::{Bow, Curve, Fitted, Start, fit};
pub use sun_position::{SunPosition, sun_position};
#[cfg(feature = "pictures")]
pub use taken::{Taken, unix_seconds};
