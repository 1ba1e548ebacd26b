//! The font compiled into the program: a bare machine has none, and without one nothing is drawn.

use crate::render::error::RenderError;
use plotters::style::{FontStyle, register_font};
use std::sync::OnceLock;

/// Family name under which the shipped font (DejaVu Sans) is registered.
pub const FONT: &str = "sans-serif";

/// Register the shipped font, once per process; every plot calls it first.
///
/// # Errors
/// [`RenderError::Drawing`] if the compiled-in font cannot be read.
pub fn ensure_font() -> Result<(), RenderError> {
    static REGISTERED: OnceLock<bool> = OnceLock::new();
    let registered = REGISTERED.get_or_init(|| {
        let bytes = include_bytes!("../../../data/fonts/DejaVuSans-subset.ttf");
        register_font(FONT, FontStyle::Normal, bytes).is_ok()
    });
    if *registered {
        Ok(())
    } else {
        Err(RenderError::Drawing("the font compiled into the program is damaged".into()))
    }
}
