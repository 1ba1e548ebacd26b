//! An RGB picture, and how it gets into a file: complete, or not at all.

use super::error::RenderError;
use crate::pending_file;
use std::path::Path;

/// 8-bit sRGB, rows from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// `3 · width · height` bytes.
    pub rgb: Vec<u8>,
}

impl Picture {
    /// All black.
    pub fn new(width: usize, height: usize) -> Self {
        Self { width, height, rgb: vec![0; 3 * width * height] }
    }

    /// The picture as PNG, tagged as sRGB, with the program's version and what else it is to tell of itself: keywords
    /// and texts.
    ///
    /// # Errors
    /// [`RenderError::Drawing`] when the encoder refuses (a side of 0, a keyword of more than 79 letters).
    #[cfg(feature = "pictures")]
    pub fn png(&self, about: &[(&str, &str)]) -> Result<Vec<u8>, RenderError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let drawing = |error: png::EncodingError| RenderError::Drawing(error.to_string());
        let version = concat!("gonio ", env!("CARGO_PKG_VERSION"));
        for (keyword, text) in [("Software", version)].iter().chain(about) {
            encoder.add_itxt_chunk((*keyword).into(), (*text).into()).map_err(drawing)?;
        }
        let mut writer = encoder.write_header().map_err(drawing)?;
        writer.write_image_data(&self.rgb).map_err(drawing)?;
        writer.finish().map_err(drawing)?;
        Ok(bytes)
    }

    /// Write as PNG; the file appears only when it is complete.
    ///
    /// # Errors
    /// [`RenderError::Write`] with the path.
    #[cfg(feature = "pictures")]
    pub fn write_png(&self, path: &Path) -> Result<(), RenderError> {
        self.write_png_about(path, &[])
    }

    /// The same, with what the picture is to tell of itself.
    ///
    /// # Errors
    /// As for [`Picture::png`], and [`RenderError::Write`] with the path.
    #[cfg(feature = "pictures")]
    pub fn write_png_about(&self, path: &Path, about: &[(&str, &str)]) -> Result<(), RenderError> {
        write_complete(path, &self.png(about)?)
    }
}

/// Write `bytes` to `path`; the file appears only when it is complete.
///
/// # Errors
/// [`RenderError::Write`]; `path` is then as it was.
pub fn write_complete(path: &Path, bytes: &[u8]) -> Result<(), RenderError> {
    pending_file::write_whole(path, bytes)
        .map_err(|source| RenderError::Write { path: path.to_owned(), source })
}

#[cfg(all(test, feature = "pictures"))]
mod tests {
    use super::*;

    /// What a picture tells of itself can be read again.
    #[test]
    fn words_are_in_the_file() {
        let bytes = Picture::new(2, 1).png(&[("Comment", "gonio render µ.toml")]).unwrap();
        let reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let words: Vec<_> = (reader.info().utf8_text.iter())
            .map(|chunk| (chunk.keyword.clone(), chunk.get_text().unwrap()))
            .collect();
        let version = format!("gonio {}", env!("CARGO_PKG_VERSION"));
        let comment = ("Comment".to_string(), "gonio render µ.toml".to_string());
        assert_eq!(words, [("Software".to_string(), version), comment]);
    }
}
