//! Colour: from a spectrum to CIE XYZ to sRGB.
//!
//! A scattered spectrum is read as a *transmittance of the light source*: a value of 1 at every
//! wavelength gives `Y = 1` and the illuminant's own white. Everything downstream is linear in the
//! spectrum until the very last step, [`to_srgb`], so spectra, tristimulus values and exposures
//! may be averaged and mixed in any order.
//!
//! # Rules
//! - Integration is a plain sum on a 1 nm grid over the range that observer and illuminant share
//!   (CIE 015:2018, section 7); the spectrum is interpolated linearly between its wavelengths and
//!   held constant beyond them.
//! - No chromatic adaptation: the picture is what a camera set to daylight (D65) sees.
//! - **Gamut rule.** A colour outside sRGB is mixed with the grey of its own luminance just until
//!   it fits. Luminance and hue direction in linear RGB stay; only saturation gives way. Luminance
//!   above 1 becomes white.
//! - **Exposure** is a factor on XYZ before that rule; callers state it.
//!
//! Data and their sources: `data/color/`.

mod difference;
mod illuminant;
mod integrate;
mod observer;
mod srgb;
mod sun;
mod tabulated;

pub use difference::{Lab, delta_e_2000, lab};
pub use illuminant::Illuminant;
pub use integrate::{ColorWeights, illuminant_white, spectrum_to_xyz};
pub use observer::Observer;
pub use srgb::{
    decode_srgb, encode_srgb, fit_gamut, srgb_to_xyz, to_srgb, wavelength_srgb, xyz_to_linear_srgb,
    xyz_to_srgb,
};
pub use sun::{LimbDarkening, SUN_ANGULAR_RADIUS};

use crate::fault::{Blame, Fault};

/// What is wrong with a request for a colour.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ColorError {
    #[error(
        "illuminant = \"{0}\": expected D65, A, E, a daylight such as D50, a black body such as \
         5778K, sun (above the air), sun-ground (ASTM G173 direct), or sun@DEGREES (through clean \
         air at that elevation, 0 to 90)"
    )]
    UnknownIlluminant(String),
    #[error("observer = \"{0}\": expected 1931 or 2015")]
    UnknownObserver(String),
    #[error(
        "wavelengths from {from_nm} to {to_nm} nm do not cover the visible: a colour needs \
         {needed_from_nm} nm or less to {needed_to_nm} nm or more"
    )]
    NotVisible { from_nm: f64, to_nm: f64, needed_from_nm: f64, needed_to_nm: f64 },
    #[error(
        "wavelengths {from_nm} and {to_nm} nm are neighbours: a colour needs steps of \
         {largest_nm} nm or less in the visible"
    )]
    Gap { from_nm: f64, to_nm: f64, largest_nm: f64 },
    #[error("{wavelengths} wavelengths but {values} values: the numbers must agree")]
    Length { wavelengths: usize, values: usize },
}

impl Blame for ColorError {
    fn fault(&self) -> Fault {
        Fault::Input
    }
}
