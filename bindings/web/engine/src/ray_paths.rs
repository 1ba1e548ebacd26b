//! Rays through a drop in its vertical plane, with the caustics of those that leave.

use crate::drop::Drop;
use crate::message::{Reply, Request, Trouble};
use gonio::color::wavelength_srgb;
use gonio::medium::radial::Body;
use gonio::plan::Plan;
use gonio::scene::Scene;
use gonio::shape::Shape;
use gonio::trace::{Chord, RadialRays, SymmetryPlane, Tracer};
use serde::Deserialize;
use serde_json::json;
use std::f64::consts::TAU;

#[derive(Deserialize)]
struct Question {
    drop: Drop,
    wavelengths_nm: Vec<f64>,
    orders: Vec<u32>,
    /// Impacts of single rays, in units of the radius, positive above the middle.
    impacts: Vec<f64>,
    /// Rays of a fan, from which the caustics are.
    fan: usize,
    /// Whether the rainbows are looked for: that takes longer than all else.
    rainbows: bool,
}

/// One ray: where it meets the surface, and its direction behind; upper side x, along z.
struct Path {
    impact: f64,
    points: Vec<[f64; 2]>,
    leaves: [f64; 2],
    deviation: f64,
    /// Where neighbouring rays of the plane cross it, if they do: before or behind the surface.
    focus: Option<[f64; 2]>,
}

impl Path {
    /// The focus, and 1 where light comes through it, 0 where it only seems to come from there.
    fn caustic(&self) -> [f64; 3] {
        let (Some([x, z]), Some(last)) = (self.focus, self.points.last()) else {
            return [f64::NAN; 3];
        };
        let ahead = (x - last[0]) * self.leaves[0] + (z - last[1]) * self.leaves[1];
        [x, z, if ahead > 0.0 { 1.0 } else { 0.0 }]
    }
}

/// Most rays, orders and wavelengths of one answer.
const MOST: usize = 2000;
/// Points of the outline.
const OUTLINE: usize = 181;
/// The outermost rays miss the rim by this share.
const RIM: f64 = 1e-6;

/// The answer: `paths` lists for each ray order, wavelength, impact, deviation and the number of its points;
/// `points` has them, the last being a direction. `caustics` likewise.
///
/// # Errors
/// A drop that is none, or too much asked for.
pub fn rays(request: &Request) -> Result<Reply, Trouble> {
    let asked: Question = request.parsed()?;
    let count = asked.orders.len() * asked.wavelengths_nm.len() * (asked.impacts.len() + asked.fan);
    if count > MOST * 10 || asked.fan > MOST || asked.orders.iter().any(|p| *p > 20) {
        return Err(Trouble::new("orders", "too many rays: at most 20 orders".into()));
    }
    let (mut paths, mut caustics, mut bows) = (Vec::new(), Vec::new(), Vec::new());
    let (mut points, mut foci, mut turned) = (Vec::new(), Vec::new(), Vec::new());
    let mut outline = Vec::new();
    for &nm in &asked.wavelengths_nm {
        let scene = asked.drop.scene(nm)?;
        let plane = Plane::new(&asked.drop, &scene, nm)?;
        if outline.is_empty() {
            outline = plane.outline();
        }
        let colour = wavelength_srgb(nm * 1e-9);
        for &order in &asked.orders {
            for &impact in &asked.impacts {
                let Some(path) = plane.path(impact, order) else { continue };
                let (deg, end) = (path.deviation.to_degrees(), path.leaves);
                paths.push(json!([order, nm, path.impact, deg, path.points.len(), colour]));
                points.extend(path.points.iter().flatten());
                points.extend(end);
            }
            let fan = plane.fan(asked.fan, order);
            let focused: Vec<[f64; 3]> = fan.iter().map(Path::caustic).collect();
            caustics.push(json!([order, nm, focused.len(), colour]));
            foci.extend(focused.iter().flatten());
            turned.extend(fan.iter().flat_map(|path| [path.impact, path.deviation.to_degrees()]));
            if !asked.rainbows {
                continue;
            }
            bows.extend(plane.rainbows(order).into_iter().map(|(impact, deviation)| {
                json!({ "order": order, "nm": nm, "impact": impact, "deg": deviation.to_degrees() })
            }));
        }
    }
    let header = json!({ "paths": paths, "caustics": caustics, "rainbows": bows });
    Ok(Reply::new(header)
        .with("points", points)
        .with("foci", foci)
        .with("deviations", turned)
        .with("outline", outline.into_iter().flatten().collect()))
}

/// The vertical plane of a drop of either kind.
enum Plane {
    Uniform { shape: Box<Shape>, index: num_complex::Complex64, size_parameter: f64 },
    Radial(Box<Body>),
}

impl Plane {
    fn new(drop: &Drop, scene: &Scene, nm: f64) -> Result<Self, Trouble> {
        let radius = drop.radius();
        if drop.is_radial() {
            let body = scene.medium.body(nm * 1e-9, radius).map_err(|error| Trouble::of(&error))?;
            let body = body.ok_or_else(|| Trouble::new("medium", "no profile".into()))?;
            return Ok(Self::Radial(Box::new(body)));
        }
        let plan = Plan::new(scene).map_err(|error| Trouble::of(&error))?;
        let light = scene.medium.light(nm * 1e-9).map_err(|error| Trouble::of(&error))?;
        let size_parameter = TAU * plan.radius / light.wavelength;
        Ok(Self::Uniform { shape: Box::new(plan.shape), index: light.index, size_parameter })
    }

    fn outline(&self) -> Vec<[f64; 2]> {
        (0..OUTLINE)
            .map(|i| {
                let (sin, cos) = (i as f64 * TAU / (OUTLINE - 1) as f64).sin_cos();
                let radius = match self {
                    Self::Uniform { shape, .. } => shape.radius_towards(sin, 0.0, cos),
                    Self::Radial(_) => 1.0,
                };
                [radius * sin, radius * cos]
            })
            .collect()
    }

    /// The silhouette's lower and upper edge.
    fn rims(&self) -> [f64; 2] {
        match self {
            Self::Uniform { shape, .. } => {
                let rim = |azimuth: f64| shape.silhouette().radius(azimuth);
                [-rim(std::f64::consts::PI), rim(0.0)]
            }
            Self::Radial(_) => [-1.0, 1.0],
        }
    }

    fn fan(&self, count: usize, order: u32) -> Vec<Path> {
        let [lower, upper] = self.rims();
        let last = count.saturating_sub(1).max(1) as f64;
        let impact = |i: usize| (1.0 - RIM) * (lower + i as f64 / last * (upper - lower));
        let mut fan: Vec<Path> = (0..count).filter_map(|i| self.path(impact(i), order)).collect();
        if matches!(self, Self::Radial(_)) {
            by_neighbours(&mut fan);
        }
        fan
    }

    fn path(&self, impact: f64, order: u32) -> Option<Path> {
        match self {
            Self::Uniform { shape, index, size_parameter } => {
                let tracer = Tracer::new(shape, *index, *size_parameter, order);
                let ray = SymmetryPlane::new(shape, &tracer, order).ray(impact)?;
                let exit = &ray.exit;
                let (s, ds, dx) = (exit.direction, exit.ds[0], exit.dx[0]);
                // neighbours cross where their distance across the ray, dx + t ds, vanishes
                let across = |x: f64, z: f64| x * s.z - z * s.x;
                let (apart, turn) = (across(dx.x, dx.z), across(ds.x, ds.z));
                let t = -apart / turn;
                let focus = t
                    .is_finite()
                    .then_some([exit.reference.x + t * s.x, exit.reference.z + t * s.z]);
                let deviation = exit.scattering_angle();
                Some(Path { impact, points: ray.points, leaves: [s.x, s.z], deviation, focus })
            }
            Self::Radial(body) => {
                let rays = RadialRays::new(body);
                let side = if impact < 0.0 { -1.0 } else { 1.0 };
                let b = impact.abs();
                if order > 0 && !matches!(rays.chord(b), Chord::Through { .. }) || b > 1.0 {
                    return None;
                }
                let points: Vec<[f64; 2]> =
                    rays.path(b, order).into_iter().map(|[x, z]| [side * x, z]).collect();
                // from the direction of the light, towards the axis and beyond
                let turned = rays.deflection(b, order)?;
                let (sin, cos) = turned.sin_cos();
                let leaves = [-side * sin, cos];
                let deviation = cos.clamp(-1.0, 1.0).acos();
                Some(Path { impact, points, leaves, deviation, focus: None })
            }
        }
    }

    fn rainbows(&self, order: u32) -> Vec<(f64, f64)> {
        let found = match self {
            Self::Uniform { shape, index, size_parameter } => {
                let tracer = Tracer::new(shape, *index, *size_parameter, order);
                // the outside reflection turns steadily, transmission of a convex drop too
                if order < 2 {
                    Vec::new()
                } else {
                    SymmetryPlane::new(shape, &tracer, order).rainbows()
                }
            }
            Self::Radial(body) => RadialRays::new(body).rainbows(order),
        };
        found.into_iter().map(|bow| (bow.impact, bow.deviation)).collect()
    }
}

/// Foci of rays from their neighbours in a fan, where there are no derivatives.
fn by_neighbours(fan: &mut [Path]) {
    let found: Vec<Option<[f64; 2]>> = (0..fan.len())
        .map(|i| {
            let (a, b) = (fan.get(i.wrapping_sub(1))?, fan.get(i + 1)?);
            let (p, q) = (a.points.last()?, b.points.last()?);
            let cross = a.leaves[0] * b.leaves[1] - a.leaves[1] * b.leaves[0];
            let (dx, dz) = (q[0] - p[0], q[1] - p[1]);
            let t = (dx * b.leaves[1] - dz * b.leaves[0]) / cross;
            t.is_finite().then(|| [p[0] + t * a.leaves[0], p[1] + t * a.leaves[1]])
        })
        .collect();
    fan.iter_mut().zip(found).for_each(|(path, focus)| path.focus = focus);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drop::tests::drop;

    fn plane(shape: &str, change: impl Fn(&mut Drop)) -> Plane {
        let mut drop = drop(shape, 500.0);
        change(&mut drop);
        let scene = drop.scene(589.0).unwrap();
        Plane::new(&drop, &scene, 589.0).unwrap()
    }

    /// A sphere whose index does not change is a sphere, by both kinds of rays: paths, directions, foci.
    #[test]
    fn a_gradient_without_a_gradient_is_a_sphere() {
        let plain = plane("sphere", |drop| drop.medium = "1.33".into());
        let radial =
            plane("gradient", |drop| (drop.centre_index, drop.surface_index) = (1.33, 1.33));
        for order in 0..4 {
            for impact in [-0.86, -0.3, 0.2, 0.6, 0.95] {
                let (a, b) =
                    (plain.path(impact, order).unwrap(), radial.path(impact, order).unwrap());
                let (last, end) = (a.points.last().unwrap(), b.points.last().unwrap());
                let off = (last[0] - end[0]).abs() + (last[1] - end[1]).abs();
                assert!(off < 1e-8, "{order} {impact}: {last:?} {end:?}");
                let turned = (a.leaves[0] - b.leaves[0]).abs() + (a.leaves[1] - b.leaves[1]).abs();
                assert!(turned < 1e-8, "{order} {impact}: {:?} {:?}", a.leaves, b.leaves);
            }
            let (fan, other) = (plain.fan(2001, order), radial.fan(2001, order));
            let (a, b) = (fan[1300].focus.unwrap(), other[1300].focus.unwrap());
            assert!(
                (a[0] - b[0]).abs() + (a[1] - b[1]).abs() < 1e-3 * a[0].hypot(a[1]),
                "{order}: {a:?} {b:?}"
            );
        }
    }

    /// Parallel rays near the axis meet at the focus of a ball lens, n/(2(n-1)) from its middle.
    #[test]
    fn the_caustic_begins_at_the_ball_lens_focus() {
        let ball = plane("sphere", |drop| drop.medium = "1.5".into());
        let focus = ball.path(1e-4, 1).unwrap().focus.unwrap();
        assert!((focus[1] - 1.5).abs() < 1e-6 && focus[0].abs() < 1e-6, "{focus:?}");
    }
}
