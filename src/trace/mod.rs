//! Tracing: what a wavefront becomes inside a particle.
//!
//! Lengths are in units of the radius of equal volume. A ray is launched at `(u, v)` on the
//! emitting plane (through the centre, normal to the light); it leaves once per order, each time as
//! an [`Exit`]. All rays of one order form a *sheet*. The tracer is generic over its scalar: real
//! rays, and the complex ones behind a caustic.

mod energy;
mod exit;
mod focal_lines;
mod ray;
mod surface_event;
mod symmetry_plane;
mod tracer;
mod wavefront;

pub use energy::{Fates, energy_by_fate};
pub use exit::{Exit, transfer};
pub use symmetry_plane::{PlaneRay, Rainbow, SymmetryPlane};
pub use tracer::{Meeting, Remainder, Tracer};
pub use wavefront::Wavefront;
