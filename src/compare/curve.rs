//! Intensity over the scattering angle, taken from a table.

use crate::phase_table::{PhaseTable, Quantity, Slab};

/// Intensities over the scattering angle.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Degrees, ascending.
    pub theta: Vec<f64>,
    /// Unpolarised, parallel and perpendicular, sr⁻¹; the last two only from Mueller tables.
    pub intensity: Vec<(&'static str, Vec<f64>)>,
}

impl Curve {
    /// The curve of `table` at the wavelength nearest to `wavelength` (metres) and the first
    /// azimuth, scaled by its scattering cross-section over that of `reference`: what is compared is
    /// scattered power, so that leaving out an order or the diffraction does not change the others.
    pub fn relative_to(table: &PhaseTable, reference: &PhaseTable, wavelength: f64) -> Self {
        let (Some(own), Some(other)) = (nearest(table, wavelength), nearest(reference, wavelength))
        else {
            return Self { theta: Vec::new(), intensity: Vec::new() };
        };
        Self::of(table, own, 0, own.scattering_cross_section / other.scattering_cross_section)
    }

    /// The curve of one wavelength and azimuth (by index), times a factor.
    pub fn of(table: &PhaseTable, slab: &Slab, azimuth: usize, factor: f64) -> Self {
        let theta: Vec<f64> =
            table.header.axes.theta.iter().map(|t| (t.to_degrees() * 1e9).round() * 1e-9).collect();
        let element = |e: usize| -> Vec<f64> {
            (0..theta.len()).map(|t| factor * f64::from(slab.values[[e, t, azimuth]])).collect()
        };
        let total = element(0);
        let mut intensity = Vec::new();
        if table.header.quantity == Quantity::Mueller {
            let q = element(1);
            let mix = |sign: f64| total.iter().zip(&q).map(|(i, q)| i + sign * q).collect();
            intensity.push(("parallel", mix(1.0)));
            intensity.push(("perpendicular", mix(-1.0)));
        }
        intensity.insert(0, ("unpolarised", total));
        Self { theta, intensity }
    }

    /// Linear interpolation; nothing outside.
    pub fn at(&self, which: usize, theta: f64) -> Option<f64> {
        let values = &self.intensity.get(which)?.1;
        let above = self.theta.partition_point(|&t| t <= theta + 1e-9);
        if above == 0 {
            return None;
        }
        let low = above - 1;
        if (theta - self.theta[low]).abs() < 1e-7 {
            return Some(values[low]);
        }
        let high = self.theta.get(above)?;
        let share = (theta - self.theta[low]) / (high - self.theta[low]);
        Some(values[low] + share * (values[above] - values[low]))
    }
}

/// The slab of the wavelength nearest to `wavelength` (metres).
pub(super) fn nearest(table: &PhaseTable, wavelength: f64) -> Option<&Slab> {
    table.slabs.iter().min_by(|a, b| {
        (a.wavelength - wavelength).abs().total_cmp(&(b.wavelength - wavelength).abs())
    })
}
