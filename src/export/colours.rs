//! Colours of scattered sunlight, in any direction between the samples of a table.

use super::ExportError;
use crate::color::{ColorWeights, Illuminant, Observer};
use crate::phase_table::{Axes, PhaseTable};

/// Colour of scattered sunlight in any direction of a table.
pub(super) struct Colours<'a> {
    table: &'a PhaseTable,
    weights: ColorWeights,
}

impl Colours<'_> {
    /// # Errors
    /// When the wavelengths do not cover the visible.
    pub(super) fn new(table: &PhaseTable) -> Result<Colours<'_>, ExportError> {
        let wavelengths = &table.header.axes.wavelength;
        let weights = ColorWeights::new(wavelengths, Illuminant::Sun, Observer::Cie1931)?;
        Ok(Colours { table, weights })
    }

    /// XYZ of P in direction (θ, φ), bilinear between samples; φ wraps.
    pub(super) fn xyz(&self, theta: f64, phi: f64) -> [f64; 3] {
        let axes = &self.table.header.axes;
        let (i, t) = bracket(&axes.theta, theta);
        let (j, next, s) = bracket_azimuth(axes, phi);
        let above = (i + 1).min(axes.theta.len() - 1);
        self.weights.xyz(self.table.slabs.iter().map(|slab| {
            let at = |i: usize, j: usize| f64::from(slab.values[(0, i, j)]);
            let low = at(i, j) * (1.0 - s) + at(i, next) * s;
            let high = at(above, j) * (1.0 - s) + at(above, next) * s;
            low * (1.0 - t) + high * t
        }))
    }
}

/// Interval and place in it.
fn bracket(line: &[f64], at: f64) -> (usize, f64) {
    if line.len() < 2 {
        return (0, 0.0);
    }
    let low = line.partition_point(|value| *value <= at).clamp(1, line.len() - 1) - 1;
    (low, ((at - line[low]) / (line[low + 1] - line[low])).clamp(0.0, 1.0))
}

/// The two azimuths around `phi` and the place between them.
fn bracket_azimuth(axes: &Axes, phi: f64) -> (usize, usize, f64) {
    use std::f64::consts::TAU;
    let line = &axes.phi;
    let last = line.len() - 1;
    let phi = line[0] + (phi - line[0]).rem_euclid(TAU);
    if phi > line[last] {
        let gap = line[0] + TAU - line[last];
        return (last, 0, if gap > 0.0 { (phi - line[last]) / gap } else { 0.0 });
    }
    let (low, t) = bracket(line, phi);
    (low, (low + 1).min(last), t)
}
