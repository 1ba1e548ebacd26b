//! The centre of a family of radial lines: the launch point whose ray passes the particle's middle.

use crate::shape::Silhouette;
use crate::trace::Tracer;
use std::f64::consts::TAU;

/// Launch point of the ray of an order whose line goes through the centre when it has left, near the
/// middle of the shadow.
pub(crate) fn central_ray(
    tracer: &Tracer,
    silhouette: &Silhouette,
    order: u32,
    whole: bool,
) -> Option<[f64; 2]> {
    const STEPS: usize = 40;
    const RADII: usize = 16;
    const AZIMUTHS: usize = 24;
    const LONGEST: f64 = 0.05;
    if !whole {
        return Some([0.0; 2]);
    }
    let impact = |place: [f64; 2]| {
        let exit = tracer.trace_order(place[0], place[1], order)?;
        Some(exit.reference.dot(exit.reference).sqrt())
    };
    let mut nearest = ([0.0; 2], impact([0.0; 2]).unwrap_or(f64::MAX));
    for j in 0..AZIMUTHS {
        let (sin, cos) = (TAU * j as f64 / AZIMUTHS as f64).sin_cos();
        let rim = silhouette.radius(sin.atan2(cos));
        for i in 1..RADII {
            let radius = 0.7 * rim * i as f64 / RADII as f64;
            let place = [radius * cos, radius * sin];
            if let Some(found) = impact(place).filter(|found| *found < nearest.1) {
                nearest = (place, found);
            }
        }
    }
    let mut place = nearest.0;
    for _ in 0..STEPS {
        let exit = tracer.trace_order(place[0], place[1], order)?;
        let [a, b] = exit.dx;
        let (aa, ab, bb) = (a.dot(a), a.dot(b), b.dot(b));
        let (ar, br) = (a.dot(exit.reference), b.dot(exit.reference));
        let determinant = aa * bb - ab * ab;
        let step = [(bb * ar - ab * br) / determinant, (aa * br - ab * ar) / determinant];
        let size = step[0].hypot(step[1]);
        let share = (LONGEST / size).min(1.0);
        place = [place[0] - share * step[0], place[1] - share * step[1]];
        if size < 1e-13 {
            return Some(place);
        }
    }
    None
}
