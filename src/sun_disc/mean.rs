//! The mean of a sphere's scattering over the sun's disc.
//!
//! Every point of the disc shines from its own direction, so that one direction of the sky sees
//! scattering angles up to 0.27° on both sides. The disc is integrated over ρ² by Gauss's rule and over
//! equal steps of its position angle ψ; the scattering angle of a point at the distance ρ
//! from the centre follows from `cos θ' = cos θ cos ρ - sin θ sin ρ cos ψ`, which holds at 0° and
//! 180° too. The mean over directions, ∫ P dΩ = 1, stays what it was. The turn of the plane of
//! polarisation from one side of the disc to the other is left out (it is at most ρ/sin θ).

use crate::color::{LimbDarkening, SUN_ANGULAR_RADIUS};
use crate::math::gauss_legendre;
use crate::math::parallel::*;
use std::f64::consts::PI;

/// Samples per lobe π/x of the fine curve: the cubic between them is then good to 1e-4.
const PER_LOBE: f64 = 10.0;
/// Coarsest step of the fine curve, in disc radii.
const PER_RADIUS: f64 = 20.0;
/// Points of the disc per lobe along its radius, at least [`LEAST_RINGS`] rings.
const RINGS_PER_LOBE: f64 = 3.0;
const LEAST_RINGS: f64 = 16.0;

/// Points of the disc: distance from its centre and share of its light.
#[derive(Clone, Debug)]
pub struct DiscMean {
    rings: Vec<(f64, f64)>,
    /// cos ψ of the points of a ring (the other half mirrors them).
    turns: Vec<f64>,
    step: f64,
    count: usize,
}

impl DiscMean {
    /// The disc for curves of spheres up to a size parameter; `limb`: darker towards its rim.
    pub fn new(size_parameter: f64, limb: Option<LimbDarkening>) -> Self {
        let lobe = PI / size_parameter;
        let step = (lobe / PER_LOBE).min(SUN_ANGULAR_RADIUS / PER_RADIUS);
        let count = (PI / step).ceil() as usize;
        let lobes = SUN_ANGULAR_RADIUS / lobe;
        let rings = self::rings((RINGS_PER_LOBE * lobes).max(LEAST_RINGS).ceil() as usize, limb);
        let turns = 2 * rings.len();
        let turn = |j: usize| (PI * (j as f64 + 0.5) / turns as f64).cos();
        Self { rings, turns: (0..turns).map(turn).collect(), step: PI / count as f64, count }
    }

    /// Scattering angles at which the fine curve is needed: an even grid from 0 to π.
    pub fn fine_angles(&self) -> Vec<f64> {
        (0..=self.count).map(|i| PI * i as f64 / self.count as f64).collect()
    }

    /// The means at some angles of the curve given at [`DiscMean::fine_angles`].
    pub fn means(&self, fine: &[[f64; 4]], theta: &[f64]) -> Vec<[f64; 4]> {
        theta.par_iter().map(|&theta| self.mean(fine, theta)).collect()
    }

    fn mean(&self, fine: &[[f64; 4]], theta: f64) -> [f64; 4] {
        let (sine, cosine) = theta.sin_cos();
        let mut sum = [0.0; 4];
        for &(rho, share) in &self.rings {
            let (s, c) = rho.sin_cos();
            let weight = share / self.turns.len() as f64;
            for turn in &self.turns {
                // Half-angle form: no loss near 0 and π.
                let away = (sine * c + cosine * s * turn).powi(2) + s * s * (1.0 - turn * turn);
                let angle = away.sqrt().atan2(cosine * c - sine * s * turn);
                let value = self.between(fine, angle);
                sum.iter_mut().zip(value).for_each(|(sum, value)| *sum += weight * value);
            }
        }
        sum
    }

    /// Cubic through the four nearest samples; beyond 0 and π the curve is its own mirror image.
    fn between(&self, fine: &[[f64; 4]], angle: f64) -> [f64; 4] {
        let place = angle / self.step;
        let cell = (place.floor() as usize).min(self.count - 1);
        let t = place - cell as f64;
        let at = |k: isize| {
            let i = cell as isize + k;
            let last = self.count as isize;
            let mirrored = if i < 0 {
                -i
            } else if i > last {
                2 * last - i
            } else {
                i
            };
            &fine[mirrored as usize]
        };
        let weights = cubic(t);
        std::array::from_fn(|e| (0..4).map(|k| weights[k] * at(k as isize - 1)[e]).sum())
    }
}

/// Rings of equal area: their distance from the centre of the disc and their share of its light.
pub(super) fn rings(count: usize, limb: Option<LimbDarkening>) -> Vec<(f64, f64)> {
    let ring = |(node, weight): (f64, f64)| {
        let square = 0.5 * (1.0 + node);
        let light = limb.map_or(1.0, |limb| limb.brightness((1.0 - square).sqrt()));
        (SUN_ANGULAR_RADIUS * square.sqrt(), light * weight)
    };
    let mut rings: Vec<(f64, f64)> = gauss_legendre::nodes(count).into_iter().map(ring).collect();
    let light: f64 = rings.iter().map(|(_, light)| light).sum();
    rings.iter_mut().for_each(|(_, share)| *share /= light);
    rings
}

/// Weights of samples at -1, 0, 1 and 2 of the cubic through them, at a place between 0 and 1.
pub(super) fn cubic(t: f64) -> [f64; 4] {
    [
        -t * (t - 1.0) * (t - 2.0) / 6.0,
        (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
        -(t + 1.0) * t * (t - 2.0) / 2.0,
        (t + 1.0) * t * (t - 1.0) / 6.0,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `exp(i l θ)`-like curves: P_l(cos θ) keeps its shape, times the disc's own transform
    /// `[P_{l-1}(c) - P_{l+1}(c)]/((2l+1)(1 - c))`, c the cosine of the disc's radius.
    #[test]
    fn legendre_polynomials_are_damped_as_by_a_cap() {
        let legendre = |l: usize, x: f64| {
            let (mut before, mut now) = (1.0, x);
            for n in 1..l {
                let next = ((2 * n + 1) as f64 * x * now - n as f64 * before) / (n + 1) as f64;
                (before, now) = (now, next);
            }
            now
        };
        let disc = DiscMean::new(400.0, None);
        for l in [1, 40, 300] {
            let fine: Vec<[f64; 4]> =
                disc.fine_angles().iter().map(|t| [legendre(l, t.cos()); 4]).collect();
            let c = SUN_ANGULAR_RADIUS.cos();
            let damping = if l == 1 {
                0.5 * (1.0 + c)
            } else {
                (legendre(l - 1, c) - legendre(l + 1, c)) / ((2 * l + 1) as f64 * (1.0 - c))
            };
            let theta = [0.0, 0.01, 0.5, 1.5, 3.0, PI];
            for (theta, mean) in theta.iter().zip(disc.means(&fine, &theta)) {
                let expected = damping * legendre(l, theta.cos());
                assert!((mean[0] - expected).abs() < 3e-4, "{l} {theta}: {} {expected}", mean[0]);
            }
        }
    }
}
