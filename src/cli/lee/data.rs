//! The diagram as numbers: HDF5 and JSON.

use super::LeeArgs;
use gonio::color::to_srgb;
use gonio::hdf5::{DiagramAxis, DiagramValues, write_diagram};
use gonio::lee::Diagram;
use std::path::Path;

/// XYZ of both polarisations as HDF5.
pub fn save(args: &LeeArgs, diagram: &Diagram, path: &Path) -> anyhow::Result<()> {
    let radii: Vec<f64> = diagram.radii.iter().map(|r| r * 1e3).collect();
    let theta: Vec<f64> = diagram.theta.iter().map(|t| t.to_degrees()).collect();
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
    let command = std::env::args().collect::<Vec<_>>().join(" ");
    write_diagram(
        path,
        args.overwrite,
        &[
            ("Conventions", "CF-1.11"),
            ("title", "Lee diagram: colour over drop radius and scattering angle"),
            ("source", concat!("gonio ", env!("CARGO_PKG_VERSION"))),
            ("command_line", &command),
            ("illuminant", &args.illuminant),
            ("observer", &args.observer),
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
    )?;
    Ok(())
}

/// Colours as JSON on stdout.
pub fn print_json(
    diagram: &Diagram,
    seen: &[Vec<[f64; 3]>],
    exposure: &[f64],
    seconds: f64,
) -> anyhow::Result<()> {
    let srgb: Vec<Vec<[u8; 3]>> = seen
        .iter()
        .zip(exposure)
        .map(|(column, &e)| column.iter().map(|&xyz| to_srgb(xyz, e)).collect())
        .collect();
    let value = serde_json::json!({
        "seconds": seconds,
        "radii_mm": diagram.radii.iter().map(|r| r * 1e3).collect::<Vec<_>>(),
        "theta_deg": diagram.theta.iter().map(|t| t.to_degrees()).collect::<Vec<_>>(),
        "srgb": srgb,
    });
    println!("{}", serde_json::to_string(&value)?);
    Ok(())
}
