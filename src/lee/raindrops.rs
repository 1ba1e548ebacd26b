//! The diagram of raindrops, by rays: flattened ones order by order, small ones as the spheres they are.
//!
//! Orders up to 3 make the two bows and what lies about them. Of those beyond, the bows at 128° (order 6)
//! and 149° (order 7) are a hundredth as bright, and are sampled accordingly. Beats between orders are too
//! fast for the sun's disc and for colours, so that orders add as intensities.

use super::{Angles, Beats, Diagram, Drop, LEAST_FINENESS, LeeError, Request, diagram};
use crate::medium::MediumSpec;
use crate::plan::Plan;
use crate::scene::{Choice, Grid, Orders, Particle, Scene, SceneFile, ShapeName};
use crate::shape::RaindropModel;
use crate::simulate;
use std::f64::consts::TAU;

/// Highest order of rays in the diagram.
pub const HIGHEST_ORDER: u32 = 7;
/// Highest order of the bright ones.
const LAST_BRIGHT_ORDER: u32 = 3;
/// Relative error asked of the faint orders: 5 % of a hundredth.
const FAINT_TOLERANCE: f64 = 0.05;
/// Factor on their numbers of wavelengths and angles.
const FAINT_FINENESS: f64 = 0.4;
/// A wavelength inside the visible, for what does not depend on it.
const MIDDLE: f64 = 550e-9;

/// Raindrops of any size under one sun, seen in one half-plane of azimuth.
#[derive(Clone, Debug)]
pub struct Raindrops {
    scene: Box<Scene>,
    azimuth: f64,
}

impl Raindrops {
    /// Drops of a medium; azimuth of the light seen, about the sun's rays, in radians.
    ///
    /// # Errors
    /// A sun that is nowhere, or a medium without data in the visible.
    pub fn new(medium: MediumSpec, sun_elevation_deg: f64, azimuth: f64) -> Result<Self, LeeError> {
        let mut file = SceneFile::default();
        file.particle.shape = Some(Choice(ShapeName::Raindrop));
        file.particle.radius_mm = Some(0.5);
        file.particle.medium = Some(medium);
        file.light.sun_elevation_deg = Some(sun_elevation_deg);
        file.light.wavelengths_nm = Some(Grid::List(vec![MIDDLE * 1e9]));
        Ok(Self { scene: Box::new(file.validate()?), azimuth })
    }

    /// Whether a drop (metres) is flattened at all, and not a sphere.
    ///
    /// # Errors
    /// A size outside the model.
    pub(super) fn is_flattened(&self, radius: f64) -> Result<bool, LeeError> {
        Ok(!self.plan(radius, MIDDLE, &[0])?.shape.is_sphere())
    }

    /// The plan of some orders of one drop (metres).
    fn plan(&self, radius: f64, wavelength: f64, orders: &[u32]) -> Result<Plan, LeeError> {
        let faint = orders.iter().all(|&order| order > LAST_BRIGHT_ORDER);
        let scene = Scene {
            particle: Particle::Raindrop { radius, model: RaindropModel::BeardChuang1987 },
            wavelengths: vec![wavelength],
            orders: Orders::List(orders.to_vec()),
            tolerance: if faint { FAINT_TOLERANCE } else { self.scene.tolerance },
            ..(*self.scene).clone()
        };
        let mut plan = Plan::new(&scene)?;
        // what one method gets wrong would show as a streak among hundreds of columns
        plan.checked = false;
        Ok(plan)
    }

    /// The diagram of these drops: the bright orders one by one, then the faint ones together.
    ///
    /// # Errors
    /// As for [`diagram`], and drops that rays cannot serve.
    pub(super) fn diagram(&self, request: &Request) -> Result<Diagram, LeeError> {
        let bright: Vec<Vec<u32>> = (0..=LAST_BRIGHT_ORDER).map(|order| vec![order]).collect();
        let faint = vec![(LAST_BRIGHT_ORDER + 1..=HIGHEST_ORDER).collect()];
        let fineness = (FAINT_FINENESS * request.fineness).max(LEAST_FINENESS);
        let coarse = Request { fineness, ..request.clone() };
        let mut whole = self.sum(request, &bright)?;
        let rest = self.sum(&coarse, &faint)?;
        let pairs = whole.xyz.iter_mut().flatten().zip(rest.xyz.iter().flatten());
        for (sum, more) in pairs {
            for (to, from) in sum.iter_mut().flatten().zip(more.iter().flatten()) {
                *to += from;
            }
        }
        Ok(whole)
    }

    /// The intensities of groups of orders, added.
    fn sum(&self, request: &Request, groups: &[Vec<u32>]) -> Result<Diagram, LeeError> {
        let directions = |angles: &Angles| -> Vec<(f64, f64)> {
            angles.theta.iter().map(|&t| (t, self.azimuth)).collect()
        };
        let one = |drop: &Drop, at: &[(f64, f64)]| -> Result<Vec<[f64; 2]>, LeeError> {
            let mut sum = vec![[0.0; 2]; at.len()];
            for orders in groups {
                let plan = self.plan(drop.radius, drop.wavelength, orders)?;
                let size_parameter = TAU * drop.radius / drop.wavelength;
                let found = simulate::scatter(&plan, drop.index, size_parameter, at);
                let matrices = simulate::finite(found, at)?;
                for (sum, m) in sum.iter_mut().zip(&matrices) {
                    sum[0] += 0.5 * (m.s2.norm_sqr() + m.s3.norm_sqr());
                    sum[1] += 0.5 * (m.s1.norm_sqr() + m.s4.norm_sqr());
                }
            }
            Ok(sum)
        };
        let scatter = |drops: &[Drop], at: &Vec<(f64, f64)>| {
            drops.iter().map(|drop| one(drop, at)).collect::<Result<Vec<_>, _>>()
        };
        diagram(request, Beats::WithinOrders, &directions, scatter)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A drop of 10 µm is a sphere, one of a millimetre is not; a sun below the ground is refused.
    #[test]
    fn small_drops_are_spheres() {
        let drops = Raindrops::new(MediumSpec::default(), 20.0, 3.0).unwrap();
        assert!(!drops.is_flattened(10e-6).unwrap() && drops.is_flattened(1e-3).unwrap());
        let refused = Raindrops::new(MediumSpec::default(), 95.0, 3.0).unwrap_err();
        assert!(refused.to_string().contains("sun_elevation_deg"), "{refused}");
    }

    /// A drop so little flattened that Lorenz–Mie nearly serves it has nearly those colours.
    #[test]
    fn a_nearly_round_drop_has_the_colours_of_a_sphere() {
        let request = Request {
            radii: vec![0.15e-3],
            theta: (0..8).map(|i| (138.0 + f64::from(i)).to_radians()).collect(),
            medium: MediumSpec::default().resolve(".".as_ref()).unwrap(),
            sun_disc: true,
            size_spread: 0.05,
            illuminant: crate::color::Illuminant::D65,
            observer: crate::color::Observer::Cie1931,
            fineness: 0.3,
        };
        let drops = Raindrops::new(MediumSpec::default(), 20.0, 90f64.to_radians()).unwrap();
        let rays = drops.diagram(&request).unwrap();
        let exact = super::super::spheres(&request).unwrap();
        let brightest = |d: &Diagram| d.xyz[0].iter().map(|c| c[1][1]).fold(0.0, f64::max);
        let ratio = brightest(&rays) / brightest(&exact);
        assert!((0.85..1.15).contains(&ratio), "{ratio}");
    }
}
