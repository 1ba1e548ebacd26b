//! Media as scenes write them, and their curves.

use super::error::FigureError;
use crate::medium::{Medium, MediumSpec};
use std::path::Path;

/// A medium as a scene writes it.
pub fn medium(spec: &str) -> Result<Medium, FigureError> {
    Ok(MediumSpec::parse(spec)?.resolve(Path::new("."))?)
}

/// n and k at wavelengths in nm.
pub fn curve(medium: &Medium, nm: &[f64]) -> Result<(Vec<f64>, Vec<f64>), FigureError> {
    let (mut n, mut k) = (Vec::new(), Vec::new());
    for nm in nm {
        let index = medium.index(nm * 1e-9)?;
        n.push(index.re);
        k.push(index.im);
    }
    Ok((n, k))
}
