//! PNG strip of the colours of a table along the scattering angle.

use super::ExportError;
use super::colours::Colours;
use crate::color::{fit_gamut, to_srgb, xyz_to_linear_srgb};
use crate::optics::Polarisation;
use crate::phase_table::PhaseTable;

/// PNG of the colours over θ (left to right, `from` to `to`, radians) at one azimuth, seen through a
/// filter or none; the brightest colour is just not clipped.
///
/// # Errors
/// When the wavelengths do not cover the visible, the table lacks the polarisation asked for, or the
/// picture cannot be encoded.
pub fn png(
    table: &PhaseTable,
    azimuth: f64,
    seen: Polarisation,
    (from, to): (f64, f64),
    (width, height): (u32, u32),
) -> Result<Vec<u8>, ExportError> {
    let colours = Colours::new(table, seen)?;
    let at = |x: u32| from + (to - from) * f64::from(x) / f64::from(width.max(2) - 1);
    let line: Vec<[f64; 3]> = (0..width).map(|x| colours.xyz(at(x), azimuth)).collect();
    let brightest = |xyz: &[f64; 3]| {
        xyz_to_linear_srgb(*xyz)
            .into_iter()
            .chain(fit_gamut(xyz_to_linear_srgb(*xyz)))
            .fold(0.0, f64::max)
    };
    let most = line.iter().map(brightest).fold(f64::MIN_POSITIVE, f64::max);
    let pixels: Vec<u8> = line.iter().flat_map(|xyz| to_srgb(*xyz, 1.0 / most)).collect();

    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&pixels.repeat(height as usize))?;
    writer.finish()?;
    Ok(file)
}
