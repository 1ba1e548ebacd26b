//! Tests of `far_field`.

use super::*;
use crate::facets::Body;
use crate::facets::beams::{Settings, split};
use glam::DMat3;

fn turned(body: Body, k: f64) -> Body {
    let turn = DMat3::from_rotation_z(0.7 * k) * DMat3::from_rotation_y(1.9 * k);
    body.turned(&(turn * DMat3::from_rotation_x(k)))
}

fn of(body: &Body, index: Complex64, size_parameter: f64) -> (FarField, Beams) {
    let light = Incidence { index, size_parameter };
    let beams = split(body, &light, &Settings { last_order: 12, least_power: 1e-5 });
    (FarField::new(&beams, &light), beams)
}

/// The sum in lanes against the polygons one by one, with and without loss.
#[test]
fn lanes_are_the_polygons_one_by_one() {
    for index in [Complex64::new(1.31, 0.0), Complex64::new(1.31, 2e-3)] {
        let body = turned(Body::hexagonal_column(1.0).unwrap(), 1.0);
        let (far, _) = of(&body, index, 40.0);
        let directions = [(0.0, 0.0), (0.3, 1.0), (1.2, -0.4), (2.9, 2.0), (1.5, 0.0)];
        for (direction, found) in directions.iter().zip(far.amplitudes(&directions)) {
            let way = Frame::new(*direction).way;
            let mut sums = NOTHING;
            for source in &far.sources {
                let slope = [0, 1].map(|c| source.slope[c] - way.dot(source.axes[c]));
                let turns = source.phase - way.dot(source.centre);
                let wave = Complex64::cis(TAU * turns) * source.left;
                let f = source.transform(far.wavenumber, slope) * wave;
                for (polarisation, sum) in sums.iter_mut().enumerate() {
                    let kinds = [source.electric, source.magnetic];
                    for (sum, e) in sum.iter_mut().zip(kinds.map(|e| e[polarisation])) {
                        for (part, e) in sum.iter_mut().zip([e.x, e.y, e.z]) {
                            part[0][0] += (f * e).re;
                            part[1][0] += (f * e).im;
                        }
                    }
                }
            }
            let wanted = far.matrix(&Frame::new(*direction), &sums, 0);
            assert!((wanted - found).s11() < 1e-22 * far.wavenumber.powi(4), "{direction:?}");
        }
    }
}

/// A plate across the light is a slab: straight ahead its amplitude is that of Airy's sum over all
/// reflections, behind that of the reflected sum.
#[test]
fn a_plate_is_a_slab() {
    for index in [Complex64::new(1.31, 0.0), Complex64::new(1.5, 1e-3)] {
        let (x, body) = (60.0, Body::cuboid(0.03).unwrap());
        let light = Incidence { index, size_parameter: x };
        let beams = split(&body, &light, &Settings { last_order: 40, least_power: 1e-40 });
        let ahead = FarField::new(&beams, &light).amplitudes(&[(0.0, 0.0), (PI, 0.0)]);
        let depth = 2.0 * body.vertices()[4].z;
        let r = (1.0 - index) / (1.0 + index);
        let pass = (Complex64::i() * index * x * depth).exp();
        let through =
            (1.0 - r * r) * pass / (1.0 - r * r * pass * pass) * Complex64::cis(-x * depth);
        let back =
            r * (1.0 - pass * pass) / (1.0 - r * r * pass * pass) * Complex64::cis(-x * depth);
        let scale = x * x * beams.shadow / TAU;
        // what is missing: real directions and lengths, complex coefficients
        let bound = 1e-12 + 2.0 * index.im;
        let forward = scale * (1.0 - through);
        assert!((ahead[0].s1 - forward).norm() < bound * scale, "{} {forward}", ahead[0].s1);
        assert!((ahead[0].s2 - forward).norm() < bound * scale);
        // B&H: reflected is r = −k²A/2π S1 with S2 = −S1 behind
        assert!((ahead[1].s1.norm() - scale * back.norm()).abs() < bound * scale);
        assert!((ahead[1].s1 + ahead[1].s2).norm() < 1e-12 * scale);
    }
}

/// Mirror images: a body that is its own image in the plane of scattering does not turn polarisation.
#[test]
fn planes_of_symmetry_keep_polarisation() {
    let turn = DMat3::from_rotation_y(0.4);
    for body in [Body::hexagonal_column(1.2).unwrap(), Body::cuboid(0.7).unwrap()] {
        let (far, _) = of(&body.turned(&turn), 1.31.into(), 50.0);
        let largest = far.amplitudes(&[(0.0, 0.0)])[0].s11().sqrt();
        for theta in [0.2, 1.0, 2.3, 3.0] {
            for s in far.amplitudes(&[(theta, 0.0), (theta, PI)]) {
                assert!(s.s3.norm() + s.s4.norm() < 1e-9 * largest, "{theta}: {s:?}");
            }
            let [a, b] = [0.7, -0.7].map(|phi| far.amplitudes(&[(theta, phi)])[0]);
            assert!((a.s1 - b.s1).norm() + (a.s2 - b.s2).norm() < 1e-9 * largest);
            assert!((a.s3 + b.s3).norm() + (a.s4 + b.s4).norm() < 1e-9 * largest);
        }
    }
}

/// The optical theorem over orientations: a large body takes out twice its shadow.
#[test]
fn extinction_is_twice_the_shadow() {
    let (mut extinction, mut shadow) = (0.0, 0.0);
    for k in 0..200 {
        let body = turned(Body::octahedron().unwrap(), f64::from(k) + 0.5);
        let (far, beams) = of(&body, 1.31.into(), 150.0);
        let ahead = far.amplitudes(&[(0.0, 0.0)])[0];
        extinction += TAU / 150.0f64.powi(2) * (ahead.s1 + ahead.s2).re;
        shadow += beams.shadow;
    }
    assert!((extinction / shadow / 2.0 - 1.0).abs() < 0.02, "{}", extinction / shadow);
}

/// Babinet: behind a body that lets nothing through is the field of its shadow, with the sign of what is
/// missing; near the axis that is a scalar transform of the silhouette.
#[test]
fn a_black_body_diffracts_as_its_shadow() {
    let body = Body::cuboid(1.0).unwrap();
    let (far, beams) = of(&body, Complex64::new(1.31, 0.1), 300.0);
    let side = beams.shadow.sqrt();
    let scale = 300.0f64.powi(2) * beams.shadow / TAU;
    for theta in [0.0, 0.002, 0.01, 0.03] {
        let h = 150.0 * side * f64::sin(theta);
        let shape = if h == 0.0 { 1.0 } else { h.sin() / h };
        let s = far.amplitudes(&[(theta, 0.0)])[0];
        assert!((s.s1 / scale - shape).norm() < 0.03, "{theta}: {} {shape}", s.s1 / scale);
    }
}
