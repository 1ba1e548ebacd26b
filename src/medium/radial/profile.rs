//! Radial profiles by formula or table, r in units of the radius.
//!
//! Luneburg's lens `√(c - r²)` (c = 2 is the lens of Luneburg 1944, which focuses on its far side),
//! Maxwell's fish-eye `2/(1 + r²)`, a Gaussian `a exp(-b r²)` (1 at the surface unless b is given),
//! the inverse `k/r`, a polynomial in r², a line from centre to surface, a table.

use crate::math::chebyshev::Chebyshev;
use crate::math::monotone::MonotoneCurve;
use crate::medium::error::{MediumError, invalid, is_plausible};
use num_complex::Complex64;
use std::f64::consts::PI;
use std::sync::Arc;

/// A profile.
#[derive(Clone, Debug, PartialEq)]
pub enum Profile {
    /// `√(c - r²)`.
    Luneburg {
        /// The square of the index at the centre.
        c: f64,
    },
    /// `2/(1 + r²)`.
    FishEye,
    /// `a exp(-b r²)`.
    Gaussian {
        /// The index at the centre.
        a: f64,
        /// How fast it falls.
        b: f64,
    },
    /// `k/r`.
    Inverse {
        /// The index at the surface.
        k: f64,
    },
    /// Coefficients of 1, r², r⁴, …
    Polynomial(Vec<f64>),
    /// From centre to surface.
    Linear {
        /// The index there.
        centre: f64,
        /// The index there.
        surface: f64,
    },
    /// n and k by radius.
    Table {
        /// Of the file.
        name: String,
        /// Real part.
        n: Arc<MonotoneCurve>,
        /// Imaginary part, if there is one.
        k: Option<Arc<MonotoneCurve>>,
    },
}

/// Radii at which a profile is looked at before it is accepted.
const SAMPLES: usize = 2000;

impl Profile {
    /// Refuses profiles that are no index somewhere inside.
    ///
    /// # Errors
    /// With the radius and the value.
    pub fn checked(self) -> Result<Self, MediumError> {
        if let Self::Inverse { k } = self {
            return match k > 0.0 && k.is_finite() {
                true => Ok(self),
                false => Err(invalid("medium: k", k, "the index at the surface, above 0")),
            };
        }
        for i in 0..=SAMPLES {
            let r = i as f64 / SAMPLES as f64;
            let index = self.index(r);
            if !(index.re > 0.0 && index.im >= 0.0 && is_plausible(index)) {
                let value = format!("n = {}, k = {} at r = {r}", index.re, index.im);
                let accepted = "n above 0 and k of at least 0 from centre to surface";
                return Err(invalid(&format!("medium: {}", self.name()), value, accepted));
            }
        }
        Ok(self)
    }

    /// Index at a radius.
    pub fn index(&self, r: f64) -> Complex64 {
        match self {
            Self::Luneburg { c } => (c - r * r).sqrt().into(),
            Self::FishEye => (2.0 / (1.0 + r * r)).into(),
            Self::Gaussian { a, b } => (a * (-b * r * r).exp()).into(),
            Self::Inverse { k } => (k / r).into(),
            Self::Polynomial(coefficients) => {
                coefficients.iter().rev().fold(0.0, |sum, c| sum * r * r + c).into()
            }
            Self::Linear { centre, surface } => (centre + (surface - centre) * r).into(),
            Self::Table { n, k, .. } => {
                Complex64::new(n.value(r), k.as_ref().map_or(0.0, |k| k.value(r)))
            }
        }
    }

    /// Radii at which it, or one of its first four derivatives, jumps.
    fn breaks(&self) -> Vec<f64> {
        match self {
            Self::Table { n, k, .. } => {
                let mut radii = n.points().0.to_vec();
                radii.extend(k.iter().flat_map(|k| k.points().0));
                radii
            }
            _ => Vec::new(),
        }
    }

    /// What it is called.
    pub fn name(&self) -> String {
        match self {
            Self::Luneburg { c } => format!("profile luneburg, c = {c}"),
            Self::FishEye => "profile fish-eye".into(),
            Self::Gaussian { a, b } => format!("profile gaussian, a = {a}, b = {b}"),
            Self::Inverse { k } => format!("profile inverse, k = {k}"),
            Self::Polynomial(coefficients) => format!("profile polynomial {coefficients:?} in r²"),
            Self::Linear { centre, surface } => format!("profile linear, {centre} to {surface}"),
            Self::Table { name, .. } => format!("profile of {name}"),
        }
    }
}

/// What varies smoothly at one wavelength, relative to an index outside.
#[derive(Clone, Debug)]
pub enum Smooth {
    /// A profile.
    Profile {
        /// As it is written.
        profile: Profile,
        /// Index by which it is divided.
        outside: f64,
    },
    /// n and k by what diffuses, 0 at the surface and 1 at the centre.
    Diffused(Chebyshev<2>),
}

/// The slowest mode of diffusion in a sphere with a fixed surface: `sin(πr)/πr`.
pub(super) fn diffused(r: f64) -> f64 {
    let x = PI * r;
    if x < 1e-4 { 1.0 - x * x / 6.0 } else { x.sin() / x }
}

impl Smooth {
    /// A profile relative to an index outside.
    pub fn profile(profile: &Profile, outside: f64) -> Self {
        Self::Profile { profile: profile.clone(), outside }
    }

    /// Index at a radius.
    pub fn index(&self, r: f64) -> Complex64 {
        match self {
            Self::Profile { profile, outside } => profile.index(r) / outside,
            Self::Diffused(curve) => {
                let [n, k] = curve.at(diffused(r)).0;
                Complex64::new(n, k.max(0.0))
            }
        }
    }

    /// Radii of jumps and kinks.
    pub fn breaks(&self) -> Vec<f64> {
        match self {
            Self::Profile { profile, .. } => profile.breaks(),
            Self::Diffused(_) => Vec::new(),
        }
    }

    /// Whether nothing absorbs.
    pub fn transparent(&self) -> bool {
        match self {
            Self::Profile { profile: Profile::Table { k, .. }, .. } => {
                k.as_ref().is_none_or(|k| k.points().1.iter().all(|k| *k == 0.0))
            }
            Self::Profile { .. } => true,
            Self::Diffused(curve) => (0..=8).all(|i| curve.at(f64::from(i) / 8.0).0[1] == 0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The formulas at a radius, and what is no index anywhere inside.
    #[test]
    fn formulas_and_refusals() {
        let at = |profile: Profile, r: f64| profile.checked().unwrap().index(r).re;
        assert!((at(Profile::Luneburg { c: 2.0 }, 0.6) - 1.64f64.sqrt()).abs() < 1e-15);
        assert_eq!(at(Profile::FishEye, 1.0), 1.0);
        let gaussian = Profile::Gaussian { a: 1.4, b: 1.4f64.ln() };
        assert!((at(gaussian, 1.0) - 1.0).abs() < 1e-15);
        assert!((at(Profile::Polynomial(vec![1.3, 0.1, 0.01]), 0.5) - 1.325_625).abs() < 1e-15);
        assert_eq!(at(Profile::Linear { centre: 1.4, surface: 1.3 }, 1.0), 1.3);
        assert_eq!(at(Profile::Inverse { k: 1.5 }, 0.5), 3.0);
        let refused = |profile: Profile| profile.checked().unwrap_err().to_string();
        assert!(refused(Profile::Luneburg { c: 0.9 }).contains("n above 0"));
        assert!(refused(Profile::Inverse { k: -1.0 }).contains("above 0"));
        let relative = Smooth::profile(&Profile::FishEye, 1.25);
        assert!((relative.index(0.0).re - 1.6).abs() < 1e-15 && relative.transparent());
    }
}
