//! Polyhedra: ice crystals, prisms, any convex closed body of flat facets, with interference and diffraction.
//!
//! Light is split into beams of polygonal cross-section, each a plane wave inside the body, with exact points
//! in three dimensions ([`beams`]). The waves inside are the sources of the scattered field: the integral
//! over the volume of every beam is done in closed form and leaves one Fourier transform per polygon on the
//! surface ([`polygon`]), which holds external reflection, every transmitted wave, and the shadow's diffraction alike: nothing is
//! counted twice ([`far_field`]). Means over orientations carry an error from replicas ([`orientation`]).
//!
//! After Yang & Liou, Appl. Opt. 35, 6568 (1996) (volume integral over rays); Bi, Yang, Kattawar, Hu & Baum,
//! J. Quant. Spectrosc. Radiat. Transfer 112, 1492 (2011) (broad beams); Wuttke, J. Appl. Cryst. 54, 580
//! (2021) (polygons).
//!
//! ```
//! use gonio::facets::Body;
//!
//! let column = Body::hexagonal_column(2.0).unwrap();
//! assert_eq!((column.facets().len(), column.vertices().len()), (8, 12));
//! assert!((column.volume() - 4.0 / 3.0 * std::f64::consts::PI).abs() < 1e-12);
//! ```

pub mod beams;
mod body;
pub mod far_field;
mod lobes;
pub mod mean;
pub mod orientation;
pub mod polygon;

pub use body::{Body, BodyError};
pub use far_field::FarField;
