//! Which engine computes a scene: rays in planes or as patches, an exact series, the T-matrix.

use super::acceptance::PlanError;
use super::t_matrix;
use crate::farfield::assignment::Thresholds;
use crate::medium::{Light, MediumError};
use crate::scene::{Diffraction, Interference, Method, Orientation, Scene};
use crate::shape::Shape;

/// Who computes the scattering.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    /// Rays along meridians with uniform Airy functions at every fold.
    Meridians,
    /// Patches on the collecting sphere (Sadeghi et al. 2012).
    Patches,
    /// The exact series.
    LorenzMie,
    /// Single orders of the exact series.
    Debye,
    /// The T-matrix of a body of revolution.
    TMatrix,
    /// Beams of flat facets.
    Facets,
}

impl Engine {
    /// Whether waves are computed exactly, all orders at once or one by one, without rays.
    pub fn is_exact(self) -> bool {
        matches!(self, Engine::LorenzMie | Engine::Debye | Engine::TMatrix)
    }

    /// Light of a wavelength in vacuum as a particle of a radius (metres) meets it: of what varies along the
    /// radius, which only its series knows of, with the index at the surface.
    ///
    /// # Errors
    /// A wavelength outside the data, or what varies where one index is needed.
    pub(super) fn light(
        self,
        scene: &Scene,
        radius: f64,
        wavelength: f64,
    ) -> Result<Light, MediumError> {
        match self {
            Engine::LorenzMie => scene.medium.light_at_surface(wavelength, radius),
            _ => scene.medium.light(wavelength),
        }
    }

    /// That of a scene of one kind of particles; a sentence says why.
    pub(super) fn of(
        scene: &Scene,
        shape: &Shape,
        radius: f64,
        by: &Thresholds,
        reasons: &mut Vec<String>,
    ) -> Result<Self, PlanError> {
        let sphere = shape.is_sphere();
        Ok(match scene.method {
            Method::Auto if sphere => {
                let series = if scene.medium.radial().is_some() {
                    "a series of its own"
                } else {
                    "Lorenz–Mie"
                };
                reasons
                    .push(format!("rays are skipped: the particle is a sphere, {series} is exact"));
                Engine::LorenzMie
            }
            Method::Mie if !sphere => return Err(PlanError::SeriesNeedsSphere("mie")),
            Method::Debye if !sphere => return Err(PlanError::SeriesNeedsSphere("debye")),
            Method::Mie => Engine::LorenzMie,
            Method::Debye => Engine::Debye,
            Method::Auto if scene.orientation == Orientation::Random => {
                t_matrix::check(scene, shape, radius)?;
                reasons.push("rays are skipped: the T-matrix averages over orientations".into());
                Engine::TMatrix
            }
            // scenes have been asked whether they name a crystal
            Method::Facets => return Err(PlanError::FacetsNeedCrystal),
            Method::TMatrix => {
                t_matrix::check(scene, shape, radius)?;
                Engine::TMatrix
            }
            Method::Auto if t_matrix::takes(scene, shape, radius, by, reasons)? => Engine::TMatrix,
            Method::Auto | Method::Rays => {
                let waves = scene.interference != Interference::Powers;
                if waves && scene.diffraction == Diffraction::Airy {
                    Engine::Meridians
                } else {
                    reasons.push(
                        "patches on the collecting sphere: interference off, or diffraction that is \
                         not \"airy\""
                            .into(),
                    );
                    Engine::Patches
                }
            }
        })
    }
}
