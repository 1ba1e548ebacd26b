//! Where a deflection curve begins, turns back, crosses the axis and ends.

use super::fold::Fold;
use super::scattering_plane::Node;

/// Landmarks along a plane.
#[derive(Clone, Debug)]
pub(crate) enum Landmark {
    Axial,
    Fold(Fold),
    /// Crossing of the axis between two nodes; unwrapped angle of the axis.
    Axis(f64),
    /// Just a launch coordinate, the same on all planes.
    Cut(f64),
    /// Last ray that leaves: the rim, or the edge of total reflection.
    End(Box<Node>),
}
