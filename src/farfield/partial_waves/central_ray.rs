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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;
    use num_complex::Complex64;

    /// The central ray's line misses the centre by rounding; upright bodies have it on the axis of the shadow.
    #[test]
    fn the_line_goes_through_the_centre() {
        for (elevation, aside) in [(0.0, false), (0.4, true)] {
            let shape = Shape::spheroid(0.8, elevation).unwrap();
            let tracer = Tracer::new(&shape, Complex64::from(1.33), 100.0, 2);
            let silhouette = shape.silhouette();
            for order in [1, 2] {
                let place = central_ray(&tracer, &silhouette, order, true).unwrap();
                let exit = tracer.trace_order(place[0], place[1], order).unwrap();
                assert!(exit.reference.dot(exit.reference).sqrt() < 1e-12, "{elevation} {order}");
                assert_eq!(place[0].hypot(place[1]) > 1e-6, aside, "{elevation} {order} {place:?}");
            }
            assert_eq!(central_ray(&tracer, &silhouette, 1, false), Some([0.0; 2]));
        }
    }
}
