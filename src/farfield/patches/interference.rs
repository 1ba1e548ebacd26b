//! Interference: the amplitude of each patch in a direction, and their coherent sum.
//!
//! One ray contributes `S = -i x T √(dA/dΩ) exp(i x W - iπ/2 m)` with `x` the size parameter, `T`
//! the field transfer, `W` the path in radii and `m` the focal lines passed (van de Hulst 1957,
//! §12.22, with the sign that belongs to `exp(-iωt)`).

use super::collecting_sphere::{CollectingSphere, Hit};
use super::sheets::Corner;
use crate::farfield::direction::Direction;
use crate::math::vec3::{Field, Vec3};
use crate::optics::AmplitudeMatrix;
use num_complex::Complex64;

/// How the path is interpolated within a patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PathInterpolation {
    /// Linear between the corners (Sadeghi et al. 2012).
    Linear,
    /// Corners' paths with half their exact gradients: exact for quadratics.
    Gradient,
}

/// Sums over patches.
#[derive(Clone, Copy, Debug)]
pub struct Interference {
    /// Circumference of the sphere of equal volume over the wavelength.
    pub size_parameter: f64,
    /// How the path goes on between the corners.
    pub interpolation: PathInterpolation,
    /// Largest `dA/dΩ` that a ray from order 2 on may have: at a caustic rays have none, the wave
    /// there has (of the order of `x^{1/3}` at a fold).
    pub largest_jacobian: f64,
}

/// The result for one direction.
#[derive(Clone, Debug, Default)]
pub struct Collected {
    /// Coherent sum.
    pub amplitude: AmplitudeMatrix,
    /// Mueller matrix of the sum without interference.
    pub incoherent: [[f64; 4]; 4],
    /// Rays found, by order.
    pub rays_by_order: Vec<u16>,
}

impl Interference {
    /// Everything that arrives in a direction.
    pub fn collect(&self, sphere: &CollectingSphere, direction: &Direction) -> Collected {
        let mut collected = Collected::default();
        sphere.patches(direction.unit, |hit| {
            let s = self.amplitude(&hit, direction);
            collected.amplitude += s;
            let mueller = s.mueller();
            for (row, add) in collected.incoherent.iter_mut().zip(mueller) {
                for (m, a) in row.iter_mut().zip(add) {
                    *m += a;
                }
            }
            let order = hit.sheet.order as usize;
            if collected.rays_by_order.len() <= order {
                collected.rays_by_order.resize(order + 1, 0);
            }
            collected.rays_by_order[order] += 1;
        });
        collected
    }

    /// Amplitude matrix of one patch in a direction.
    pub fn amplitude(&self, hit: &Hit, direction: &Direction) -> AmplitudeMatrix {
        let corners = hit.sheet.triangles[hit.triangle].map(|i| &hit.sheet.corners[i as usize]);
        let path = self.path(&corners, hit.weights, direction.unit);
        let bound = if hit.sheet.order < 2 { f64::INFINITY } else { self.largest_jacobian };
        let size = jacobian(&corners, hit).min(bound).min(self.at_axis(&corners)).sqrt();
        let transfer = transfer(&corners, hit.weights, direction);
        let turns = -0.25 * f64::from(1 + focal_lines(&corners, hit.sense));
        let phase = self.size_parameter * path + std::f64::consts::TAU * turns;
        transfer * (Complex64::cis(phase) * (self.size_parameter * size))
    }

    /// Largest `dA/dΩ` of rays whose ring of radius `b` (exit impact) is focused on the axis: their wave
    /// `J₀(x b sin θ)` has `π x b/2` where rays have `1/sin θ`. Rays of small impact form no ring.
    fn at_axis(&self, corners: &[&Corner; 3]) -> f64 {
        const LEAST_RING: f64 = 5.0;
        let square = corners.iter().map(|c| c.reference.dot(c.reference)).fold(0.0, f64::max);
        let zones = self.size_parameter * square;
        if zones > LEAST_RING { 0.5 * std::f64::consts::PI * zones } else { f64::INFINITY }
    }

    fn path(&self, corners: &[&Corner; 3], weights: [f64; 3], d: Vec3<f64>) -> f64 {
        let linear = |c: &Corner| c.path;
        let gradient = |c: &Corner| c.path - 0.5 * c.reference.dot(d - c.direction);
        match self.interpolation {
            PathInterpolation::Linear => weighted(corners, weights, linear),
            PathInterpolation::Gradient => weighted(corners, weights, gradient),
        }
    }
}

fn weighted(corners: &[&Corner; 3], weights: [f64; 3], value: impl Fn(&Corner) -> f64) -> f64 {
    corners.iter().zip(weights).map(|(c, w)| w * value(c)).sum()
}

/// `dA/dΩ`: from the exact spread where it keeps its sign over the patch, else (a caustic runs
/// through) the ratio of the patch's area to its solid angle, which stays finite.
fn jacobian(corners: &[&Corner; 3], hit: &Hit) -> f64 {
    if corners.iter().all(|c| c.spread * hit.sense > 0.0) {
        return 1.0 / weighted(corners, hit.weights, |c| c.spread).abs();
    }
    let [a, b, c] = corners.map(|c| c.direction);
    let solid_angle = 0.5 * a.dot(b.cross(c)).abs();
    let [p, q, r] = corners.map(|c| c.place);
    let area = 0.5 * ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])).abs();
    area / solid_angle
}

/// Focal lines of the branch that the patch lies on.
fn focal_lines(corners: &[&Corner; 3], sense: f64) -> u32 {
    let same = corners.iter().find(|c| c.spread * sense > 0.0);
    same.unwrap_or(&corners[0]).focal_lines
}

/// Field transfer of the patch, in the frames of the direction.
fn transfer(corners: &[&Corner; 3], weights: [f64; 3], direction: &Direction) -> AmplitudeMatrix {
    let mix = |k: usize| {
        let mut sum = Field::default();
        for (corner, weight) in corners.iter().zip(weights) {
            sum = sum + corner.field[k] * Complex64::new(weight, 0.0);
        }
        sum
    };
    crate::trace::transfer(
        &[mix(0), mix(1)],
        direction.theta_hat,
        direction.phi_hat,
        direction.cos_phi,
        direction.sin_phi,
    )
}

#[cfg(test)]
mod tests;
