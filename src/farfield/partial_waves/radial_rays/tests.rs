//! Tests of `radial_rays`.

use super::*;
use crate::shape::Shape;

/// Both series are those of what they stand for, next to grazing incidence; the path's ends where the
/// ray meets the surface squarely.
#[test]
fn series_are_those_of_the_angle_and_the_path() {
    for sin in [0.0, 0.1, 0.25f64] {
        let left = sin.powi(11);
        assert!((angle_series(sin) - sin.asin()).abs() <= 0.03 * left + 1e-16, "{sin}");
        let path = Grazing::path_outside(sin);
        assert!((path_series(sin) - path).abs() <= 3.3 * sin.powi(13) + 1e-16, "{sin}");
    }
    assert_eq!(path_series(1.0), 0.0);
    assert!((angle_series(-0.3) + angle_series(0.3)).abs() < 1e-16);
}

/// Turned back, everything along a line of a sphere is constant or zero, up to the last ray: the impact
/// is the launch point, path and directions are a sphere's.
#[test]
fn a_sphere_s_rays_are_constant_along_the_line() {
    for (order, index) in [(1u32, 1.333), (2, 1.333), (3, 1.5)] {
        let shape = Shape::sphere();
        let tracer = Tracer::new(&shape, Complex64::from(index), 100.0, order);
        let silhouette = shape.silhouette();
        let way = Way::new(&tracer, &silhouette, order, [0.0; 2], 0.7);
        assert!(way.last_real().unwrap() > 0.999);
        let sense = way.sense(0.9).unwrap();
        let row = |s: f64| way.row((s / index).asin(), sense).unwrap();
        let first = row(0.3);
        assert!((first.impact - 1.0).abs() < 1e-12);
        assert!(first.path.abs() + first.inside.abs() < 1e-12);
        let all = |ray: RadialRay| -> Vec<f64> {
            let RadialRay { impact, path, inside, direction, aside, density, meetings, normal } =
                ray;
            let vectors = [direction, aside].into_iter().chain(meetings).flatten();
            let pairs = [density, normal].into_iter().flatten();
            [impact, path, inside].into_iter().chain(vectors).chain(pairs).collect()
        };
        for s in [0.1, 0.6, 0.9, 0.99] {
            for (c, (a, b)) in all(row(0.3)).into_iter().zip(all(row(s))).enumerate() {
                assert!((a - b).abs() < 1e-8, "{order} {s} {c}: {a} {b}");
            }
        }
        // direction and impact are square to each other and of unit length
        let [d, a] = [first.direction, first.aside].map(|[x, y, z]| Vec3 { x, y, z });
        assert!((d.dot(d) - 1.0).abs() + (a.dot(a) - 1.0).abs() + d.dot(a).abs() < 1e-12);
    }
}

/// Half the path of a sphere's waves by the sine is the angle inside, times the order and the index.
#[test]
fn the_sphere_s_path_grows_with_its_angle() {
    const H: f64 = 1e-5;
    let path = |s: f64| path_on_sphere(3, 1.333, (s / 1.333).asin());
    for s in [0.2, 0.9, 1.1] {
        let rate = (path(s + H) - path(s - H)) / (2.0 * H);
        assert!((rate - 6.0 * (s / 1.333f64).asin()).abs() < 1e-8, "{s}: {rate}");
    }
}

/// The frame goes with the ray: carried through a refraction it keeps its angles to the plane of
/// incidence; the surface mirrors it.
#[test]
fn frames_are_carried_and_mirrored() {
    let shape = Shape::sphere();
    let tracer = Tracer::new(&shape, Complex64::from(1.5), 100.0, 2);
    let mut meetings = Vec::new();
    let exit = tracer.trace_with_meetings(0.4, 0.5, 2, &mut meetings).unwrap();
    let axis = Vec3 { x: 0.6, y: 0.8, z: 0.0 };
    let mut frame = [axis, axis.cross(meetings[0].direction)];
    for (hit, meeting) in meetings.iter().enumerate() {
        let next = meetings.get(hit + 1).map_or(exit.direction, |next| next.direction);
        let mirrored = hit == 1;
        let parts = frame.map(|axis| axis.dot(meeting.perpendicular));
        frame = frame.map(|axis| carried(axis, meeting, next, mirrored));
        let [a, b] = frame;
        assert!(a.dot(next).abs() + b.dot(next).abs() + a.dot(b).abs() < 1e-13);
        assert!((a.dot(a) - 1.0).abs() + (b.dot(b) - 1.0).abs() < 1e-13);
        for (axis, part) in frame.iter().zip(parts) {
            assert!((axis.dot(meeting.perpendicular) - part).abs() < 1e-14);
        }
        let hand = a.cross(next).dot(b).signum();
        assert_eq!(hand, if hit == 0 { 1.0 } else { -1.0 }, "{hit}");
    }
}
