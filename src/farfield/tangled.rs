//! Orders that meridians do not serve: sums of partial waves where the particle is small; else, where
//! meridians do not correspond, sums on a complex wavefront.
//!
//! Order 0 stays with patches: its rays are strongest where launch points end, at the rim, which a sum
//! over them would show as an edge that shines.

use super::collecting_sphere::CollectingSphere;
use super::complex_wavefront::ComplexWavefront;
use super::direction::Direction;
use super::fan::FanSettings;
use super::interference::{Interference, PathInterpolation};
use super::partial_waves::PartialWaves;
use super::patch;
use crate::optics::AmplitudeMatrix;
use crate::trace::{Tracer, Wavefront};

/// The waves of tangled orders.
pub(super) struct Tangled<'a>(Vec<Part<'a>>);

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
/// Doubt of patches; of sums, as many times as the number of the lowest order.
const OF_REFLECTION: f64 = 0.07;
const OF_SUMS: f64 = 0.02;
/// Doubt of partial waves times the size parameter.
const OF_PARTIAL_WAVES: f64 = 2.0;

impl<'a> Tangled<'a> {
    /// For some orders, ascending, and the shares of their amplitudes.
    pub(super) fn new(
        tracer: &Tracer<'a>,
        waves: Option<PartialWaves>,
        shares: &[(u32, f64)],
        settings: &FanSettings,
    ) -> Self {
        let (reflected, transmitted) = shares.split_at(shares.partition_point(|share| share.0 == 0));
        let doubt = OF_PARTIAL_WAVES / settings.size_parameter;
        let of_waves = |waves| Part { method: Method::PartialWaves(waves), doubt };
        let mut parts: Vec<Part<'a>> = waves.map(of_waves).into_iter().collect();
        if !reflected.is_empty() {
            let method = patches(tracer, &[0], settings);
            parts.push(Part { method, doubt: OF_REFLECTION });
        }
        if let Some(&(lowest, _)) = transmitted.first() {
            let sum = ComplexWavefront::new(tracer, transmitted, settings.size_parameter);
            parts.push(Part { method: Method::Sum(sum), doubt: OF_SUMS * f64::from(lowest) });
        }
        Self(parts)
    }

    /// Add the waves in some directions of one azimuth, scattering angles ascending.
    pub(super) fn add(&self, theta: &[f64], phi: f64, sums: &mut [AmplitudeMatrix]) {
        for part in &self.0 {
            part.add(theta, phi, sums);
        }
    }

    /// The same, with `S11` of what may be wrong.
    pub(super) fn doubted(&self, theta: &[f64], phi: f64) -> (Vec<AmplitudeMatrix>, Vec<f64>) {
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

fn patches<'a>(tracer: &Tracer, orders: &[u32], settings: &FanSettings) -> Method<'a> {
    let size_parameter = settings.size_parameter;
    let rings = (PATCH_RINGS * (0.01 / settings.tolerance).cbrt()).clamp(40.0, 400.0);
    let wavefront = Wavefront::corners(tracer.shape(), rings as usize, 2 * rings as usize, 0.0123);
    let interpolation = PathInterpolation::Gradient;
    let largest_jacobian = FOLD_JACOBIAN * size_parameter.cbrt();
    let interference = Interference { size_parameter, interpolation, largest_jacobian };
    let sheets = patch::sheets(tracer, &wavefront, orders);
    Method::Patches(CollectingSphere::new(sheets), interference)
}
