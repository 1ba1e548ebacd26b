//! OpenEXR map of the bow around the antisolar point, for renderers that take no tables.
//!
//! A square, azimuthal equidistant about the antisolar point: the distance from the centre is the
//! angle from that point (180° − θ), up to `radius` at the edges; up is the upper side (φ = 0).
//! Linear sRGB, P·(sunlight) with equal-energy light of Y = 1 per sr⁻¹; 32-bit float, scan lines in
//! zlib blocks of 16, which every reader knows.

use super::ExportError;
use super::colours::Colours;
use crate::color::xyz_to_linear_srgb;
use crate::optics::Polarisation;
use crate::phase_table::PhaseTable;
use exr::prelude::{
    Blocks, Compression, Encoding, Image, LineOrder, SpecificChannels, Vec2, WritableImage,
};
use rayon::prelude::*;
use std::f64::consts::PI;
use std::io::Cursor;

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
    let row = |y: u32| (0..size).map(move |x| (x, y));
    let places = (0..size).into_par_iter().flat_map_iter(row);
    let pixels: Vec<[f32; 3]> = places.map(|(x, y)| pixel(x, y)).collect();
    Ok(encode(&pixels, size as usize)?)
}

/// The file of `size` × `size` pixels, row by row.
fn encode(pixels: &[[f32; 3]], size: usize) -> exr::error::Result<Vec<u8>> {
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let channels = SpecificChannels::rgb(|at: Vec2<usize>| {
        let [red, green, blue] = pixels[at.y() * size + at.x()];
        (red, green, blue)
    });
    let mut file = Cursor::new(Vec::new());
    Image::from_encoded_channels((size, size), encoding, channels)
        .write()
        .to_buffered(&mut file)?;
    Ok(file.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;
    use exr::prelude::{FlatSamples, ReadChannels, ReadLayers, read};

    /// Every bit of every pixel comes back, at its place, by channels of these names.
    #[test]
    fn pixels_are_stored_without_loss() {
        let size = 37;
        let value = |at: usize| [1.0 / (1 + at) as f32, (at as f32).exp2(), -0.0];
        let pixels: Vec<[f32; 3]> = (0..size * size).map(value).collect();
        let bytes = encode(&pixels, size).unwrap();
        let image = read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes()
            .from_buffered(Cursor::new(bytes))
            .unwrap();
        assert_eq!(image.layer_data.size, Vec2(size, size));
        let channels = &image.layer_data.channel_data.list;
        let names: Vec<String> = channels.iter().map(|c| c.name.to_string()).collect();
        assert_eq!(names, ["B", "G", "R"]);
        for (channel, colour) in channels.iter().zip([2, 1, 0]) {
            let FlatSamples::F32(values) = &channel.sample_data else { panic!("32 bits") };
            let same = values.iter().zip(&pixels).all(|(a, b)| a.to_bits() == b[colour].to_bits());
            assert!(same && values.len() == pixels.len(), "channel {}", channel.name);
        }
    }
}
