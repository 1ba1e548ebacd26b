//! Real rays along a line of launch points ([`super::radial_line`]), turned back so that what is known of
//! them is analytic through grazing incidence.

use crate::math::vec3::Vec3;
use crate::optics::Grazing;
use crate::shape::Silhouette;
use crate::trace::{Exit, Meeting, Tracer};
use num_complex::Complex64;
use std::f64::consts::FRAC_PI_2;

/// What a wave needs of a ray, each less what it is on a sphere.
pub(crate) struct RadialRay {
    /// Impact, a ratio.
    pub impact: f64,
    pub path: f64,
    /// Path inside.
    pub inside: f64,
    pub direction: [f64; 3],
    /// Direction of the impact.
    pub aside: [f64; 3],
    /// Density of rays, real and imaginary part.
    pub density: [f64; 2],
    /// For each meeting the vector of incidence, and the curvature along the ray times the square of the sine
    /// outside.
    pub meetings: Vec<[f64; 3]>,
    /// Normal of the ray's plane, in the frame that follows the ray.
    pub normal: [f64; 2],
}

/// Real rays along a line.
pub(crate) struct Way<'a> {
    tracer: &'a Tracer<'a>,
    order: u32,
    centre: [f64; 2],
    azimuth: f64,
    /// From the centre to the rim, and its derivative by azimuth.
    reach: [f64; 2],
    by_azimuth: [f64; 2],
}

/// Derivatives along the line and across it (by azimuth) of an exit ray, in its own frame.
pub(crate) struct Rates {
    /// Of the impact.
    pub impact: [f64; 2],
    /// Of the direction, along the impact and across.
    along: [f64; 2],
    across: [f64; 2],
    /// Of the impact's own direction, across.
    turn: [f64; 2],
}

impl<'a> Way<'a> {
    pub(crate) fn new(
        tracer: &'a Tracer<'a>,
        silhouette: &Silhouette,
        order: u32,
        centre: [f64; 2],
        azimuth: f64,
    ) -> Self {
        let (rim, slope) = silhouette.radius_and_slope(azimuth);
        let (sin, cos) = azimuth.sin_cos();
        let reach = [rim * cos - centre[0], rim * sin - centre[1]];
        let by_azimuth = [slope * cos - rim * sin, slope * sin + rim * cos];
        Self { tracer, order, centre, azimuth, reach, by_azimuth }
    }

    fn place(&self, s: f64) -> [f64; 2] {
        [0, 1].map(|k| self.centre[k] + s * self.reach[k])
    }

    pub(crate) fn exit(&self, s: f64) -> Option<Exit<f64>> {
        let [u, v] = self.place(s);
        self.tracer.trace_order(u, v, self.order)
    }

    /// Launch coordinate of the last ray that leaves.
    pub(crate) fn last_real(&self) -> Option<f64> {
        const STEPS: usize = 200;
        const SHORTEST: f64 = 0.5;
        const END: f64 = 1.0 - 1e-6;
        let leaves = |s: f64| self.exit(s).is_some();
        if leaves(END) {
            return Some(END);
        }
        let missing =
            (1..STEPS).map(|k| END * (1.0 - k as f64 / STEPS as f64)).find(|s| leaves(*s))?;
        (missing > SHORTEST).then_some(missing)
    }

    /// How far a ray is turned towards its impact on a sphere, but for a constant. Turned back, all is
    /// analytic through grazing incidence, and constant on a sphere.
    fn turned(&self, meetings: &[Meeting], tau: f64) -> Option<f64> {
        let s = self.tracer.index().re * tau.sin();
        let sine = (1.0 - s * s).sqrt();
        let grazing = |meeting: &Meeting| {
            let sin = meeting.cos_squared_outside.max(0.0).sqrt().min(1.0);
            s.acos() + angle_series(sin) - angle_series(sine)
        };
        let outside = grazing(meetings.first()?) + grazing(meetings.last()?);
        Some(outside + 2.0 * f64::from(self.order) * tau)
    }

    pub(crate) fn rates(&self, exit: &Exit<f64>, s: f64) -> Rates {
        let size = exit.reference.dot(exit.reference).sqrt();
        let aside = exit.reference * size.recip();
        let normal = exit.direction.cross(aside);
        let by = |d: &[Vec3<f64>; 2], axis: Vec3<f64>| {
            let along = (d[0] * self.reach[0] + d[1] * self.reach[1]).dot(axis);
            let across = (d[0] * self.by_azimuth[0] + d[1] * self.by_azimuth[1]).dot(axis);
            [along, s * across]
        };
        Rates {
            impact: by(&exit.dx, aside),
            along: by(&exit.ds, aside),
            across: by(&exit.ds, normal),
            turn: by(&exit.dx, normal).map(|rate| rate / size),
        }
    }

    /// `det |impact| Z / (∂impact/∂s)` and what it is made of.
    fn density(&self, exit: &Exit<f64>, s: f64) -> (Complex64, Rates) {
        let rates = self.rates(exit, s);
        let area = s * (self.reach[0] * self.by_azimuth[1] - self.reach[1] * self.by_azimuth[0]);
        // at constant impact
        let slide = rates.impact[1] / rates.impact[0];
        let z = Complex64::new(
            rates.turn[1] - slide * rates.turn[0],
            rates.across[1] - slide * rates.across[0],
        );
        let size = exit.reference.dot(exit.reference).sqrt();
        (z * (area * size / rates.impact[0]), rates)
    }

    /// Sign of the incidence along the frame's first axis.
    pub(crate) fn sense(&self, s: f64) -> Option<f64> {
        let (_, meetings) = self.meetings(s)?;
        Some(meetings[0].perpendicular.dot(self.across()).signum())
    }

    fn across(&self) -> Vec3<f64> {
        let (sin, cos) = self.azimuth.sin_cos();
        Vec3 { x: -sin, y: cos, z: 0.0 }
    }

    fn meetings(&self, s: f64) -> Option<(Exit<f64>, Vec<Meeting>)> {
        let [u, v] = self.place(s);
        let mut meetings = Vec::new();
        let exit = self.tracer.trace_with_meetings(u, v, self.order, &mut meetings)?;
        Some((exit, meetings))
    }

    /// What is known of one ray.
    pub(crate) fn row(&self, tau: f64, sense: f64) -> Option<RadialRay> {
        let index = self.tracer.index().re;
        let s = index * tau.sin();
        let (exit, meetings) = self.meetings(s)?;
        let impact = exit.reference.dot(exit.reference).sqrt();
        let aside = exit.reference * impact.recip();
        let normal = exit.direction.cross(aside);
        let turned = self.turned(&meetings, tau)?;
        let sine = (1.0 - s * s).sqrt();
        let outside = |meeting: &Meeting| {
            let sin = meeting.cos_squared_outside.max(0.0).sqrt().min(1.0);
            Grazing::path_outside(sine) + meeting.radius * path_series(sin) - path_series(sine)
        };
        let outside = outside(meetings.first()?) + outside(meetings.last()?);
        let order = self.order as usize;
        let path = exit.path + outside + impact * turned - path_on_sphere(order, index, tau);
        let inside = meetings.last()?.path - meetings.first()?.path;
        let inside = inside - 2.0 * order as f64 * index * tau.cos();
        let (density, _) = self.density(&exit, s);
        let density = density * Complex64::cis(-turned) / (s * s);
        let (sin, cos) = turned.sin_cos();
        let (d, a) = (exit.direction * cos - aside * sin, aside * cos + exit.direction * sin);
        let mut met = Vec::with_capacity(meetings.len());
        // a frame that follows the ray smoothly, also where it meets the surface squarely
        let mut frame = [self.across(), self.across().cross(meetings[0].direction)];
        for (hit, meeting) in meetings.iter().enumerate() {
            let square = (1.0 - meeting.cos_squared_outside).max(0.0);
            let [v1, v2] = frame.map(|axis| square.sqrt() * meeting.perpendicular.dot(axis));
            met.push([v1 - sense * s, v2, square / meeting.radius - s * s]);
            let next = meetings.get(hit + 1).map_or(exit.direction, |next| next.direction);
            let mirrored = hit > 0 && hit < order;
            frame = frame.map(|axis| carried(axis, meeting, next, mirrored));
        }
        Some(RadialRay {
            impact: impact / s,
            path,
            inside,
            direction: [d.x, d.y, d.z],
            aside: [a.x, a.y, a.z],
            density: [density.re, density.im],
            meetings: met,
            normal: frame.map(|axis| normal.dot(axis)),
        })
    }

    /// The root of the density of a real ray, turned back, but for a positive factor, such that stationary
    /// phase gives the ray's wave, `-i e^{-iπm/2}` for `m` focal lines.
    pub(crate) fn root(&self, tau: f64) -> Option<Complex64> {
        let s = self.tracer.index().re * tau.sin();
        let (exit, meetings) = self.meetings(s)?;
        let (_, rates) = self.density(&exit, s);
        let size = exit.reference.dot(exit.reference).sqrt();
        let z = [0, 1].map(|k| Complex64::new(rates.turn[k], rates.across[k]));
        // minus the second derivatives of the exponent, over the size parameter
        let element = |i: usize, j: usize| {
            -Complex64::i() * (rates.impact[i] * rates.along[j] + size * z[i] * rates.across[j])
        };
        let (a, b, c) = (element(0, 0), 0.5 * (element(0, 1) + element(1, 0)), element(1, 1));
        let (mean, half) = (0.5 * (a + c), 0.5 * (a - c));
        let split = (half * half + b * b).sqrt();
        let root = (mean + split).sqrt() * (mean - split).sqrt();
        let focal_lines = f64::from(exit.focal_lines);
        let phase = FRAC_PI_2 * (1.0 + focal_lines) + 0.5 * self.turned(&meetings, tau)?;
        Some(root * Complex64::cis(-phase))
    }
}

/// An axis of a ray's frame after the surface: turned about the normal of the plane of incidence, or
/// mirrored by the surface.
fn carried(axis: Vec3<f64>, meeting: &Meeting, next: Vec3<f64>, mirrored: bool) -> Vec3<f64> {
    let normal = meeting.perpendicular;
    let sign = if mirrored { -1.0 } else { 1.0 };
    let before = normal.cross(meeting.direction);
    let behind = normal.cross(next) * sign;
    normal * axis.dot(normal) + behind * axis.dot(before)
}

/// Path of a sphere's waves, turned back, between their turning points.
pub(crate) fn path_on_sphere(order: usize, index: f64, tau: f64) -> f64 {
    2.0 * order as f64 * index * (tau.cos() + tau * tau.sin())
}

/// First terms of `asin`, which alone are not analytic in the square.
fn angle_series(sin: f64) -> f64 {
    let square = sin * sin;
    sin * (1.0
        + square
            * (1.0 / 6.0 + square * (3.0 / 40.0 + square * (5.0 / 112.0 + square * 35.0 / 1152.0))))
}

/// The same of [`Grazing::path_outside`], and zero where the ray meets the surface squarely, where its
/// plane of incidence and with it the radius of curvature turn fast.
pub(crate) fn path_series(sin: f64) -> f64 {
    let square = sin * sin;
    let terms = [1.0 / 3.0, 2.0 / 15.0, 8.0 / 105.0, 16.0 / 315.0, 128.0 / 3465.0];
    // divided by (1 - sin²)²
    let over = |k: usize| (0..=k).map(|j| terms[j] * (k - j + 1) as f64).sum::<f64>();
    let sum = (0..terms.len()).rev().fold(0.0, |sum, k| sum * square + over(k));
    sin * square * (1.0 - square).powi(2) * sum
}

#[cfg(test)]
mod tests;
