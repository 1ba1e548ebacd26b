//! Scattered light over the scattering angle, the whole and by orders.
//!
//! Intensities are the differential cross-section over the geometrical one, sr⁻¹, polarised along and across
//! the scattering plane, for unpolarised light: `½(|S2|²+|S3|²)/(π x²)` and `½(|S1|²+|S4|²)/(π x²)`.

use crate::drop::Drop;
use crate::message::{Reply, Request, Trouble};
use gonio::color::SUN_ANGULAR_RADIUS;
use gonio::optics::{AmplitudeMatrix, rainbow_angle};
use gonio::plan::Plan;
use gonio::scene::{Orders, Scene};
use gonio::series::angular::{AngleSet, amplitudes, amplitudes_together};
use gonio::series::debye::{DebyeSeries, Term};
use gonio::series::layered::Layered;
use gonio::series::lorenz_mie::Sphere;
use gonio::simulate;
use gonio::size_distribution::log_normal_sample;
use gonio::sun_disc::smooth_over_sun;
use num_complex::Complex64;
use serde::Deserialize;
use serde_json::json;
use std::f64::consts::{PI, TAU};

#[derive(Deserialize)]
pub(crate) struct Question {
    pub drop: Drop,
    pub wavelength_nm: f64,
    pub theta_deg: [f64; 2],
    pub points: usize,
    pub azimuth_deg: f64,
    /// Orders shown one by one, and whether diffraction's half is among what is added.
    pub orders: Vec<u32>,
    pub sun_disc: bool,
    /// Sizes that stand for the spread.
    pub sizes: usize,
    /// Relative error asked of rays.
    pub tolerance: f64,
    /// Take rays although there is an exact series.
    pub by_rays: bool,
    /// Whether the whole is wanted, of rays: it takes longer than single orders.
    pub whole: bool,
}

/// Most angles of an answer, and of what the sun's disc averages; most sizes.
const MOST_POINTS: usize = 20_000;
const MOST_SAMPLES: usize = 60_000;
const MOST_SIZES: usize = 200;
/// Largest size parameter that a page should spend its time on.
const LARGEST: f64 = 1e5;
/// Angles per period of the fastest beat, which goes as 2x.
const PER_BEAT: f64 = 2.5;
/// Angles per radius of the sun's disc that make a smooth curve.
const PER_RADIUS: f64 = 20.0;
/// Relative error of the amplitudes of a profile.
pub(crate) const PROFILE_ERROR: f64 = 1e-5;

/// A curve of both polarisations.
pub(crate) type Curve = Vec<[f64; 2]>;

/// The answer: `theta_deg`, `whole`, `added` and `order p`, pairs (along, across) each.
///
/// # Errors
/// What the library refuses, by the control.
pub fn scattered(request: &Request) -> Result<Reply, Trouble> {
    let asked: Question = request.parsed()?;
    let seen = asked.seen()?;
    let index = asked.drop.medium()?.index(1e-9 * asked.wavelength_nm).ok().map(|index| index.re);
    let bows: Vec<_> = (2..=7)
        .filter_map(|order| Some((order, rainbow_angle(index?, order)?.to_degrees())))
        .collect();
    let header = json!({
        "method": seen.method, "size_parameter": asked.size_parameter(), "sizes": asked.sizes(),
        "index": index, "rainbows": bows, "orders": asked.orders,
    });
    let flat = |curve: Curve| curve.into_iter().flatten().collect();
    let theta = grid(asked.theta_deg, asked.points).iter().map(|t| t.to_degrees()).collect();
    let mut reply = Reply::new(header).with("theta_deg", theta);
    for (name, curve) in [("whole", seen.whole), ("added", seen.added)] {
        if !curve.is_empty() {
            reply = reply.with(name, flat(curve));
        }
    }
    for (order, curve) in asked.orders.iter().zip(seen.orders) {
        reply = reply.with(&format!("order {order}"), flat(curve));
    }
    Ok(reply)
}

/// Evenly from one angle to another, radians.
fn grid([from, to]: [f64; 2], points: usize) -> Vec<f64> {
    (0..points)
        .map(|i| {
            (from + (to - from) * i as f64 / (points - 1) as f64).clamp(0.0, 180.0).to_radians()
        })
        .collect()
}

impl Question {
    fn size_parameter(&self) -> f64 {
        TAU * self.drop.radius() / (self.wavelength_nm * 1e-9)
    }

    fn sizes(&self) -> usize {
        if self.drop.spread > 0.0 { self.sizes.max(1) } else { 1 }
    }

    /// The curves, averaged over sizes and the sun's disc.
    pub fn seen(&self) -> Result<Curves, Trouble> {
        self.check()?;
        let scene = self.drop.scene(self.wavelength_nm)?;
        let wavelength = self.wavelength_nm * 1e-9;
        let out = grid(self.theta_deg, self.points);
        let x = self.size_parameter();
        let samples = self.samples(&out, x);
        let mut sums = Curves::default();
        for i in 0..self.sizes() {
            let radius = log_normal_sample(self.drop.radius(), self.drop.spread, i);
            let drop = Drop { radius_um: 1e6 * radius, ..self.drop.clone() };
            // sizes count by their own cross-sections, over that of the nominal one
            let scale = 1.0 / (PI * x * x * self.sizes() as f64);
            sums.add(&self.one(&drop, &scene, wavelength, &samples)?, scale);
        }
        if self.sun_disc {
            let seen = |curve: &Curve| -> Curve {
                if curve.is_empty() {
                    return Curve::new();
                }
                let part = |k: usize| {
                    let values: Vec<f64> = curve.iter().map(|v| v[k]).collect();
                    smooth_over_sun(&samples, &values, wavelength, SUN_ANGULAR_RADIUS, &out)
                };
                part(0).into_iter().zip(part(1)).map(|(a, b)| [a, b]).collect()
            };
            sums.whole = seen(&sums.whole);
            sums.added = seen(&sums.added);
            sums.orders = sums.orders.iter().map(seen).collect();
        }
        Ok(sums)
    }

    fn check(&self) -> Result<(), Trouble> {
        let [from, to] = self.theta_deg;
        if !(0.0..=180.0).contains(&from) || !(from + 0.01..=180.0).contains(&to) {
            let message = format!("{from} to {to}: accepted are ascending angles from 0 to 180");
            return Err(Trouble::new("theta_deg", message));
        }
        if !(2..=MOST_POINTS).contains(&self.points) || self.sizes > MOST_SIZES {
            return Err(Trouble::new("points", format!("{}: too many", self.points)));
        }
        if self.orders.len() > 12 || self.orders.iter().any(|p| *p > 20) {
            return Err(Trouble::new("orders", "at most 12 orders, none above 20".into()));
        }
        if !(1e-4..=0.5).contains(&self.tolerance) {
            return Err(Trouble::new(
                "tolerance",
                format!("{}: accepted are 1e-4 to 0.5", self.tolerance),
            ));
        }
        if !self.azimuth_deg.is_finite() {
            return Err(Trouble::new("azimuth_deg", "accepted are -360 to 360".into()));
        }
        let x = TAU * self.drop.radius() / (self.wavelength_nm * 1e-9);
        if x > LARGEST && self.drop.is_round() {
            let message = format!("size parameter {x:.0}: the page stops at {LARGEST:.0}");
            return Err(Trouble::new("radius_um", message));
        }
        Ok(())
    }

    /// Angles that are computed: those asked for, or what the disc averages over.
    fn samples(&self, out: &[f64], x: f64) -> Vec<f64> {
        if !self.sun_disc {
            return out.to_vec();
        }
        let margin = SUN_ANGULAR_RADIUS.to_degrees() + 0.01;
        let from = (self.theta_deg[0] - margin).max(0.0);
        let to = (self.theta_deg[1] + margin).min(180.0);
        // rays are interpolated between waves and are slow per angle: beats of one order alone
        let beats = if self.drop.is_round() { 2.0 } else { 0.8 };
        let needed = (to - from).to_radians() * beats * x * PER_BEAT / TAU;
        // more than the disc asks for would cost much close to the axis, where each is weighed along an arc
        let smooth = (to - from).to_radians() / SUN_ANGULAR_RADIUS * PER_RADIUS;
        let least = self.points.min(smooth as usize).max(2);
        grid([from, to], (needed as usize).clamp(least, MOST_SAMPLES.min(6 * self.points)))
    }

    /// One size.
    fn one(
        &self,
        drop: &Drop,
        scene: &Scene,
        wavelength: f64,
        theta: &[f64],
    ) -> Result<Curves, Trouble> {
        let x = TAU * drop.radius() / wavelength;
        if drop.is_radial() {
            let body = scene.medium.body(wavelength, drop.radius()).map_err(|e| Trouble::of(&e))?;
            let body = body.ok_or_else(|| Trouble::new("medium", "no profile".into()))?;
            let sphere = Layered::body(x, &body, PROFILE_ERROR).map_err(|e| Trouble::of(&e))?;
            let pairs = sphere.amplitudes_parallel(theta);
            let whole = pairs.iter().map(|(s1, s2)| [0.5 * s2.norm_sqr(), 0.5 * s1.norm_sqr()]);
            let whole = whole.collect();
            return Ok(Curves { whole, method: "exact series of layers", ..Curves::default() });
        }
        if drop.is_plain_sphere() && !self.by_rays {
            let index = scene.medium.index(wavelength).map_err(|error| Trouble::of(&error))?;
            return self.sphere(x, index, theta);
        }
        self.rays(drop, x, theta)
    }

    fn sphere(&self, x: f64, index: Complex64, theta: &[f64]) -> Result<Curves, Trouble> {
        let whole = Sphere::new(x, index).map_err(|error| Trouble::of(&error))?;
        let mut waves = vec![(whole.a().to_vec(), whole.b().to_vec())];
        if !self.orders.is_empty() {
            let series = DebyeSeries::new(x, index).map_err(|error| Trouble::of(&error))?;
            waves.extend(self.orders.iter().map(|p| series.coefficients(&[Term::Order(*p)])));
        }
        let mut each = summed(&waves, theta);
        let pairs = |pairs: Vec<(Complex64, Complex64)>| -> Curve {
            pairs.into_iter().map(|(s1, s2)| [0.5 * s2.norm_sqr(), 0.5 * s1.norm_sqr()]).collect()
        };
        let mut curves = Curves {
            whole: pairs(each.remove(0)),
            method: "Lorenz–Mie series",
            ..Curves::default()
        };
        if !each.is_empty() {
            let add = |i: usize| {
                each.iter().fold((Complex64::default(), Complex64::default()), |s, e| {
                    (s.0 + e[i].0, s.1 + e[i].1)
                })
            };
            curves.added = pairs((0..theta.len()).map(add).collect());
            curves.orders = each.into_iter().map(pairs).collect();
        }
        Ok(curves)
    }

    fn rays(&self, drop: &Drop, x: f64, theta: &[f64]) -> Result<Curves, Trouble> {
        let scene = Scene {
            tolerance: self.tolerance,
            method: gonio::scene::Method::Rays,
            ..drop.scene(self.wavelength_nm)?
        };
        let azimuth = self.azimuth_deg.to_radians();
        let directions: Vec<(f64, f64)> = theta.iter().map(|&t| (t, azimuth)).collect();
        let of = |orders: Orders| -> Result<Vec<AmplitudeMatrix>, Trouble> {
            let scene = Scene { orders, ..scene.clone() };
            let plan =
                Plan { checked: false, ..Plan::new(&scene).map_err(|error| Trouble::of(&error))? };
            let light = scene
                .medium
                .light(self.wavelength_nm * 1e-9)
                .map_err(|error| Trouble::of(&error))?;
            let found = simulate::scatter(&plan, light.index, x, &directions);
            simulate::finite(found, &directions).map_err(|error| Trouble::of(&error))
        };
        let each: Vec<Vec<AmplitudeMatrix>> =
            self.orders.iter().map(|p| of(Orders::List(vec![*p]))).collect::<Result<_, _>>()?;
        let mut curves = Curves {
            whole: if self.whole { intensities(&of(Orders::Auto)?) } else { Vec::new() },
            method: "rays with phase",
            ..Curves::default()
        };
        if !each.is_empty() {
            let add = |i: usize| each.iter().fold(AmplitudeMatrix::default(), |sum, e| sum + e[i]);
            let added: Vec<AmplitudeMatrix> = (0..theta.len()).map(add).collect();
            curves.added = intensities(&added);
            curves.orders = each.iter().map(|order| intensities(order)).collect();
        }
        Ok(curves)
    }
}

/// (S1, S2) of partial waves a_n, b_n; two by two, since they share the functions of the angle.
fn summed(
    waves: &[(Vec<Complex64>, Vec<Complex64>)],
    theta: &[f64],
) -> Vec<Vec<(Complex64, Complex64)>> {
    let set = AngleSet::new(theta);
    let sums = waves.chunks(2).flat_map(|some| match some {
        [p, q] => amplitudes_together([(&p.0[..], &p.1[..]), (&q.0, &q.1)], &set).to_vec(),
        _ => some.iter().map(|(a, b)| amplitudes(a, b, &set)).collect(),
    });
    sums.collect()
}

fn intensities(amplitudes: &[AmplitudeMatrix]) -> Curve {
    let one = |m: &AmplitudeMatrix| {
        [0.5 * (m.s2.norm_sqr() + m.s3.norm_sqr()), 0.5 * (m.s1.norm_sqr() + m.s4.norm_sqr())]
    };
    amplitudes.iter().map(one).collect()
}

/// The whole, what is ticked added as waves, and each order.
#[derive(Default)]
pub(crate) struct Curves {
    pub whole: Curve,
    pub added: Curve,
    pub orders: Vec<Curve>,
    pub method: &'static str,
}

impl Curves {
    fn add(&mut self, other: &Curves, scale: f64) {
        let add = |into: &mut Curve, from: &Curve| {
            into.resize(from.len(), [0.0; 2]);
            into.iter_mut().zip(from).for_each(|(a, b)| (0..2).for_each(|k| a[k] += scale * b[k]));
        };
        add(&mut self.whole, &other.whole);
        add(&mut self.added, &other.added);
        self.orders.resize(other.orders.len(), Vec::new());
        self.orders.iter_mut().zip(&other.orders).for_each(|(a, b)| add(a, b));
        self.method = other.method;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drop::tests::drop;

    fn asked(shape: &str, radius_um: f64) -> Question {
        Question {
            drop: drop(shape, radius_um),
            wavelength_nm: 589.0,
            theta_deg: [120.0, 160.0],
            points: 401,
            azimuth_deg: 180.0,
            orders: vec![2],
            sun_disc: false,
            sizes: 1,
            tolerance: 0.01,
            by_rays: false,
            whole: true,
        }
    }

    fn curves(asked: &Question) -> Curves {
        let scene = asked.drop.scene(asked.wavelength_nm).unwrap();
        let theta = grid(asked.theta_deg, asked.points);
        asked.one(&asked.drop, &scene, asked.wavelength_nm * 1e-9, &theta).unwrap()
    }

    /// Rays of order 2 are Debye's term of order 2 at the bow.
    #[test]
    fn rays_are_debye_terms() {
        let exact = curves(&asked("sphere", 100.0));
        let rays = curves(&Question { by_rays: true, ..asked("sphere", 100.0) });
        let largest = exact.orders[0].iter().map(|v| v[1]).fold(0.0, f64::max);
        let off = exact.orders[0]
            .iter()
            .zip(&rays.orders[0])
            .map(|(a, b)| (a[1] - b[1]).abs())
            .fold(0.0, f64::max);
        assert!(off < 0.03 * largest, "{off} of {largest}");
    }

    /// Layers of one medium are a sphere of it.
    #[test]
    fn equal_layers_are_a_sphere() {
        let mut same = asked("layered", 10.0);
        (same.drop.core_medium, same.drop.medium) = ("1.33".into(), "1.33".into());
        let mut plain = asked("sphere", 10.0);
        plain.drop.medium = "1.33".into();
        for (a, b) in curves(&same).whole.iter().zip(&curves(&plain).whole) {
            assert!((a[1] - b[1]).abs() < 1e-8 * b[1], "{a:?} {b:?}");
        }
    }

    /// What makes no sense is refused by its name.
    #[test]
    fn nonsense_is_refused() {
        for (bad, field) in [
            (Question { theta_deg: [f64::NAN, 3.0], ..asked("sphere", 5.0) }, "theta_deg"),
            (Question { theta_deg: [90.0, 20.0], ..asked("sphere", 5.0) }, "theta_deg"),
            (Question { points: 1 << 30, ..asked("sphere", 5.0) }, "points"),
            (Question { orders: vec![99], ..asked("sphere", 5.0) }, "orders"),
            (asked("sphere", 5e5), "radius_um"),
        ] {
            assert_eq!(bad.check().unwrap_err().field, field);
        }
    }
}
