//! The waves about the axis that a curve's rays make, in a rotationally symmetric scene.

use super::cut_layout::CutLayout;
use crate::farfield::deflection::curve::DeflectionCurve;
use crate::farfield::deflection::landmark::Landmark;
use crate::farfield::deflection::scan::Edge;
use crate::farfield::impact_integral::glory::Glory;
use crate::farfield::impact_integral::near_grazing::NearGrazing;
use crate::farfield::impact_integral::rays::Rays;
use std::f64::consts::PI;

/// The waves about the axis of rays that cross it, in a rotationally symmetric scene; `rim` are those near the rim.
pub(crate) fn axis_waves(
    curve: &DeflectionCurve,
    layout: &CutLayout,
    rim: Option<&Rays>,
) -> Vec<Glory> {
    let (reach, x) = (layout.axis_gap, layout.size_parameter);
    let launch = |landmark: &Landmark| curve.launch(landmark);
    let crossing = |around: &[Landmark]| {
        let Landmark::Axis(axis) = around[1] else { return None };
        let side = |is_start| curve.find(Edge::Axis { axis, gap: reach }, is_start);
        let (before, after) = (side(false)?, side(true)?);
        let limits = [launch(&around[0])?, launch(&around[2])?];
        let number = (axis / PI).round() as i64;
        let share = |sin: f64| layout.rim.as_ref().map_or(1.0, |rim| 1.0 - rim.weight(sin));
        Glory::of_crossing(curve, share, [&before, &after], limits, number, reach, x)
    };
    let mut waves: Vec<Glory> = curve.landmarks.windows(3).filter_map(crossing).collect();
    let near_rim = layout.rim.as_ref().zip(rim);
    let rim = near_rim.and_then(|(rim, rays)| NearGrazing::new(curve, rim, rays, x));
    waves.extend(rim.iter().flat_map(|rim| rim.about_axes(reach)));
    waves
}
