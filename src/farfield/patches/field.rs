//! Patches as the waves of orders that have no planes.

use super::collecting_sphere::CollectingSphere;
use super::interference::{Interference, PathInterpolation};
use super::sheets::{self, Sheet};
use crate::farfield::direction::Direction;
use crate::farfield::settings::FarFieldSettings;
use crate::farfield::wave_field::WaveField;
use crate::optics::AmplitudeMatrix;
use crate::trace::{Tracer, Wavefront};

/// `dA/dΩ` of the wave at a fold, in units of `x^{1/3}`: patches that stand for one may not exceed it.
const FOLD_JACOBIAN: f64 = 0.5;
/// Rings of their grid at a tolerance of 1 %.
const RINGS: f64 = 90.0;

/// Sheets of rays on the sphere of directions, and how they interfere.
pub struct PatchField {
    pub(crate) sphere: CollectingSphere,
    pub(crate) interference: Interference,
}

impl PatchField {
    /// Of sheets that were traced.
    pub fn of_sheets(sheets: Vec<Sheet>, size_parameter: f64) -> Self {
        Self::bounded(sheets, size_parameter, f64::INFINITY)
    }

    /// Of orders whose caustics are too disordered for anything better: bounded at folds.
    pub(crate) fn of_orders(tracer: &Tracer, orders: &[u32], settings: &FarFieldSettings) -> Self {
        let size_parameter = settings.size_parameter;
        let rings = (RINGS * (0.01 / settings.tolerance).cbrt()).clamp(40.0, 400.0) as usize;
        let wavefront = Wavefront::corners(tracer.shape(), rings, 2 * rings, 0.0123);
        let sheets = sheets::sheets(tracer, &wavefront, orders);
        Self::bounded(sheets, size_parameter, FOLD_JACOBIAN * size_parameter.cbrt())
    }

    fn bounded(sheets: Vec<Sheet>, size_parameter: f64, largest_jacobian: f64) -> Self {
        let interpolation = PathInterpolation::Gradient;
        let interference = Interference { size_parameter, interpolation, largest_jacobian };
        Self { sphere: CollectingSphere::new(sheets), interference }
    }
}

impl WaveField for PatchField {
    fn add(&self, theta: &[f64], phi: f64, sums: &mut [AmplitudeMatrix]) {
        for (sum, &t) in sums.iter_mut().zip(theta) {
            *sum += self.interference.collect(&self.sphere, &Direction::new(t, phi)).amplitude;
        }
    }
}
