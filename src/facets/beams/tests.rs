//! Tests of `beams`.

use super::*;
use glam::DMat3;
use std::f64::consts::PI;

fn bodies() -> Vec<Body> {
    vec![
        Body::hexagonal_column(1.3).unwrap(),
        Body::hexagonal_column(0.1).unwrap(),
        Body::triangular_prism(1.1, 2.0).unwrap(),
        Body::cuboid(1.0).unwrap(),
        Body::octahedron().unwrap(),
        Body::pyramidal_crystal(1.0, 0.98).unwrap(),
        Body::bullet(2.0, 0.98).unwrap(),
    ]
}

fn turn(k: u32) -> DMat3 {
    let k = f64::from(k);
    DMat3::from_rotation_z(0.7 * k) * DMat3::from_rotation_y(1.9 * k) * DMat3::from_rotation_x(k)
}

/// Whatever the body and its orientation, all light is told of.
#[test]
fn energy_closes() {
    let mut worst = 0.0f64;
    for body in bodies() {
        for k in 0..40 {
            let light = Incidence { index: 1.31.into(), size_parameter: 100.0 };
            let settings = Settings { last_order: 15, least_power: 1e-7 };
            let beams = split(&body.turned(&turn(k)), &light, &settings);
            worst = worst.max(beams.budget.residual.abs());
            assert!(beams.budget.truncated < 0.5);
        }
    }
    assert!(worst < 1e-10, "{worst:e}");
    assert!(worst < 1e-12, "as measured: {worst:e}");
}

/// So it does with absorption; strong absorption leaves the reflected light.
#[test]
fn absorbed_light_is_told_of() {
    for (k, x) in [(1e-6, 100.0), (1e-3, 100.0), (1e-2, 1000.0)] {
        for body in bodies() {
            let light = Incidence { index: Complex64::new(1.31, k), size_parameter: x };
            let beams = split(&body.turned(&turn(3)), &light, &Settings::default());
            let budget = &beams.budget;
            assert!(budget.residual.abs() < 1e-12, "{k} {budget:?}");
            let through: f64 = budget.left_by_order[1..].iter().sum();
            assert!(x < 500.0 || (through < 1e-3 && budget.absorbed > 0.85), "{budget:?}");
        }
    }
    // thin: all that is absorbed is k times the mean length; Beer's law on a slab
    let light = Incidence { index: Complex64::new(1.31, 1e-4), size_parameter: 10.0 };
    let plate = Body::cuboid(0.05).unwrap();
    let depth = plate.vertices()[4].z - plate.vertices()[0].z;
    let absorbed = split(&plate, &light, &Settings::default()).budget.absorbed;
    let passes = (1.0 - (0.31f64 / 2.31).powi(2)) / (1.0 - (0.31f64 / 2.31).powi(2));
    let expected = 2.0 * 10.0 * 1e-4 * depth * passes;
    assert!((absorbed / expected - 1.0).abs() < 2e-2, "{absorbed} {expected}");
}

/// Directions of beams through a prism with the light turned about its edge: the least deviation by a
/// wedge is `2 asin(n sin(A/2)) − A`.
#[test]
fn least_deviations_are_those_of_wedges() {
    for (apex, known) in [(60.0f64, 21.8393), (90.0, 45.7334), (80.0, 34.7148)] {
        let body = Body::triangular_prism(apex.to_radians(), 1.0).unwrap();
        let mut least = f64::INFINITY;
        // the edge across the light
        let upright = DMat3::from_rotation_x(0.5 * PI);
        for k in 0..20_000 {
            let turn = DMat3::from_rotation_y(2.0 * PI * f64::from(k) / 20_000.0) * upright;
            let light = Incidence { index: 1.31.into(), size_parameter: 100.0 };
            let settings = Settings { last_order: 1, least_power: 1e-6 };
            let beams = split(&body.turned(&turn), &light, &settings);
            let turned = body.turned(&turn);
            let wedge = |way: DVec3| {
                // by which facet light came in: there its wave vector changes along the normal
                let change = (1.31 * way - DVec3::Z).normalize();
                turned.facets()[..2].iter().any(|f| (f.normal + change).length() < 1e-6)
            };
            let through = beams.patches.iter().filter(|p| {
                let first = p.leaving.order == 1 && p.facet < 2 && p.leaving.power > 1e-6;
                first && wedge(p.inside)
            });
            let angles = through.filter_map(|p| p.leaving.direction).map(|d| d.z.acos());
            least = angles.fold(least, f64::min);
        }
        assert!((least.to_degrees() - known).abs() < 1e-4, "{apex}: {}", least.to_degrees());
    }
}

/// Light the other way along a beam: the same corners, power and Jones matrix.
#[test]
fn beams_run_backwards_too() {
    let body = Body::hexagonal_column(1.0).unwrap().turned(&turn(1));
    let light = Incidence { index: 1.31.into(), size_parameter: 50.0 };
    let settings = Settings { last_order: 4, least_power: 1e-9 };
    let beams = split(&body, &light, &settings);
    let mut seen = 0;
    for there in beams.patches.iter().filter(|p| p.leaving.power > 1e-3 && p.leaving.order > 0) {
        let out = there.leaving.direction.unwrap();
        if (out - DVec3::Z).length() < 1e-6 || (out + DVec3::Z).length() < 1e-6 {
            continue;
        }
        // turn the body so that light along z runs against the beam
        let turn = DMat3::from_quat(glam::DQuat::from_rotation_arc(-out, DVec3::Z));
        let back = split(&body.turned(&turn), &light, &settings);
        let goal = turn * -DVec3::Z;
        let found = back.patches.iter().find(|p| {
            p.leaving.order == there.leaving.order
                && p.leaving.direction.is_some_and(|d| (d - goal).length() < 1e-7)
                && same_jones(there, p, &turn)
        });
        assert!(found.is_some(), "order {} power {}", there.leaving.order, there.leaving.power);
        seen += 1;
    }
    assert!(seen > 5, "{seen}");
}

/// Reciprocity: `b·(J a)` times the cross-section on the far side is the same the other way round.
fn same_jones(there: &Patch, back: &Patch, turn: &DMat3) -> bool {
    let section = |p: &Patch| {
        let out = p.leaving.direction.unwrap();
        p.polygon.area() * out.dot(p.axes[0].cross(p.axes[1]))
    };
    let (a, b) = (DVec3::X, across(there.leaving.direction.unwrap(), DVec3::Z));
    let forth = real(b).project(there.leaving.fields[0]) * section(there);
    // light of polarisation b along −out, in the turned frame; seen along a
    let (b, a) = (*turn * b, *turn * a);
    let received = real(a).project(back.leaving.fields[0]) * b.x
        + real(a).project(back.leaving.fields[1]) * b.y;
    (forth - received * section(back)).norm() < 1e-9
}
