//! The diagram as a picture: what its title says, and the bows of ray optics beside it.

use super::args::{LeeArgs, LeeMethod, LeeShape};
use crate::cli::args::polarisation::PolarisationFlag;
use crate::cli::args::ranges::radii;
use crate::cli::command_line::command_line;
use crate::cli::failure::Result;
use gonio::lee::{HIGHEST_ORDER, Request};
use gonio::medium::Medium;
use gonio::optics::rainbow_angle;
use gonio::render::ColorDiagram;
use std::path::Path;

/// Draw and write.
pub fn draw(
    args: &LeeArgs,
    request: &Request,
    seen: &[Vec<[f64; 3]>],
    exposure: &[f64],
    path: &Path,
) -> Result<()> {
    let shape = match args.shape {
        LeeShape::Sphere if args.method == LeeMethod::Airy => {
            "spheres, Airy's theory of both bows".to_string()
        }
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
    let millimetres: Vec<f64> = request.radii.iter().map(|r| r * 1e3).collect();
    let theta: Vec<f64> = request.theta.iter().map(|t| t.to_degrees()).collect();
    let diagram = ColorDiagram {
        title: &format!("Lee diagram: {} ({shape})", args.medium),
        subtitle: &format!(
            "{light}, {disc}{spread}, light {}, CIE {}; every radius scaled to the same brightest \
             luminance",
            args.illuminant, args.observer
        ),
        radii: &millimetres,
        logarithmic: radii(&args.radius_mm, args.linear)?.logarithmic,
        theta: &theta,
        xyz: seen,
        exposure,
        // a flattened drop's bows lie elsewhere for each radius
        marks: &match args.shape {
            LeeShape::Sphere => descartes(&request.medium),
            LeeShape::Raindrop => Vec::new(),
        },
    };
    let about = [("Title", "Lee diagram"), ("Comment", &command_line())];
    diagram.picture()?.write_png_about(path, &about)?;
    Ok(())
}

/// Rainbow angles of ray optics for a sphere, red and violet.
fn descartes(medium: &Medium) -> Vec<(f64, String)> {
    let mut marks = Vec::new();
    for (nm, colour) in [(650.0, "650 nm"), (420.0, "420 nm")] {
        let Ok(index) = medium.index(nm * 1e-9) else { continue };
        for (order, bow) in [(2, "primary"), (3, "secondary")] {
            if let Some(angle) = rainbow_angle(index.re, order) {
                marks.push((angle.to_degrees(), format!("{bow} {colour}, rays")));
            }
        }
    }
    marks
}
