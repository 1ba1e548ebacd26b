//! The rays of the vertical symmetry plane, and the rainbows among them.

use gonio::trace::{Exit, Tracer};

/// One ray of the plane.
pub(super) struct PlaneRay {
    pub impact: f64,
    pub exit: Exit<f64>,
    /// Points where the ray meets the surface, in the frame of the light (along z, upper side x).
    pub points: Vec<[f64; 2]>,
}

/// A ray of stationary deviation.
pub(super) struct Rainbow {
    pub impact: f64,
    pub deviation: f64,
}

/// The ray at an impact parameter, if it leaves in this order.
pub(super) fn trace(tracer: &Tracer, order: u32, impact: f64) -> Option<PlaneRay> {
    let mut points = Vec::new();
    let exit = tracer.trace_with_points(impact, 0.0, order, &mut points)?;
    Some(PlaneRay { impact, exit, points })
}

/// Stationary points of the deviation: zeros of the in-plane derivative of the exit direction.
pub(super) fn rainbows(tracer: &Tracer, order: u32, lower: f64, upper: f64) -> Vec<Rainbow> {
    // So close that two rainbows of one drop never share an interval.
    const SCAN: usize = 4000;
    // Halvings of an interval: beyond the last digit of an impact.
    const HALVINGS: usize = 60;
    let mut found = Vec::new();
    // turn of the direction within the plane, per impact
    let turn = |impact: f64| {
        let ray = trace(tracer, order, impact)?;
        let (s, ds) = (ray.exit.direction, ray.exit.ds[0]);
        Some((s.z * ds.x - s.x * ds.z, ray.exit.scattering_angle()))
    };
    let impact = |i: usize| -lower + (i as f64 + 0.5) / SCAN as f64 * (upper + lower);
    for i in 1..SCAN {
        let (mut a, mut b) = (impact(i - 1), impact(i));
        let (Some((mut fa, _)), Some((fb, _))) = (turn(a), turn(b)) else { continue };
        if fa * fb > 0.0 {
            continue;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (a + b);
            let Some((f, _)) = turn(middle) else { break };
            if f * fa > 0.0 { (a, fa) = (middle, f) } else { b = middle }
        }
        if let Some((_, deviation)) = turn(0.5 * (a + b)) {
            found.push(Rainbow { impact: 0.5 * (a + b), deviation });
        }
    }
    found
}
