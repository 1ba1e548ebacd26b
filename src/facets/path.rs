//! One ray's way through a convex body: where it comes in, what leaves at every facet that it meets.
//!
//! Fields are scaled to power: the mean square of those for light of both polarisations is the share of the
//! ray's power, on both sides of a facet, so that what is reflected and what passes add up to 1.

use super::Body;
use super::beams::{GRAZING, across, mean_square, mirrored, real, refracted, turned};
use crate::math::vec3::Field;
use crate::optics::fresnel;
use glam::DVec3;
use num_complex::Complex64;

/// A body as rays need it.
pub(super) struct Facets {
    normals: Vec<DVec3>,
    distances: Vec<f64>,
    areas: Vec<f64>,
    /// Of each facet, with the share of its area up to the end of each.
    triangles: Vec<Vec<([DVec3; 3], f64)>>,
}

/// What leaves the body by one facet.
pub(super) struct Sent {
    /// Chords inside before; 0: reflected outside.
    pub order: u32,
    /// Unit vector.
    pub direction: DVec3,
    /// For light of both polarisations, scaled to power.
    pub fields: [Field; 2],
    /// Share of the ray's power.
    pub power: f64,
}

/// Where the rest of a ray's power went.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Rest {
    /// In the body.
    pub absorbed: f64,
    /// Totally reflected ever since it came in, and not followed further.
    pub trapped: f64,
    /// Not followed further.
    pub truncated: f64,
}

/// Light that meets a body: unit vectors of its way and of both polarisations.
#[derive(Clone, Copy, Debug)]
pub(super) struct Light {
    pub direction: DVec3,
    pub polarisations: [DVec3; 2],
    /// Of the body, and the wavenumber outside in units of the body.
    pub index: Complex64,
    pub wavenumber: f64,
}

/// How far a ray is followed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    pub last_order: u32,
    pub least_power: f64,
}

impl Facets {
    pub(super) fn of(body: &Body) -> Self {
        let vertices = body.vertices();
        let triangles = |corners: &[usize]| {
            let fan = (1..corners.len() - 1).map(|k| {
                let [a, b, c] = [corners[0], corners[k], corners[k + 1]].map(|i| vertices[i]);
                ([a, b, c], 0.5 * (b - a).cross(c - a).length())
            });
            let mut all: Vec<_> = fan.collect();
            let total: f64 = all.iter().map(|triangle| triangle.1).sum();
            let mut up_to = 0.0;
            for triangle in &mut all {
                up_to += triangle.1 / total;
                triangle.1 = up_to;
            }
            all
        };
        let facets = body.facets();
        Self {
            normals: facets.iter().map(|f| f.normal).collect(),
            distances: facets.iter().map(|f| f.distance).collect(),
            areas: facets.iter().map(|f| f.area(vertices)).collect(),
            triangles: facets.iter().map(|f| triangles(&f.corners)).collect(),
        }
    }

    /// Facets that light meets, each with the area of its shadow and of those before it; and that of all.
    pub(super) fn lit(&self, direction: DVec3, into: &mut Vec<(usize, f64)>) -> f64 {
        into.clear();
        let mut shadow = 0.0;
        for (facet, normal) in self.normals.iter().enumerate() {
            let cos = -normal.dot(direction);
            if cos > GRAZING {
                shadow += cos * self.areas[facet];
                into.push((facet, shadow));
            }
        }
        shadow
    }

    /// The point of a facet for two numbers from 0 to 1, even over its area.
    pub(super) fn point(&self, facet: usize, u: f64, v: f64) -> DVec3 {
        let triangles = &self.triangles[facet];
        let place = triangles.partition_point(|t| t.1 < u).min(triangles.len() - 1);
        let before = if place == 0 { 0.0 } else { triangles[place - 1].1 };
        let ([a, b, c], end) = triangles[place];
        // what is left of the first number is even again
        let side = ((u - before) / (end - before)).clamp(0.0, 1.0).sqrt();
        a * (1.0 - side) + b * (side * (1.0 - v)) + c * (side * v)
    }

    /// Follow a ray that meets a facet at a point; `send` hears of all that leaves.
    pub(super) fn follow(
        &self,
        light: &Light,
        (facet, mut point): (usize, DVec3),
        limits: &Limits,
        mut send: impl FnMut(Sent),
    ) -> Rest {
        let n = light.index.re;
        let loss = light.wavenumber * light.index.im;
        let mut rest = Rest::default();
        let normal = self.normals[facet];
        let f = fresnel(-normal.dot(light.direction), n.into());
        let aside = across(light.direction, normal);
        let incident = light.polarisations.map(|e| real(e).carry(1.0.into()));
        let outside = mirrored(light.direction, normal);
        let back = [f.r_perpendicular, f.r_parallel];
        let fields = incident.map(|e| turned(e, aside, [light.direction, outside], back));
        send(Sent { order: 0, direction: outside, power: mean_square(&fields), fields });
        let Some(mut direction) = refracted(light.direction, normal, 1.0 / n) else { return rest };
        let through = [f.t_perpendicular, f.t_parallel];
        let mut fields = incident.map(|e| turned(e, aside, [light.direction, direction], through));
        let mut total = true;
        for order in 1.. {
            let power = mean_square(&fields);
            if order > limits.last_order || power < limits.least_power {
                *(if total && order > 1 { &mut rest.trapped } else { &mut rest.truncated }) +=
                    power;
                return rest;
            }
            let Some((next, length)) = self.next(point, direction) else {
                rest.truncated += power;
                return rest;
            };
            if loss > 0.0 {
                let left = (-loss * length).exp();
                fields = fields.map(|e| e * Complex64::from(left));
                rest.absorbed += power * (1.0 - left * left);
            }
            point += length * direction;
            let normal = self.normals[next];
            let f = fresnel(normal.dot(direction), (1.0 / n).into());
            let aside = across(direction, normal);
            if let Some(outside) = refracted(direction, normal, n) {
                let through = [f.t_perpendicular, f.t_parallel];
                let sent = fields.map(|e| turned(e, aside, [direction, outside], through));
                send(Sent { order, direction: outside, power: mean_square(&sent), fields: sent });
                total = false;
            }
            let inside = mirrored(direction, normal);
            let back = [f.r_perpendicular, f.r_parallel];
            fields = fields.map(|e| turned(e, aside, [direction, inside], back));
            direction = inside;
        }
        rest
    }

    /// The facet that a ray inside meets first, and how far it is.
    fn next(&self, point: DVec3, direction: DVec3) -> Option<(usize, f64)> {
        let mut nearest = None;
        let mut least = f64::INFINITY;
        for (facet, (normal, distance)) in self.normals.iter().zip(&self.distances).enumerate() {
            let cos = normal.dot(direction);
            if cos > GRAZING {
                let length = (distance - normal.dot(point)) / cos;
                if length < least {
                    (nearest, least) = (Some(facet), length);
                }
            }
        }
        nearest.map(|facet| (facet, least.max(0.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::facets::beams::{Incidence, Settings, split};

    /// A ray's power is told to the end, and many rays share it out by order as exact beams do.
    #[test]
    fn rays_share_out_power_as_beams_do() {
        let body = Body::hexagonal_column(1.3).unwrap();
        let turn = glam::DMat3::from_rotation_y(0.7) * glam::DMat3::from_rotation_z(0.2);
        let body = body.turned(&turn);
        let index = Complex64::new(1.31, 2e-3);
        let settings = Settings { last_order: 60, least_power: 1e-9 };
        let beams = split(&body, &Incidence { index, size_parameter: 40.0 }, &settings);
        let facets = Facets::of(&body);
        let light = Light {
            direction: DVec3::Z,
            polarisations: [DVec3::X, DVec3::Y],
            index,
            wavenumber: 40.0,
        };
        let limits = Limits { last_order: 60, least_power: 1e-9 };
        let mut lit = Vec::new();
        let shadow = facets.lit(DVec3::Z, &mut lit);
        assert!((shadow / beams.shadow - 1.0).abs() < 1e-12);
        let count = 40_000;
        let (mut by_order, mut absorbed) = ([0.0; 6], 0.0);
        for ray in 0..count {
            let [u, v, w] = crate::facets::orientation::point(ray, 3);
            let place = lit.partition_point(|l| l.1 < u * shadow);
            let facet = lit[place].0;
            let (mut left, mut first) = (0.0, [0.0; 6]);
            let rest = facets.follow(&light, (facet, facets.point(facet, v, w)), &limits, |sent| {
                left += sent.power;
                if let Some(order) = first.get_mut(sent.order as usize) {
                    *order += sent.power;
                }
            });
            let told = left + rest.absorbed + rest.trapped + rest.truncated;
            assert!((told - 1.0).abs() < 1e-12, "{told}");
            by_order.iter_mut().zip(first).for_each(|(to, from)| *to += from / f64::from(count));
            absorbed += rest.absorbed / f64::from(count);
        }
        for (order, share) in by_order.iter().enumerate() {
            let exact = beams.budget.left_by_order[order];
            assert!((share - exact).abs() < 1e-3 + 5e-3 * exact, "{order}: {share} {exact}");
        }
        assert!((absorbed / beams.budget.absorbed - 1.0).abs() < 5e-3);
    }

    /// Points are even over a facet: their mean is its centre of area, none lies outside.
    #[test]
    fn points_are_even_over_a_facet() {
        let body = Body::hexagonal_column(0.5).unwrap();
        let facets = Facets::of(&body);
        for (number, facet) in body.facets().iter().enumerate() {
            let corners: Vec<DVec3> = facet.corners.iter().map(|&i| body.vertices()[i]).collect();
            let centre = corners.iter().sum::<DVec3>() / corners.len() as f64;
            let count = 4096;
            let mut mean = DVec3::ZERO;
            for i in 0..count {
                let [u, v, _] = crate::facets::orientation::point(i, 1);
                let point = facets.point(number, u, v);
                assert!(body.facets().iter().all(|f| f.normal.dot(point) < f.distance + 1e-12));
                mean += point / f64::from(count);
            }
            assert!((mean - centre).length() < 2e-3, "{}", (mean - centre).length());
        }
    }
}
