//! Scattering planes: the rays of one order that leave in one plane through the light's axis.
//!
//! For an azimuth `φ₀` all rays of an order whose direction lies in the plane of `φ₀` form a curve on
//! the emitting plane, from the axial ray to the rim. Along it the exit direction has only one
//! coordinate left, the unwrapped angle `ϑ` (scattering angle θ = ϑ on the side of `φ₀`, θ = -ϑ on
//! the far side, both modulo 2π), which turns back at every fold caustic. So the two-dimensional
//! problem of sheets and caustics becomes one of branches of a function of one variable, for any
//! smooth drop.

pub use super::node::Node;
use super::node::Rates;
pub(crate) use super::node::ScannedRay;
use crate::math::scalar::Scalar;
use crate::math::vec3::Vec3;
use crate::optics::AmplitudeMatrix;
use crate::shape::Silhouette;
use crate::trace::{Exit, Tracer, transfer};
use std::f64::consts::{PI, TAU};

/// The rays of one order in one plane.
pub struct ScatteringPlane<'a> {
    /// Traces the rays.
    pub tracer: &'a Tracer<'a>,
    /// Number of chords.
    pub order: u32,
    /// Azimuth of the plane.
    pub azimuth: f64,
    /// Launch point of the axial ray.
    pub(super) centre: [f64; 2],
    along: Vec3<f64>,
    across: Vec3<f64>,
    pub(super) rotational: bool,
}

/// Newton steps allowed; convergence is quadratic.
const STEPS: usize = 12;
/// Step (radians) that is taken without tracing again: what is linear in it follows from the ray's differentials, what is
/// not is below rounding in a path, and fields err by some times the step.
pub(super) const SETTLED: f64 = 1e-6;
/// The same (radii) next to caustics: what parts the two rays there is divided by the root of a small angle.
const SETTLED_NEAR_CAUSTIC: f64 = 1e-13;
/// Closest approach of a launch to the rim, in α.
pub const GRAZING: f64 = 1e-4;
/// Largest turn of the launch azimuth between neighbouring nodes.
const LARGEST_TURN: f64 = 0.25;

impl<'a> ScatteringPlane<'a> {
    /// Prepare the plane of an azimuth; `centre` is the launch point of the order's axial ray.
    pub fn new(tracer: &'a Tracer<'a>, order: u32, azimuth: f64, centre: [f64; 2]) -> Self {
        let (sin, cos) = azimuth.sin_cos();
        Self {
            tracer,
            order,
            azimuth,
            centre,
            along: Vec3 { x: cos, y: sin, z: 0.0 },
            across: Vec3 { x: -sin, y: cos, z: 0.0 },
            rotational: tracer.shape().rotational_symmetry(),
        }
    }

    /// The exit of this order for a launch point, if it leaves.
    pub fn exit<T: Scalar>(&self, place: [T; 2]) -> Option<Exit<T>> {
        self.tracer.trace_order(place[0], place[1], self.order)
    }

    /// Unit vector in the plane at an unwrapped angle, and the vector of growing angle.
    pub fn frame(&self, angle: f64) -> (Vec3<f64>, Vec3<f64>) {
        let (sin, cos) = angle.sin_cos();
        let axis = Vec3 { x: 0.0, y: 0.0, z: 1.0 };
        (self.along * sin + axis * cos, self.along * cos - axis * sin)
    }

    /// Unit normal of the plane.
    pub fn across(&self) -> Vec3<f64> {
        self.across
    }

    /// Transfer of a field in the frames of an unwrapped angle in this plane.
    pub fn transfer<T: Scalar>(&self, exit: &Exit<T>, angle: f64) -> AmplitudeMatrix {
        let (_, growing) = self.frame(angle);
        transfer(
            &exit.field,
            Vec3::real(growing),
            Vec3::real(self.across),
            T::real(self.along.x),
            T::real(self.along.y),
        )
    }

    /// `|∂(β, s⊥)/∂(u, v)|` with the exit ray's impact β in the plane and its direction `s⊥` across:
    /// how rays spread across the plane, without the folds within it.
    pub fn spread_across(&self, exit: &Exit<f64>, angle: f64) -> f64 {
        let (_, growing) = self.frame(angle);
        let impact = |k: usize| exit.dx[k].dot(growing);
        let across = |k: usize| exit.ds[k].dot(self.across);
        impact(0) * across(1) - impact(1) * across(0)
    }

    /// Launch point at `(α, ψ)`, and its derivatives with respect to ψ.
    pub(super) fn place(
        &self,
        silhouette: &Silhouette,
        alpha: f64,
        psi: f64,
    ) -> ([f64; 2], [f64; 2]) {
        let (rim, slope) = silhouette.radius_and_slope(psi);
        let ((sin, cos), reach) = (psi.sin_cos(), alpha.sin());
        let [cu, cv] = self.centre;
        let place = [cu + reach * (rim * cos - cu), cv + reach * (rim * sin - cv)];
        (place, [reach * (slope * cos - rim * sin), reach * (slope * sin + rim * cos)])
    }

    /// The ray at `α` that leaves in the plane, searched from a guess of ψ; its angle is unwrapped
    /// towards `near`. `None` where there is none nearby (total reflection, an axial caustic).
    pub fn node(&self, silhouette: &Silhouette, alpha: f64, guess: f64, near: f64) -> Option<Node> {
        if alpha == 0.0 {
            let exit = self.exit(self.centre)?;
            return Some(self.finish(0.0, guess, self.centre, exit, near));
        }
        let mut psi = guess;
        for _ in 0..STEPS {
            let (place, by_psi) = self.place(silhouette, alpha, psi);
            let exit = self.exit(place)?;
            let turn = exit.ds[0] * by_psi[0] + exit.ds[1] * by_psi[1];
            let (miss, rate) = (exit.direction.dot(self.across), turn.dot(self.across));
            if self.rotational || miss.abs() < 1e-15 {
                return Some(self.finish(alpha, psi, place, exit, near));
            }
            let step = miss / rate;
            if step.is_nan() || step.abs() >= LARGEST_TURN {
                return None;
            }
            psi -= step;
            if step.abs() < SETTLED {
                let aside = by_psi.map(|rate| -step * rate);
                let place = [place[0] + aside[0], place[1] + aside[1]];
                return Some(self.finish(alpha, psi, place, exit.moved(aside), near));
            }
            if (psi - guess).abs() > LARGEST_TURN {
                return None;
            }
        }
        None
    }

    /// What a scan keeps of a node.
    pub(super) fn scanned(&self, node: &Node) -> ScannedRay {
        let Node { alpha, psi, place, angle, exit } = node;
        let (spread, across) = (exit.spread(), self.spread_across(exit, *angle));
        ScannedRay { alpha: *alpha, psi: *psi, place: *place, angle: *angle, spread, across }
    }

    /// What changes along the plane by the launch coordinate, next to a node.
    pub(super) fn rates(&self, silhouette: &Silhouette, node: &Node) -> Rates {
        let (_, by_psi) = self.place(silhouette, node.alpha, node.psi);
        let (rim, _) = silhouette.radius_and_slope(node.psi);
        let ((sin, cos), [cu, cv]) = (node.psi.sin_cos(), self.centre);
        let outward = [rim * cos - cu, rim * sin - cv].map(|way| node.alpha.cos() * way);
        let turn = |way: [f64; 2]| node.exit.ds[0] * way[0] + node.exit.ds[1] * way[1];
        let aside = |way: [f64; 2]| turn(way).dot(self.across);
        let psi = if self.rotational { 0.0 } else { -aside(outward) / aside(by_psi) };
        let place = [0, 1].map(|k| outward[k] + psi * by_psi[k]);
        Rates { angle: turn(place).dot(self.frame(node.angle).1), psi, place }
    }

    fn finish(&self, alpha: f64, psi: f64, place: [f64; 2], exit: Exit<f64>, near: f64) -> Node {
        let raw = exit.direction.dot(self.along).atan2(exit.direction.z);
        let angle = raw + TAU * ((near - raw) / TAU).round();
        Node { alpha, psi, place, angle, exit }
    }

    /// Unwrapped exit angle of a sphere's ray.
    pub(super) fn angle_on_sphere(&self, alpha: f64) -> f64 {
        let inside = (alpha.sin() / self.tracer.index().re).min(1.0).asin();
        self.axis_angle() - 2.0 * alpha + 2.0 * f64::from(self.order) * inside
    }

    /// Unwrapped angle of the axial ray: backward for even orders, forward for odd ones.
    pub fn axis_angle(&self) -> f64 {
        if self.order % 2 == 1 { 0.0 } else { PI }
    }

    /// Search the launch point whose ray leaves at an unwrapped angle in the plane.
    pub fn aim<T: Scalar>(&self, angle: f64, guess: [T; 2]) -> Option<([T; 2], Exit<T>)> {
        let (_, growing) = self.frame(angle);
        let (growing, across) = (Vec3::<T>::real(growing), Vec3::<T>::real(self.across));
        let mut place = guess;
        let mut last_step = f64::INFINITY;
        for _ in 0..2 * STEPS {
            let exit = self.exit(place)?;
            let s = exit.direction;
            let (r1, r2) = (s.dot(growing), s.dot(across));
            let (a, b) = (exit.ds[0].dot(growing), exit.ds[1].dot(growing));
            let (c, d) = (exit.ds[0].dot(across), exit.ds[1].dot(across));
            let det = a * d - b * c;
            let step = [(r1 * d - r2 * b) / det, (r2 * a - r1 * c) / det];
            let size = step[0].size() + step[1].size();
            if size.is_nan() || size >= 0.3 {
                return None;
            }
            place = [place[0] - step[0], place[1] - step[1]];
            if size < SETTLED_NEAR_CAUSTIC || (size < 1e-9 && size > 0.5 * last_step) {
                return Some((place, exit.moved([-step[0], -step[1]])));
            }
            last_step = size;
        }
        None
    }
}

/// Launch point of the ray of an order that leaves along the axis, near the centre.
pub fn axial_ray(tracer: &Tracer, order: u32) -> [f64; 2] {
    if tracer.shape().rotational_symmetry() {
        return [0.0, 0.0];
    }
    let probe = ScatteringPlane::new(tracer, order, 0.0, [0.0, 0.0]);
    let angle = if order % 2 == 1 { 0.0 } else { PI };
    probe.aim(angle, [0.0, 0.0]).map_or([0.0, 0.0], |(place, _)| place)
}

#[cfg(test)]
mod tests;
