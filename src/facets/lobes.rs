//! Directions drawn where light goes: about every beam that leaves, about the shadow's peak, and everywhere.
//!
//! A large crystal in one orientation scatters into lobes much narrower than the distances between them; evenly
//! spread directions would miss most. The chance of a direction is that of a mixture of lobes, and its weight
//! the inverse: means stay what they are, whatever the lobes (Veach & Guibas 1995), their scatter falls.

use super::beams::Beams;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// A lobe: `1 + width²·2(1 − cos ψ)` is its scale at an angle ψ from its middle.
#[derive(Clone, Copy, Debug)]
struct Lobe {
    middle: DVec3,
    /// Size parameter of the circle of the beam's cross-section.
    size: f64,
    power: f64,
}

/// All lobes of one orientation.
#[derive(Clone, Debug)]
pub(super) struct Lobes {
    lobes: Vec<Lobe>,
}

/// Share of the directions that is spread evenly.
const EVENLY: f64 = 0.4;
/// Straight ahead and behind all azimuths are one direction.
const ON_AXIS: f64 = 1e-9;
/// Strongest beams that are looked for.
const MOST: usize = 24;

impl Lobes {
    pub fn new(beams: &Beams, wavenumber: f64) -> Self {
        let size = |area: f64| wavenumber * (area / PI).sqrt();
        let shadow = Lobe { middle: DVec3::Z, size: size(beams.shadow), power: 1.0 };
        let mut lobes: Vec<Lobe> = beams
            .patches
            .iter()
            .filter_map(|patch| {
                let middle = patch.leaving.direction?;
                let normal = patch.axes[0].cross(patch.axes[1]);
                let area = patch.polygon.area() * normal.dot(middle).abs();
                let power = patch.leaving.power;
                (power > 1e-6).then_some(Lobe { middle, size: size(area), power })
            })
            .collect();
        lobes.sort_by(|a, b| b.power.total_cmp(&a.power));
        lobes.truncate(MOST);
        lobes.push(shadow);
        Self { lobes }
    }

    /// Azimuths at one scattering angle, each with its weight in the mean over azimuth; `start` from 0 to 1.
    pub fn azimuths(&self, theta: f64, count: usize, start: f64) -> Vec<(f64, f64)> {
        let (sin, cos) = theta.sin_cos();
        if sin < ON_AXIS {
            // frames turn with the azimuth: evenly spread, polarisation cancels
            let even = |j: usize| (TAU * (j as f64 + start) / count as f64, 1.0 / count as f64);
            return (0..count).map(even).collect();
        }
        // a − b cos Δ, its share of all, and its azimuth
        let mut parts: Vec<[f64; 4]> = Vec::with_capacity(self.lobes.len());
        let mut total = 0.0;
        for lobe in &self.lobes {
            let square = 2.0 * lobe.size * lobe.size;
            let across = lobe.middle.x.hypot(lobe.middle.y);
            let (a, b) = (1.0 + square * (1.0 - cos * lobe.middle.z), square * sin * across);
            let spread = ((a - b) * (a + b)).sqrt();
            let share = lobe.power * square / (spread * (a - b).max(1.0).sqrt());
            total += share;
            parts.push([a, b, share, lobe.middle.y.atan2(lobe.middle.x)]);
        }
        let even = EVENLY / (1.0 - EVENLY) * total;
        let whole = total + even;
        let density = |phi: f64| {
            let of = |[a, b, share, at]: &[f64; 4]| {
                share * ((a - b) * (a + b)).sqrt() / (TAU * (a - b * (phi - at).cos()))
            };
            (even / TAU + parts.iter().map(of).sum::<f64>()) / whole
        };
        (0..count)
            .map(|j| {
                let mut u = (j as f64 + start) / count as f64 * whole;
                let mut phi = TAU * (u / even);
                if u >= even {
                    u -= even;
                    for [a, b, share, at] in &parts {
                        let inside = (u / share).min(1.0);
                        phi = at + wrapped(*a, *b, inside);
                        if u < *share {
                            break;
                        }
                        u -= share;
                    }
                }
                (phi, 1.0 / (TAU * density(phi) * count as f64))
            })
            .collect()
    }

    /// Directions over the sphere, each with its solid angle; `start` from 0 to 1 in three dimensions.
    pub fn directions(&self, count: usize, start: [f64; 3]) -> Vec<(f64, f64, f64)> {
        let total: f64 = self.lobes.iter().map(|lobe| lobe.power).sum();
        let even = EVENLY / (1.0 - EVENLY) * total;
        let whole = total + even;
        let density = |way: DVec3| {
            let of = |lobe: &Lobe| lobe.power * lobe.density(way);
            (even / (4.0 * PI) + self.lobes.iter().map(of).sum::<f64>()) / whole
        };
        (0..count)
            .map(|j| {
                let j = j as f64;
                // steps of Roberts' sequence fill the two dimensions beside the choice of the lobe
                let v = (start[1] + j * 0.754_877_666_246_692_8).fract();
                let turn = TAU * (start[2] + j * 0.569_840_290_998_053_3).fract();
                let mut u = (j + start[0]) / count as f64 * whole;
                let way = if u < even {
                    around(DVec3::Z, 1.0 - 2.0 * v, turn)
                } else {
                    u -= even;
                    let mut lobe = self.lobes[self.lobes.len() - 1];
                    for next in &self.lobes {
                        if u < next.power {
                            lobe = *next;
                            break;
                        }
                        u -= next.power;
                    }
                    around(lobe.middle, 1.0 - lobe.depth(v), turn)
                };
                let theta = way.x.hypot(way.y).atan2(way.z);
                (theta, way.y.atan2(way.x), 1.0 / (density(way) * count as f64))
            })
            .collect()
    }
}

impl Lobe {
    /// Chance per solid angle, `∝ (1 + 2 size² (1 − cos ψ))^(−3/2)`: lobes of polygons fall like that on average.
    fn density(&self, way: DVec3) -> f64 {
        let square = 2.0 * self.size * self.size;
        let scale = 1.0 + square * (1.0 - way.dot(self.middle));
        let norm = TAU * 2.0 / square * (1.0 - 1.0 / (1.0 + 2.0 * square).sqrt());
        scale.powf(-1.5) / norm
    }

    /// `1 − cos ψ` that a share of the lobe is within.
    fn depth(&self, share: f64) -> f64 {
        let square = 2.0 * self.size * self.size;
        let root = 1.0 - share * (1.0 - 1.0 / (1.0 + 2.0 * square).sqrt());
        ((1.0 / (root * root) - 1.0) / square).min(2.0)
    }
}

/// The angle that a share of `1/(a − b cos Δ)` lies below, from −π on.
fn wrapped(a: f64, b: f64, share: f64) -> f64 {
    let narrow = ((a - b) / (a + b)).sqrt();
    2.0 * (narrow * (PI * (share - 0.5)).tan()).atan()
}

/// The direction at an angle of this cosine from another.
fn around(middle: DVec3, cos: f64, turn: f64) -> DVec3 {
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    let (x, y) = middle.any_orthonormal_pair();
    (middle * cos + sin * (turn.cos() * x + turn.sin() * y)).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::facets::Body;
    use crate::facets::beams::{Incidence, Settings, split};

    fn lobes(x: f64) -> Lobes {
        let turn = glam::DMat3::from_rotation_y(0.5) * glam::DMat3::from_rotation_z(0.2);
        let body = Body::hexagonal_column(1.0).unwrap().turned(&turn);
        let light = Incidence { index: 1.31.into(), size_parameter: x };
        Lobes::new(&split(&body, &light, &Settings::default()), x)
    }

    /// Weights make any mean what it is over evenly spread directions.
    #[test]
    fn weights_leave_means_alone() {
        for x in [20.0, 500.0] {
            let lobes = lobes(x);
            for theta in [0.0, 0.4, 2.0, PI] {
                let drawn = lobes.azimuths(theta, 4000, 0.3);
                let mean = |f: &dyn Fn(f64) -> f64| {
                    drawn.iter().map(|(phi, weight)| weight * f(*phi)).sum::<f64>()
                };
                assert!((mean(&|_| 1.0) - 1.0).abs() < 0.02, "{x} {theta}: {}", mean(&|_| 1.0));
                assert!((mean(&|phi| phi.cos().powi(2)) - 0.5).abs() < 0.02);
            }
            let drawn = lobes.directions(20_000, [0.3, 0.1, 0.7]);
            let mean = |f: &dyn Fn(f64, f64) -> f64| {
                drawn.iter().map(|(theta, phi, weight)| weight * f(*theta, *phi)).sum::<f64>()
            };
            assert!((mean(&|_, _| 1.0) / (4.0 * PI) - 1.0).abs() < 0.02);
            assert!(mean(&|theta, _| theta.cos()).abs() < 0.2);
            let narrow =
                mean(&|theta, _| (1.0 + (2.0 * x * (0.5 * theta).sin()).powi(2)).powf(-1.5));
            let wanted = TAU / (x * x);
            assert!((narrow / wanted - 1.0).abs() < 0.1, "{x}: {narrow} {wanted}");
        }
    }

    /// Half of the directions go where the light is.
    #[test]
    fn beams_are_met() {
        let lobes = lobes(500.0);
        let strongest = lobes.lobes[0];
        let drawn = lobes.directions(1000, [0.5; 3]);
        let near = drawn.iter().filter(|(theta, phi, _)| {
            let way = DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
            way.angle_between(strongest.middle) < 10.0 / strongest.size
        });
        let share = strongest.power / 2.0 * (1.0 - EVENLY);
        assert!(near.count() as f64 > 700.0 * share);
    }
}
