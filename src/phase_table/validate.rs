//! What a sound table is: axes that ascend, finite values, S11 ≥ |Sij|, a sum of 1.

use super::{Axes, ForwardPeak, PhaseTable, Slab, TableHeader};
use std::f64::consts::{PI, TAU};

/// How far an element may exceed S11, relative: rounding to `f32` of both.
const ELEMENT_TOLERANCE: f64 = 1e-5;
/// How far Σ P·ΔΩ may be from 1 where the table covers the sphere.
const NORMALISATION_TOLERANCE: f64 = 1e-3;

/// What is wrong with a table or its header: the field, the value, what is accepted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{field} = {value}: {accepted}")]
pub struct InvalidTable {
    pub field: String,
    pub value: String,
    pub accepted: String,
}

fn invalid(field: &str, value: impl ToString, accepted: &str) -> InvalidTable {
    InvalidTable { field: field.into(), value: value.to_string(), accepted: accepted.into() }
}

impl Axes {
    /// # Errors
    /// When an axis is empty, not finite, not ascending (θ, φ) or out of its range.
    pub fn validate(&self) -> Result<(), InvalidTable> {
        if self.wavelength.is_empty() {
            return Err(invalid("wavelengths", "none", "at least one wavelength"));
        }
        if let Some(bad) = self.wavelength.iter().find(|w| !(w.is_finite() && **w > 0.0)) {
            return Err(invalid("wavelength", bad, "a positive length in metres"));
        }
        ascending("theta", &self.theta, PI)?;
        ascending("phi", &self.phi, TAU)
    }
}

/// Angles finite, strictly ascending, within [0, most] up to rounding.
fn ascending(field: &str, angles: &[f64], most: f64) -> Result<(), InvalidTable> {
    if angles.is_empty() {
        return Err(invalid(field, "none", "at least one angle"));
    }
    let within = |angle: f64| (-1e-9..=most * (1.0 + 1e-9)).contains(&angle);
    if let Some(bad) = angles.iter().find(|angle| !within(**angle)) {
        let accepted = format!("angles from 0 to {most:.4} radians");
        return Err(invalid(field, bad, &accepted));
    }
    match angles.windows(2).find(|pair| pair[0] >= pair[1]) {
        Some(pair) => Err(invalid(field, pair[1], "angles must ascend")),
        None => Ok(()),
    }
}

impl TableHeader {
    /// # Errors
    /// When an axis is wrong, or `rotational_symmetry` contradicts the azimuths.
    pub fn validate(&self) -> Result<(), InvalidTable> {
        self.axes.validate()?;
        if self.rotational_symmetry && self.axes.phi.len() != 1 {
            let accepted = "one azimuth where the scattering does not depend on it";
            return Err(invalid("phi", format!("{} azimuths", self.axes.phi.len()), accepted));
        }
        Ok(())
    }
}

impl Slab {
    /// Check one wavelength against its header: finite, S11 ≥ |Sij|, normalised.
    ///
    /// `rounding` is the relative error with which values were stored (0: as computed).
    ///
    /// # Errors
    /// The first thing found wrong, with its place.
    pub fn validate(&self, header: &TableHeader, rounding: f64) -> Result<(), InvalidTable> {
        let axes = &header.axes;
        let place = |i: usize, j: usize| {
            format!(
                "at {} nm, theta {:.4}°, phi {:.4}°",
                self.wavelength * 1e9,
                axes.theta[i].to_degrees(),
                axes.phi[j].to_degrees()
            )
        };
        let face = self.values.index_axis(ndarray::Axis(0), 0);
        for ((element, i, j), &value) in self.values.indexed_iter() {
            if !value.is_finite() {
                return Err(invalid("phase function", value, &format!("finite {}", place(i, j))));
            }
            let (s11, size) = (f64::from(face[(i, j)]), f64::from(value.abs()));
            let most = s11 * (1.0 + ELEMENT_TOLERANCE + 2.0 * rounding);
            if element > 0 && size > most {
                let name = format!("S{}{}", element / 4 + 1, element % 4 + 1);
                let accepted = format!("at most S11 = {s11:e} {}", place(i, j));
                return Err(invalid(&name, value, &accepted));
            }
            if element == 0 && value < 0.0 {
                return Err(invalid("S11", value, &format!("not negative {}", place(i, j))));
            }
        }
        self.validate_numbers(header)
    }

    fn validate_numbers(&self, header: &TableHeader) -> Result<(), InvalidTable> {
        let (scattering, extinction) =
            (self.scattering_cross_section, self.extinction_cross_section);
        if !(scattering.is_finite() && scattering > 0.0) {
            return Err(invalid("scattering_cross_section", scattering, "a positive area in m²"));
        }
        if !(extinction.is_finite() && extinction >= scattering * (1.0 - 1e-6)) {
            let accepted = "at least the scattering cross-section";
            return Err(invalid("extinction_cross_section", extinction, accepted));
        }
        if !(-1.0..=1.0).contains(&self.asymmetry) {
            return Err(invalid("asymmetry", self.asymmetry, "from −1 to 1"));
        }
        let expected = match header.forward_peak {
            ForwardPeak::CellAverage => 1.0 - self.left_out,
            ForwardPeak::Separate => 1.0 - self.peak_share - self.left_out,
            ForwardPeak::Point => return Ok(()),
        };
        let sum = self.sum(&header.axes);
        if header.axes.cover_sphere() && (sum - expected).abs() > NORMALISATION_TOLERANCE {
            let accepted = format!(
                "{expected:.6} ± {NORMALISATION_TOLERANCE} at {} nm",
                self.wavelength * 1e9
            );
            return Err(invalid("sum of P times solid angle", sum, &accepted));
        }
        Ok(())
    }
}

impl PhaseTable {
    /// Check the whole table: axes, shapes, finite values, S11 ≥ |Sij|, normalisation.
    ///
    /// # Errors
    /// The first thing found wrong, with its place.
    pub fn validate(&self) -> Result<(), InvalidTable> {
        self.header.validate()?;
        let axes = &self.header.axes;
        if self.slabs.len() != axes.wavelength.len() {
            let accepted = format!("{}, one per wavelength", axes.wavelength.len());
            return Err(invalid("slabs", self.slabs.len(), &accepted));
        }
        let shape = (self.header.quantity.elements(), axes.theta.len(), axes.phi.len());
        self.slabs.iter().try_for_each(|slab| {
            if slab.values.dim() != shape {
                let accepted = format!("{shape:?} (elements, theta, phi)");
                return Err(invalid("slab shape", format!("{:?}", slab.values.dim()), &accepted));
            }
            slab.validate(&self.header, 0.0)
        })
    }
}
