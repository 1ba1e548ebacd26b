//! The scene: `SceneFile` mirrors the TOML and the flags; `Scene` is validated and immutable.
//! After validation, physics does not fail.

use crate::medium::Medium;
use crate::phase_table::{ForwardPeak, Quantity};
use crate::shape::RaindropModel;

/// What scatters. Radii are those of the sphere of equal volume, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Particle {
    Sphere {
        radius: f64,
    },
    /// `axis_ratio` is vertical over horizontal diameter.
    Spheroid {
        radius: f64,
        axis_ratio: f64,
    },
    Raindrop {
        radius: f64,
        model: RaindropModel,
    },
}

/// How scattering is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Lorenz–Mie for a sphere, rays otherwise.
    Auto,
    Rays,
    Mie,
    Debye,
}

/// Diffraction in the ray method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Diffraction {
    None,
    /// The Gaussian filter of Sadeghi et al. 2012.
    Gaussian,
    /// Uniform Airy functions at every fold caustic, and the silhouette's forward diffraction.
    Airy,
}

/// Orders to be summed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Orders {
    /// All that matter at the tolerance, and forward diffraction.
    Auto,
    /// Just these (number of chords).
    List(Vec<u32>),
}

/// A validated scene. Units: metres, radians.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    pub particle: Particle,
    pub medium: Medium,
    pub sun_elevation: f64,
    pub wavelengths: Vec<f64>,
    pub theta: Vec<f64>,
    pub phi: Vec<f64>,
    pub quantity: Quantity,
    pub forward_peak: ForwardPeak,
    pub method: Method,
    pub interference: bool,
    pub diffraction: Diffraction,
    pub orders: Orders,
    pub tolerance: f64,
    /// Rays across the silhouette; `None`: chosen from the tolerance.
    pub rays_across: Option<usize>,
    /// The scene resolved, as TOML, for the record.
    pub toml: String,
}
