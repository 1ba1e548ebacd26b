//! Tests of `fold`.

use super::*;
use crate::shape::Shape;
use crate::trace::Tracer;

const INDEX: f64 = 1.333;

/// Unwrapped angle and path of a sphere's ray.
fn ray(order: u32, b: f64) -> (f64, f64) {
    let (outside, inside) = (b.asin(), (b / INDEX).asin());
    let p = f64::from(order);
    let axis = if order % 2 == 1 { 0.0 } else { std::f64::consts::PI };
    let path = 2.0 * (p * INDEX * inside.cos() - outside.cos());
    (axis + 2.0 * (p * inside - outside), path)
}

/// Impact of the bow (Descartes).
fn bow(order: u32) -> f64 {
    let p = f64::from(order);
    (1.0 - (INDEX * INDEX - 1.0) / (p * p - 1.0)).sqrt()
}

fn with_fold(order: u32, test: impl FnOnce(&Fold, &ScatteringPlane)) {
    let shape = Shape::sphere();
    let tracer = Tracer::new(&shape, INDEX.into(), 100.0, order);
    let silhouette = shape.silhouette();
    let plane = ScatteringPlane::new(&tracer, order, 0.0, [0.0; 2]);
    let alpha = bow(order).asin();
    let node = |alpha: f64| {
        let angle = ray(order, alpha.sin()).0;
        plane.scanned(&plane.node(&silhouette, alpha, 0.0, angle).unwrap())
    };
    let fold =
        Fold::between(&plane, &silhouette, &node(alpha - 0.013), &node(alpha + 0.021)).unwrap();
    test(&fold, &plane);
}

#[test]
fn bows_of_a_sphere_are_descartes_s() {
    for (order, lines) in [(2, 5), (3, 9)] {
        with_fold(order, |fold, _| {
            assert!((fold.alpha.sin() - bow(order)).abs() < 1e-9);
            assert!((fold.angle - ray(order, bow(order)).0).abs() < 1e-13);
            assert_eq!((fold.focal_lines, fold.lit), (lines, -1.0));
        });
    }
}

/// On the lit side mean path and `ζ̂` are those of the two rays in closed form; the functions go
/// on analytically through the fold, where `ζ̂` changes its sign.
#[test]
fn the_pair_s_functions_are_those_of_its_rays() {
    with_fold(2, |fold, plane| {
        let series = fold.sample(plane, 0.1, 0.15, 20).unwrap();
        for delta in [0.003, 0.02, 0.09, 0.14] {
            let wanted = fold.angle - delta;
            let find = |mut low: f64, mut high: f64| {
                for _ in 0..80 {
                    let middle = 0.5 * (low + high);
                    let beyond = (ray(2, middle).0 - wanted) * (ray(2, high).0 - wanted) < 0.0;
                    if beyond { low = middle } else { high = middle }
                }
                ray(2, low).1
            };
            let (inner, outer) = (find(0.3, bow(2)), find(bow(2), 0.9999));
            let ([mean, zeta, ..], _) = series.at(delta);
            assert!((mean - 0.5 * (inner + outer)).abs() < 1e-10, "{delta}");
            let exact = (0.75 * (inner - outer).abs()).powf(2.0 / 3.0);
            assert!((zeta - exact).abs() < 1e-8, "{delta}: {zeta} {exact}");
            assert_eq!((outer > inner) as i32 as f64 * 2.0 - 1.0, fold.larger);
        }
        let ([_, zeta, ..], [_, slope, ..]) = series.at(0.0);
        assert!(zeta.abs() < 1e-9, "{zeta}");
        assert!((slope / fold.strength(plane).unwrap() - 1.0).abs() < 2e-3, "{slope}");
        assert!(series.at(-0.1).0[1] < -0.09 * slope);
    });
}

/// The dark side, from complex rays, continues the lit side: a series through lit rays alone meets it.
#[test]
fn complex_rays_continue_the_pair_to_the_dark_side() {
    with_fold(2, |fold, plane| {
        let both = fold.sample(plane, 0.05, 0.1, 20).unwrap();
        let lit = fold.sample(plane, -1e-4, 0.1, 20).unwrap();
        let (both, lit) = (both.at(-0.002).0, lit.at(-0.002).0);
        for c in 0..PAIR_CHANNELS {
            assert!(
                (both[c] - lit[c]).abs() < 1e-6 * (1.0 + lit[c].abs()),
                "{c}: {} {}",
                both[c],
                lit[c]
            );
        }
    });
}
