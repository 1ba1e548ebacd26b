//! Tests of `tracer`.

use super::*;
use crate::shape::RaindropModel;
use std::f64::consts::PI;

const INDEX: f64 = 1.333;

fn drop() -> Shape {
    Shape::raindrop(1e-3, RaindropModel::BeardChuang1987, 0.4).unwrap()
}

/// Rays caught in a prolate body by total reflection, where absorption per hit is less than what the complex
/// interface would add: they lose what they have, and no more.
#[test]
fn caught_rays_do_not_grow() {
    let shape = Shape::spheroid(1.15, 0.0).unwrap();
    for k in [1e-5, 1e-3, 7e-3] {
        let tracer = Tracer::new(&shape, Complex64::new(1.31, k), 15.78, 5);
        let (mut sum, mut count) = (0.0, 0.0);
        for (i, j) in (0..40).flat_map(|i| (0..40).map(move |j| (i, j))) {
            let place = |n: i32| (f64::from(n) - 19.5) / 20.0;
            let rest =
                tracer.trace_to_the_end(place(i), place(j), |exit: Exit<f64>| sum += exit.power());
            let Some(rest) = rest else { continue };
            assert!((0.0..1.0 + 2.0 * k.sqrt()).contains(&rest.absorbed), "{rest:?}");
            sum += rest.absorbed + rest.truncated + rest.totally_reflected;
            count += 1.0;
        }
        // coefficients of an absorbing interface add up to 1 but for a part of k
        let off = sum / count - 1.0;
        assert!(off.abs() < 6.0 * k, "k = {k}: {off}");
    }
}

/// Path `2 (p n cos θt - cos θi)`, deviation `2 (θi - θt) + (p - 1)(π - 2 θt)`, impact as at the
/// entry.
#[test]
fn rays_of_a_sphere_are_known() {
    let shape = Shape::sphere();
    let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 5);
    for b in [0.1, 0.5, 0.8, 0.97f64] {
        let (outside, inside) = (b.asin(), (b / INDEX).asin());
        for p in 0..=5 {
            let exit = tracer.trace_order(0.6 * b, 0.8 * b, p).unwrap();
            let order = f64::from(p);
            let path = 2.0 * (order * INDEX * inside.cos() - outside.cos());
            assert!((exit.path - path).abs() < 1e-13, "{p} {b}");
            let deviation = 2.0 * (outside - inside) + (order - 1.0) * (PI - 2.0 * inside);
            assert!((exit.direction.z - deviation.cos()).abs() < 1e-13, "{p} {b}");
            assert!((exit.reference.dot(exit.reference).sqrt() - b).abs() < 1e-13);
        }
    }
}

/// `|dΩ/dA| = |sin Θ Θ'/(b)|` with the deviation's slope, and the focal lines on both sides of a bow.
#[test]
fn the_spread_of_a_sphere_s_rays_is_known() {
    let shape = Shape::sphere();
    let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 3);
    for (b, p, lines) in [(0.4, 0, 0), (0.4, 1, 2), (0.6, 2, 2), (0.95, 2, 3), (0.98, 3, 5)] {
        let exit = tracer.trace_order(b, 0.0, p).unwrap();
        let order = f64::from(p);
        let slope = 2.0 / (1.0 - b * b).sqrt() - 2.0 * order / (INDEX * INDEX - b * b).sqrt();
        let expected = (exit.scattering_angle().sin() * slope / b).abs();
        assert!((exit.spread().abs() - expected).abs() < 1e-11 * expected.max(1.0), "{p} {b}");
        assert_eq!(exit.focal_lines, lines, "{p} {b}");
    }
}

/// On a raindrop, by neighbouring rays: derivatives of direction and reference point, and Hamilton's
/// `dW = -x_ref · ds`.
#[test]
fn differentials_are_those_of_neighbouring_rays() {
    const H: f64 = 1e-5;
    let shape = drop();
    let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 3);
    for p in 0..=3 {
        let at = |du: f64, dv: f64| tracer.trace_order(0.35 + du, -0.5 + dv, p).unwrap();
        let exit = at(0.0, 0.0);
        for (k, (du, dv)) in [(H, 0.0), (0.0, H)].into_iter().enumerate() {
            let (a, b) = (at(-du, -dv), at(du, dv));
            let turned = (b.direction - a.direction) * (0.5 / H) - exit.ds[k];
            assert!(turned.dot(turned).sqrt() < 1e-6, "{p}: {turned:?}");
            let moved = (b.reference - a.reference) * (0.5 / H);
            let moved = moved - exit.direction * moved.dot(exit.direction) - exit.dx[k];
            assert!(moved.dot(moved).sqrt() < 1e-6, "{p}: {moved:?}");
            let path = (b.path - a.path) / (2.0 * H) + exit.reference.dot(exit.ds[k]);
            assert!(path.abs() < 1e-7, "{p}: {path}");
        }
    }
}

/// One way through visits the exits that are asked for one by one, and power adds up; where the
/// medium absorbs, but for a small part of k at every interface.
#[test]
fn exits_come_in_order_and_power_adds_up() {
    let shape = drop();
    for (k, bound) in [(0.0, 1e-13), (1e-4, 1e-6)] {
        let tracer = Tracer::new(&shape, Complex64::new(INDEX, k), 1000.0, 4);
        let (mut left, mut next) = (0.0, 0);
        let rest = tracer.trace(0.2, 0.7, |exit| {
            let alone = tracer.trace_order(0.2, 0.7, exit.order).unwrap();
            let found = (exit.order, exit.path, exit.spread());
            assert_eq!(found, (next, alone.path, alone.spread()));
            next += 1;
            left += exit.power();
        });
        let rest = rest.unwrap();
        assert_eq!(next, 5);
        assert!((left + rest.absorbed + rest.truncated - 1.0).abs() < bound, "{rest:?}");
        assert_eq!(rest.absorbed > 0.0, k > 0.0);
    }
    assert!(Tracer::new(&shape, INDEX.into(), 1.0, 4).trace(1.2, 0.0, |_| {}).is_none());
}

/// The first chord takes what Beer's law says.
#[test]
fn chords_absorb_by_beer_s_law() {
    let shape = drop();
    let index = Complex64::new(INDEX, 1e-4);
    let first = Tracer::new(&shape, index, 1000.0, 1);
    let mut meetings = Vec::new();
    first.trace_with_meetings(0.2, 0.7, 1, &mut meetings).unwrap();
    let chord = (meetings[1].path - meetings[0].path) / INDEX;
    let reflected = first.trace_order(0.2, 0.7, 0).unwrap().power();
    let beer = (1.0 - reflected) * (1.0 - (-2.0 * 1000.0 * 1e-4 * chord).exp());
    let rest = first.trace(0.2, 0.7, |_| {}).unwrap();
    assert!((rest.absorbed - beer).abs() < 1e-6, "{rest:?} {beer}");
    // later chords take more, out of what would be left
    let end = first.trace_to_the_end(0.2, 0.7, |_| {}).unwrap();
    assert!(end.absorbed > 1.01 * rest.absorbed, "{end:?}");
    let both = |r: &Remainder| r.absorbed + r.truncated;
    assert!((both(&end) - both(&rest)).abs() < 1e-14);
}

/// A complex ray with real coordinates is the real ray, and exits are analytic in them.
#[test]
fn complex_rays_continue_real_ones() {
    const H: f64 = 1e-5;
    let shape = drop();
    let tracer = Tracer::new(&shape, INDEX.into(), 100.0, 2);
    let at = |du: Complex64| tracer.trace_order(0.3 + du, Complex64::from(0.6), 2).unwrap();
    let real = tracer.trace_order(0.3, 0.6, 2).unwrap();
    let (here, i) = (at(0.0.into()), Complex64::i());
    assert!((here.path - real.path).norm() < 1e-13);
    assert!((here.spread() - real.spread()).norm() < 1e-12);
    let slope = (at(i * H).path - at(-i * H).path) / (2.0 * H * i);
    assert!((slope + real.reference.dot(real.ds[0])).norm() < 1e-7, "{slope}");
}
