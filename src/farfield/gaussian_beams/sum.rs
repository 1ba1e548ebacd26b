//! Sums of Gaussian beams, for orders whose rays are tangled.
//!
//! Where more than two rays coalesce (cusps, umbilics, the webs that strongly flattened drops make of
//! high orders) no formula for single rays or pairs holds, but the wave is still an integral over the
//! launch points `y` of its rays (Kirchhoff, on the plane through the centre normal to each exit ray),
//! `S(n) = -(x²/2π) ∬ T √|A| e^{-iπm/2} exp(ix [W + r·(s - n)]) d²y`, `A = |∂r/∂y|`,
//! `r` where the ray crosses its plane, `m` the focal lines passed up to there. Launch points are cut
//! into Gaussians of width `σ/√x` that add up to 1. Each sees a phase of second degree,
//! `(∂r/∂y)ᵀ(∂s/∂y) + ∂²r/∂y²·(s - n)`, so that its integral is a Gaussian of directions about its exit
//! ray: finite and smooth at every caustic. The error falls like `1/√x`. (Popov 1982; Heller 1991.)
//!
//! The plane must be the same for neighbouring rays: one that jumps from ray to ray leaves edges that
//! shine. Through the centre it meets no focus of a sphere's rays, and hardly one of a drop's.

use super::beam::{APART, Beam, FARTHEST, moved, step};
use super::launch::Launch;
use crate::farfield::direction::Direction;
use crate::farfield::wave_field::WaveField;
use crate::math::vec3::Vec3;
use crate::optics::AmplitudeMatrix;
use crate::shape::Silhouette;
use crate::trace::{Exit, Tracer};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// All beams of some orders, of launch points on one side of the mirror plane.
pub struct GaussianBeams {
    size_parameter: f64,
    beams: Vec<Beam>,
    /// For each sector of exit azimuths, where its beams begin in `members`.
    starts: Vec<usize>,
    members: Vec<u32>,
}

/// Fields weaker than this share of the strongest of their order are left out.
const WEAKEST: f64 = 1e-4;
/// Sectors of azimuth in a whole turn.
const SECTORS: usize = 720;

impl GaussianBeams {
    /// Trace the beams of some orders, as far as they reach one of these azimuths.
    pub fn new(tracer: &Tracer, orders: &[u32], azimuths: &[f64], size_parameter: f64) -> Self {
        let silhouette = tracer.shape().silhouette().tabulated();
        let step = step(size_parameter);
        let rows = (1.0 / step).ceil() as i64;
        let half_planes = HalfPlanes::new(azimuths);
        let farthest = FARTHEST / size_parameter.sqrt();
        let reaches = |exit: &Exit<f64>| half_planes.near(exit.direction, farthest);
        let row = |j: i64| {
            let mut found: Vec<(u32, Beam)> = Vec::new();
            for i in -rows..rows {
                // rows lie half a step off the mirror plane, which pairs them
                let place = [(i as f64 + 0.5) * step, (j as f64 + 0.5) * step];
                found.extend(beams_at(tracer, &silhouette, orders, place, size_parameter, reaches));
            }
            found
        };
        let all: Vec<(u32, Beam)> = (0..rows).into_par_iter().flat_map_iter(row).collect();
        let strongest = |order: u32| {
            let of_order = all.iter().filter(|(p, _)| *p == order);
            of_order.map(|(_, beam)| beam.strength()).fold(0.0, f64::max)
        };
        let floors: Vec<(u32, f64)> =
            orders.iter().map(|&order| (order, WEAKEST * strongest(order))).collect();
        let counts = |(order, beam): &(u32, Beam)| {
            floors.iter().any(|(p, floor)| p == order && beam.strength() > *floor)
        };
        let beams = all.into_iter().filter(counts).map(|(_, beam)| beam).collect();
        Self::sorted(beams, size_parameter)
    }

    /// With the sectors of azimuth that each beam reaches.
    fn sorted(beams: Vec<Beam>, size_parameter: f64) -> Self {
        let mut counts = vec![0usize; SECTORS + 1];
        for beam in &beams {
            sectors(beam, |sector| counts[sector + 1] += 1);
        }
        let starts: Vec<usize> = counts
            .into_iter()
            .scan(0, |sum, count| {
                *sum += count;
                Some(*sum)
            })
            .collect();
        let mut next = starts.clone();
        let mut members = vec![0u32; starts[SECTORS]];
        for (number, beam) in beams.iter().enumerate() {
            sectors(beam, |sector| {
                members[next[sector]] = number as u32;
                next[sector] += 1;
            });
        }
        Self { size_parameter, beams, starts, members }
    }

    fn add_side(
        &self,
        theta: &[f64],
        directions: &[Direction],
        phi: f64,
        mut add: impl FnMut(usize, AmplitudeMatrix),
    ) {
        let sector = sector_of(phi);
        for &number in &self.members[self.starts[sector]..self.starts[sector + 1]] {
            let beam = &self.beams[number as usize];
            let centre = beam.direction.x.hypot(beam.direction.y).atan2(beam.direction.z);
            let from = theta.partition_point(|&t| t < centre - beam.reach);
            for (i, direction) in directions.iter().enumerate().skip(from) {
                if direction.theta > centre + beam.reach {
                    break;
                }
                if let Some(wave) = beam.towards(direction, self.size_parameter) {
                    add(i, wave);
                }
            }
        }
    }
}

impl WaveField for GaussianBeams {
    fn add(&self, theta: &[f64], phi: f64, sums: &mut [AmplitudeMatrix]) {
        let directions: Vec<Direction> = theta.iter().map(|&t| Direction::new(t, phi)).collect();
        self.add_side(theta, &directions, phi, |i, wave| sums[i] += wave);
        // beams of the other side are mirror images
        let mirrored: Vec<Direction> = theta.iter().map(|&t| Direction::new(t, -phi)).collect();
        self.add_side(theta, &mirrored, -phi, |i, mut wave| {
            (wave.s3, wave.s4) = (-wave.s3, -wave.s4);
            sums[i] += wave;
        });
    }
}

/// The beams launched at a place, of those orders whose rays reach far enough.
fn beams_at(
    tracer: &Tracer,
    silhouette: &Silhouette,
    orders: &[u32],
    place: [f64; 2],
    x: f64,
    reaches: impl Fn(&Exit<f64>) -> bool,
) -> Vec<(u32, Beam)> {
    let rays = |off: [f64; 2]| -> Option<(Launch, Vec<Exit<f64>>)> {
        let launch = Launch::at(silhouette, [place[0] + off[0], place[1] + off[1]])?;
        let mut exits = Vec::new();
        let keep = |exit: Exit<f64>| exits.extend(orders.contains(&exit.order).then_some(exit));
        tracer.trace(launch.point[0], launch.point[1], keep)?;
        Some((launch, exits))
    };
    let Some((launch, exits)) = rays([0.0; 2]) else { return Vec::new() };
    if !exits.iter().any(&reaches) {
        return Vec::new();
    }
    let beside = [[-APART, 0.0], [APART, 0.0], [0.0, -APART], [0.0, APART]].map(rays);
    let [Some(a), Some(b), Some(c), Some(d)] = beside else { return Vec::new() };
    let beam = |exit: &Exit<f64>| {
        let of_order = |(launch, exits): &(Launch, Vec<Exit<f64>>)| {
            let exit = exits.iter().find(|other| other.order == exit.order)?;
            Some(moved(exit, launch))
        };
        let around = [[of_order(&a)?, of_order(&b)?], [of_order(&c)?, of_order(&d)?]];
        Some((exit.order, Beam::new(exit, &launch, &around, x)?))
    };
    exits.iter().filter(|exit| reaches(exit)).filter_map(beam).collect()
}

/// The half-planes of some azimuths and of their mirror images; none where they are so many that every
/// ray is near one.
struct HalfPlanes(Option<Vec<(f64, f64)>>);

impl HalfPlanes {
    fn new(azimuths: &[f64]) -> Self {
        const MOST: usize = 40;
        let both = |&azimuth: &f64| [azimuth.sin_cos(), (-azimuth).sin_cos()];
        Self((azimuths.len() <= MOST).then(|| azimuths.iter().flat_map(both).collect()))
    }

    /// Whether a direction comes nearer to one than an angle.
    fn near(&self, direction: Vec3<f64>, angle: f64) -> bool {
        let Some(planes) = &self.0 else { return true };
        let Vec3 { x, y, .. } = direction;
        let chord = angle.sin();
        planes.iter().any(|(sin, cos)| {
            let (along, aside) = (x * cos + y * sin, y * cos - x * sin);
            if along > 0.0 { aside.abs() < chord } else { x.hypot(y) < chord }
        })
    }
}

fn sector_of(phi: f64) -> usize {
    ((phi.rem_euclid(TAU) / TAU * SECTORS as f64) as usize).min(SECTORS - 1)
}

/// Hand every sector of azimuth that a beam reaches to `visit`.
fn sectors(beam: &Beam, mut visit: impl FnMut(usize)) {
    let sin = beam.direction.x.hypot(beam.direction.y);
    let theta = sin.atan2(beam.direction.z);
    let centre = beam.direction.y.atan2(beam.direction.x);
    let half = if theta.min(PI - theta) <= beam.reach {
        PI
    } else {
        (beam.reach.sin() / sin).min(1.0).asin()
    };
    let width = TAU / SECTORS as f64;
    let from = ((centre - half) / width).floor() as i64;
    let to = ((centre + half) / width).floor() as i64;
    let to = to.min(from + SECTORS as i64 - 1);
    for sector in from..=to {
        visit(sector.rem_euclid(SECTORS as i64) as usize);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::series::debye::{DebyeSeries, Term};
    use crate::shape::{RaindropModel, Shape};

    #[test]
    fn half_planes_tell_which_rays_come_near() {
        let planes = HalfPlanes::new(&[0.5]);
        let ray = |theta: f64, phi: f64| Direction::new(theta, phi).unit;
        assert!(planes.near(ray(1.0, 0.5), 0.01) && planes.near(ray(1.0, -0.5), 0.01));
        assert!(!planes.near(ray(1.0, 0.5 + PI), 0.1) && !planes.near(ray(1.0, 0.7), 0.1));
        assert!(planes.near(ray(1.0, 0.7), 0.3));
        // about the axis every plane is near
        assert!(planes.near(ray(0.05, 3.0), 0.1));
        assert!(HalfPlanes::new(&[0.0; 41]).near(ray(1.0, 2.0), 0.0));
    }

    #[test]
    fn sectors_cover_the_turn() {
        assert_eq!(
            (sector_of(0.0), sector_of(-1e-9), sector_of(PI)),
            (0, SECTORS - 1, SECTORS / 2)
        );
        assert_eq!(sector_of(-f64::MIN_POSITIVE), SECTORS - 1);
        let shape = Shape::sphere();
        let silhouette = shape.silhouette();
        let tracer = Tracer::new(&shape, 1.333.into(), 3000.0, 1);
        for (place, all) in [([0.5, 0.3], false), ([0.013, 0.011], true)] {
            let beams = beams_at(&tracer, &silhouette, &[1], place, 3000.0, |_| true);
            let [(1, beam)] = &beams[..] else { panic!("one beam") };
            let mut reached = Vec::new();
            sectors(beam, |sector| reached.push(sector));
            let own = sector_of(beam.direction.y.atan2(beam.direction.x));
            assert!(reached.contains(&own));
            assert_eq!(reached.len() == SECTORS, all, "{} sectors", reached.len());
        }
    }

    /// Plain rays of a sphere: the sum is the Debye term to the beams' few percent, and the same whether
    /// all azimuths are asked for or one.
    #[test]
    fn beams_of_a_sphere_add_up_to_its_debye_term() {
        let (x, index) = (2000.0, 1.333.into());
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, index, x, 1);
        let theta: Vec<f64> = (0..30).map(|k| 0.4 + 0.01 * f64::from(k)).collect();
        let exact = DebyeSeries::new(x, index).unwrap().amplitudes(Term::Order(1), &theta);
        let many: Vec<f64> = (0..50).map(|k| 0.12 * f64::from(k)).collect();
        for azimuths in [vec![0.7], many] {
            let beams = GaussianBeams::new(&tracer, &[1], &azimuths, x);
            let mut found = vec![AmplitudeMatrix::default(); theta.len()];
            beams.add(&theta, 0.7, &mut found);
            let (mut off, mut size) = (0.0, 0.0);
            for (f, (s1, s2)) in found.iter().zip(&exact) {
                off += (f.s1 - s1).norm_sqr() + (f.s2 - s2).norm_sqr() + f.s3.norm_sqr();
                size += s1.norm_sqr() + s2.norm_sqr();
            }
            assert!((off / size).sqrt() < 0.02, "{}", (off / size).sqrt());
        }
    }

    /// The vertical plane is a mirror: S3 and S4 change their sign.
    #[test]
    fn the_other_side_is_a_mirror_image() {
        let shape = Shape::raindrop(0.8e-3, RaindropModel::BeardChuang1987, 0.4).unwrap();
        let tracer = Tracer::new(&shape, 1.333.into(), 1000.0, 2);
        let beams = GaussianBeams::new(&tracer, &[2], &[0.6], 1000.0);
        let theta = [2.5, 2.6];
        let at = |phi: f64| {
            let mut found = vec![AmplitudeMatrix::default(); 2];
            beams.add(&theta, phi, &mut found);
            found
        };
        for (a, b) in at(0.6).into_iter().zip(at(-0.6)) {
            let size = a.s11().sqrt();
            assert!(size > 1.0 && a.s3.norm() > 1e-3 * size);
            assert!((a.s1 - b.s1).norm() + (a.s2 - b.s2).norm() < 1e-9 * size);
            assert!((a.s3 + b.s3).norm() + (a.s4 + b.s4).norm() < 1e-9 * size);
        }
    }
}
