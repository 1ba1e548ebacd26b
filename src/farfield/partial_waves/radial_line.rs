//! Rays of one order along a line of launch points, as smooth functions of the exit ray's impact.
//!
//! The line goes to the rim from the launch point of the ray whose exit line passes through the particle's
//! centre (high orders, which hold next to nothing in rays that meet the surface steeply: from the middle of the shadow, its steep rays left out). What the wave of a
//! ray needs is a polynomial along it, less what it is on a sphere, and continued beyond the last ray,
//! where waves tunnel through the surface. Parts that are not analytic there, odd in the grazing angle of
//! the entry and of the exit, are taken out as on a sphere: paths are measured between the turning points
//! of the waves outside ([`Grazing::path_outside`]), directions turned back by the grazing angles.

use super::radial_channels::{Channels, RAYS};
use super::radial_rays::{Way, path_on_sphere, path_series};
use crate::farfield::branch::window::Window;
use crate::farfield::impact_integral::met_fields::{MeetingChannels, transfer};
use crate::farfield::impact_integral::rays::TUNNEL;
use crate::math::chebyshev::{self, Chebyshev};
use crate::math::vec3::Vec3;
use crate::optics::Grazing;
use crate::shape::Silhouette;
use crate::trace::Tracer;
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Where the line begins, and the share of it left out before the last ray.
const BEGIN: f64 = 0.02;
const SPARE: f64 = 0.02;
/// Lines of high orders rise between two launch points.
const RISE: Window = Window { start: 0.45, full: 0.65 };
/// How far the phase of the density may be off, times 4.
const LARGEST_TURN: f64 = 1.0;
/// Least growth of the impact along the line.
const LEAST_SLOPE: f64 = 0.1;
/// Largest angle inside.
const STEEPEST: f64 = 0.98 * FRAC_PI_2;

/// The line of launch points at one azimuth; its coordinate is a sphere's angle inside, `τ`, with the
/// launch point at `s = n sin τ` of the way from the centre to the rim.
pub(crate) struct RadialLine {
    channels: Channels,
    order: usize,
    /// Whether the line begins at the centre.
    whole: bool,
    azimuth: f64,
    index: f64,
    /// Sign of the incidence along the frame's first axis.
    sense: f64,
    /// The first real ray.
    from: f64,
    /// The last real ray, beyond which channels are continued.
    last: f64,
    /// Coordinate beyond which nothing tunnels.
    end: f64,
    /// Phase of the square root of the density, as it continues from the real ray at `anchor`.
    anchor: f64,
    turn: Complex64,
}

/// The wave of the ray of one impact.
pub(crate) struct Ring {
    /// Null vector `direction - i aside` of its plane.
    pub null: Vec3<Complex64>,
    /// Amplitudes along the normal of the plane and along the impact, for incident light along x and y.
    pub fields: [[Complex64; 2]; 2],
}

impl RadialLine {
    /// `None` where rays cannot be followed.
    pub(crate) fn new(
        tracer: &Tracer,
        silhouette: &Silhouette,
        order: u32,
        centre: [f64; 2],
        azimuth: f64,
        x: f64,
        whole: bool,
    ) -> Option<Self> {
        let way = Way::new(tracer, silhouette, order, centre, azimuth);
        let index = tracer.index().re;
        let to = way.last_real().filter(|_| index > 1.0)?;
        let inside = |s: f64| (s / index).asin();
        let begin = if whole { BEGIN } else { RISE.start };
        let (from, last) = (inside(begin), inside((1.0 - SPARE) * to));
        let points = chebyshev::points(RAYS, from, last);
        let sense = way.sense(index * last.sin())?;
        let rows = points.iter().map(|&tau| way.row(tau, sense)).collect::<Option<Vec<_>>>()?;
        let channels = Channels::through(&rows, from, last);
        let anchor = points[RAYS / 2];
        // impacts must serve as coordinates
        let slope =
            |s: f64| way.exit(s).is_some_and(|exit| way.rates(&exit, s).impact[0] > LEAST_SLOPE);
        if !points.iter().all(|tau| slope(index * tau.sin())) {
            return None;
        }
        let wanted = way.root(anchor)?;
        let order = order as usize;
        let turn = Complex64::from(1.0);
        let mut line = Self {
            channels,
            order,
            whole,
            azimuth,
            index,
            sense,
            from,
            last,
            end: last,
            anchor,
            turn,
        };
        let turn = wanted / line.root(anchor);
        line.turn = turn / turn.norm();
        // one of four, unless the polynomials fail
        if line.turn.powi(4).arg().abs() > LARGEST_TURN {
            return None;
        }
        let grazing = line.grazing(0).min(line.grazing(order));
        let end = index * grazing.sin() + TUNNEL * x.powf(-2.0 / 3.0);
        line.end = inside(end.min(index)).min(STEEPEST);
        Some(line)
    }

    /// The values of a polynomial and their slopes, continued in a straight line.
    fn at<const C: usize>(&self, series: &Chebyshev<C>, tau: f64) -> ([f64; C], [f64; C]) {
        let (value, slope) = series.at(tau.min(self.last));
        let beyond = (tau - self.last).max(0.0);
        (std::array::from_fn(|c| value[c] + slope[c] * beyond), slope)
    }

    /// Coordinate from the last real ray on at which a meeting becomes grazing.
    fn grazing(&self, hit: usize) -> f64 {
        const STEPS: usize = 40;
        let step = (STEEPEST - self.last) / STEPS as f64;
        let places = (0..=STEPS).map(|k| self.last + k as f64 * step);
        places.into_iter().find(|&tau| self.incidence(hit, tau).square < 0.0).unwrap_or(STEEPEST)
    }

    /// How the ray meets the surface.
    fn incidence(&self, hit: usize, tau: f64) -> Incidence {
        let s = self.index * tau.sin();
        let ([v1, v2, curved], _) = self.at(&self.channels.meetings[hit], tau);
        let v1 = self.sense * s + v1;
        let sine = v1 * v1 + v2 * v2;
        let radius = (sine / (s * s + curved)).clamp(1e-3, 1e3);
        Incidence { square: 1.0 - sine, radius, angle: v2.atan2(v1) }
    }

    /// Fields of the ray that has left, by [`transfer`].
    fn fields(&self, tau: f64, index: Complex64, x: f64) -> [[Complex64; 2]; 2] {
        let mut meetings = Vec::with_capacity(self.order + 1);
        let (mut before, mut hand) = (0.0, 1.0);
        for hit in 0..=self.order {
            let Incidence { square, radius, angle } = self.incidence(hit, tau);
            meetings.push(MeetingChannels { square, radius, turn: hand * (angle - before) });
            before = angle;
            // frames are mirrored where rays are reflected
            if hit > 0 && hit < self.order {
                hand = -hand;
            }
        }
        let ([along, across], _) = self.at(&self.channels.normal, tau);
        let last_turn = hand * (across.atan2(along) - before);
        transfer(meetings.into_iter(), last_turn, index, x)
    }

    /// The path, with the ways of the waves outside.
    fn path(&self, tau: f64) -> f64 {
        let outside = |hit: usize| {
            let Incidence { square, radius, .. } = self.incidence(hit, tau);
            if square > 0.0 {
                let sin = square.sqrt().min(1.0);
                radius * (Grazing::path_outside(sin) - path_series(sin))
            } else {
                0.0
            }
        };
        let s = self.index * tau.sin();
        let sphere = if s < 1.0 {
            let sin = (1.0 - s * s).sqrt();
            Grazing::path_outside(sin) - path_series(sin)
        } else {
            0.0
        };
        let ([path], _) = self.at(&self.channels.path, tau);
        let smooth = path + path_on_sphere(self.order, self.index, tau);
        smooth + outside(0) + outside(self.order) - 2.0 * sphere
    }

    /// The impact and its slope.
    fn impact(&self, tau: f64) -> (f64, f64) {
        let ([ratio], [slope]) = self.at(&self.channels.impact, tau);
        let s = self.index * tau.sin();
        (s * ratio, self.index * tau.cos() * ratio + s * slope)
    }

    /// Largest component along the light of the impact's moment.
    pub(crate) fn largest_twist(&self) -> f64 {
        let twist = |k: usize| {
            let tau = self.from + (self.last - self.from) * k as f64 / 19.0;
            let [direction, aside] =
                [&self.channels.direction, &self.channels.aside].map(|v| self.vector(v, tau));
            let normal = direction.cross(aside);
            (self.impact(tau).0 * normal.z).abs()
        };
        (0..20).map(twist).fold(0.0, f64::max)
    }

    fn vector(&self, series: &Chebyshev<3>, tau: f64) -> Vec3<f64> {
        let ([x, y, z], _) = self.at(series, tau);
        Vec3 { x, y, z }
    }

    /// Rings of the impacts `(l + ½)/x`, without the weight of this azimuth; the first `l` beside.
    pub(crate) fn rings(&self, index: Complex64, x: f64) -> (usize, Vec<Ring>) {
        // lines that begin near the centre are continued to it
        let from = if self.whole { 0.0 } else { self.impact(self.from).0 };
        let first = (x * from - 0.5).ceil().max(1.0) as usize;
        let mut tau = self.from;
        let mut rings = Vec::new();
        for l in first.. {
            let impact = (l as f64 + 0.5) / x;
            let Some(found) = self.launch_of(impact, tau).filter(|tau| *tau < self.end) else {
                break;
            };
            tau = found;
            let Some(ring) = self.ring(tau, index, x) else { break };
            rings.push(ring);
        }
        (first, rings)
    }

    /// Launch coordinate of an impact.
    fn launch_of(&self, impact: f64, near: f64) -> Option<f64> {
        let mut tau = near;
        for _ in 0..30 {
            let (value, slope) = self.impact(tau);
            let step = ((value - impact) / slope).clamp(-0.1, 0.1);
            tau -= step;
            if step.abs() < 1e-12 {
                return (slope > 0.0).then_some(tau);
            }
        }
        None
    }

    fn ring(&self, tau: f64, index: Complex64, x: f64) -> Option<Ring> {
        let [across, along] = self.fields(tau, index, x);
        let ([inside], _) = self.at(&self.channels.inside, tau);
        let inside = inside + 2.0 * self.order as f64 * index.re * tau.cos();
        let absorbed = (-x * index.im * inside / index.re).exp();
        let wave = Complex64::cis(TAU * (x / TAU * self.path(tau)).fract());
        let s = self.index * tau.sin();
        let rise = if self.whole { 1.0 } else { RISE.weight(s) };
        let weight = wave * self.root(tau) * (x / TAU * s * absorbed * rise);
        let (sin, cos) = self.azimuth.sin_cos();
        let fields = [
            [0, 1].map(|k| weight * (along[k] * cos - across[k] * sin)),
            [0, 1].map(|k| weight * (along[k] * sin + across[k] * cos)),
        ];
        let direction = self.vector(&self.channels.direction, tau);
        let direction = direction * direction.dot(direction).sqrt().recip();
        let aside = self.vector(&self.channels.aside, tau);
        let aside = aside - direction * aside.dot(direction);
        let aside = aside * aside.dot(aside).sqrt().recip();
        let null = Vec3 {
            x: Complex64::new(direction.x, -aside.x),
            y: Complex64::new(direction.y, -aside.y),
            z: Complex64::new(direction.z, -aside.z),
        };
        fields.iter().flatten().all(|f| f.is_finite()).then_some(Ring { null, fields })
    }

    /// Root of the density, continued from the anchor.
    fn root(&self, tau: f64) -> Complex64 {
        const STEPS: usize = 24;
        let density = |tau: f64| {
            let ([re, im], _) = self.at(&self.channels.density, tau);
            -Complex64::new(re, im)
        };
        let mut root = density(self.anchor).sqrt();
        for k in 1..=STEPS {
            let next = density(self.anchor + (tau - self.anchor) * k as f64 / STEPS as f64).sqrt();
            root = if (next * root.conj()).re < 0.0 { -next } else { next };
        }
        root * self.turn
    }
}

/// How a ray meets the surface: squared cosine outside, radius of curvature, azimuth of the incidence in
/// the ray's frame.
struct Incidence {
    square: f64,
    radius: f64,
    angle: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::farfield::partial_waves::central_ray::central_ray;
    use crate::shape::Shape;

    const INDEX: f64 = 1.333;

    /// Along a line of a sphere the impact is the launch point, the ray meets the surface at its angle
    /// of incidence everywhere, and rings go on beyond the rim, where waves tunnel, getting weaker.
    #[test]
    fn lines_of_a_sphere_are_known() {
        let x = 60.0;
        let shape = Shape::sphere();
        for order in [1u32, 2, 3] {
            let tracer = Tracer::new(&shape, INDEX.into(), x, order).with_curved_interface(x);
            let silhouette = shape.silhouette();
            let centre = central_ray(&tracer, &silhouette, order, true).unwrap();
            assert!(centre[0].hypot(centre[1]) < 1e-12);
            let line = RadialLine::new(&tracer, &silhouette, order, centre, 0.4, x, true).unwrap();
            for s in [0.1, 0.6, 0.95, 1.05] {
                let tau = (s / INDEX).asin();
                let (impact, slope) = line.impact(tau);
                assert!((impact - s).abs() < 1e-8 && (slope - INDEX * tau.cos()).abs() < 1e-6);
                let found = line.launch_of(s, 0.5).unwrap();
                assert!((found - tau).abs() < 1e-8);
                for hit in 0..=order as usize {
                    let Incidence { square, radius, .. } = line.incidence(hit, tau);
                    assert!((square - (1.0 - s * s)).abs() < 1e-7, "{order} {s} {hit}: {square}");
                    assert!((radius - 1.0).abs() < 1e-5, "{order} {s} {hit}: {radius}");
                }
            }
            assert!(line.largest_twist() < 1e-8);
            let (first, rings) = line.rings(INDEX.into(), x);
            assert_eq!(first, 1);
            let beyond = rings.len() as f64 + 0.5 - x;
            let tunnel = TUNNEL * x.cbrt();
            assert!(beyond > 0.5 * tunnel && beyond <= tunnel + 1.0, "{beyond} {tunnel}");
            let size =
                |ring: &Ring| ring.fields.iter().flatten().map(|f| f.norm_sqr()).sum::<f64>();
            let (rim, last) = (size(&rings[x as usize - 1]), size(&rings[rings.len() - 1]));
            assert!(last < 1e-2 * rim, "{order}: {last} {rim}");
            // each plane's vector is null
            let null = rings[20].null;
            assert!(null.dot(null).norm() < 1e-12);
        }
    }
}
