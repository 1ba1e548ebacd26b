//! What the surface makes of a ray's field, from how the ray meets it each time: also where no real ray
//! does, beyond the rim.

use crate::math::scalar::Scalar;
use crate::math::vec3::Vec3;
use crate::optics::{Grazing, curved_from_inside};
use crate::trace::Meeting;
use num_complex::Complex64;

/// How a ray meets the surface.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MeetingChannels<T> {
    /// Squared cosine outside.
    pub square: T,
    /// Radius of curvature.
    pub radius: T,
    /// Turn of the frame before it.
    pub turn: T,
}

/// Fields `[perpendicular, perpendicular × direction]` of a ray that has left, for incident light of either
/// kind, from how it met the surface each time and the last turn of the frame; with the phases of the waves
/// outside.
pub(crate) fn transfer(
    meetings: impl ExactSizeIterator<Item = MeetingChannels<f64>>,
    last_turn: f64,
    index: Complex64,
    x: f64,
) -> [[Complex64; 2]; 2] {
    let count = meetings.len();
    let mut fields = [[Complex64::from(1.0), 0.0.into()], [0.0.into(), Complex64::from(1.0)]];
    for (hit, MeetingChannels { square, radius, turn: before }) in meetings.enumerate() {
        turn(&mut fields, before);
        let grazing = Grazing::whole(square, x * radius);
        let inside = (1.0 - (1.0 - square) / (index * index)).root();
        let f = curved_from_inside(inside, index, &grazing);
        let through = hit == 0 || hit + 1 == count;
        let (perpendicular, parallel) = if through {
            (f.t_perpendicular, f.t_parallel)
        } else {
            (f.r_perpendicular, f.r_parallel)
        };
        for field in &mut fields {
            field[0] *= perpendicular;
            field[1] *= parallel;
        }
    }
    turn(&mut fields, last_turn);
    fields
}

/// Turn the frame of fields about the ray.
fn turn(fields: &mut [[Complex64; 2]; 2], angle: f64) {
    let (sin, cos) = angle.sin_cos();
    for field in fields {
        let [a, b] = *field;
        *field = [a * cos + b * sin, b * cos - a * sin];
    }
}

/// What [`transfer`] needs, for the first axes of the frames before and behind; frames are
/// (perpendicular, perpendicular × direction).
pub(super) fn turned_frames(
    meetings: &[Meeting],
    before: Vec3<f64>,
    behind: Vec3<f64>,
    direction: Vec3<f64>,
) -> (Vec<MeetingChannels<f64>>, f64) {
    let mut frame = before;
    let met = |meeting: &Meeting| {
        let turn = frame_turn(frame, meeting.perpendicular, meeting.direction);
        frame = meeting.perpendicular;
        MeetingChannels { square: meeting.cos_squared_outside, radius: meeting.radius, turn }
    };
    let met = meetings.iter().map(met).collect();
    (met, frame_turn(frame, behind, direction))
}

/// Angle by which a frame about a ray must turn for its first axis to become another.
fn frame_turn(from: Vec3<f64>, to: Vec3<f64>, direction: Vec3<f64>) -> f64 {
    from.cross(direction).dot(to).atan2(from.dot(to))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_turn_about_the_ray() {
        let z = Vec3::new(0.0, 0.0, 1.0);
        let at = |angle: f64| Vec3::new(angle.cos(), angle.sin(), 0.0);
        // `perpendicular, perpendicular × direction`: clockwise about the ray
        assert!((frame_turn(at(0.4), at(0.1), z) - 0.3).abs() < 1e-15);
        let mut fields = [[Complex64::from(1.0), 0.0.into()], [0.0.into(), Complex64::from(1.0)]];
        turn(&mut fields, 0.3);
        let second = at(0.1).cross(z);
        assert!((fields[0][0] - at(0.4).dot(at(0.1))).norm() < 1e-15);
        assert!((fields[0][1] - at(0.4).dot(second)).norm() < 1e-15);
    }
}
