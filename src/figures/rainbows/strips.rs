//! Strips of colours over the scattering angle, of spheres and raindrops, and of tables.

use crate::color::{Illuminant, Observer, SUN_ANGULAR_RADIUS, to_srgb};
use crate::figures::FigureError;
use crate::lee::Request;
use crate::medium::MediumSpec;
use crate::phase_table::PhaseTable;
use crate::render::plots::sheet::Strip;
use crate::render::rotational_xyz;
use std::path::Path;

/// Luminance of the brightest place of a strip.
pub const PEAK: f64 = 0.85;

/// Drops of water of these radii (metres) in daylight with the sun's disc, at angles in degrees.
pub fn daylight(radii: Vec<f64>, degrees: &[f64]) -> Result<Request, FigureError> {
    Ok(Request {
        radii,
        theta: degrees.iter().map(|t| t.to_radians()).collect(),
        medium: MediumSpec::default().resolve(Path::new("."))?,
        sun_disc: true,
        size_spread: 0.0,
        illuminant: Illuminant::D65,
        observer: Observer::Cie1931,
        fineness: 1.0,
    })
}

/// What the sun's disc shows of a table without azimuth dependence, XYZ at angles in degrees.
pub fn of_table(table: &PhaseTable, degrees: &[f64]) -> Result<Vec<[f64; 3]>, FigureError> {
    let out: Vec<f64> = degrees.iter().map(|t| t.to_radians()).collect();
    let (light, eye) = (Illuminant::D65, Observer::Cie1931);
    let xyz = rotational_xyz(table, 0, light, eye, SUN_ANGULAR_RADIUS, &out);
    Ok(xyz.map_err(crate::render::RenderError::from)?)
}

/// The exposure that gives the brightest colour the luminance [`PEAK`].
pub fn exposure(xyz: &[[f64; 3]]) -> f64 {
    let brightest = xyz.iter().map(|xyz| xyz[1]).fold(0.0, f64::max);
    if brightest > 0.0 { PEAK / brightest } else { 0.0 }
}

/// A strip with an exposure.
pub fn strip(name: &str, xyz: &[[f64; 3]], exposure: f64) -> Strip {
    Strip { name: name.into(), colours: xyz.iter().map(|&xyz| to_srgb(xyz, exposure)).collect() }
}
