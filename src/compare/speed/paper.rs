//! The paper's mode: a grid of rays, patches, bilinear paths, plain Fresnel coefficients, orders up
//! to 3, and a Gaussian filter about the bows in the place of diffraction (Sadeghi et al. 2012).

use super::case::SpeedCase;
use crate::farfield::Direction;
use crate::farfield::patches::collecting_sphere::CollectingSphere;
use crate::farfield::patches::interference::{Interference, PathInterpolation};
use crate::farfield::patches::{gaussian_filter, sheets};
use crate::math::parallel::*;
use crate::optics::AmplitudeMatrix;
use crate::trace::{Tracer, Wavefront};

/// Grids with more rays across than this are held one order at a time, to bound memory.
const LARGE: usize = 1500;
/// Spokes start off the symmetry plane.
const FIRST_SPOKE: f64 = 0.0123;

/// Intensities without and with the filter.
pub fn intensities(case: &SpeedCase, rays_across: usize) -> (Vec<f64>, Vec<f64>) {
    let groups: Vec<Vec<u32>> = if rays_across > LARGE {
        case.orders.iter().map(|&p| vec![p]).collect()
    } else {
        vec![case.orders.clone()]
    };
    let mut amplitudes = vec![AmplitudeMatrix::default(); case.theta.len()];
    let mut counts = vec![Vec::<u16>::new(); case.theta.len()];
    for orders in &groups {
        let found = collect(case, orders, rays_across);
        for (i, (amplitude, rays)) in found.into_iter().enumerate() {
            amplitudes[i] += amplitude;
            let length = counts[i].len().max(rays.len());
            counts[i].resize(length, 0);
            for (sum, count) in counts[i].iter_mut().zip(rays) {
                *sum += count;
            }
        }
    }
    let plain: Vec<f64> = amplitudes.iter().map(AmplitudeMatrix::s11).collect();
    let bows = gaussian_filter::bows(&case.theta, &counts);
    let sigma = gaussian_filter::standard_deviation(case.radius);
    let filtered = gaussian_filter::apply(&case.theta, &plain, &bows, sigma);
    (plain, filtered)
}

/// Coherent sums and numbers of rays in every direction.
fn collect(
    case: &SpeedCase,
    orders: &[u32],
    rays_across: usize,
) -> Vec<(AmplitudeMatrix, Vec<u16>)> {
    let last = orders.iter().copied().max().unwrap_or(0);
    let tracer = Tracer::new(&case.shape, case.index, case.size_parameter, last);
    let rings = rays_across.div_ceil(2);
    let wavefront = Wavefront::corners(&case.shape, rings, 2 * rings, FIRST_SPOKE);
    let sphere = CollectingSphere::new(sheets::sheets(&tracer, &wavefront, orders));
    let interference = Interference {
        size_parameter: case.size_parameter,
        interpolation: PathInterpolation::Linear,
        largest_jacobian: f64::INFINITY,
    };
    case.theta
        .par_iter()
        .map(|&theta| {
            let found = interference.collect(&sphere, &Direction::new(theta, case.azimuth));
            (found.amplitude, found.rays_by_order)
        })
        .collect()
}
