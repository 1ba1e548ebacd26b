//! Polyhedra: ice crystals, prisms, any convex closed body of flat facets, with interference and diffraction.
//!
//! Light is split into beams of polygonal cross-section, each a plane wave inside the body, with exact points
//! in three dimensions ([`beams`]). The fields where beams start and end on the surface radiate, each polygon by
//! one Fourier transform in closed form ([`polygon`]): external reflection, every transmitted wave and the
//! shadow's diffraction are one sum, and nothing is counted twice ([`far_field`]). Means over orientations
//! carry an error from replicas ([`mean`], [`orientation`]). Without diffraction and interference every beam is a ray
//! that takes its power along (`rays`).
//!
//! After Yang & Liou, Appl. Opt. 35, 6568 (1996) (fields near the body by rays); Bi, Yang, Kattawar, Hu & Baum,
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
pub mod far_field;
mod lobes;
pub mod mean;
pub mod orientation;
mod path;
pub mod polygon;
mod rays;
pub mod table;

pub use crate::shape::polyhedron::{Body, BodyError};
pub use far_field::FarField;
