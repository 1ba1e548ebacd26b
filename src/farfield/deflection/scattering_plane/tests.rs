//! Tests of `scattering_plane`.

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
