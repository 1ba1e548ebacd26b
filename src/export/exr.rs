//! OpenEXR map of the bow around the antisolar point, for renderers that take no tables.
//!
//! A square, azimuthal equidistant about the antisolar point: the distance from the centre is the
//! angle from that point (180° − θ), up to `radius` at the edges; up is the upper side (φ = 0).
//! Linear sRGB, P·(sunlight) with equal-energy light of Y = 1 per sr⁻¹; 32-bit float, uncompressed
//! scan lines (OpenEXR file layout, openexr.com/en/latest/OpenEXRFileLayout.html).

use super::ExportError;
use super::colours::Colours;
use crate::color::xyz_to_linear_srgb;
use crate::optics::Polarisation;
use crate::phase_table::PhaseTable;
use rayon::prelude::*;
use std::f64::consts::PI;

/// The bytes of the map, `size` × `size` pixels, `radius` in radians, seen through a filter that is
/// turned with the scattering plane of each pixel, or none.
///
/// # Errors
/// When the wavelengths do not cover the visible, or the table lacks the polarisation asked for.
pub fn antisolar_map(
    table: &PhaseTable,
    seen: Polarisation,
    size: u32,
    radius: f64,
) -> Result<Vec<u8>, ExportError> {
    let colours = Colours::new(table, seen)?;
    let middle = 0.5 * (f64::from(size) - 1.0);
    let scale = radius / (0.5 * f64::from(size));
    let pixel = |x: u32, y: u32| -> [f32; 3] {
        let (right, up) = (f64::from(x) - middle, middle - f64::from(y));
        let angle = scale * right.hypot(up);
        if angle > radius {
            return [0.0; 3];
        }
        // Seen from within the light, looking down at the shadow: right is φ = 270°.
        let phi = (-right).atan2(up);
        xyz_to_linear_srgb(colours.xyz(PI - angle, phi)).map(|value| value as f32)
    };
    let rows: Vec<Vec<[f32; 3]>> =
        (0..size).into_par_iter().map(|y| (0..size).map(|x| pixel(x, y)).collect()).collect();
    Ok(encode(&rows, size))
}

/// Magic number, header, table of line offsets, lines; channels in alphabetical order.
fn encode(rows: &[Vec<[f32; 3]>], size: u32) -> Vec<u8> {
    const FLOAT: i32 = 2;
    let mut file = vec![0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0];
    let mut attribute = |name: &str, kind: &str, value: &[u8]| {
        file.extend_from_slice(name.as_bytes());
        file.push(0);
        file.extend_from_slice(kind.as_bytes());
        file.push(0);
        file.extend_from_slice(&(value.len() as i32).to_le_bytes());
        file.extend_from_slice(value);
    };
    let words = |values: &[i32]| values.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>();
    let floats = |values: &[f32]| values.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>();

    let mut channels = Vec::new();
    for name in ["B", "G", "R"] {
        channels.extend_from_slice(name.as_bytes());
        channels.push(0);
        channels.extend(words(&[FLOAT, 0, 1, 1]));
    }
    channels.push(0);
    let window = words(&[0, 0, size as i32 - 1, size as i32 - 1]);
    attribute("channels", "chlist", &channels);
    attribute("compression", "compression", &[0]);
    attribute("dataWindow", "box2i", &window);
    attribute("displayWindow", "box2i", &window);
    attribute("lineOrder", "lineOrder", &[0]);
    attribute("pixelAspectRatio", "float", &floats(&[1.0]));
    attribute("screenWindowCenter", "v2f", &floats(&[0.0, 0.0]));
    attribute("screenWindowWidth", "float", &floats(&[1.0]));
    file.push(0);

    let line_bytes = 12 * size as usize;
    let first = file.len() + 8 * rows.len();
    for line in 0..rows.len() {
        file.extend_from_slice(&((first + line * (8 + line_bytes)) as u64).to_le_bytes());
    }
    for (y, row) in rows.iter().enumerate() {
        file.extend(words(&[y as i32, line_bytes as i32]));
        for channel in [2, 1, 0] {
            row.iter().for_each(|pixel| file.extend_from_slice(&pixel[channel].to_le_bytes()));
        }
    }
    file
}
