//! The columns of the diagram, each on its own: spheres by Lorenz–Mie, raindrops by rays.

use super::{LeeArgs, LeeShape, usage};
use crate::cli::progress;
use gonio::lee::{self, Angles, Beats, Diagram, Drop, LeeError, Request};
use gonio::medium::MediumSpec;
use gonio::plan::Plan;
use gonio::scene::{Choice, Grid, Orders, Particle, Scene, SceneFile, ShapeName};
use gonio::shape::RaindropModel;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Highest order of rays in the diagram.
pub const HIGHEST_ORDER: u32 = 7;
/// Up to here orders make the two bows and what lies about them; of those beyond, the bows at 128°
/// (order 6) and 149° (order 7) are a hundredth as bright and are sampled accordingly.
const LAST_BRIGHT_ORDER: u32 = 3;
/// Relative error asked of the faint orders: 5 % of a hundredth.
const FAINT_TOLERANCE: f64 = 0.05;
/// Factor on their numbers of wavelengths and angles.
const FAINT_FINENESS: f64 = 0.4;

/// All columns, the largest drops first, since they take longest; a bar counts them.
pub fn columns(args: &LeeArgs, request: &Request) -> anyhow::Result<Diagram> {
    let drops = match args.shape {
        LeeShape::Sphere => None,
        LeeShape::Raindrop => Some(Raindrops::new(args)?),
    };
    let mut order: Vec<usize> = (0..request.radii.len()).collect();
    order.sort_by(|&i, &j| request.radii[j].total_cmp(&request.radii[i]));
    let bar = progress::bar(order.len(), "radii");
    let mut columns = order
        .par_iter()
        .with_max_len(1)
        .map(|&i| {
            let one = Request { radii: vec![request.radii[i]], ..request.clone() };
            let column = match &drops {
                Some(drops) if !drops.plan(one.radii[0], MIDDLE, &[0])?.shape.is_sphere() => {
                    drops.column(&one)?
                }
                _ => lee::spheres(&one).map_err(wrong_input)?,
            };
            bar.inc(1);
            anyhow::Ok((i, column.xyz))
        })
        .collect::<anyhow::Result<Vec<_>>>()?;
    bar.finish_and_clear();
    columns.sort_by_key(|(i, _)| *i);
    Ok(Diagram {
        radii: request.radii.clone(),
        theta: request.theta.clone(),
        xyz: columns.into_iter().flat_map(|(_, column)| column).collect(),
    })
}

/// A wavelength inside the visible, for what does not depend on it.
const MIDDLE: f64 = 550e-9;

/// What the library refuses here was asked for on the command line.
fn wrong_input(error: LeeError) -> anyhow::Error {
    usage(error.to_string())
}

/// Raindrops in one half-plane of azimuth. Small ones are spheres, for which Lorenz–Mie is exact.
struct Raindrops {
    scene: Scene,
    azimuth: f64,
}

impl Raindrops {
    fn new(args: &LeeArgs) -> anyhow::Result<Self> {
        let mut file = SceneFile::default();
        file.particle.shape = Some(Choice(ShapeName::Raindrop));
        file.particle.radius_mm = Some(0.5);
        file.particle.medium = Some(MediumSpec::parse(&args.medium)?);
        file.light.sun_elevation_deg = Some(args.sun_elevation_deg);
        file.light.wavelengths_nm = Some(Grid::List(vec![MIDDLE * 1e9]));
        Ok(Self { scene: file.validate()?, azimuth: args.azimuth_deg.to_radians() })
    }

    /// The plan of some orders of one drop (metres).
    fn plan(&self, radius: f64, wavelength: f64, orders: &[u32]) -> anyhow::Result<Plan> {
        let faint = orders.iter().all(|&order| order > LAST_BRIGHT_ORDER);
        let scene = Scene {
            particle: Particle::Raindrop { radius, model: RaindropModel::BeardChuang1987 },
            wavelengths: vec![wavelength],
            orders: Orders::List(orders.to_vec()),
            tolerance: if faint { FAINT_TOLERANCE } else { self.scene.tolerance },
            ..self.scene.clone()
        };
        let mut plan = Plan::new(&scene)?;
        // what one method gets wrong would show as a streak among hundreds of columns
        plan.checked = false;
        Ok(plan)
    }

    /// One column: the bright orders one by one, then the faint ones together.
    fn column(&self, request: &Request) -> anyhow::Result<Diagram> {
        let bright: Vec<Vec<u32>> = (0..=LAST_BRIGHT_ORDER).map(|order| vec![order]).collect();
        let faint = vec![(LAST_BRIGHT_ORDER + 1..=HIGHEST_ORDER).collect()];
        let coarse = Request { fineness: FAINT_FINENESS * request.fineness, ..request.clone() };
        let mut column = self.sum(request, &bright)?;
        let rest = self.sum(&coarse, &faint)?;
        let pairs = column.xyz.iter_mut().flatten().zip(rest.xyz.iter().flatten());
        for (sum, more) in pairs {
            for (to, from) in sum.iter_mut().flatten().zip(more.iter().flatten()) {
                *to += from;
            }
        }
        Ok(column)
    }

    /// The intensities of groups of orders, added: beats between groups are too fast for the sun's
    /// disc and for colours.
    fn sum(&self, request: &Request, groups: &[Vec<u32>]) -> anyhow::Result<Diagram> {
        let directions = |angles: &Angles| -> Vec<(f64, f64)> {
            angles.theta.iter().map(|&t| (t, self.azimuth)).collect()
        };
        let one = |drop: &Drop, at: &[(f64, f64)]| {
            let mut sum = vec![[0.0; 2]; at.len()];
            for orders in groups {
                let plan = self.plan(drop.radius, drop.wavelength, orders)?;
                let size_parameter = TAU * drop.radius / drop.wavelength;
                let found = gonio::simulate::scatter(&plan, drop.index, size_parameter, at);
                let matrices = gonio::simulate::finite(found, at)?;
                for (sum, m) in sum.iter_mut().zip(&matrices) {
                    sum[0] += 0.5 * (m.s2.norm_sqr() + m.s3.norm_sqr());
                    sum[1] += 0.5 * (m.s1.norm_sqr() + m.s4.norm_sqr());
                }
            }
            anyhow::Ok(sum)
        };
        let scatter = |drops: &[Drop], at: &Vec<(f64, f64)>| {
            drops.iter().map(|drop| one(drop, at)).collect::<anyhow::Result<Vec<_>>>()
        };
        lee::diagram(request, Beats::WithinOrders, &directions, scatter)
    }
}
