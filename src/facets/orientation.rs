//! How a crystal stands: fixed, at random, or lying as it falls, with tilts; and points that spread evenly over
//! all of it.
//!
//! Orientations are those of a Sobol sequence in three dimensions (Joe & Kuo, SIAM J. Sci. Comput. 30, 2635,
//! 2008), scrambled anew for each of several replicas (Owen 1995; by hashing, Burley, J. Comput. Graph. Tech. 9(4), 2020):
//! their scatter is the error of the mean.
//!
//! ```
//! use gonio::facets::orientation::{Stand, point};
//!
//! let turn = Stand::Random.rotation(point(0, 7), 0.3);
//! assert!((turn.determinant() - 1.0).abs() < 1e-12);
//! ```

use glam::{DMat3, DVec3};
use std::f64::consts::{FRAC_PI_2, TAU};

/// How the axis of a body (its z) stands to the vertical. Angles in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stand {
    /// One orientation: the axis from the vertical, the azimuth of its tilt about the vertical (0: away from
    /// the sun), and a turn about the axis.
    Fixed {
        /// Axis from the vertical.
        zenith: f64,
        /// Of the tilt.
        azimuth: f64,
        /// About the axis.
        spin: f64,
    },
    /// All alike.
    Random,
    /// Axis vertical, as that of falling plates: turned about it at random, tilted with this standard
    /// deviation in each of two planes.
    Upright {
        /// Standard deviation.
        deviation: f64,
    },
    /// Axis horizontal, as that of falling columns: turned about the vertical and about its own axis at
    /// random, its ends up and down with this standard deviation.
    Horizontal {
        /// Standard deviation.
        deviation: f64,
    },
}

impl Stand {
    /// Whether there is a mean to take.
    pub fn is_fixed(&self) -> bool {
        matches!(self, Stand::Fixed { .. })
    }

    /// From the frame of the body to that of the light (z along it, x to the upper side of the vertical
    /// plane), for a point of the unit cube and a sun at an elevation (radians).
    pub fn rotation(&self, point: [f64; 3], sun_elevation: f64) -> DMat3 {
        let [u, v, w] = point;
        let about = DMat3::from_rotation_z;
        let local = match *self {
            Stand::Fixed { zenith, azimuth, spin } => {
                about(azimuth) * DMat3::from_rotation_y(zenith) * about(spin)
            }
            Stand::Random => {
                let tilt = (1.0 - 2.0 * u).clamp(-1.0, 1.0).acos();
                about(TAU * v) * DMat3::from_rotation_y(tilt) * about(TAU * w)
            }
            Stand::Upright { deviation } => {
                let (x, y) = (deviation * normal(u), deviation * normal(v));
                let tilt = DVec3::new(x, y, 0.0);
                let turn = DMat3::from_axis_angle(
                    DVec3::new(-y, x, 0.0).try_normalize().unwrap_or(DVec3::X),
                    tilt.length(),
                );
                turn * about(TAU * w)
            }
            Stand::Horizontal { deviation } => {
                let lean = FRAC_PI_2 + deviation * normal(u);
                about(TAU * v) * DMat3::from_rotation_y(lean) * about(TAU * w)
            }
        };
        to_light(sun_elevation) * local
    }
}

/// From a frame that stands upright (z up, x away from the sun) to that of the light.
fn to_light(sun_elevation: f64) -> DMat3 {
    let (sin, cos) = sun_elevation.sin_cos();
    let (up, away) = (DVec3::new(cos, 0.0, -sin), DVec3::new(sin, 0.0, cos));
    DMat3::from_cols(away, up.cross(away), up)
}

/// The normal deviate that this share of all lies below: Acklam's rational functions, right to 1e-9.
fn normal(share: f64) -> f64 {
    const A: [f64; 6] = [
        -3.969_683_028_665_376e1,
        2.209_460_984_245_205e2,
        -2.759_285_104_469_687e2,
        1.383_577_518_672_69e2,
        -3.066_479_806_614_716e1,
        2.506_628_277_459_239,
    ];
    const B: [f64; 5] = [
        -5.447_609_879_822_406e1,
        1.615_858_368_580_409e2,
        -1.556_989_798_598_866e2,
        6.680_131_188_771_972e1,
        -1.328_068_155_288_572e1,
    ];
    const C: [f64; 6] = [
        -7.784_894_002_430_293e-3,
        -3.223_964_580_411_365e-1,
        -2.400_758_277_161_838,
        -2.549_732_539_343_734,
        4.374_664_141_464_968,
        2.938_163_982_698_783,
    ];
    const D: [f64; 4] = [
        7.784_695_709_041_462e-3,
        3.224_671_290_700_398e-1,
        2.445_134_137_142_996,
        3.754_408_661_907_416,
    ];
    const EDGE: f64 = 0.02425;
    let powers = |c: &[f64], x: f64| c.iter().fold(0.0, |sum, c| sum * x + c);
    let share = share.clamp(1e-12, 1.0 - 1e-12);
    let tail = |p: f64| {
        let q = (-2.0 * p.ln()).sqrt();
        powers(&C, q) / (powers(&D, q) * q + 1.0)
    };
    if share < EDGE {
        tail(share)
    } else if share > 1.0 - EDGE {
        -tail(1.0 - share)
    } else {
        let q = share - 0.5;
        q * powers(&A, q * q) / (powers(&B, q * q) * q * q + 1.0)
    }
}

/// Direction numbers of the second and third dimension by their recurrences; the first has the bits
/// themselves.
fn sobol(index: u32, dimension: u32) -> u32 {
    if dimension == 0 {
        return index.reverse_bits();
    }
    let mut directions = [0u32; 32];
    let (degree, inner) = if dimension == 1 { (1, 0) } else { (2, 1) };
    let start = [1u32, 3];
    for k in 0..32 {
        directions[k] = if k < degree {
            start[k] << (31 - k)
        } else {
            let last = directions[k - degree];
            let mut value = last ^ (last >> degree);
            if degree == 2 && inner == 1 {
                value ^= directions[k - 1];
            }
            value
        };
    }
    (0..32).filter(|bit| index >> bit & 1 == 1).fold(0, |x, bit| x ^ directions[bit])
}

/// Owen's nested scrambling by a hash in which bits act on lower bits alone.
fn scrambled(x: u32, seed: u32) -> u32 {
    let mut x = x.reverse_bits();
    x = x.wrapping_add(seed);
    x ^= x.wrapping_mul(0x6c50_b47c);
    x ^= x.wrapping_mul(0xb82f_1e52);
    x ^= x.wrapping_mul(0xc7af_e638);
    x ^= x.wrapping_mul(0x8d22_f6e6);
    x.reverse_bits()
}

/// A seed for each replica and dimension.
fn hash(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// A point of the unit cube: number `index` of the sequence of a replica.
pub fn point(index: u32, replica: u32) -> [f64; 3] {
    std::array::from_fn(|dimension| {
        let seed = hash(3 * replica + dimension as u32 + 1);
        let bits = scrambled(sobol(index, dimension as u32), seed);
        (f64::from(bits) + 0.5) / 2f64.powi(32)
    })
}

/// A number from 0 to 1 that goes with an orientation of a replica, spread evenly over neighbours.
pub(super) fn offset(index: u32, replica: u32) -> f64 {
    let start = f64::from(hash(0x9e37 + replica)) / 2f64.powi(32);
    (start + f64::from(index) * crate::math::GOLDEN).fract()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every stratum of a power of two holds one point, in each dimension and in pairs of them.
    #[test]
    fn points_are_spread_evenly() {
        for replica in 0..4 {
            let points: Vec<[f64; 3]> = (0..256).map(|i| point(i, replica)).collect();
            for d in 0..3 {
                let mut seen = [0; 256];
                points.iter().for_each(|p| seen[(p[d] * 256.0) as usize] += 1);
                assert!(seen.iter().all(|&n| n == 1), "dimension {d}");
            }
            for (a, b) in [(0, 1), (1, 2), (0, 2)] {
                let mut seen = [0; 64];
                points
                    .iter()
                    .for_each(|p| seen[(p[a] * 8.0) as usize * 8 + (p[b] * 8.0) as usize] += 1);
                assert!(seen.iter().all(|&n| n == 4), "dimensions {a}, {b}");
            }
        }
        assert_ne!(point(5, 0), point(5, 1));
    }

    /// Moments of the axis: isotropic, or as wide as asked.
    #[test]
    fn axes_stand_as_asked() {
        let axis = |stand: Stand, i: u32| stand.rotation(point(i, 1), 0.0) * DVec3::Z;
        let mean = |stand: Stand, f: &dyn Fn(DVec3) -> f64| {
            (0..4096).map(|i| f(axis(stand, i))).sum::<f64>() / 4096.0
        };
        // with the sun on the horizon x is up and z away from it
        for square in [&|a: DVec3| a.x * a.x, &|a: DVec3| a.y * a.y, &|a: DVec3| a.z * a.z]
            as [&dyn Fn(DVec3) -> f64; 3]
        {
            assert!((mean(Stand::Random, square) - 1.0 / 3.0).abs() < 1e-3);
        }
        let upright = Stand::Upright { deviation: 0.02 };
        for part in [|a: DVec3| a.y, |a: DVec3| a.z] {
            let deviation = mean(upright, &|a| part(a).powi(2)).sqrt();
            assert!((deviation / 0.02 - 1.0).abs() < 0.01, "{deviation}");
        }
        let lying = Stand::Horizontal { deviation: 0.01 };
        assert!((mean(lying, &|a| a.x * a.x).sqrt() / 0.01 - 1.0).abs() < 0.01);
        assert!((mean(lying, &|a| a.z * a.z) - 0.5).abs() < 0.01);
    }

    /// The sun above: light comes down on an upright axis.
    #[test]
    fn the_axis_turns_with_the_sun() {
        let up = |elevation: f64| {
            let fixed = Stand::Fixed { zenith: 0.0, azimuth: 0.0, spin: 0.2 };
            fixed.rotation([0.5; 3], elevation) * DVec3::Z
        };
        assert!((up(FRAC_PI_2) + DVec3::Z).length() < 1e-15);
        assert!((up(0.3) - DVec3::new(0.3f64.cos(), 0.0, -0.3f64.sin())).length() < 1e-15);
        let leaning = Stand::Fixed { zenith: FRAC_PI_2, azimuth: 0.0, spin: 0.0 };
        assert!((leaning.rotation([0.5; 3], 0.0) * DVec3::Z - DVec3::Z).length() < 1e-15);
    }

    #[test]
    fn deviates_are_normal() {
        // Abramowitz & Stegun, table 26.5
        for (share, x) in
            [(0.5, 0.0), (0.841_344_746, 1.0), (0.975, 1.959_963_985), (1e-3, -3.090_232_306)]
        {
            assert!((normal(share) - x).abs() < 1e-7, "{share}: {}", normal(share));
        }
    }
}
