//! Plots: common styles, and the way a figure gets into a file.
//!
//! A figure draws itself on any backend, and the ending of the file's name picks PNG or SVG.

use super::notes;
use crate::cli::failure::{Failure, Result};
use gonio::render::ensure_font;
use plotters::coord::Shift;
use plotters::prelude::*;
use std::path::Path;

pub use gonio::render::FONT;

/// Colours that stay apart for colour-blind readers (Okabe & Ito 2008), in order of use.
pub const PALETTE: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];

/// Something that can draw itself on any backend.
pub trait Figure {
    /// Draws the whole figure; `root` is filled with white already.
    fn draw<B: DrawingBackend>(
        &self,
        root: &DrawingArea<B, Shift>,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>>;
}

/// Draws `figure` and writes it as PNG or SVG, by the ending of `path`. Size in pixels.
///
/// The file appears only when it is complete.
pub fn save<F: Figure>(figure: &F, path: &Path, size: (u32, u32)) -> Result<()> {
    ensure_font()?;
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    let bytes = match ending.as_str() {
        "png" => png_bytes(figure, size)?,
        "svg" => svg_text(figure, size)?.into_bytes(),
        _ => {
            let message =
                format!("{}: a plot's file name must end in .png or .svg", path.display());
            return Err(Failure::usage(message));
        }
    };
    write_whole(path, &bytes)
}

/// The figure as the text of an SVG document.
fn svg_text<F: Figure>(figure: &F, size: (u32, u32)) -> Result<String> {
    ensure_font()?;
    let mut text = String::new();
    paint(figure, SVGBackend::with_string(&mut text, size))?;
    Ok(text)
}

/// The figure as the bytes of a PNG file.
fn png_bytes<F: Figure>(figure: &F, size: (u32, u32)) -> Result<Vec<u8>> {
    ensure_font()?;
    let mut pixels = vec![255_u8; size.0 as usize * size.1 as usize * 3];
    paint(figure, BitMapBackend::with_buffer(&mut pixels, size))?;
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size.0, size.1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let drawn = encoder.write_header().and_then(|mut writer| writer.write_image_data(&pixels));
    drawn.map_err(|error| Failure::run(error.to_string()))?;
    Ok(bytes)
}

fn paint<F: Figure, B: DrawingBackend>(figure: &F, backend: B) -> Result<()> {
    let fail = |e: String| Failure::run(format!("drawing the plot failed: {e}"));
    let root = backend.into_drawing_area();
    root.fill(&WHITE).map_err(|e| fail(e.to_string()))?;
    figure.draw(&root).map_err(|e| fail(e.to_string()))?;
    root.present().map_err(|e| fail(e.to_string()))
}

/// Writes a file; it appears only when it is complete.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<()> {
    gonio::pending_file::write_whole(path, bytes)
        .map_err(|e| Failure::from(e).while_doing(format!("cannot write {}", path.display())))?;
    notes::wrote(path);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Letters;

    impl Figure for Letters {
        fn draw<B: DrawingBackend>(
            &self,
            root: &DrawingArea<B, Shift>,
        ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
            root.draw(&Text::new("λ in µm, n², θ°", (10, 10), (FONT, 24)))
        }
    }

    #[test]
    fn letters_leave_ink_on_a_machine_without_fonts() {
        let mut pixels = vec![255_u8; 300 * 60 * 3];
        ensure_font().unwrap();
        paint(&Letters, BitMapBackend::with_buffer(&mut pixels, (300, 60))).unwrap();
        assert!(pixels.iter().filter(|&&p| p < 100).count() > 300);
        assert!(svg_text(&Letters, (300, 60)).unwrap().contains("λ in µm"));
    }

    #[test]
    fn an_unknown_ending_is_refused() {
        let error = save(&Letters, Path::new("plot.gif"), (10, 10)).unwrap_err();
        assert!(error.words().contains(".png or .svg"), "{error:?}");
    }
}
