//! Over which scattering angles formulas stand for the single rays of an order.

use super::order_planes::OrderPlanes;
use crate::farfield::assignment::{Formula, FormulaRange};
use crate::farfield::branch::knots::{Kind, Segment};
use std::f64::consts::{PI, TAU};

impl OrderPlanes {
    /// Where formulas stand for single rays.
    pub(crate) fn formulas(&self) -> Vec<FormulaRange> {
        let Some(segments) = self.planes.first() else { return Vec::new() };
        let near_rim = self.layout.rim.as_ref().map_or(0, |rim| rim.knots.len());
        let first_near_rim = self.beside_penumbra - near_rim;
        let formula = |(number, segment): (usize, &Segment)| {
            let formula = match segment.kind {
                Kind::Plain { .. } => return None,
                Kind::Pair { .. } => Formula::AiryPair,
                Kind::Wave if number >= self.beside_penumbra => Formula::Penumbra,
                Kind::Wave if number >= first_near_rim => Formula::NearGrazing,
                Kind::Wave => Formula::NearCritical,
            };
            let (low, high) = self.spans[number];
            Some(FormulaRange { formula, theta: scattering_angles(low, high) })
        };
        let about_axis = self
            .about_axis
            .iter()
            .map(|wave| FormulaRange { formula: Formula::AxialRings, theta: wave.theta() });
        merged(segments.iter().enumerate().filter_map(formula).chain(about_axis))
    }
}

/// Ranges of the same formula that meet, as one.
fn merged(ranges: impl Iterator<Item = FormulaRange>) -> Vec<FormulaRange> {
    let mut all: Vec<FormulaRange> = Vec::new();
    for range in ranges {
        let [low, high] = range.theta;
        let meets = |other: &&mut FormulaRange| {
            other.formula == range.formula && low <= other.theta[1] && other.theta[0] <= high
        };
        match all.iter_mut().find(meets) {
            Some(other) => other.theta = [low.min(other.theta[0]), high.max(other.theta[1])],
            None => all.push(range),
        }
    }
    all
}

/// Scattering angles of a stretch of unwrapped ones.
fn scattering_angles(low: f64, high: f64) -> [f64; 2] {
    let theta = |angle: f64| {
        let turned = angle.rem_euclid(TAU);
        turned.min(TAU - turned)
    };
    let [a, b] = [theta(low), theta(high)];
    let meets = |axis: f64| ((high - axis) / TAU).floor() >= ((low - axis) / TAU).ceil();
    [if meets(0.0) { 0.0 } else { a.min(b) }, if meets(PI) { PI } else { a.max(b) }]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unwrapped_stretches_fold_onto_scattering_angles() {
        let near = |[a, b]: [f64; 2], [c, d]: [f64; 2]| (a - c).abs() + (b - d).abs() < 1e-12;
        assert!(near(scattering_angles(1.0, 2.0), [1.0, 2.0]));
        assert!(near(scattering_angles(TAU - 2.0, TAU - 1.0), [1.0, 2.0]));
        assert!(near(scattering_angles(PI - 0.1, PI + 0.3), [PI - 0.3, PI]));
        assert!(near(scattering_angles(-0.2, 0.1), [0.0, 0.2]));
    }
}
