//! What is known of a ray on its way through the surface, or the polynomials in the launch point through that of many.

use super::met_fields::{MeetingChannels, turned_frames};
use crate::farfield::deflection::curve::DeflectionCurve;
use crate::farfield::deflection::scattering_plane::Node;
use crate::math::chebyshev::Chebyshev;
use crate::optics::Grazing;
use crate::trace::Meeting;
use std::f64::consts::TAU;

/// What is known of a ray, or the polynomials through that of all.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Channels<T> {
    pub impact: T,
    /// Path L without the part outside.
    pub path: T,
    pub spreading: T,
    /// Path inside.
    pub inside: T,
    pub meetings: Vec<MeetingChannels<T>>,
    /// Last turn of the frame.
    pub last_turn: T,
}

impl Channels<Chebyshev<1>> {
    /// All at a launch point.
    pub(super) fn at(&self, sin: f64) -> Channels<f64> {
        let at = |series: &Chebyshev<1>| series.value(sin)[0];
        Channels {
            impact: at(&self.impact),
            path: at(&self.path),
            spreading: at(&self.spreading),
            inside: at(&self.inside),
            meetings: self.meetings.iter().map(|meeting| meeting.at(sin)).collect(),
            last_turn: at(&self.last_turn),
        }
    }
}

impl MeetingChannels<Chebyshev<1>> {
    pub(super) fn at(&self, sin: f64) -> MeetingChannels<f64> {
        let at = |series: &Chebyshev<1>| series.value(sin)[0];
        MeetingChannels { square: at(&self.square), radius: at(&self.radius), turn: at(&self.turn) }
    }
}

/// What is known of one ray.
pub(super) fn row(
    curve: &DeflectionCurve,
    node: &Node,
    meetings: &[Meeting],
) -> Option<Channels<f64>> {
    let plane = curve.plane();
    let (_, growing) = plane.frame(node.angle);
    let across = plane.across();
    let exit = &node.exit;
    let impact = exit.reference.dot(growing);
    let minor = plane.spread_across(exit, node.angle);
    let path = exit.path + impact * node.angle + paths_outside(meetings)?;
    let spreading = node.angle.sin().abs() / minor.abs();
    let inside = path_inside(meetings)?;
    let (meetings, last_turn) = turned_frames(meetings, across, across, exit.direction);
    Some(Channels { impact, path, spreading, inside, meetings, last_turn })
}

/// The ways of the waves outside from their turning points to the first meeting and from the last.
fn paths_outside(meetings: &[Meeting]) -> Option<f64> {
    let outside = |m: &Meeting| {
        m.radius * Grazing::path_outside(m.cos_squared_outside.max(0.0).sqrt().min(1.0))
    };
    Some(outside(meetings.first()?) + outside(meetings.last()?))
}

/// The optical path inside.
fn path_inside(meetings: &[Meeting]) -> Option<f64> {
    Some(meetings.last()?.path - meetings.first()?.path)
}

/// Unwrap the turns of frames, smooth along rows.
pub(super) fn unwrap_turns(rows: &mut [Channels<f64>]) {
    let near = |turn: &mut f64, before: f64| *turn += TAU * ((before - *turn) / TAU).round();
    for k in 1..rows.len() {
        let (before, rest) = rows.split_at_mut(k);
        let (before, row) = (&before[k - 1], &mut rest[0]);
        for (meeting, before) in row.meetings.iter_mut().zip(&before.meetings) {
            near(&mut meeting.turn, before.turn);
        }
        near(&mut row.last_turn, before.last_turn);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_unwrapped_along_rows() {
        let row = |a: f64, last_turn: f64| Channels {
            impact: 0.0,
            path: 0.0,
            spreading: 1.0,
            inside: 1.0,
            meetings: [a, 0.1]
                .map(|turn| MeetingChannels { square: 1.0, radius: 1.0, turn })
                .into(),
            last_turn,
        };
        let mut rows = [row(3.1, -3.1), row(-3.1, 3.1), row(-3.0, 3.0)];
        unwrap_turns(&mut rows);
        let first = |k: usize| rows[k].meetings[0].turn;
        assert!((first(1) - (TAU - 3.1)).abs() < 1e-15 && (first(2) - (TAU - 3.0)).abs() < 1e-15);
        assert!((rows[2].last_turn - (3.0 - TAU)).abs() < 1e-15);
        assert_eq!(rows[2].meetings[1].turn, 0.1);
    }
}
