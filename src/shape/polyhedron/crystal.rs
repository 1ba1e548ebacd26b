//! Crystals and prisms by their proportions, and meshes; how light goes through them stands in [`crate::facets`].

use super::mesh::Mesh;
use std::sync::Arc;

/// A convex body of flat facets. Axis ratios are length over width, angles radians.
#[derive(Clone, Debug, PartialEq)]
pub enum Crystal {
    /// A hexagonal column (or plate): length over width from corner to corner.
    HexagonalColumn {
        /// Length over width.
        axis_ratio: f64,
    },
    /// A prism over an isosceles triangle: length of its edge over the side opposite to it.
    TriangularPrism {
        /// Length over the side opposite to the wedge.
        axis_ratio: f64,
        /// Of the wedge.
        apex: f64,
    },
    /// A cuboid on a square base: height over side.
    Cuboid {
        /// Height over side.
        axis_ratio: f64,
    },
    /// A regular octahedron.
    Octahedron,
    /// A hexagonal column with pyramids on both ends: the ratio is that of the column between them.
    PyramidalCrystal {
        /// Of the column.
        axis_ratio: f64,
        /// Between opposite facets of a pyramid.
        apex: f64,
    },
    /// A hexagonal column with a pyramid on its lower end.
    Bullet {
        /// Of the column.
        axis_ratio: f64,
        /// Between opposite facets of the pyramid.
        apex: f64,
    },
    /// A hexagonal column that narrows upwards.
    TaperedColumn {
        /// Length over the width half-way up.
        axis_ratio: f64,
        /// Between opposite sides.
        apex: f64,
    },
    /// A round brilliant.
    Brilliant,
    /// A closed convex mesh of a file.
    Mesh(Arc<Mesh>),
}

impl Crystal {
    /// The word of scenes.
    ///
    /// ```
    /// use gonio::shape::Crystal;
    /// assert_eq!(Crystal::Octahedron.name(), "octahedron");
    /// ```
    pub fn name(&self) -> &'static str {
        match self {
            Crystal::HexagonalColumn { .. } => "hexagonal-column",
            Crystal::TriangularPrism { .. } => "triangular-prism",
            Crystal::Cuboid { .. } => "cuboid",
            Crystal::Octahedron => "octahedron",
            Crystal::PyramidalCrystal { .. } => "pyramidal-crystal",
            Crystal::Bullet { .. } => "bullet",
            Crystal::TaperedColumn { .. } => "tapered-column",
            Crystal::Brilliant => "brilliant",
            Crystal::Mesh(_) => "mesh",
        }
    }
}
