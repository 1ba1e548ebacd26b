//! Orders that planes do not serve: sums of partial waves where the particle is small; else, where
//! planes do not correspond, sums on a complex wavefront.
//!
//! Order 0 stays with patches: its rays are strongest where launch points end, at the rim, which a sum
//! over them would show as an edge that shines.

use crate::farfield::assignment::{self, Assignment};
use crate::farfield::complex_wavefront::ComplexWavefront;
use crate::farfield::direction::Direction;
use crate::farfield::partial_waves::PartialWaves;
use crate::farfield::patches::collecting_sphere::CollectingSphere;
use crate::farfield::patches::interference::{Interference, PathInterpolation};
use crate::farfield::patches::sheets;
use crate::farfield::settings::FarFieldSettings;
use crate::optics::AmplitudeMatrix;
use crate::trace::{Tracer, Wavefront};

/// The waves of tangled orders.
pub(crate) struct FallbackField<'a>(Vec<Part<'a>>);

/// Orders that one method serves.
struct Part<'a> {
    method: Method<'a>,
    /// Share of its amplitude by which its wave may be wrong, measured against Debye terms.
    doubt: f64,
}

enum Method<'a> {
    PartialWaves(PartialWaves),
    Sum(ComplexWavefront<'a>),
    Patches(CollectingSphere, Interference),
}

/// `dA/dΩ` of the wave at a fold, in units of `x^{1/3}`: patches may not exceed it.
const FOLD_JACOBIAN: f64 = 0.5;
/// Rings of the patch grid for tangled orders at a tolerance of 1 %.
const PATCH_RINGS: f64 = 90.0;

impl<'a> FallbackField<'a> {
    /// What an assignment leaves beside scattering planes; `waves` are its partial waves.
    pub(crate) fn new(
        tracer: &Tracer<'a>,
        waves: Option<PartialWaves>,
        assignment: &Assignment,
        settings: &FarFieldSettings,
    ) -> Self {
        let part = |method: Method<'a>, of: assignment::Method| Part {
            method,
            doubt: assignment.error_of(of),
        };
        // theirs is measured on the sphere of equal volume
        let of_waves = |waves| Part { method: Method::PartialWaves(waves), doubt: 0.0 };
        let mut parts: Vec<Part<'a>> = waves.map(of_waves).into_iter().collect();
        let by_patches = assignment.orders_of(assignment::Method::Patches);
        if !by_patches.is_empty() {
            let method = patches(tracer, &by_patches, settings);
            parts.push(part(method, assignment::Method::Patches));
        }
        let by_sum = assignment.shares_of(assignment::Method::ComplexWavefront);
        if !by_sum.is_empty() {
            let sum = ComplexWavefront::new(tracer, &by_sum, settings.size_parameter);
            parts.push(part(Method::Sum(sum), assignment::Method::ComplexWavefront));
        }
        Self(parts)
    }

    /// Add the waves in some directions of one azimuth, scattering angles ascending.
    pub(crate) fn add(&self, theta: &[f64], phi: f64, sums: &mut [AmplitudeMatrix]) {
        for part in &self.0 {
            part.add(theta, phi, sums);
        }
    }

    /// Add the waves to columns of some azimuths together, which share the rays between them.
    pub(crate) fn add_columns(
        &self,
        theta: &[f64],
        azimuths: &[f64],
        columns: &mut [Vec<AmplitudeMatrix>],
    ) {
        for part in &self.0 {
            if let Method::Sum(sum) = &part.method {
                for (column, waves) in columns.iter_mut().zip(sum.columns(theta, azimuths)) {
                    column.iter_mut().zip(waves).for_each(|(sum, wave)| *sum += wave);
                }
                continue;
            }
            for (column, &phi) in columns.iter_mut().zip(azimuths) {
                part.add(theta, phi, column);
            }
        }
    }

    /// The waves at one azimuth, with `S11` of what may be wrong.
    pub(crate) fn doubted(&self, theta: &[f64], phi: f64) -> (Vec<AmplitudeMatrix>, Vec<f64>) {
        let mut sums = vec![AmplitudeMatrix::default(); theta.len()];
        let mut wrong = vec![0.0; theta.len()];
        for part in &self.0 {
            let mut waves = vec![AmplitudeMatrix::default(); theta.len()];
            part.add(theta, phi, &mut waves);
            for (i, wave) in waves.into_iter().enumerate() {
                sums[i] += wave;
                wrong[i] += part.doubt * part.doubt * wave.s11();
            }
        }
        (sums, wrong)
    }
}

impl Part<'_> {
    fn add(&self, theta: &[f64], phi: f64, sums: &mut [AmplitudeMatrix]) {
        match &self.method {
            Method::PartialWaves(waves) => waves.add(theta, phi, sums),
            Method::Sum(sum) => sum.add(theta, phi, sums),
            Method::Patches(sphere, interference) => {
                for (sum, &t) in sums.iter_mut().zip(theta) {
                    *sum += interference.collect(sphere, &Direction::new(t, phi)).amplitude;
                }
            }
        }
    }
}

fn patches<'a>(tracer: &Tracer, orders: &[u32], settings: &FarFieldSettings) -> Method<'a> {
    let size_parameter = settings.size_parameter;
    let rings = (PATCH_RINGS * (0.01 / settings.tolerance).cbrt()).clamp(40.0, 400.0);
    let wavefront = Wavefront::corners(tracer.shape(), rings as usize, 2 * rings as usize, 0.0123);
    let interpolation = PathInterpolation::Gradient;
    let largest_jacobian = FOLD_JACOBIAN * size_parameter.cbrt();
    let interference = Interference { size_parameter, interpolation, largest_jacobian };
    let sheets = sheets::sheets(tracer, &wavefront, orders);
    Method::Patches(CollectingSphere::new(sheets), interference)
}
