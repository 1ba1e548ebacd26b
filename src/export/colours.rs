//! Colours of scattered sunlight, in any direction between the samples of a table.

use super::ExportError;
use crate::color::{ColorWeights, Illuminant, Observer};
use crate::optics::Polarisation;
use crate::phase_table::{Axes, PhaseTable, Quantity};

/// Place of element 21 among the 16, row by row.
const ELEMENT_21: usize = 4;

/// Colour of scattered sunlight in any direction of a table.
pub(super) struct Colours<'a> {
    table: &'a PhaseTable,
    weights: ColorWeights,
    seen: Polarisation,
}

impl Colours<'_> {
    /// # Errors
    /// When the wavelengths do not cover the visible, or a filter is asked of a table that knows no
    /// polarisation.
    pub(super) fn new(table: &PhaseTable, seen: Polarisation) -> Result<Colours<'_>, ExportError> {
        if seen != Polarisation::Total && table.header.quantity != Quantity::Mueller {
            return Err(ExportError::Invalid {
                field: "polarisation".into(),
                value: format!("{seen:?}").to_lowercase(),
                accepted: "a table with quantity = \"mueller\" has it; this one knows unpolarised \
                           light alone (total)"
                    .into(),
            });
        }
        let wavelengths = &table.header.axes.wavelength;
        let weights = ColorWeights::new(wavelengths, Illuminant::Sun, Observer::Cie1931)?;
        Ok(Colours { table, weights, seen })
    }

    /// XYZ of what passes the filter of P in direction (θ, φ), bilinear between samples; φ wraps.
    pub(super) fn xyz(&self, theta: f64, phi: f64) -> [f64; 3] {
        let axes = &self.table.header.axes;
        let (i, t) = bracket(&axes.theta, theta);
        let (j, next, s) = bracket_azimuth(axes, phi);
        let above = (i + 1).min(axes.theta.len() - 1);
        self.weights.xyz(self.table.slabs.iter().map(|slab| {
            let element = |e: usize, i: usize, j: usize| f64::from(slab.values[(e, i, j)]);
            let at = |i: usize, j: usize| match self.seen {
                Polarisation::Total => element(0, i, j),
                filter => filter.passed(element(0, i, j), element(ELEMENT_21, i, j)),
            };
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
