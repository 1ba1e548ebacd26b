//! The mean over azimuth, with the forward peak cut and its share told.

use super::{ExportError, invalid};
use crate::phase_table::{Axes, PhaseTable, Quantity, Slab};

/// Elements that a randomly turned particle has, by their place in the Mueller matrix.
pub const ELEMENTS: [(&str, usize); 6] =
    [("11", 0), ("12", 1), ("22", 5), ("33", 10), ("34", 11), ("44", 15)];

/// One wavelength, mean over azimuth.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Metres.
    pub wavelength: f64,
    /// Values in sr⁻¹ per element of [`ELEMENTS`] and θ; all but "11" are zero where the table has
    /// the phase function alone. Scaled so that ∫ P11 dΩ = 1 without the peak.
    pub elements: [Vec<f64>; 6],
    /// Share of the scattered power that was cut.
    pub peak_share: f64,
    /// Cross-sections (m²) without the cut peak, which counts as unscattered.
    pub scattering_cross_section: f64,
    /// The same for extinction, m².
    pub extinction_cross_section: f64,
    /// Mean cosine of what is left.
    pub asymmetry: f64,
}

/// All wavelengths, mean over azimuth.
#[derive(Clone, Debug, PartialEq)]
pub struct Averaged {
    /// Radians, ascending.
    pub theta: Vec<f64>,
    /// One per wavelength.
    pub curves: Vec<Curve>,
    /// Angle below which P keeps the value that it has there, radians (0: nothing is cut).
    pub cap: f64,
    /// The table has the whole Mueller matrix.
    pub polarised: bool,
    /// Spheres: elements 22 and 44 are 11 and 33.
    pub spherical: bool,
}

/// Average a table over azimuth and cut the forward peak below the angle `cap` (radians).
///
/// # Errors
/// When the table does not cover all scattering angles and azimuths, or the cap is out of range.
pub fn average(table: &PhaseTable, cap: f64) -> Result<Averaged, ExportError> {
    let axes = &table.header.axes;
    if !axes.cover_sphere() {
        let accepted = "scattering angles from 0 to 180 degrees and all azimuths";
        return Err(invalid("table", "part of the sphere", accepted));
    }
    if !(0.0..=1.0).contains(&cap) {
        let accepted = "0 (cut nothing) to 57 degrees";
        return Err(invalid("--cap-deg", cap.to_degrees(), accepted));
    }
    let polarised = table.header.quantity == Quantity::Mueller;
    let curves = table.slabs.iter().map(|slab| curve(slab, axes, cap, polarised)).collect();
    let spherical = table.header.shape == "sphere";
    Ok(Averaged { theta: axes.theta.clone(), curves, cap, polarised, spherical })
}

/// Largest size, relative to element 11, of what the six elements of [`ELEMENTS`] cannot hold of the
/// mean over azimuth: 21 - 12, 43 + 34 and the eight that vanish by symmetry.
pub(super) fn average_departure(table: &PhaseTable) -> f64 {
    const BLOCKS: [usize; 8] = [2, 3, 6, 7, 8, 9, 12, 13];
    let axes = &table.header.axes;
    let mut most = 0.0f64;
    for slab in &table.slabs {
        let element = |e: usize| slab.azimuth_mean(axes, e);
        let (p11, p12, p21) = (element(0), element(1), element(4));
        let (p34, p43) = (element(11), element(14));
        let others = BLOCKS.map(element);
        for (i, whole) in p11.iter().enumerate().filter(|(_, whole)| **whole > 0.0) {
            let rest = others.iter().map(|values| values[i].abs()).fold(0.0, f64::max);
            let odd = (p21[i] - p12[i]).abs().max((p34[i] + p43[i]).abs());
            most = most.max(odd.max(rest) / whole);
        }
    }
    most
}

fn curve(slab: &Slab, axes: &Axes, cap: f64, polarised: bool) -> Curve {
    let mut elements = ELEMENTS.map(|(_, element)| {
        if element == 0 || polarised {
            slab.azimuth_mean(axes, element)
        } else {
            vec![0.0; axes.theta.len()]
        }
    });
    // A peak that the table already holds apart is not in the values.
    let apart = slab.peak_share;
    let before = integral(axes, &elements[0], |_| 1.0);
    if let Some(edge) =
        axes.theta.iter().position(|theta| *theta >= cap * (1.0 - 1e-9)).filter(|_| cap > 0.0)
    {
        // Ratios to S11 stay: the capped part is polarised as it was.
        for i in 0..edge {
            let factor = (elements[0][edge] / elements[0][i]).min(1.0);
            elements.iter_mut().for_each(|values| values[i] *= factor);
        }
    }
    let after = integral(axes, &elements[0], |_| 1.0);
    let cut = (1.0 - after / before).max(0.0);
    elements.iter_mut().flatten().for_each(|value| *value /= after);
    let asymmetry = integral(axes, &elements[0], f64::cos);
    let peak_share = 1.0 - (1.0 - apart) * (1.0 - cut);
    let lost = slab.scattering_cross_section * peak_share;
    Curve {
        wavelength: slab.wavelength,
        elements,
        peak_share,
        scattering_cross_section: slab.scattering_cross_section - lost,
        extinction_cross_section: slab.extinction_cross_section - lost,
        asymmetry,
    }
}

/// 2π Σ f(θ) P ΔΩ over the θ cells of the table.
fn integral(axes: &Axes, values: &[f64], weight: impl Fn(f64) -> f64) -> f64 {
    let (widths, _) = axes.solid_angle_factors();
    let terms = values.iter().zip(&widths).zip(&axes.theta);
    std::f64::consts::TAU
        * terms.map(|((value, width), theta)| value * width * weight(*theta)).sum::<f64>()
}

impl Averaged {
    /// The elements that the table has, by name and place in [`ELEMENTS`], in the order in which
    /// libRadtran and Eradiate count them: those of spheres first, then 22 and 44.
    pub(super) fn elements(&self) -> &'static [(&'static str, usize)] {
        const ORDER: [(&str, usize); 6] =
            [("11", 0), ("12", 1), ("33", 3), ("34", 4), ("22", 2), ("44", 5)];
        match (self.polarised, self.spherical) {
            (false, _) => &ORDER[..1],
            (true, true) => &ORDER[..4],
            (true, false) => &ORDER,
        }
    }

    /// P11 of a curve at any θ (radians), linear between the samples.
    pub(super) fn p11(&self, curve: &Curve, theta: f64) -> f64 {
        let values = &curve.elements[0];
        let high = self.theta.partition_point(|t| *t < theta).clamp(1, self.theta.len() - 1);
        let (low_theta, high_theta) = (self.theta[high - 1], self.theta[high]);
        let t = ((theta - low_theta) / (high_theta - low_theta)).clamp(0.0, 1.0);
        values[high - 1] * (1.0 - t) + values[high] * t
    }
}
