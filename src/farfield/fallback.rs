//! Orders that planes do not serve: sums of partial waves where the particle is small; else, where
//! planes do not correspond, sums of beams, whose error falls like `1/√x`, or patches for
//! particles so small, or tolerances so coarse, that those do better.
//!
//! Order 0 stays with patches: its rays are strongest where launch points end, at the rim, which beams
//! would show as an edge that shines.

use crate::farfield::direction::Direction;
use crate::farfield::gaussian_beams::GaussianBeams;
use crate::farfield::partial_waves::PartialWaves;
use crate::farfield::patches::collecting_sphere::CollectingSphere;
use crate::farfield::patches::interference::{Interference, PathInterpolation};
use crate::farfield::patches::sheets;
use crate::farfield::settings::FarFieldSettings;
use crate::optics::AmplitudeMatrix;
use crate::trace::{Tracer, Wavefront};

/// The waves of tangled orders.
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

/// Size parameter from which on tangled orders are sums of beams, and the tolerance up to which they are
/// worth their time: ten times that of patches where few directions are asked for.
const FIRST_OF_BEAMS: f64 = 1000.0;
const COARSEST_OF_BEAMS: f64 = 0.03;
/// `dA/dΩ` of the wave at a fold, in units of `x^{1/3}`: patches may not exceed it.
const FOLD_JACOBIAN: f64 = 0.5;
/// Rings of the patch grid for tangled orders at a tolerance of 1 %.
const PATCH_RINGS: f64 = 90.0;
/// Doubt of patches, without and with bows; of beams, as many times as the number of the lowest order.
const OF_REFLECTION: f64 = 0.07;
const OF_PATCHES: f64 = 0.3;
const OF_BEAMS: f64 = 0.02;
/// Doubt of partial waves times the size parameter.
const OF_PARTIAL_WAVES: f64 = 2.0;

/// Whether beams serve.
pub(crate) fn with_beams(settings: &FarFieldSettings) -> bool {
    settings.size_parameter >= FIRST_OF_BEAMS && settings.tolerance <= COARSEST_OF_BEAMS
}

impl FallbackField {
    /// For some orders, ascending.
    pub(crate) fn new(
        tracer: &Tracer,
        waves: Option<PartialWaves>,
        orders: &[u32],
        settings: &FarFieldSettings,
    ) -> Self {
        let (reflected, transmitted) = orders.split_at(orders.partition_point(|&order| order == 0));
        let doubt = OF_PARTIAL_WAVES / settings.size_parameter;
        let of_waves = |waves| Part { method: Method::PartialWaves(waves), doubt };
        let mut parts: Vec<Part> = waves.map(of_waves).into_iter().collect();
        if !reflected.is_empty() {
            let method = patches(tracer, reflected, settings);
            parts.push(Part { method, doubt: OF_REFLECTION });
        }
        if let Some(&lowest) = transmitted.first() {
            parts.push(if with_beams(settings) {
                let (azimuths, x) = (settings.azimuths, settings.size_parameter);
                let beams = GaussianBeams::new(tracer, transmitted, azimuths, x);
                Part { method: Method::Beams(beams), doubt: OF_BEAMS * f64::from(lowest) }
            } else {
                Part { method: patches(tracer, transmitted, settings), doubt: OF_PATCHES }
            });
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
