//! Media that vary along the radius of a sphere: layers, profiles, gradients in water, films.
//!
//! A [`Radial`] has no one index; [`Radial::at`] gives the [`Body`] at a wavelength: a core, smooth
//! or homogeneous, and layers around it, all relative to the medium outside.
//!
//! ```
//! use gonio::medium::MediumSpec;
//! use std::path::Path;
//!
//! let lens = MediumSpec::parse("{ profile = \"luneburg\", c = 2.0 }")?.resolve(Path::new("."))?;
//! let body = lens.body(500e-9, 1e-6)?.unwrap();
//! assert!((body.index(0.6).re - 1.64f64.sqrt()).abs() < 1e-15);
//! # Ok::<(), gonio::medium::MediumError>(())
//! ```

mod body;
mod gradient;
mod immersed;
mod profile;
mod profile_table;
pub(super) mod spec;
mod varied;

pub use body::{Body, Core};
pub use gradient::Gradient;
pub use immersed::Immersed;
pub use profile::{Profile, Smooth};
pub use varied::{Film, Inside, Radial};
