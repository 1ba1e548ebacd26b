//! The diagram as a picture: what its title says, and the bows of ray optics beside it.

use super::columns::HIGHEST_ORDER;
use super::{LeeArgs, LeeShape, PolarisationFlag};
use gonio::lee::Request;
use gonio::medium::Medium;
use gonio::render::ColorDiagram;
use std::f64::consts::TAU;
use std::path::Path;

/// Draw and write.
pub fn draw(
    args: &LeeArgs,
    request: &Request,
    seen: &[Vec<[f64; 3]>],
    exposure: &[f64],
    path: &Path,
) -> anyhow::Result<()> {
    let shape = match args.shape {
        LeeShape::Sphere => "spheres, Lorenz–Mie".to_string(),
        LeeShape::Raindrop => format!(
            "raindrops: rays, orders 0 to {HIGHEST_ORDER}, small ones spheres; sun at {}°, azimuth {}°{}",
            args.sun_elevation_deg,
            args.azimuth_deg,
            match args.azimuth_deg.rem_euclid(360.0) {
                180.0 => ", the bow's top",
                0.0 => ", the bow's lowest point",
                _ => "",
            }
        ),
    };
    let light = match args.polarisation {
        PolarisationFlag::Total => "all polarisations",
        PolarisationFlag::Parallel => "polarised along the scattering plane",
        PolarisationFlag::Perpendicular => "polarised across the scattering plane",
    };
    let disc = if request.sun_disc { "sun's disc 0.53°" } else { "point source" };
    let spread = if request.size_spread > 0.0 {
        format!(", sizes spread by {}", request.size_spread)
    } else {
        String::new()
    };
    let radii: Vec<f64> = request.radii.iter().map(|r| r * 1e3).collect();
    let theta: Vec<f64> = request.theta.iter().map(|t| t.to_degrees()).collect();
    let diagram = ColorDiagram {
        title: &format!("Lee diagram: {} ({shape})", args.medium),
        subtitle: &format!(
            "{light}, {disc}{spread}, light {}, CIE {}; every radius scaled to the same brightest \
             luminance",
            args.illuminant, args.observer
        ),
        radii: &radii,
        logarithmic: !args.linear,
        theta: &theta,
        xyz: seen,
        exposure,
        marks: &descartes(&request.medium),
    };
    diagram.picture()?.write_png(path)?;
    Ok(())
}

/// Rainbow angles of ray optics for a sphere, red and violet.
fn descartes(medium: &Medium) -> Vec<(f64, String)> {
    let mut marks = Vec::new();
    for (nm, colour) in [(650.0, "650 nm"), (420.0, "420 nm")] {
        let Ok(index) = medium.index(nm * 1e-9) else { continue };
        for (p, bow) in [(2.0, "primary"), (3.0, "secondary")] {
            let n = index.re;
            let squared: f64 = (n * n - 1.0) / (p * p - 1.0);
            if !(0.0..1.0).contains(&squared) {
                continue;
            }
            let incident = squared.sqrt().acos();
            let refracted = (incident.sin() / n).asin();
            let turned = (p - 1.0) * std::f64::consts::PI + 2.0 * incident - 2.0 * p * refracted;
            let angle = turned.rem_euclid(TAU);
            let angle = angle.min(TAU - angle).to_degrees();
            marks.push((angle, format!("{bow} {colour}, rays")));
        }
    }
    marks
}
