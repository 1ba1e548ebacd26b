//! The diagram as an HDF5 file: XYZ of both polarisations over radius and angle.

use super::Diagram;
use crate::hdf5::TableError;
use crate::hdf5::diagram::{DiagramAxis, DiagramValues, write_diagram};
use std::path::Path;

/// What the numbers do not say.
#[derive(Clone, Copy, Debug)]
pub struct About<'a> {
    /// The command line that made the diagram.
    pub command_line: &'a str,
    /// Name of what shines.
    pub illuminant: &'a str,
    /// Name of the observer.
    pub observer: &'a str,
}

/// Write the diagram; the file appears only when it is complete.
///
/// # Errors
/// The file exists and `overwrite` is off, or it cannot be written.
pub fn save(
    diagram: &Diagram,
    about: About<'_>,
    path: &Path,
    overwrite: bool,
) -> Result<(), TableError> {
    let radii = diagram.radii_mm();
    let theta = diagram.theta_deg();
    let flat = |part: usize| -> Vec<f32> {
        let columns = diagram.xyz.iter().flatten();
        columns.flat_map(|cell| cell[part].map(|v| v as f32)).collect()
    };
    let (parallel, perpendicular) = (flat(0), flat(1));
    let axis = |name, units, long_name, values| DiagramAxis { name, units, long_name, values };
    let values = |name, long_name, values| DiagramValues {
        name,
        units: "sr-1",
        long_name,
        axes: &[0, 1, 2],
        values,
    };
    write_diagram(
        path,
        overwrite,
        &[
            ("Conventions", "CF-1.11"),
            ("title", "Lee diagram: colour over drop radius and scattering angle"),
            ("source", concat!("gonio ", env!("CARGO_PKG_VERSION"))),
            ("command_line", about.command_line),
            ("illuminant", about.illuminant),
            ("observer", about.observer),
            (
                "comment",
                "XYZ of the differential over the geometrical cross-section, relative to the \
                 illuminant (Y = 1 for 1 sr-1 at all wavelengths); total = parallel + perpendicular",
            ),
        ],
        &[
            axis("radius_mm", "mm", "radius of the sphere of equal volume", &radii),
            axis("theta", "degree", "scattering angle, 0 = forward", &theta),
            axis("stimulus", "1", "CIE X, Y, Z", &[0.0, 1.0, 2.0]),
        ],
        &[
            values("xyz_parallel", "light polarised along the scattering plane", &parallel),
            values("xyz_perpendicular", "light polarised across it", &perpendicular),
        ],
    )
}
