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
    /// Whether that is a share of the wave's median over the scattering angle where it is brighter: what is
    /// wrong of a deformed body's bows and rings stands in all directions, not in its bright ones.
    everywhere: bool,
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
    /// What an assignment leaves beside scattering planes; `waves` are its partial waves, of
    /// a body whose outline has some deformation.
    pub(crate) fn new(
        tracer: &Tracer,
        waves: Option<PartialWaves>,
        deformation: f64,
        assignment: &Assignment,
        settings: &FarFieldSettings,
    ) -> Self {
        let by_patches = assignment.orders_of(assignment::Method::Patches);
        let (reflected, transmitted): (Vec<u32>, Vec<u32>) =
            by_patches.into_iter().partition(|&order| order == 0);
        let by_beams = assignment.orders_of(assignment::Method::Beams);
        // of a sphere theirs is measured
        let doubt =
            assignment.thresholds().doubt_of_deformed_waves(settings.size_parameter, deformation);
        let of_waves =
            |waves| Part { method: Method::PartialWaves(waves), doubt, everywhere: true };
        let mut parts: Vec<Part> = waves.map(of_waves).into_iter().collect();
        for orders in [reflected, transmitted] {
            if let Some(&lowest) = orders.iter().min() {
                let method = patches(tracer, &orders, settings);
                parts.push(Part { method, doubt: assignment.error_of(lowest), everywhere: false });
            }
        }
        if let Some(&lowest) = by_beams.iter().min() {
            let (azimuths, x) = (settings.azimuths, settings.size_parameter);
            let beams = GaussianBeams::new(tracer, &by_beams, azimuths, x);
            let doubt = assignment.error_of(lowest);
            parts.push(Part { method: Method::Beams(beams), doubt, everywhere: false });
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
            let most = if part.everywhere { median(&waves) } else { f64::INFINITY };
            for (i, wave) in waves.into_iter().enumerate() {
                sums[i] += wave;
                wrong[i] += part.doubt * part.doubt * wave.s11().min(most);
            }
        }
        (sums, wrong)
    }
}

/// The median of `S11` over some directions.
fn median(waves: &[AmplitudeMatrix]) -> f64 {
    let mut sizes: Vec<f64> = waves.iter().map(AmplitudeMatrix::s11).collect();
    sizes.sort_by(f64::total_cmp);
    sizes.get(sizes.len() / 2).copied().unwrap_or(0.0)
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
