//! Tracing: what a wavefront becomes inside a particle.
//!
//! Lengths are in units of the radius of equal volume. A ray is launched at `(u, v)` on the
//! emitting plane (through the centre, normal to the light); it leaves once per order, each time as
//! an [`Exit`]. All rays of one order form a *sheet*. The tracer is generic over its scalar: real
//! rays, and the complex ones behind a caustic.
//!
//! ```
//! use gonio::shape::Shape;
//! use gonio::trace::Tracer;
//!
//! // the ray that turns back at the primary bow of a water drop (Descartes)
//! let (shape, index) = (Shape::sphere(), 1.333f64);
//! let tracer = Tracer::new(&shape, index.into(), 5000.0, 2);
//! let impact = ((4.0 - index * index) / 3.0).sqrt();
//! let bow = tracer.trace_order(impact, 0.0, 2).expect("the ray meets the sphere");
//! assert!((bow.scattering_angle().to_degrees() - 137.92).abs() < 0.01);
//! ```

mod energy;
mod exit;
mod focal_lines;
mod meeting;
mod radial;
mod radial_path;
mod ray;
mod surface_event;
mod symmetry_plane;
mod tracer;
mod wavefront;

pub use energy::{Fates, energy_by_fate};
pub use exit::Exit;
pub(crate) use exit::transfer;
pub(crate) use meeting::Meeting;
pub use radial::{Chord, RadialRays};
pub use symmetry_plane::{PlaneRay, Rainbow, SymmetryPlane};
pub use tracer::{Remainder, Tracer};
pub use wavefront::Wavefront;
