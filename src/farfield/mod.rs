//! The far field: from rays that left the particle to amplitudes in any direction.
//!
//! Which method serves which order is decided in [`assignment`] and nowhere else.
//! Two ways lead there. The main one follows, for each order, the rays that leave in one scattering plane
//! (`deflection`), cuts them at their landmarks into the segments of a `branch` with uniform formulas
//! at folds, near the rim (`impact_integral`) and at the edge of the shadow (`forward`), interpolates
//! them over `azimuth` and adds them up over the samples. Orders whose caustics are too disordered for
//! that are sums on a complex wavefront (`complex_wavefront`), and those of small particles of `partial_waves`. The other, that
//! of Sadeghi et al. 2012, is `patches`: sheets of rays cut into triangles on the sphere of directions,
//! the interference of all that contain a direction, and diffraction by a Gaussian filter. `reference`
//! is a brute-force sum that needs no asymptotics; `sphere_check` says what the method is worth. [`FarField`] is what the rest of the house uses.
//!
//! ```
//! use gonio::farfield::{FarField, FarFieldSettings};
//! use gonio::shape::Shape;
//! use gonio::trace::Tracer;
//!
//! let (shape, size_parameter) = (Shape::sphere(), 2000.0);
//! let tracer = Tracer::new(&shape, 1.333.into(), size_parameter, 2);
//! let settings = FarFieldSettings {
//!     size_parameter,
//!     orders: &[2],
//!     tolerance: 0.01,
//!     diffraction: false,
//! };
//! let field = FarField::meridians(&tracer, &settings);
//! let at = |degrees: f64| field.scatter(&[(degrees.to_radians(), 0.0)], false)[0].s11();
//! assert!(at(138.8) > 100.0 * at(136.0), "the primary bow and the dark band beside it");
//! ```

pub mod assignment;
mod azimuth;
mod branch;
mod column;
mod complex_wavefront;
mod cross_check;
mod deflection;
pub(crate) mod direction;
mod error_estimate;
mod fallback;
mod far_field;
pub(crate) mod forward;
mod impact_integral;
mod partial_waves;
pub(crate) mod patches;
pub(crate) mod reference;
mod settings;
pub(crate) mod sphere_check;
mod wave_field;

pub use azimuth::guides::Guides;
pub use azimuth::plane_set::{Piece, PlaneSet};
pub use branch::knots::Kind;
pub use column::Column;
pub use complex_wavefront::{ComplexWavefront, PLACE, Place};
pub use direction::Direction;
pub use error_estimate::ErrorEstimate;
pub use far_field::FarField;
pub use forward::diffraction::ForwardDiffraction;
pub use partial_waves::PartialWaves;
pub use patches::sheets::{Sheet, sheets};
pub use reference::huygens_fresnel::{HuygensFresnel, Wave};
pub use settings::FarFieldSettings;
pub use wave_field::{WaveField, waves};
