//! Shapes of particles: surface, normal, curvature, silhouette. One file per kind.
//!
//! Every shape is a body of revolution about a vertical axis, scaled so that the sphere of equal
//! volume has radius 1. Its surface is `F(q, ζ) = 0` with `q = x·x` and `ζ = x·down` (the depth
//! below the centre); `F < 0` inside. A kind of shape supplies only this function of two scalars
//! with its derivatives, for real and for complex points; intersection, normal and curvature
//! follow for all kinds alike.
//!
//! ```
//! use gonio::shape::{RaindropModel, Shape};
//!
//! // a falling drop of 2 mm is flatter than it is wide, and flattest below
//! let drop = Shape::raindrop(2e-3, RaindropModel::BeardChuang1987, 0.0)?;
//! let down = drop.down;
//! let below = drop.radius_towards(down.x, down.y, down.z);
//! let above = drop.radius_towards(-down.x, -down.y, -down.z);
//! let aside = drop.radius_towards(0.0, 1.0, 0.0);
//! assert!(below < above && above < aside);
//! # Ok::<(), gonio::shape::ShapeError>(())
//! ```

mod body;
mod error;
mod level;
mod line;
mod outlines;
mod own;
pub(crate) mod polyhedron;
mod raindrop;
#[cfg(test)]
mod samples;
mod silhouette;
mod sphere;
mod spheroid;
mod tangent;

pub(crate) use body::Body;
pub use body::Shape;
pub use error::ShapeError;
pub use own::{Outline, OwnBody};
pub use polyhedron::{Crystal, Format as MeshFormat, Mesh, MeshError};
pub use raindrop::{AxisRatioLaw, RaindropModel};
pub use silhouette::Silhouette;
pub(crate) use tangent::Tangent;
