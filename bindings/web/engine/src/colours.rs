//! Colours over the scattering angle: one column of a Lee diagram.

use crate::drop::Drop;
use crate::message::{Reply, Request, Trouble};
use crate::scattered::Question;
use gonio::color::{Illuminant, Observer, to_srgb};
use gonio::lee::{Angles, Beats, Diagram, LeeError, PEAK, Request as Lee, diagram, spheres};
use gonio::medium::Medium;
use gonio::plan::Plan;
use gonio::scene::{Method, Orders, Scene};
use gonio::series::layered::Layered;
use gonio::simulate;
use num_complex::Complex64;
use serde::Deserialize;
use serde_json::json;
use std::f64::consts::TAU;

/// A column that is asked for.
#[derive(Clone, Debug, Deserialize)]
pub struct Column {
    /// The drop.
    pub drop: Drop,
    /// From and to.
    pub theta_deg: [f64; 2],
    /// Angles.
    pub points: usize,
    /// Of what is not round.
    pub azimuth_deg: f64,
    /// Averaged over the sun's disc.
    pub sun_disc: bool,
    /// Factor on the numbers of wavelengths and angles, 0.1 and more.
    pub fineness: f64,
    /// One wavelength in place of daylight.
    pub wavelength_nm: Option<f64>,
}

/// Most angles of a column.
const MOST_POINTS: usize = 4000;
/// Largest radius of a sphere in a column: larger ones take minutes here.
const LARGEST_UM: f64 = 2000.0;
/// Orders that make a column of rays, those added as waves together.
const GROUPS: [&[u32]; 4] = [&[0], &[1], &[2], &[3]];
/// The bows alone, when it is to be quick.
const QUICK: [&[u32]; 2] = [&[2], &[3]];
/// Fineness below which the bows alone are taken.
const QUICK_BELOW: f64 = 0.3;
/// Relative errors asked of rays.
const TOLERANCE: f64 = 0.02;
const QUICK_TOLERANCE: f64 = 0.1;
/// Sizes that stand for a spread in light of one wavelength.
const SIZES: usize = 32;
const QUICK_SIZES: usize = 5;

impl Column {
    /// Angles, radians.
    ///
    /// # Errors
    /// Angles that make no sense.
    pub fn theta(&self) -> Result<Vec<f64>, Trouble> {
        let [from, to] = self.theta_deg;
        let sensible = (0.0..=180.0).contains(&from) && (from + 0.01..=180.0).contains(&to);
        if !sensible || !(2..=MOST_POINTS).contains(&self.points) {
            let message = format!("{from} to {to}: accepted are ascending angles from 0 to 180");
            return Err(Trouble::new("theta_deg", message));
        }
        let step = (to - from) / (self.points - 1) as f64;
        Ok((0..self.points).map(|i| (from + step * i as f64).min(180.0).to_radians()).collect())
    }

    /// The diagram of this one radius.
    ///
    /// # Errors
    /// What the library refuses.
    pub fn diagram(&self) -> Result<Diagram, Trouble> {
        let scene = self.drop.scene(550.0)?;
        if self.drop.radius_um > LARGEST_UM && self.drop.is_round() {
            let message = format!(
                "radius {} µm: colours of spheres up to {LARGEST_UM} µm are offered here",
                self.drop.radius_um
            );
            return Err(Trouble::new("radius_um", message));
        }
        if let Some(nm) = self.wavelength_nm {
            return self.of_one_wavelength(nm);
        }
        let trouble = |error: LeeError| Trouble::new("", error.to_string());
        let request = Lee {
            radii: vec![self.drop.radius()],
            theta: self.theta()?,
            medium: scene.medium.clone(),
            sun_disc: self.sun_disc,
            size_spread: self.drop.spread,
            illuminant: Illuminant::D65,
            observer: Observer::Cie1931,
            fineness: self.fineness,
        };
        if self.drop.is_plain_sphere() {
            return spheres(&request).map_err(trouble);
        }
        if self.drop.is_radial() {
            return radial(&request, &scene.medium).map_err(trouble);
        }
        self.rays(&request, &scene).map_err(trouble)
    }

    /// Light of one wavelength, in its colour. Of rays, when it is to be quick, the primary bow alone.
    fn of_one_wavelength(&self, nm: f64) -> Result<Diagram, Trouble> {
        let rays = !self.drop.is_round();
        let quick = self.fineness < QUICK_BELOW;
        let orders = match (rays, quick) {
            (false, _) => Vec::new(),
            (true, true) => vec![2],
            (true, false) => GROUPS.concat(),
        };
        let curves = Question {
            drop: self.drop.clone(),
            wavelength_nm: nm,
            theta_deg: self.theta_deg,
            points: self.points,
            azimuth_deg: self.azimuth_deg,
            orders,
            sun_disc: self.sun_disc,
            sizes: if quick { QUICK_SIZES } else { SIZES },
            tolerance: if quick { QUICK_TOLERANCE } else { TOLERANCE },
            by_rays: rays,
            whole: !rays,
        }
        .seen()?;
        let matching = Observer::Cie1931.matching(nm * 1e-9);
        let cell = |i: usize| -> [[f64; 3]; 2] {
            let parts = if rays { &curves.orders } else { std::slice::from_ref(&curves.whole) };
            let sum = |k: usize| parts.iter().map(|part| part[i][k]).sum::<f64>();
            [0, 1].map(|k| matching.map(|m| m * sum(k)))
        };
        let xyz = vec![(0..self.points).map(cell).collect()];
        Ok(Diagram { radii: vec![self.drop.radius()], theta: self.theta()?, xyz })
    }

    /// Rays: orders add as intensities, since their beats are too fast for colours.
    fn rays(&self, request: &Lee, scene: &Scene) -> Result<Diagram, LeeError> {
        let quick = self.fineness < QUICK_BELOW;
        let groups: &[&[u32]] = if quick { &QUICK } else { &GROUPS };
        let tolerance = if quick { QUICK_TOLERANCE } else { TOLERANCE };
        let azimuth = self.azimuth_deg.to_radians();
        let directions = |angles: &Angles| -> Vec<(f64, f64)> {
            angles.theta.iter().map(|&t| (t, azimuth)).collect()
        };
        diagram(request, Beats::WithinOrders, &directions, |drops, at: &Vec<(f64, f64)>| {
            drops
                .iter()
                .map(|drop| {
                    let mut sum = vec![[0.0; 2]; at.len()];
                    for orders in groups {
                        let scene = Scene {
                            particle: scene.particle_with_radius(drop.radius),
                            wavelengths: vec![drop.wavelength],
                            orders: Orders::List(orders.to_vec()),
                            method: Method::Rays,
                            tolerance,
                            ..scene.clone()
                        };
                        let plan = Plan { checked: false, ..Plan::new(&scene)? };
                        let x = TAU * drop.radius / drop.wavelength;
                        let found =
                            simulate::finite(simulate::scatter(&plan, drop.index, x, at), at)?;
                        for (sum, m) in sum.iter_mut().zip(&found) {
                            sum[0] += 0.5 * (m.s2.norm_sqr() + m.s3.norm_sqr());
                            sum[1] += 0.5 * (m.s1.norm_sqr() + m.s4.norm_sqr());
                        }
                    }
                    Ok::<_, LeeError>(sum)
                })
                .collect()
        })
    }
}

/// Relative error of the amplitudes of a profile.
const PROFILE_ERROR: f64 = 1e-3;

/// Spheres that vary along their radius. Sampling asks for one index: that of the surface stands for all.
fn radial(request: &Lee, medium: &Medium) -> Result<Diagram, LeeError> {
    let surface = medium.body(550e-9, request.radii[0])?.map_or(1.33.into(), |body| body.surface());
    let request = Lee { medium: Medium::Constant(surface), ..request.clone() };
    let angles = |angles: &Angles| angles.theta.clone();
    diagram(&request, Beats::All, &angles, |drops, theta: &Vec<f64>| {
        drops
            .iter()
            .map(|drop| {
                let x = TAU * drop.radius / drop.wavelength;
                let body = medium.body(drop.wavelength, drop.radius)?;
                let pairs: Vec<(Complex64, Complex64)> = match &body {
                    Some(body) => Layered::body(x, body, PROFILE_ERROR)?.amplitudes_parallel(theta),
                    None => Vec::new(),
                };
                Ok(pairs
                    .iter()
                    .map(|(s1, s2)| [0.5 * s2.norm_sqr(), 0.5 * s1.norm_sqr()])
                    .collect())
            })
            .collect::<Result<Vec<_>, LeeError>>()
    })
}

/// The answer: `theta_deg`, and `xyz`, six numbers per angle: XYZ along the scattering plane and across it.
///
/// # Errors
/// What the library refuses, by the control.
pub fn column(request: &Request) -> Result<Reply, Trouble> {
    let asked: Column = request.parsed()?;
    let found = asked.diagram()?;
    let xyz = found.xyz.iter().flatten().flatten().flatten().copied().collect();
    let method = match () {
        () if asked.drop.is_plain_sphere() => "Lorenz–Mie series",
        () if asked.drop.is_radial() => "exact series of layers",
        () => "rays with phase, orders added as intensities",
    };
    Ok(Reply::new(json!({ "method": method }))
        .with("theta_deg", found.theta_deg())
        .with("xyz", xyz))
}

#[derive(Deserialize)]
struct Painting {
    polarisation: String,
    /// Stops above what gives the brightest angle the luminance of pictures.
    stops: f64,
}

/// Numbers of `xyz` per angle.
pub const PER_ANGLE: usize = 6;

/// XYZ seen with or without a filter.
pub fn seen(six: &[f64], polarisation: &str) -> Result<[f64; 3], Trouble> {
    match polarisation {
        "total" => Ok(std::array::from_fn(|c| six[c] + six[3 + c])),
        "parallel" => Ok(std::array::from_fn(|c| six[c])),
        "perpendicular" => Ok(std::array::from_fn(|c| six[3 + c])),
        other => {
            let accepted = "accepted: total, parallel, perpendicular";
            Err(Trouble::new("polarisation", format!("\"{other}\" is not known; {accepted}")))
        }
    }
}

/// The numbers of a request, `xyz` of one column, as sRGB: `rgb`, three bytes per angle.
///
/// # Errors
/// A polarisation that is none.
pub fn paint(request: &Request) -> Result<Reply, Trouble> {
    let asked: Painting = request.parsed()?;
    let xyz: Vec<[f64; 3]> = (request.numbers.chunks_exact(PER_ANGLE))
        .map(|six| seen(six, &asked.polarisation))
        .collect::<Result<_, _>>()?;
    let brightest = xyz.iter().fold(0.0_f64, |most, xyz| most.max(xyz[1]));
    let exposure = if brightest > 0.0 { PEAK / brightest * asked.stops.exp2() } else { 0.0 };
    let rgb = xyz.into_iter().flat_map(|xyz| to_srgb(xyz, exposure)).collect();
    Ok(Reply::new(json!({ "exposure": exposure })).with_bytes("rgb", rgb))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drop::tests::drop;

    fn asked(shape: &str, radius_um: f64) -> Column {
        Column {
            drop: drop(shape, radius_um),
            theta_deg: [132.0, 148.0],
            points: 65,
            azimuth_deg: 90.0,
            sun_disc: true,
            fineness: 0.3,
            wavelength_nm: None,
        }
    }

    fn bow(column: &Column) -> f64 {
        let found = column.diagram().unwrap();
        let y = |i: usize| found.xyz[0][i][0][1] + found.xyz[0][i][1][1];
        let best = (0..column.points).max_by(|a, b| y(*a).total_cmp(&y(*b))).unwrap();
        found.theta_deg()[best]
    }

    /// Layers of one medium have the bow of a sphere of it; a round spheroid by rays has it nearly.
    #[test]
    fn bows_agree() {
        let mut plain = asked("sphere", 60.0);
        plain.drop.medium = "1.333".into();
        let mut layers = asked("layered", 60.0);
        (layers.drop.medium, layers.drop.core_medium) = ("1.333".into(), "1.333".into());
        let mut rays = asked("spheroid", 60.0);
        (rays.drop.medium, rays.drop.axis_ratio) = ("1.333".into(), 0.999);
        assert!((bow(&plain) - bow(&layers)).abs() < 1e-9);
        // colours of rays take long here: one wavelength says as much
        let one = |column: &Column| bow(&Column { wavelength_nm: Some(550.0), ..column.clone() });
        assert!((one(&plain) - one(&rays)).abs() < 0.6, "{} {}", one(&plain), one(&rays));
    }
}
