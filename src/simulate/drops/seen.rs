//! At which scattering angles drops are computed, and what the sun's disc makes of their means.
//!
//! One drop's fringes are finer than the disc; they average out over sizes and over the disc alike, so that
//! fewer radii serve a mean over both.

use super::azimuths::Azimuths;
use crate::color::LimbDarkening;
use crate::phase_table::ForwardPeak;
use crate::scene::{Scene, SunDisc};
use crate::sun_disc::DiscField;
use ndarray::Array3;

/// Relative error of the mean over the disc: of its samples and of what it takes for the same in azimuth.
pub(super) const DISC_ERROR: f64 = 1e-3;

/// The means of an order over every radius and every second: elements, scattering angles, azimuths.
pub(super) type Means = [Array3<f64>; 2];

/// How a scene's means are seen.
pub(super) enum Seen {
    /// As they are, at the angles of the table.
    Directly,
    /// Through the disc of a sun, at even angles.
    Disc(Box<DiscField>),
}

impl Seen {
    /// By light of a wavelength in vacuum (metres).
    pub fn new(scene: &Scene, wavelength: f64, azimuths: &Azimuths) -> Self {
        let limb = match scene.sun_disc {
            SunDisc::None => return Self::Directly,
            SunDisc::Uniform => None,
            SunDisc::LimbDarkened => Some(LimbDarkening::at(wavelength)),
        };
        let cells = scene.forward_peak == ForwardPeak::CellAverage;
        Self::Disc(Box::new(DiscField::new(&scene.theta, limb, cells, azimuths.half_turn())))
    }

    /// The scene at whose scattering angles drops are computed.
    pub fn scene(&self, scene: &Scene) -> Scene {
        match self {
            Self::Directly => scene.clone(),
            Self::Disc(disc) => Scene { theta: disc.fine_angles(), ..scene.clone() },
        }
    }

    /// What is seen of means.
    pub fn means(&self, means: Means) -> Means {
        match self {
            Self::Directly => means,
            Self::Disc(disc) => means.map(|mean| disc.means(&mean)),
        }
    }

    /// What that errs by.
    pub fn error(&self) -> f64 {
        match self {
            Self::Directly => 0.0,
            Self::Disc(_) => DISC_ERROR,
        }
    }
}
