//! One ray of a scattering plane, and its neighbours along the plane to first order.

use crate::trace::Exit;

/// One ray of a plane.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// Launch coordinate: `sin α` of the way from the axial ray to the rim.
    pub alpha: f64,
    /// Azimuth of the launch point on the emitting plane, radians.
    pub psi: f64,
    /// Launch point.
    pub place: [f64; 2],
    /// Unwrapped exit angle.
    pub angle: f64,
    /// Where and how the ray leaves.
    pub exit: Exit<f64>,
}

/// What a scan keeps of a ray: where it starts, where it leaves, how its neighbours part.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScannedRay {
    /// Launch coordinate, as in [`Node`].
    pub alpha: f64,
    /// Azimuth of the launch point.
    pub psi: f64,
    /// Launch point.
    pub place: [f64; 2],
    /// Unwrapped exit angle.
    pub angle: f64,
    /// Solid angle per area of the wavefront, signed.
    pub spread: f64,
    /// Its part across the plane.
    pub across: f64,
}

/// What changes along a plane by the launch coordinate α.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rates {
    /// Exit angle.
    pub angle: f64,
    /// Launch azimuth.
    pub psi: f64,
    /// Launch point.
    pub place: [f64; 2],
}

impl Node {
    /// The ray launched at `α + step`, to first order.
    pub(super) fn moved(&self, rates: &Rates, step: f64) -> Self {
        let aside = rates.place.map(|rate| step * rate);
        Self {
            alpha: self.alpha + step,
            psi: self.psi + step * rates.psi,
            place: [self.place[0] + aside[0], self.place[1] + aside[1]],
            angle: self.angle + step * rates.angle,
            exit: self.exit.moved(aside),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::farfield::deflection::scattering_plane::ScatteringPlane;
    use crate::shape::{RaindropModel, Shape};
    use crate::trace::Tracer;

    /// A node moved by a small step is the ray traced there, but for the square of the step.
    #[test]
    fn moved_nodes_are_the_rays_there() {
        const STEP: f64 = 1e-5;
        let shape = Shape::raindrop(0.8e-3, RaindropModel::BeardChuang1987, 0.4).unwrap();
        let tracer = Tracer::new(&shape, 1.333.into(), 100.0, 2);
        let silhouette = shape.silhouette();
        let plane = ScatteringPlane::new(&tracer, 2, 1.1, [0.01, 0.0]);
        let node =
            |alpha: f64| plane.node(&silhouette, alpha, 1.1, plane.angle_on_sphere(alpha)).unwrap();
        let (here, there) = (node(0.7), node(0.7 + STEP));
        let moved = here.moved(&plane.rates(&silhouette, &here), STEP);
        let off = [
            moved.angle - there.angle,
            moved.psi - there.psi,
            moved.place[0] - there.place[0],
            moved.exit.path - there.exit.path,
            moved.exit.reference.dot(plane.across()) - there.exit.reference.dot(plane.across()),
            moved.exit.direction.dot(plane.across()),
        ];
        assert!(off.iter().all(|off| off.abs() < 20.0 * STEP * STEP), "{off:?}");
        assert!((there.angle - here.angle).abs() > 1e3 * STEP * STEP);
    }
}
