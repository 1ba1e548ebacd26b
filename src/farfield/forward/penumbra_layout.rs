//! Where the edge wave is known: the taper from rays to the integral, the integral's nodes by impact,
//! and the angles of its knots; the same for all normals of an outline.

use crate::farfield::branch::window::Window;
use crate::math::gauss_legendre;
use std::f64::consts::{PI, TAU};

/// The angles at which profiles are known, and where the integral takes over from rays.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    pub size_parameter: f64,
    /// Weight of the integral, by the cosine of the grazing angle.
    pub taper: Window,
    /// Nodes of the integral by impact over the radius of the circle along the light, the cosine of
    /// the grazing angle there, on both sides of the edge, with their weights.
    pub nodes: Vec<(f64, f64)>,
    /// Impact of the carrier, from the edge.
    pub shift: f64,
    /// Angles at which profiles are known: evenly about the axis, then beyond it on the side of the
    /// edge, then across the axis.
    pub angles: Vec<f64>,
    /// How many of them lie about the axis and on the side of the edge.
    pub about_axis: usize,
    pub near_side: usize,
}

impl Layout {
    pub(crate) fn new(x: f64) -> Self {
        /// Wave zones between the edge and the end of the taper, Fresnel zones of a ray within it.
        const WAVE_ZONES: f64 = 4.0;
        const FRESNEL_ZONES: f64 = 30.0;
        const TUNNEL: f64 = 2.6;
        const PENUMBRA: f64 = 8.0;
        const KNOTS_PER_PERIOD: f64 = 6.0;
        const FARTHEST: f64 = 3.0;
        let wave_zone = 0.5 * (2.0 / x).powf(2.0 / 3.0);
        let full = (1.0 - WAVE_ZONES * wave_zone).max(0.3);
        let fresnel_zone = ((1.0 - full * full).sqrt() / (2.0 * x)).sqrt();
        let start = (full - FRESNEL_ZONES * fresnel_zone).max(0.5 * full);
        let taper = Window { start, full };
        let tunnel = TUNNEL * x.powf(-2.0 / 3.0);
        let inner = 2.0 * start.acos();
        let axial = near_axis(x);
        let lit = (inner + 6.0 / (x * (full - start))).min(FARTHEST);
        let dark = (PENUMBRA * x.cbrt().recip()).min(FARTHEST);
        let half_band = 0.5 * (1.0 - start + tunnel);
        let about_axis = (2.0 * axial * x * half_band * KNOTS_PER_PERIOD / TAU).ceil() as usize + 8;
        let step = 2.0 * axial / (about_axis - 1) as f64;
        let mut angles: Vec<f64> = (0..about_axis).map(|k| k as f64 * step - axial).collect();
        let near = beyond_axis(x, lit);
        let near_side = near.len();
        angles.extend(near);
        angles.extend(beyond_axis(x, dark).into_iter().map(|angle| -angle));
        Self {
            size_parameter: x,
            taper,
            nodes: nodes(taper, tunnel, x * (inner + lit.max(dark).max(axial))),
            shift: tunnel - half_band,
            angles,
            about_axis,
            near_side,
        }
    }
}

/// Gauss–Legendre nodes from the start of the taper to the edge and from there to where tunnelling
/// ends, for a phase that changes by at most `rate` per length.
fn nodes(taper: Window, tunnel: f64, rate: f64) -> Vec<(f64, f64)> {
    /// How far inside the start of the taper the integral begins, in lengths from there to the
    /// edge: on deformed particles the ray of that grazing angle may lie there.
    const INWARD: f64 = 0.3;
    const PER_PERIOD: f64 = 3.5;
    const PANEL: usize = 32;
    let start = (taper.start - INWARD * (1.0 - taper.start)).max(0.01);
    let panel = gauss_legendre::nodes(PANEL);
    let mut all = Vec::new();
    for (from, to) in [(start, 1.0), (1.0, 1.0 + tunnel)] {
        let panels = (PER_PERIOD * (to - from) * rate / TAU / PANEL as f64).ceil().max(1.0);
        let half = 0.5 * (to - from) / panels;
        for k in 0..panels as usize {
            let begin = from + 2.0 * half * k as f64;
            all.extend(panel.iter().map(|(node, w)| (begin + half * (1.0 + node), half * w)));
        }
    }
    all
}

/// Knots from exactly the end of the stretch about the axis to `reach`: close enough for the wave
/// zone, which is `(2/x)^{1/3}` wide, and closer next to the axis, where the waves of a sharp edge
/// grow. None where that stretch reaches farther.
fn beyond_axis(x: f64, reach: f64) -> Vec<f64> {
    const STEP_BY_ANGLE: f64 = 0.08;
    const STEP_BY_ZONE: f64 = 0.12;
    const LONGEST: f64 = 0.03;
    let step = (STEP_BY_ZONE * (2.0 / x).cbrt()).min(LONGEST);
    let mut angles = vec![near_axis(x)];
    while let Some(&last) = angles.last().filter(|&&last| last < reach) {
        angles.push((last + step.min(STEP_BY_ANGLE * last)).min(reach));
    }
    if angles.len() > 1 { angles } else { Vec::new() }
}

/// Angle up to which the wave is an integral along the outline: 20 lobes of the forward peak.
pub fn near_axis(size_parameter: f64) -> f64 {
    (20.0 * PI / size_parameter).min(PI)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The nodes integrate polynomials over the taper and the tunnel, on both sides of the edge.
    #[test]
    fn nodes_integrate_over_taper_and_tunnel() {
        for x in [60.0f64, 1000.0, 3e4] {
            let layout = Layout::new(x);
            let start = layout.taper.start;
            let from = (start - 0.3 * (1.0 - start)).max(0.01);
            let to = 1.0 + 2.6 * x.powf(-2.0 / 3.0);
            let sum = |f: fn(f64) -> f64| layout.nodes.iter().map(|(b, w)| w * f(*b)).sum::<f64>();
            assert!((sum(|_| 1.0) - (to - from)).abs() < 1e-13, "{x}");
            assert!((sum(|b| b.powi(4)) - (to.powi(5) - from.powi(5)) / 5.0).abs() < 1e-12, "{x}");
            // no node upon the edge, where the cosine's square root begins
            assert!(layout.nodes.iter().all(|(b, _)| (b - 1.0).abs() > 1e-9));
            assert!(start < layout.taper.full && layout.taper.full < 1.0);
        }
    }

    /// Knots: even about the axis, then from exactly there outward on either side.
    #[test]
    fn angles_cover_the_axis_and_both_sides() {
        for x in [60.0, 1000.0, 3e4] {
            let layout = Layout::new(x);
            let (axial, rest) = layout.angles.split_at(layout.about_axis);
            let edge = near_axis(x);
            assert!(
                (axial[0] + edge).abs() < 1e-12 && (axial[axial.len() - 1] - edge).abs() < 1e-12
            );
            let step = axial[1] - axial[0];
            assert!(axial.windows(2).all(|w| (w[1] - w[0] - step).abs() < 1e-12));
            let (near, far) = rest.split_at(layout.near_side);
            for side in [near.to_vec(), far.iter().map(|a| -a).collect::<Vec<_>>()] {
                assert!(side.first().is_none_or(|&first| first == edge), "{x}");
                assert!(side.windows(2).all(|w| w[0] < w[1] && w[1] - w[0] <= 0.08 * w[0] + 1e-12));
            }
        }
        assert!(beyond_axis(1000.0, 0.01).is_empty());
        assert_eq!(beyond_axis(1000.0, 0.5).last(), Some(&0.5));
    }
}
