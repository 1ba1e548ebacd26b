//! Tests of `surface_event`.

use super::*;
use crate::shape::Shape;

const INDEX: f64 = 1.4;

fn plain() -> Interface {
    Interface { index: INDEX.into(), curved: None }
}

/// A ray along the light where it meets the surface.
fn launched(shape: &Shape, u: f64, v: f64) -> (Ray<f64>, Tangent<f64>) {
    let position = Vec3::new(u, v, shape.entry(u, v).unwrap());
    let unit = |x: f64, y: f64| Vec3 {
        x: Complex64::from(x),
        y: Complex64::from(y),
        z: Complex64::default(),
    };
    let ray = Ray {
        position,
        direction: Vec3::new(0.0, 0.0, 1.0),
        dx: [Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)],
        ds: [Vec3::default(); 2],
        path: position.z,
        field: [unit(1.0, 0.0), unit(0.0, 1.0)],
        focal_lines: 0,
    };
    (ray, shape.tangent(position))
}

/// Both rays behind the first meeting.
fn parted(shape: &Shape, u: f64, v: f64) -> [Ray<f64>; 2] {
    let (mut ray, tangent) = launched(shape, u, v);
    let event = Event::new(&mut ray, &tangent, &plain());
    [event.reflect(&ray), event.refract(&ray, 1.0 / INDEX).unwrap()]
}

fn length(v: Vec3<f64>) -> f64 {
    v.dot(v).sqrt()
}

#[test]
fn angles_and_powers_are_those_of_snell_and_fresnel() {
    let shape = Shape::spheroid(0.8, 0.3).unwrap();
    for (u, v) in [(0.0, 0.0), (0.3, 0.2), (-0.7, 0.4), (0.1, -0.97)] {
        let (ray, tangent) = launched(&shape, u, v);
        let [back, on] = parted(&shape, u, v);
        let tangential = |s: Vec3<f64>| s - tangent.normal * tangent.normal.dot(s);
        assert!(length(tangential(back.direction) - tangential(ray.direction)) < 1e-14);
        let sine = tangential(on.direction) * INDEX;
        assert!(length(sine - tangential(ray.direction)) < 1e-14);
        assert!(back.direction.dot(tangent.normal) > 0.0);
        assert!(on.direction.dot(tangent.normal) < 0.0);
        assert!((back.power() + on.power() - 1.0).abs() < 1e-14);
        for out in [back, on] {
            assert!((length(out.direction) - 1.0).abs() < 1e-14);
            assert!(out.field.iter().all(|&e| out.direction.project(e).norm() < 1e-14));
        }
    }
}

/// Directions of neighbouring rays by differences.
#[test]
fn differentials_are_those_of_neighbouring_rays() {
    const H: f64 = 1e-6;
    let shape = Shape::spheroid(0.8, 0.3).unwrap();
    let (u, v) = (0.35, -0.5);
    let here = parted(&shape, u, v);
    for (k, (du, dv)) in [(H, 0.0), (0.0, H)].into_iter().enumerate() {
        let (before, behind) = (parted(&shape, u - du, v - dv), parted(&shape, u + du, v + dv));
        for way in 0..2 {
            let turned = (behind[way].direction - before[way].direction) * (0.5 / H);
            assert!(length(turned - here[way].ds[k]) < 1e-8, "{way} {k}");
            let moved = (behind[way].position - before[way].position) * (0.5 / H);
            assert!(length(moved - here[way].dx[k]) < 1e-8, "{way} {k}");
        }
    }
}

#[test]
fn beyond_the_critical_angle_all_is_reflected() {
    let shape = Shape::sphere();
    let position = Vec3::new(0.0, 0.0, 1.0);
    let critical = (1.0 / INDEX).asin();
    for (angle, leaves) in [(critical - 1e-3, true), (critical + 1e-3, false)] {
        let mut ray = launched(&shape, 0.0, 0.0).0;
        ray.position = position;
        ray.direction = Vec3::new(angle.sin(), 0.0, angle.cos());
        ray.field[0] = Vec3::new(angle.cos(), 0.0, -angle.sin()).carry(1.0.into());
        let event = Event::new(&mut ray, &shape.tangent(position), &plain());
        assert_eq!(event.refract(&ray, INDEX).is_some(), leaves);
        let kept = event.reflect(&ray).power();
        assert!(if leaves { kept < 0.9 } else { (kept - 1.0).abs() < 1e-14 }, "{kept}");
    }
}

/// Near normal incidence the plane is of no consequence, but there is one.
#[test]
fn there_is_a_plane_of_incidence_at_normal_incidence() {
    for normal in [Vec3::new(0.0, 0.0, -1.0), Vec3::new(-1.0, 0.0, 0.0)] {
        let plane = plane_of_incidence(-normal, normal);
        assert!((length(plane) - 1.0).abs() < 1e-15 && plane.dot(normal).abs() < 1e-15);
    }
    let [on_axis, beside] = [0.0, 1e-9].map(|u| parted(&Shape::sphere(), u, 0.0)[0].field);
    for (a, b) in on_axis.iter().zip(beside) {
        assert!((a.x - b.x).norm() + (a.y - b.y).norm() < 1e-8);
    }
}

/// Far from grazing a curved interface of a large particle is flat.
#[test]
fn curvature_counts_near_grazing_only() {
    let shape = Shape::sphere();
    let curved = Interface { curved: Some(1e4), ..plain() };
    let power = |interface: &Interface, u: f64| {
        let (mut ray, tangent) = launched(&shape, u, 0.0);
        Event::new(&mut ray, &tangent, interface).reflect(&ray).power()
    };
    assert_eq!(power(&curved, 0.5), power(&plain(), 0.5));
    assert!((power(&curved, 0.9) - power(&plain(), 0.9)).abs() < 1e-5);
    assert!((power(&curved, 0.9999) - power(&plain(), 0.9999)).abs() > 1e-3);
}
