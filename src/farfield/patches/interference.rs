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
    pub size_parameter: f64,
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
mod tests {
    use super::super::sheets::sheets;
    use super::*;
    use crate::shape::Shape;
    use crate::trace::{Tracer, Wavefront};
    use std::f64::consts::FRAC_PI_2;

    const INDEX: f64 = 1.333;

    /// Transmitted rays of a sphere: amplitude and phase of each patch are those of the ray that leaves
    /// there, and rays are counted by order.
    #[test]
    fn patches_have_the_waves_of_their_rays() {
        let x = 200.0;
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, INDEX.into(), x, 1);
        let wavefront = Wavefront::corners(&shape, 60, 120, 0.0);
        let sphere = CollectingSphere::new(sheets(&tracer, &wavefront, &[1]));
        let interference = Interference {
            size_parameter: x,
            interpolation: PathInterpolation::Gradient,
            largest_jacobian: f64::INFINITY,
        };
        for theta in [0.2, 0.5, 0.9] {
            let direction = Direction::new(theta, 0.41);
            let found = interference.collect(&sphere, &direction);
            assert_eq!(found.rays_by_order, [0, 1]);
            // the impact of the ray that is turned by this angle
            let (mut low, mut high) = (0.0f64, 1.0f64);
            for _ in 0..60 {
                let b = 0.5 * (low + high);
                if 2.0 * (b.asin() - (b / INDEX).asin()) < theta { low = b } else { high = b }
            }
            // it leaves on the other side of the axis
            let exit = tracer.trace_order(-low * 0.41f64.cos(), -low * 0.41f64.sin(), 1).unwrap();
            let Direction { theta_hat, phi_hat, cos_phi, sin_phi, .. } = direction;
            let transfer =
                crate::trace::transfer(&exit.field, theta_hat, phi_hat, cos_phi, sin_phi);
            let phase = x * exit.path - FRAC_PI_2 * f64::from(1 + exit.focal_lines);
            let ray = transfer * (Complex64::cis(phase) * (x / exit.spread().abs().sqrt()));
            let off = (found.amplitude - ray).s11().sqrt() / ray.s11().sqrt();
            assert!(off < 5e-3, "{theta}: {off}");
            assert!((found.incoherent[0][0] / ray.s11() - 1.0).abs() < 0.01);
        }
    }

    fn corners() -> [Corner; 3] {
        let wavefront = Wavefront::corners(&Shape::sphere(), 40, 80, 0.0);
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 1);
        let sheet = &sheets(&tracer, &wavefront, &[1])[0];
        sheet.triangles[900].map(|i| sheet.corners[i as usize])
    }

    /// Inside a patch the path by gradients is a hundred times nearer the ray's than that by corners.
    #[test]
    fn gradients_interpolate_the_path() {
        let corners = corners();
        let [a, b, c] = [0, 1, 2].map(|k| corners[k].place);
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 1);
        let exit =
            tracer.trace_order((a[0] + b[0] + c[0]) / 3.0, (a[1] + b[1] + c[1]) / 3.0, 1).unwrap();
        let d = exit.direction;
        let edge = |i: usize, j: usize| d.dot(corners[i].direction.cross(corners[j].direction));
        let weights = [edge(1, 2), edge(2, 0), edge(0, 1)];
        let sum: f64 = weights.iter().sum();
        let weights = weights.map(|w| w / sum);
        let path = |interpolation| {
            let interference = Interference {
                size_parameter: 1.0,
                interpolation,
                largest_jacobian: f64::INFINITY,
            };
            interference.path(&[&corners[0], &corners[1], &corners[2]], weights, d)
        };
        let linear = (path(PathInterpolation::Linear) - exit.path).abs();
        let gradient = (path(PathInterpolation::Gradient) - exit.path).abs();
        assert!(linear > 1e-5 && gradient < 0.02 * linear, "{linear} {gradient}");
    }

    /// Where a caustic runs through a patch its mean area per solid angle stands for what would be infinite;
    /// the branch's focal lines are those of a corner on it.
    #[test]
    fn a_caustic_in_a_patch_leaves_a_finite_mean() {
        let mut corners = corners();
        let sheet = crate::farfield::patches::sheets::Sheet {
            order: 1,
            corners: corners.to_vec(),
            triangles: vec![[0, 1, 2]],
        };
        let third = [1.0 / 3.0; 3];
        let hit = |sense: f64| Hit { sheet: &sheet, triangle: 0, weights: third, sense };
        let sense = corners[0].spread.signum();
        let refs = |c: &[Corner; 3]| [c[0], c[1], c[2]];
        let all = refs(&corners);
        let plain = jacobian(&[&all[0], &all[1], &all[2]], &hit(sense));
        let mean = jacobian(&[&all[0], &all[1], &all[2]], &hit(-sense));
        assert!((mean / plain - 1.0).abs() < 0.05, "{plain} {mean}");
        corners[2].spread *= -1.0;
        corners[2].focal_lines += 1;
        let all = refs(&corners);
        assert_eq!(focal_lines(&[&all[0], &all[1], &all[2]], -sense), corners[2].focal_lines);
        assert_eq!(focal_lines(&[&all[0], &all[1], &all[2]], sense), corners[0].focal_lines);
    }

    /// A ring focused on the axis has `π x b²/2` at most, none where it is no ring.
    #[test]
    fn rings_on_the_axis_are_bounded() {
        let mut corner = corners()[0];
        let at = |corner: &Corner, x: f64| {
            let interference = Interference {
                size_parameter: x,
                interpolation: PathInterpolation::Gradient,
                largest_jacobian: f64::INFINITY,
            };
            interference.at_axis(&[corner; 3])
        };
        corner.reference = Vec3::new(0.3, 0.4, 0.0);
        assert!((at(&corner, 100.0) - 0.5 * std::f64::consts::PI * 25.0).abs() < 1e-12);
        assert_eq!(at(&corner, 10.0), f64::INFINITY);
    }
}
