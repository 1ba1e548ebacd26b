//! How a real ray meets the surface on its way through the particle.

use super::exit::Exit;
use super::surface_event::plane_of_incidence;
use super::tracer::Tracer;
use crate::math::vec3::Vec3;

/// How a real ray meets the surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Meeting {
    /// Squared cosine of the angle outside; negative under total reflection.
    pub cos_squared_outside: f64,
    /// Radius of curvature in the plane of incidence.
    pub radius: f64,
    /// Unit normal of the plane of incidence.
    pub perpendicular: Vec3<f64>,
    /// Direction before the meeting.
    pub direction: Vec3<f64>,
    /// Optical path up to here.
    pub path: f64,
}

impl Tracer<'_> {
    /// The exit of one order for the ray launched at `(u, v)`, noting where a real ray meets the surface as `(x, z)`.
    pub fn trace_with_points(
        &self,
        u: f64,
        v: f64,
        order: u32,
        points: &mut Vec<[f64; 2]>,
    ) -> Option<Exit<f64>> {
        self.follow(u, v, order, |ray, _| points.push([ray.position.x, ray.position.z]))
    }

    /// The same, noting how a real ray meets the surface each time.
    pub(crate) fn trace_with_meetings(
        &self,
        u: f64,
        v: f64,
        order: u32,
        meetings: &mut Vec<Meeting>,
    ) -> Option<Exit<f64>> {
        meetings.clear();
        self.follow(u, v, order, |ray, tangent| {
            let cos = ray.direction.dot(tangent.normal);
            let sin_squared = 1.0 - cos * cos;
            let index_before = if meetings.is_empty() { 1.0 } else { self.index().re };
            meetings.push(Meeting {
                cos_squared_outside: 1.0 - sin_squared * index_before * index_before,
                radius: tangent.radius_along(ray.direction),
                perpendicular: plane_of_incidence(ray.direction, tangent.normal),
                direction: ray.direction,
                path: ray.path,
            });
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;

    const INDEX: f64 = 1.333;

    /// On a sphere every meeting is at the same angle; the path runs on.
    #[test]
    fn meetings_tell_the_angle_the_radius_and_the_path() {
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 3);
        let (mut meetings, mut points) = (Vec::new(), Vec::new());
        let exit = tracer.trace_with_meetings(0.7, 0.0, 3, &mut meetings).unwrap();
        tracer.trace_with_points(0.7, 0.0, 3, &mut points).unwrap();
        assert_eq!((meetings.len(), points.len(), exit.order), (4, 4, 3));
        let chord = 2.0 * INDEX * (1.0 - (0.7 / INDEX).powi(2)).sqrt();
        for (k, (meeting, point)) in meetings.iter().zip(&points).enumerate() {
            assert!((meeting.cos_squared_outside - 0.51).abs() < 1e-13);
            assert!((meeting.radius - 1.0).abs() < 1e-13);
            assert!((meeting.path - (k as f64 * chord - 0.51f64.sqrt())).abs() < 1e-13);
            assert!((point[0].hypot(point[1]) - 1.0).abs() < 1e-13);
        }
    }
}
