//! A picture as light: linear sRGB.

use crate::color::{decode_srgb, encode_srgb, fit_gamut};
use crate::render::picture::Picture;

/// Linear sRGB, rows from the top; 1 is white.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearPicture {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// `3 · width · height` values.
    pub rgb: Vec<f32>,
}

impl LinearPicture {
    /// The light of a picture.
    ///
    /// ```
    /// use gonio::render::{Picture, photo::LinearPicture};
    ///
    /// let picture = Picture { width: 1, height: 1, rgb: vec![0, 128, 255] };
    /// let light = LinearPicture::of(&picture);
    /// assert!((light.rgb[1] - 0.2159).abs() < 1e-4 && light.rgb[2] == 1.0);
    /// assert_eq!(light.plus(&LinearPicture { rgb: vec![0.0; 3], ..light.clone() }, 1.0), picture);
    /// ```
    pub fn of(picture: &Picture) -> Self {
        let known: Vec<f32> = (0..256).map(|v| decode_srgb(f64::from(v) / 255.0) as f32).collect();
        let rgb = picture.rgb.iter().map(|&v| known[usize::from(v)]).collect();
        Self { width: picture.width, height: picture.height, rgb }
    }

    /// The light of one pixel.
    pub fn at(&self, column: usize, row: usize) -> [f64; 3] {
        let first = 3 * (row * self.width + column);
        [0, 1, 2].map(|c| f64::from(self.rgb[first + c]))
    }

    /// Light added, times a factor, as a picture of bytes; of the smaller number of pixels.
    pub fn plus(&self, light: &Self, factor: f64) -> Picture {
        let mut picture = Picture::new(self.width, self.height);
        let pixels = picture.rgb.chunks_exact_mut(3);
        let both = self.rgb.chunks_exact(3).zip(light.rgb.chunks_exact(3));
        for (out, (own, more)) in pixels.zip(both) {
            let sum = [0, 1, 2].map(|c| f64::from(own[c]) + factor * f64::from(more[c]));
            out.copy_from_slice(&fit_gamut(sum).map(|v| (255.0 * encode_srgb(v)).round() as u8));
        }
        picture
    }
}
