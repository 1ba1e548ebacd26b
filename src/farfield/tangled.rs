//! Orders whose meridians do not correspond: sums of beams, whose error falls like `1/√x`, or patches for
//! particles so small, or tolerances so coarse, that those do better.

use super::collecting_sphere::CollectingSphere;
use super::direction::Direction;
use super::fan::FanSettings;
use super::gaussian_beams::GaussianBeams;
use super::interference::{Interference, PathInterpolation};
use super::patch;
use crate::optics::AmplitudeMatrix;
use crate::trace::{Tracer, Wavefront};

/// The waves of tangled orders.
pub(super) enum Tangled {
    None,
    Beams(GaussianBeams),
    Patches(CollectingSphere, Interference),
}

/// Size parameter from which on tangled orders are sums of beams, and the tolerance up to which they are
/// worth their time: ten times that of patches where few directions are asked for.
const FIRST_OF_BEAMS: f64 = 1000.0;
const COARSEST_OF_BEAMS: f64 = 0.03;
/// `dA/dΩ` of the wave at a fold, in units of `x^{1/3}`: patches may not exceed it.
const FOLD_JACOBIAN: f64 = 0.5;
/// Rings of the patch grid for tangled orders at a tolerance of 1 %.
const PATCH_RINGS: f64 = 90.0;

/// Whether beams serve.
pub(super) fn with_beams(settings: &FanSettings) -> bool {
    settings.size_parameter >= FIRST_OF_BEAMS && settings.tolerance <= COARSEST_OF_BEAMS
}

impl Tangled {
    pub(super) fn new(tracer: &Tracer, orders: &[u32], settings: &FanSettings) -> Self {
        let size_parameter = settings.size_parameter;
        if orders.is_empty() {
            return Self::None;
        }
        if with_beams(settings) {
            return Self::Beams(GaussianBeams::new(
                tracer,
                orders,
                settings.azimuths,
                size_parameter,
            ));
        }
        let rings = (PATCH_RINGS * (0.01 / settings.tolerance).cbrt()).clamp(40.0, 400.0);
        let wavefront =
            Wavefront::corners(tracer.shape(), rings as usize, 2 * rings as usize, 0.0123);
        let interpolation = PathInterpolation::Gradient;
        let largest_jacobian = FOLD_JACOBIAN * size_parameter.cbrt();
        let interference = Interference { size_parameter, interpolation, largest_jacobian };
        let sheets = patch::sheets(tracer, &wavefront, orders);
        Self::Patches(CollectingSphere::new(sheets), interference)
    }

    /// Add the waves in some directions of one azimuth, scattering angles ascending.
    pub(super) fn add(&self, theta: &[f64], phi: f64, sums: &mut [AmplitudeMatrix]) {
        match self {
            Self::None => {}
            Self::Beams(beams) => beams.add(theta, phi, sums),
            Self::Patches(sphere, interference) => {
                for (sum, &t) in sums.iter_mut().zip(theta) {
                    *sum += interference.collect(sphere, &Direction::new(t, phi)).amplitude;
                }
            }
        }
    }
}
