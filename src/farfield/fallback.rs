//! Orders that planes do not serve, each by the method that it is assigned to: sums of partial waves, of
//! beams, or patches.

use crate::farfield::assignment::{self, Assignment};
use crate::farfield::direction::Direction;
use crate::farfield::gaussian_beams::GaussianBeams;
use crate::farfield::partial_waves::PartialWaves;
use crate::farfield::patches::collecting_sphere::CollectingSphere;
use crate::farfield::patches::interference::{Interference, PathInterpolation};
use crate::farfield::patches::sheets;
use crate::farfield::settings::FarFieldSettings;
use crate::optics::AmplitudeMatrix;
use crate::trace::{Tracer, Wavefront};

/// The waves of orders without planes.
pub(crate) struct FallbackField(Vec<Part>);

/// Orders that one method serves.
struct Part {
    method: Method,
    /// Share of its amplitude by which its wave may be wrong, measured against Debye terms.
    doubt: f64,
}

enum Method {
    PartialWaves(PartialWaves),
    Beams(GaussianBeams),
    Patches(CollectingSphere, Interference),
}

/// `dA/dΩ` of the wave at a fold, in units of `x^{1/3}`: patches may not exceed it.
const FOLD_JACOBIAN: f64 = 0.5;
/// Rings of the patch grid for orders without planes at a tolerance of 1 %.
const PATCH_RINGS: f64 = 90.0;

impl FallbackField {
    /// What an assignment leaves beside scattering planes; `waves` are its partial waves.
    pub(crate) fn new(
        tracer: &Tracer,
        waves: Option<PartialWaves>,
        assignment: &Assignment,
        settings: &FarFieldSettings,
    ) -> Self {
        let by_patches = assignment.orders_of(assignment::Method::Patches);
        let (reflected, transmitted): (Vec<u32>, Vec<u32>) =
            by_patches.into_iter().partition(|&order| order == 0);
        let by_beams = assignment.orders_of(assignment::Method::Beams);
        // theirs is measured on the sphere of equal volume
        let of_waves = |waves| Part { method: Method::PartialWaves(waves), doubt: 0.0 };
        let mut parts: Vec<Part> = waves.map(of_waves).into_iter().collect();
        for orders in [reflected, transmitted] {
            if let Some(&lowest) = orders.iter().min() {
                let method = patches(tracer, &orders, settings);
                parts.push(Part { method, doubt: assignment.error_of(lowest) });
            }
        }
        if let Some(&lowest) = by_beams.iter().min() {
            let (azimuths, x) = (settings.azimuths, settings.size_parameter);
            let beams = GaussianBeams::new(tracer, &by_beams, azimuths, x);
            parts.push(Part { method: Method::Beams(beams), doubt: assignment.error_of(lowest) });
        }
        Self(parts)
    }

    /// Add the waves in some directions of one azimuth, scattering angles ascending.
    pub(crate) fn add(&self, theta: &[f64], phi: f64, sums: &mut [AmplitudeMatrix]) {
        for part in &self.0 {
            part.add(theta, phi, sums);
        }
    }

    /// The same, with `S11` of what may be wrong.
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

impl Part {
    fn add(&self, theta: &[f64], phi: f64, sums: &mut [AmplitudeMatrix]) {
        match &self.method {
            Method::PartialWaves(waves) => waves.add(theta, phi, sums),
            Method::Beams(beams) => beams.add(theta, phi, sums),
            Method::Patches(sphere, interference) => {
                for (sum, &t) in sums.iter_mut().zip(theta) {
                    *sum += interference.collect(sphere, &Direction::new(t, phi)).amplitude;
                }
            }
        }
    }
}

fn patches(tracer: &Tracer, orders: &[u32], settings: &FarFieldSettings) -> Method {
    let size_parameter = settings.size_parameter;
    let rings = (PATCH_RINGS * (0.01 / settings.tolerance).cbrt()).clamp(40.0, 400.0);
    let wavefront = Wavefront::corners(tracer.shape(), rings as usize, 2 * rings as usize, 0.0123);
    let interpolation = PathInterpolation::Gradient;
    let largest_jacobian = FOLD_JACOBIAN * size_parameter.cbrt();
    let interference = Interference { size_parameter, interpolation, largest_jacobian };
    let sheets = sheets::sheets(tracer, &wavefront, orders);
    Method::Patches(CollectingSphere::new(sheets), interference)
}
