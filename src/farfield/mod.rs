//! The far field: from rays that left the particle to amplitudes in any direction.
//!
//! Stages, each replaceable: sheets of rays cut into [`patch`]es, held in a [`collecting_sphere`];
//! [`interference`] of all patches that contain a direction; diffraction by the
//! [`gaussian_filter`] of Sadeghi et al. 2012; [`forward_diffraction`] by the silhouette.

pub mod collecting_sphere;
pub mod direction;
pub mod forward_diffraction;
pub mod forward_peak;
pub mod gaussian_filter;
pub mod interference;
pub mod patch;
pub mod tabulate;

pub use collecting_sphere::CollectingSphere;
pub use direction::Direction;

use crate::optics::AmplitudeMatrix;
use crate::shape::Shape;
use forward_diffraction::ForwardDiffraction;
use interference::{Interference, PathInterpolation};
use tabulate::Column;

/// The far field of one wavelength, ready to be asked for columns or single directions.
pub struct FarField<'a> {
    source: Source,
    silhouette: ForwardDiffraction,
    size_parameter: f64,
    _shape: &'a Shape,
}

/// How amplitudes are found.
enum Source {
    Patches(CollectingSphere, Interference),
}

impl<'a> FarField<'a> {
    /// Patches on the collecting sphere.
    pub fn patches(shape: &'a Shape, sheets: Vec<patch::Sheet>, size_parameter: f64) -> Self {
        let interpolation = PathInterpolation::Gradient;
        let interference = Interference { size_parameter, interpolation };
        Self {
            source: Source::Patches(CollectingSphere::new(sheets), interference),
            silhouette: ForwardDiffraction::new(shape),
            size_parameter,
            _shape: shape,
        }
    }

    /// The silhouette and its diffraction.
    pub fn silhouette(&self) -> &ForwardDiffraction {
        &self.silhouette
    }

    /// All scattering angles at one azimuth, without forward diffraction.
    pub fn column(&self, theta: &[f64], phi: f64, incoherent: bool) -> Column {
        match &self.source {
            Source::Patches(sphere, interference) => {
                let mut column = Column {
                    amplitude: Vec::with_capacity(theta.len()),
                    incoherent: Vec::new(),
                    rays: Vec::with_capacity(theta.len()),
                    caustic_order: Vec::new(),
                };
                for &t in theta {
                    let found = interference.collect(sphere, &Direction::new(t, phi));
                    column.amplitude.push(found.amplitude);
                    if incoherent {
                        column.incoherent.push(found.incoherent);
                    }
                    column.rays.push(found.rays_by_order);
                }
                column
            }
        }
    }

    /// Amplitudes in single directions `(θ, φ)`, with forward diffraction where asked.
    pub fn scatter(&self, directions: &[(f64, f64)], diffraction: bool) -> Vec<AmplitudeMatrix> {
        directions
            .iter()
            .map(|&(theta, phi)| {
                let direction = Direction::new(theta, phi);
                let mut amplitude = match &self.source {
                    Source::Patches(sphere, interference) => {
                        interference.collect(sphere, &direction).amplitude
                    }
                };
                if diffraction {
                    let tail = self.silhouette.tail(self.size_parameter, &direction);
                    forward_peak::add(&mut amplitude, tail);
                }
                amplitude
            })
            .collect()
    }
}
