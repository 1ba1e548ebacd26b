//! One drop, one answer: orders of raindrops that are right in every direction, hold the power that rays
//! bring, are the same from both ends of a path and whatever else is asked for, and do not jump.
//!
//! Figures: `cargo test --release --test physics one_drop:: -- --nocapture`; `validation/one_drop.md`.

use super::reciprocity::{Path, turned};
use gonio::farfield::{FarField, FarFieldSettings};
use gonio::optics::AmplitudeMatrix;
use gonio::series::debye::{DebyeSeries, Term};
use gonio::shape::{RaindropModel, Shape};
use gonio::trace::{Tracer, Wavefront, energy_by_fate};
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

const INDEX: Complex64 = Complex64::new(1.3314, 0.0);

fn raindrop(radius_mm: f64, sun_deg: f64) -> Shape {
    let model = RaindropModel::BeardChuang1987;
    Shape::raindrop(radius_mm * 1e-3, model, sun_deg.to_radians()).unwrap()
}

fn size_parameter(radius_mm: f64) -> f64 {
    TAU * radius_mm * 1e-3 / 650e-9
}

/// One order of a particle.
fn with_order<R>(shape: &Shape, x: f64, order: u32, ask: impl FnOnce(&FarField) -> R) -> R {
    with_order_within(0.01, shape, x, order, ask)
}

/// The same within a tolerance, which decides on how many planes are traced.
fn with_order_within<R>(
    tolerance: f64,
    shape: &Shape,
    x: f64,
    order: u32,
    ask: impl FnOnce(&FarField) -> R,
) -> R {
    let tracer = Tracer::new(shape, INDEX, x, order.max(1)).with_curved_interface(x);
    let settings =
        FarFieldSettings { size_parameter: x, orders: &[order], tolerance, diffraction: false };
    ask(&FarField::meridians(&tracer, &settings))
}

fn line(theta: &[f64], phi: f64) -> Vec<(f64, f64)> {
    theta.iter().map(|&t| (t, phi)).collect()
}

fn power(column: &[AmplitudeMatrix]) -> f64 {
    column.iter().map(AmplitudeMatrix::s11).sum()
}

/// Relative L2 error of the whole amplitude matrix.
fn error(found: &[AmplitudeMatrix], truth: &[AmplitudeMatrix]) -> f64 {
    let off: f64 = found.iter().zip(truth).map(|(f, t)| (*f - *t).s11()).sum();
    (off / power(truth)).sqrt()
}

/// The surface of large drops has a hollow below, which rays leave and must not be found beyond of.
#[test]
fn rays_of_large_drops_lose_nothing() {
    let mut worst = (0.0f64, 0.0, 0.0);
    for radius in [2.9, 3.2, 3.3, 3.5, 3.7, 3.9, 4.0, 4.1, 4.3, 4.5] {
        for sun in [-90.0, -60.0, -30.0, 0.0, 20.0, 50.0, 90.0f64] {
            let model = RaindropModel::ChuangBeard1990;
            let shape = Shape::raindrop(radius * 1e-3, model, sun.to_radians()).unwrap();
            let tracer = Tracer::new(&shape, INDEX, size_parameter(radius), 7);
            let fates = energy_by_fate(&tracer, &Wavefront::midpoints(&shape, 60, 60));
            if fates.residual.abs() > worst.0 {
                worst = (fates.residual.abs(), radius, sun);
            }
        }
    }
    println!("light unaccounted for: {:.1e} at {} mm, sun {}°", worst.0, worst.1, worst.2);
    assert!(worst.0 < 1e-6, "{worst:?}");
}

/// A raindrop of 400.1 µm, all but a sphere, against Debye terms in bands of 5°: within 1.5 times the
/// error of the sphere of 400.0 µm, and 1 %. The drop's deformation (1e-5 of the radius) turns the phase of a
/// whole band by up to 0.1, which is not counted. Bands that hold less than a thousandth of the order's mean
/// power are left out.
#[test]
fn drops_that_are_all_but_round_are_as_good_as_spheres() {
    const BANDS: usize = 34;
    const IN_BAND: usize = 60;
    let x = size_parameter(0.4001);
    let drop = raindrop(0.4001, 20.0);
    assert!(!drop.rotational_symmetry());
    let count = (BANDS * IN_BAND) as f64;
    let theta: Vec<f64> = (0..BANDS * IN_BAND)
        .map(|i| (5.0 + 170.0 * (i as f64 + 0.5) / count).to_radians())
        .collect();
    let series = DebyeSeries::new(x, INDEX).unwrap();
    let mut faults = Vec::new();
    for order in 1..=4 {
        let exact: Vec<AmplitudeMatrix> = series
            .sum_parallel(&[Term::Order(order)], &theta)
            .iter()
            .map(|&(s1, s2)| AmplitudeMatrix { s1, s2, ..Default::default() })
            .collect();
        let of = |shape: &Shape| {
            with_order(shape, x, order, |rays| rays.scatter(&line(&theta, 0.7), false))
        };
        let (sphere, drop) = (of(&Shape::sphere()), of(&drop));
        for band in 0..BANDS {
            let part = band * IN_BAND..(band + 1) * IN_BAND;
            let truth = &exact[part.clone()];
            if power(truth) < 1e-3 * power(&exact) / BANDS as f64 {
                continue;
            }
            let errors =
                [&sphere, &drop].map(|found| error_but_for_phase(&found[part.clone()], truth));
            // known defect: the penumbra of order 2, which reaches to the axis, is missing
            let known = [(2, 29..BANDS, 0.2)];
            if let Some((.., bound)) = known.iter().find(|k| k.0 == order && k.1.contains(&band)) {
                assert!(errors[1] < *bound, "p = {order}, band {band}: {}", errors[1]);
                continue;
            }
            if errors[1] > 1.5 * errors[0] + 0.01 {
                let [sphere, drop] = errors.map(|e| 1e2 * e);
                let from = 5 + 5 * band;
                faults.push(format!("p = {order}, {from}°: {drop:.2} %, sphere {sphere:.2} %"));
            }
        }
    }
    println!("{} bands off", faults.len());
    assert!(faults.is_empty(), "{} bands:\n{}", faults.len(), faults.join("\n"));
}

/// Relative L2 error of S1 and S2, the phase of the whole apart.
fn error_but_for_phase(found: &[AmplitudeMatrix], truth: &[AmplitudeMatrix]) -> f64 {
    let together: Complex64 =
        found.iter().zip(truth).map(|(f, t)| 0.5 * (f.s1 * t.s1.conj() + f.s2 * t.s2.conj())).sum();
    let off = power(found) + power(truth) - 2.0 * together.norm();
    (off.max(0.0) / power(truth)).sqrt()
}

/// `tests/data/raindrop_orders_huygens_fresnel.json` (its header tells how it was made and where it holds),
/// directions of an uncertainty below 1 %. It has plain Fresnel coefficients, so that rays that leave near
/// total reflection differ.
#[test]
fn orders_of_raindrops_against_a_sum_over_wavefronts() {
    let text = include_str!("../data/raindrop_orders_huygens_fresnel.json");
    let file: serde_json::Value = serde_json::from_str(text).unwrap();
    let number = |v: &serde_json::Value| v.as_f64().unwrap();
    for case in file["cases"].as_array().unwrap() {
        let (radius, order) = (number(&case["radius_mm"]), number(&case["order"]) as u32);
        let phi = number(&case["azimuth_deg"]).to_radians();
        let rows = case["rows"].as_array().unwrap().iter();
        let rows: Vec<Vec<f64>> = rows
            .map(|row| row.as_array().unwrap().iter().map(number).collect::<Vec<f64>>())
            .filter(|row| row[9] < 0.01)
            .collect();
        if rows.len() < 10 {
            continue;
        }
        let theta: Vec<f64> = rows.iter().map(|row| row[0].to_radians()).collect();
        let entry = |row: &[f64], k: usize| Complex64::new(row[k], row[k + 1]);
        let matrix = |row: &Vec<f64>| AmplitudeMatrix {
            s1: entry(row, 1),
            s2: entry(row, 3),
            s3: entry(row, 5),
            s4: entry(row, 7),
        };
        let truth: Vec<AmplitudeMatrix> = rows.iter().map(matrix).collect();
        let shape = raindrop(radius, 20.0);
        let found = with_order(&shape, size_parameter(radius), order, |rays| {
            rays.scatter(&line(&theta, phi), false)
        });
        let mut single: Vec<f64> =
            found.iter().zip(&truth).map(|(f, t)| error(&[*f], &[*t])).collect();
        single.sort_by(f64::total_cmp);
        let (all, median) = (error(&found, &truth), single[single.len() / 2]);
        println!(
            "{radius} mm, p = {order}, {:.0}°: {:.2} %, median {:.2} %",
            phi.to_degrees(),
            1e2 * all,
            1e2 * median
        );
        let bound = if order < 3 { [0.011, 0.004] } else { [0.055, 0.055] };
        assert!(all < bound[0] && median < bound[1], "{radius} mm, {order}, {phi}: {all}");
    }
}

/// Azimuths of a table, degree by degree, over the half-turn that is computed.
fn whole_degrees() -> Vec<f64> {
    (0..=180).map(|degree| f64::from(degree).to_radians()).collect()
}

/// One order asked for as a table does, all azimuths at once, and in one direction alone.
#[test]
fn tables_and_single_directions_agree() {
    let theta: Vec<f64> = (2..178).map(|t| f64::from(t).to_radians()).collect();
    for (radius, sun) in [(0.45, 20.0), (0.7, 20.0), (1.25, 20.0)] {
        let (shape, x) = (raindrop(radius, sun), size_parameter(radius));
        for order in 0..=4 {
            let azimuths = whole_degrees();
            let some = [0, 33, 90, 151].map(|k: usize| azimuths[k]);
            let table = with_order(&shape, x, order, |rays| rays.columns(&theta, &some, false));
            let mean: f64 = table.iter().map(|c| power(&c.amplitude)).sum::<f64>() / 4.0;
            let mut worst = 0.0f64;
            for (column, &phi) in table.iter().zip(&some) {
                let single =
                    with_order(&shape, x, order, |rays| rays.scatter(&line(&theta, phi), false));
                let off: f64 =
                    single.iter().zip(&column.amplitude).map(|(a, b)| (*a - *b).s11()).sum();
                worst = worst.max((off / mean).sqrt());
            }
            println!("{radius} mm, p = {order}: {:.3} %", 1e2 * worst);
            assert!(worst < 5e-3, "{radius} mm, p = {order}: {worst}");
        }
    }
}

/// Planes whose rays get lost are filled from those beside them: others stand elsewhere with another tolerance.
#[test]
fn lost_planes_leave_no_trace() {
    let theta: Vec<f64> = (300..1700).map(|t| (0.1 * f64::from(t)).to_radians()).collect();
    let azimuths: Vec<f64> = (0..9).map(|k| (84.0 + 2.0 * f64::from(k)).to_radians()).collect();
    let (shape, x) = (raindrop(0.5, 20.0), 1.3 * size_parameter(0.5));
    for order in [5, 6] {
        let [coarse, fine] = [0.01, 0.004].map(|tolerance| {
            let ask = |rays: &FarField| rays.columns(&theta, &azimuths, false);
            with_order_within(tolerance, &shape, x, order, ask)
        });
        let pairs = coarse.iter().zip(&fine).map(|(a, b)| error(&a.amplitude, &b.amplitude));
        let worst = pairs.fold(0.0, f64::max);
        println!("p = {order}: {:.3} %", 1e2 * worst);
        assert!(worst < 6e-3, "p = {order}: {worst}");
    }
}

/// Power of one order over the sphere, in units of the light on the shadow, and that of its rays.
fn power_and_budget(shape: &Shape, x: f64, order: u32) -> (f64, f64) {
    const ANGLES: usize = 1440;
    const AZIMUTHS: usize = 12;
    let step = PI / ANGLES as f64;
    let theta: Vec<f64> = (0..ANGLES).map(|i| (i as f64 + 0.5) * step).collect();
    let azimuths: Vec<f64> =
        (0..AZIMUTHS).map(|j| PI * (j as f64 + 0.5) / AZIMUTHS as f64).collect();
    let columns = with_order(shape, x, order, |rays| rays.columns(&theta, &azimuths, false));
    let sum: f64 = columns
        .iter()
        .flat_map(|c| c.amplitude.iter().zip(&theta))
        .map(|(s, t)| s.s11() * t.sin())
        .sum();
    let power = sum * step * TAU / AZIMUTHS as f64 / (x * x) / shape.silhouette().area();
    let tracer = Tracer::new(shape, INDEX, x, order.max(1));
    let fates = energy_by_fate(&tracer, &Wavefront::midpoints(shape, 100, 100));
    (power, fates.left_by_order[order as usize])
}

/// Power of each order over that of its rays.
#[test]
fn orders_hold_the_power_of_their_rays() {
    for radius in [0.3, 0.5, 0.6, 0.8, 1.0, 1.5] {
        let mut row = Vec::new();
        for order in 1..=5 {
            let (power, budget) =
                power_and_budget(&raindrop(radius, 20.0), size_parameter(radius), order);
            let ratio = power / budget;
            row.push(format!("{ratio:.3}"));
            // high orders tunnel at the rim: a sphere's hold up to 22 % more than rays at this size
            let [low, high] = [[0.99, 1.01], [0.98, 1.03], [0.97, 1.05], [0.9, 1.13], [0.7, 1.23]]
                [order as usize - 1];
            assert!((low..high).contains(&ratio), "{radius} mm, p = {order}: {ratio}");
        }
        println!("{radius} mm: {}", row.join(" "));
    }
}

/// Light's path backwards: random directions brighter than a twentieth of the order's mean.
#[test]
fn orders_of_raindrops_are_reciprocal() {
    const PATHS: usize = 5;
    for radius in [1.0, 1.5] {
        let x = size_parameter(radius);
        for order in 1..=3 {
            let sun = 20f64.to_radians();
            // evenly over the sphere, in no order
            let paths: Vec<Path> = (1..200)
                .map(|k| {
                    let place = |ratio: f64| (f64::from(k) * ratio).fract();
                    let theta = (1.0 - 2.0 * place(0.754_877_666)).acos();
                    Path { sun, theta, phi: PI * place(0.569_840_291) }
                })
                .filter(|path| path.theta > 0.05 && path.theta < 3.09)
                .collect();
            let directions: Vec<(f64, f64)> = paths.iter().map(|p| (p.theta, p.phi)).collect();
            let direct = with_order(&raindrop(radius, 20.0), x, order, |rays| {
                rays.scatter(&directions, false)
            });
            let mean = power(&direct) / direct.len() as f64;
            let bright = paths.iter().zip(&direct).filter(|(_, s)| s.s11() > 0.05 * mean);
            let mut errors: Vec<f64> = bright
                .take(PATHS)
                .map(|(path, found)| {
                    let back = path.reversed();
                    let shape = raindrop(radius, back.sun.to_degrees());
                    let back = with_order(&shape, x, order, |rays| {
                        rays.scatter(&[(back.theta, back.phi)], false)[0]
                    });
                    error(&[turned(back)], &[*found])
                })
                .collect();
            errors.sort_by(f64::total_cmp);
            println!(
                "{radius} mm, p = {order}: median {:.2} %, worst {:.2} %",
                1e2 * errors[errors.len() / 2],
                1e2 * errors[errors.len() - 1]
            );
            let (median, worst) = (errors[errors.len() / 2], errors[errors.len() - 1]);
            assert!(median < 5e-3 && worst < 0.15, "{radius} mm, p = {order}: {median} {worst}");
        }
    }
}

/// Powers of bands of 10°, mean over azimuths, of drops whose radius grows by 0.1 %, where methods take over
/// from each other.
#[test]
fn nothing_jumps_with_the_radius() {
    const STEPS: u32 = 4;
    let theta: Vec<f64> = (0..1700).map(|i| (5.0 + 0.1 * f64::from(i)).to_radians()).collect();
    let azimuths: Vec<f64> = (0..12).map(|j| PI * (f64::from(j) + 0.5) / 12.0).collect();
    for (order, radius) in [(4, 0.545), (3, 1.06), (2, 1.37), (1, 2.0)] {
        let bands = |k: u32| -> Vec<f64> {
            let radius = radius * (1.0 + 1e-3 * f64::from(k));
            let (shape, x) = (raindrop(radius, 20.0), size_parameter(radius));
            let columns =
                with_order(&shape, x, order, |rays| rays.columns(&theta, &azimuths, false));
            let band = |b: usize| -> f64 {
                let part =
                    |c: &gonio::farfield::Column| power(&c.amplitude[100 * b..100 * b + 100]);
                columns.iter().map(part).sum::<f64>() / (x * x)
            };
            (0..17).map(band).collect()
        };
        let all: Vec<Vec<f64>> = (0..STEPS).map(bands).collect();
        let mean = all[0].iter().sum::<f64>() / 17.0;
        let mut worst = 0.0f64;
        for pair in all.windows(2) {
            for (a, b) in pair[0].iter().zip(&pair[1]).filter(|(a, _)| **a > 0.05 * mean) {
                worst = worst.max((b / a - 1.0).abs());
            }
        }
        println!("p = {order}, from {radius} mm: {:.2} % per 0.1 %", 1e2 * worst);
        assert!(worst < 0.05, "p = {order}, from {radius} mm: {worst}");
    }
}
