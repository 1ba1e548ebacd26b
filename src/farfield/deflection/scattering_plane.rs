//! Scattering planes: the rays of one order that leave in one plane through the light's axis.
//!
//! For an azimuth `φ₀` all rays of an order whose direction lies in the plane of `φ₀` form a curve on
//! the emitting plane, from the axial ray to the rim. Along it the exit direction has only one
//! coordinate left, the unwrapped angle `ϑ` (scattering angle θ = ϑ on the side of `φ₀`, θ = -ϑ on
//! the far side, both modulo 2π), which turns back at every fold caustic. So the two-dimensional
//! problem of sheets and caustics becomes one of branches of a function of one variable, for any
//! smooth drop.

use crate::farfield::direction::Direction;
use crate::math::scalar::Scalar;
use crate::math::vec3::Vec3;
use crate::optics::AmplitudeMatrix;
use crate::shape::Silhouette;
use crate::trace::{Exit, Tracer, transfer};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The rays of one order in one plane.
pub struct ScatteringPlane<'a> {
    pub tracer: &'a Tracer<'a>,
    pub order: u32,
    /// Azimuth of the plane.
    pub azimuth: f64,
    /// Launch point of the axial ray.
    centre: [f64; 2],
    along: Vec3<f64>,
    across: Vec3<f64>,
    rotational: bool,
}

/// One ray of a plane.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// Launch coordinate: `sin α` of the way from the axial ray to the rim.
    pub alpha: f64,
    pub psi: f64,
    /// Launch point.
    pub place: [f64; 2],
    /// Unwrapped exit angle.
    pub angle: f64,
    pub exit: Exit<f64>,
}

/// Newton steps allowed; convergence is quadratic.
const STEPS: usize = 12;
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
    fn place(&self, silhouette: &Silhouette, alpha: f64, psi: f64) -> ([f64; 2], [f64; 2]) {
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
            let step = if self.rotational { 0.0 } else { miss / rate };
            if step.is_nan() || step.abs() >= LARGEST_TURN {
                return None;
            }
            if step.abs() < 1e-13 || self.rotational || miss.abs() < 1e-15 {
                return Some(self.finish(alpha, psi, place, exit, near));
            }
            psi -= step;
            if (psi - guess).abs() > LARGEST_TURN {
                return None;
            }
        }
        None
    }

    fn finish(&self, alpha: f64, psi: f64, place: [f64; 2], exit: Exit<f64>, near: f64) -> Node {
        let raw = exit.direction.dot(self.along).atan2(exit.direction.z);
        let angle = raw + TAU * ((near - raw) / TAU).round();
        Node { alpha, psi, place, angle, exit }
    }

    /// Follow the plane from the axial ray to the rim in even steps of α; gaps are `None`.
    ///
    /// Where the plane crosses the axis again, rays of many azimuths leave in almost one direction
    /// and its branches are entangled, within `axis_gap` of the axis. So every stretch between
    /// crossings is followed from its own middle, where rays are nearly those of a sphere, to both
    /// sides, until the first node inside the gap.
    pub fn scan(&self, silhouette: &Silhouette, count: usize, axis_gap: f64) -> Vec<Option<Node>> {
        let mut nodes = vec![None; count];
        let stretches = self.stretches(count);
        for (j, &[from, seed, to]) in stretches.iter().enumerate() {
            let way = Way { plane: self, silhouette, count, axis_gap };
            let start = if j == 0 { self.first_azimuth() } else { self.azimuth };
            let Some(first) = way.seed(seed, start, j > 0) else { continue };
            way.follow(&mut nodes, first, seed..to);
            if seed > from {
                way.follow(&mut nodes, first, (from..=seed).rev());
            }
        }
        nodes
    }

    /// Stretches between crossings of the axis on a sphere: first node, the one to start from, end.
    fn stretches(&self, count: usize) -> Vec<[usize; 3]> {
        let angle = |i: usize| self.angle_on_sphere(self.alpha(i, count)) - self.axis_angle();
        let crossings: Vec<usize> = (2..count)
            .take_while(|&i| angle(i).abs() >= angle(i - 1).abs())
            .filter(|&i| (angle(i) / PI).floor() != (angle(i - 1) / PI).floor())
            .collect();
        let bow = (1..count).find(|&i| angle(i).abs() < angle(i - 1).abs()).unwrap_or(count);
        let mut stretches = vec![[0, 0, crossings.first().copied().unwrap_or(count)]];
        for (j, &from) in crossings.iter().enumerate() {
            let to = crossings.get(j + 1).copied();
            // the angle's middle between the two ends
            let end = to.unwrap_or(bow);
            let middle = 0.5 * (angle(from) + angle(end - 1));
            let off = |i: &usize| (angle(*i) - middle).abs();
            let seed = (from..end).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(from);
            stretches.push([from, seed, to.unwrap_or(count)]);
        }
        stretches
    }

    /// Launch coordinate of a node of the scan.
    fn alpha(&self, i: usize, count: usize) -> f64 {
        (i as f64 + 0.5) * (FRAC_PI_2 - GRAZING) / count as f64
    }

    /// Unwrapped exit angle of a sphere's ray.
    fn angle_on_sphere(&self, alpha: f64) -> f64 {
        let inside = (alpha.sin() / self.tracer.index().re).min(1.0).asin();
        self.axis_angle() - 2.0 * alpha + 2.0 * f64::from(self.order) * inside
    }

    /// Search a ray of the plane at `α` over launch azimuths, for use beyond a crossing of the axis,
    /// where the plane may go on at quite another azimuth.
    fn search(&self, silhouette: &Silhouette, alpha: f64, near: f64, slack: f64) -> Option<Node> {
        const PROBES: usize = 24;
        const REACH: f64 = 1.3;
        let crossing = ((near - self.axis_angle()) / PI).round();
        if crossing == 0.0 || self.rotational {
            return None;
        }
        let probe = |k: usize| {
            let psi = self.azimuth + REACH * (2.0 * k as f64 / PROBES as f64 - 1.0);
            let exit = self.exit(self.place(silhouette, alpha, psi).0)?;
            Some((psi, exit.direction.dot(self.across)))
        };
        let probes: Vec<Option<(f64, f64)>> = (0..=PROBES).map(probe).collect();
        let mut best: Option<Node> = None;
        for pair in probes.windows(2) {
            let (Some(a), Some(b)) = (pair[0], pair[1]) else { continue };
            if a.1 * b.1 > 0.0 {
                continue;
            }
            let guess = a.0 + (b.0 - a.0) * a.1 / (a.1 - b.1);
            let Some(node) = self.node(silhouette, alpha, guess, near) else { continue };
            let off = |n: &Node| (n.angle - near).abs();
            if off(&node) < slack.max(0.2) && best.is_none_or(|b| off(&node) < off(&b)) {
                best = Some(node);
            }
        }
        best
    }

    /// Unwrapped angle of the axial ray: backward for even orders, forward for odd ones.
    pub fn axis_angle(&self) -> f64 {
        if self.order % 2 == 1 { 0.0 } else { PI }
    }

    /// Launch azimuth at the axial ray: where the linear map of directions points along the plane.
    fn first_azimuth(&self) -> f64 {
        let Some(exit) = self.exit(self.centre).filter(|_| !self.rotational) else {
            return self.azimuth;
        };
        // s·across = 0 to first order in the launch point
        let (a, b) = (exit.ds[0].dot(self.across), exit.ds[1].dot(self.across));
        let psi = (-a).atan2(b);
        let turn = (self.azimuth - psi) / PI;
        psi + PI * turn.round()
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
            if size < 1e-13 || (size < 1e-9 && size > 0.5 * last_step) {
                return Some((place, exit));
            }
            place = [place[0] - step[0], place[1] - step[1]];
            last_step = size;
        }
        None
    }
}

/// Following a plane from node to node of a scan.
struct Way<'m, 'a, 's> {
    plane: &'m ScatteringPlane<'a>,
    silhouette: &'s Silhouette<'s>,
    count: usize,
    axis_gap: f64,
}

impl Way<'_, '_, '_> {
    /// The node to start from, with the launch azimuth expected there.
    fn seed(&self, i: usize, azimuth: f64, search: bool) -> Option<Node> {
        let (m, s) = (self.plane, self.silhouette);
        let alpha = m.alpha(i, self.count);
        let near = m.angle_on_sphere(alpha);
        let close = |node: &Node| !search || (node.angle - near).abs() < 0.5;
        m.node(s, alpha, azimuth, near)
            .filter(close)
            .or_else(|| m.search(s, alpha, near, 2.0 * self.axis_gap))
    }

    /// Go from `first` over the nodes of a range; stop inside the gap about the axis.
    fn follow(&self, nodes: &mut [Option<Node>], first: Node, range: impl Iterator<Item = usize>) {
        let (m, s) = (self.plane, self.silhouette);
        let (mut before, mut psi_rate) = (first, 0.0);
        for i in range {
            let alpha = m.alpha(i, self.count);
            let ahead = alpha - before.alpha;
            let near = before.angle + m.angle_on_sphere(alpha) - m.angle_on_sphere(before.alpha);
            let Some(node) = m.node(s, alpha, before.psi + psi_rate * ahead, near) else {
                continue;
            };
            if ahead != 0.0 {
                psi_rate = (node.psi - before.psi) / ahead;
            }
            nodes[i] = Some(node);
            before = node;
            let turns = (node.angle - m.axis_angle()) / PI;
            let crossing = turns.round();
            if crossing != 0.0 && (turns - crossing).abs() * PI < self.axis_gap {
                return;
            }
        }
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

/// The direction of an unwrapped angle in the plane of an azimuth.
pub fn direction(angle: f64, azimuth: f64) -> Direction {
    let wrapped = angle.rem_euclid(TAU);
    if wrapped <= PI {
        Direction::new(wrapped, azimuth)
    } else {
        Direction::new(TAU - wrapped, azimuth + PI)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{RaindropModel, Shape};

    const INDEX: f64 = 1.333;

    fn drop() -> Shape {
        Shape::raindrop(0.8e-3, RaindropModel::BeardChuang1987, 0.4).unwrap()
    }

    fn length(v: Vec3<f64>) -> f64 {
        v.dot(v).sqrt()
    }

    /// The angle goes `2 (p β - α)` from the axis, backward for even orders.
    #[test]
    fn rays_of_a_sphere_have_its_deflection() {
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 5);
        let silhouette = shape.silhouette();
        for order in 0..=5u32 {
            let plane = ScatteringPlane::new(&tracer, order, 0.7, [0.0; 2]);
            for alpha in [0.0, 0.3, 0.9, 1.4f64] {
                let inside = (alpha.sin() / INDEX).asin();
                let axis = if order.is_multiple_of(2) { PI } else { 0.0 };
                let angle = axis + 2.0 * (f64::from(order) * inside - alpha);
                let node = plane.node(&silhouette, alpha, 0.7, angle + 0.4).unwrap();
                assert!((node.angle - angle).abs() < 1e-12, "{order} {alpha}: {}", node.angle);
                assert!((node.place[0].hypot(node.place[1]) - alpha.sin()).abs() < 1e-14);
                let off = plane.frame(node.angle).0 - node.exit.direction;
                assert!(length(off) < 1e-12, "{order} {alpha}");
            }
        }
    }

    /// Neither plane nor handedness matter to a sphere: nothing is turned from one polarisation to the
    /// other, and what is reflected is Fresnel's.
    #[test]
    fn polarisations_keep_apart_on_a_sphere() {
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 2);
        let silhouette = shape.silhouette();
        for (order, azimuth) in [(0, 0.4), (1, 2.0), (2, -1.0)] {
            let plane = ScatteringPlane::new(&tracer, order, azimuth, [0.0; 2]);
            let node = plane.node(&silhouette, 0.8, azimuth, plane.axis_angle()).unwrap();
            let t = plane.transfer(&node.exit, node.angle);
            assert!(t.s3.norm() + t.s4.norm() < 1e-13, "{t:?}");
            let inside = (0.8f64.sin() / INDEX).asin();
            let reflected = (0.8 - inside).sin() / (0.8 + inside).sin();
            let across = match order {
                0 => reflected.abs(),
                _ => (1.0 - reflected * reflected) * reflected.abs().powi(order as i32 - 1),
            };
            assert!((t.s1.norm() - across).abs() < 1e-13, "{order}: {} {across}", t.s1);
        }
    }

    /// On a raindrop the rays found leave in the plane, at their launch coordinate.
    #[test]
    fn nodes_leave_in_their_plane() {
        let shape = drop();
        let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 3);
        let silhouette = shape.silhouette();
        for order in 0..=3 {
            let centre = axial_ray(&tracer, order);
            let plane = ScatteringPlane::new(&tracer, order, 1.1, centre);
            for alpha in [0.2, 0.7, 1.2f64] {
                let near = plane.angle_on_sphere(alpha);
                let node = plane.node(&silhouette, alpha, 1.1, near).unwrap();
                assert!(node.exit.direction.dot(plane.across()).abs() < 1e-13);
                assert!(length(plane.frame(node.angle).0 - node.exit.direction) < 1e-12);
                let [u, v] = [0, 1].map(|k| centre[k] + (node.place[k] - centre[k]) / alpha.sin());
                let rim = silhouette.radius(v.atan2(u));
                assert!((u.hypot(v) - rim).abs() < 1e-12, "{order} {alpha}");
            }
        }
    }

    /// Between two nodes the impact in the plane and the direction across it spread as differences say.
    #[test]
    fn the_spread_across_is_that_of_neighbouring_rays() {
        const H: f64 = 1e-5;
        let shape = drop();
        let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 2);
        let plane = ScatteringPlane::new(&tracer, 2, 0.6, axial_ray(&tracer, 2));
        let node = plane.node(&shape.silhouette(), 0.9, 0.6, plane.angle_on_sphere(0.9)).unwrap();
        let (_, growing) = plane.frame(node.angle);
        let at = |du: f64, dv: f64| {
            let exit = plane.exit([node.place[0] + du, node.place[1] + dv]).unwrap();
            [exit.reference.dot(growing), exit.direction.dot(plane.across())]
        };
        let rates = |du: f64, dv: f64| {
            let (a, b) = (at(-du, -dv), at(du, dv));
            [0, 1].map(|k| (b[k] - a[k]) / (2.0 * H))
        };
        let ([bu, su], [bv, sv]) = (rates(H, 0.0), rates(0.0, H));
        let found = plane.spread_across(&node.exit, node.angle);
        assert!((found - (bu * sv - bv * su)).abs() < 1e-7, "{found}");
    }

    /// Rays are found by their angle, from complex guesses too, and none where there is none.
    #[test]
    fn aiming_finds_the_ray_of_an_angle() {
        let shape = drop();
        let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 2);
        let plane = ScatteringPlane::new(&tracer, 2, 0.3, [0.0; 2]);
        let node = plane.node(&shape.silhouette(), 0.7, 0.3, plane.angle_on_sphere(0.7)).unwrap();
        let guess = [node.place[0] + 0.02, node.place[1] - 0.03];
        let (place, exit) = plane.aim(node.angle, guess).unwrap();
        assert!((place[0] - node.place[0]).hypot(place[1] - node.place[1]) < 1e-12);
        assert!(length(exit.direction - node.exit.direction) < 1e-12);
        let i = num_complex::Complex64::i();
        let (place, _) = plane.aim(node.angle, [guess[0] + i * 0.02, guess[1] - i * 0.01]).unwrap();
        assert!((place[0] - node.place[0]).norm() + (place[1] - node.place[1]).norm() < 1e-11);
        // behind the bow there are complex rays only
        assert!(plane.aim(plane.axis_angle() + 1.2, guess).is_none());
    }

    #[test]
    fn the_axial_ray_leaves_along_the_axis() {
        let shape = drop();
        let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 3);
        for order in 0..=3 {
            let [u, v] = axial_ray(&tracer, order);
            let exit = tracer.trace_order(u, v, order).unwrap();
            let along = if order % 2 == 1 { 1.0 } else { -1.0 };
            assert!((exit.direction.z - along).abs() < 1e-14, "{order}: {:?}", exit.direction);
            assert!(v.abs() < 1e-12);
        }
        assert!(axial_ray(&tracer, 1)[0].abs() > 1e-3);
    }

    #[test]
    fn unwrapped_angles_are_directions_of_either_side() {
        for (angle, theta, azimuth) in [
            (0.3, 0.3, 1.0),
            (-0.3, 0.3, 1.0 + PI),
            (TAU + 0.5, 0.5, 1.0),
            (PI + 0.2, PI - 0.2, 1.0 + PI),
        ] {
            let found = direction(angle, 1.0);
            assert!((found.theta - theta).abs() + (found.phi - azimuth).abs() < 1e-14, "{angle}");
            let shape = Shape::sphere();
            let tracer = Tracer::new(&shape, INDEX.into(), 1.0, 1);
            let unit = ScatteringPlane::new(&tracer, 1, 1.0, [0.0; 2]).frame(angle).0;
            assert!(length(unit - found.unit) < 1e-15);
        }
    }

    /// The stretches of a scan follow on one another and leave nothing out.
    #[test]
    fn stretches_cover_the_scan() {
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 9);
        for (order, crossings) in [(1, 0), (2, 0), (3, 0), (4, 1), (6, 2), (9, 3)] {
            let plane = ScatteringPlane::new(&tracer, order, 0.0, [0.0; 2]);
            let stretches = plane.stretches(160);
            assert_eq!(stretches.len(), 1 + crossings, "{order}: {stretches:?}");
            assert!(stretches[0][0] == 0 && stretches.last().unwrap()[2] == 160);
            assert!(stretches.windows(2).all(|w| w[0][2] == w[1][0]), "{stretches:?}");
            assert!(stretches.iter().all(|[from, seed, to]| from <= seed && seed < to));
        }
    }
}
