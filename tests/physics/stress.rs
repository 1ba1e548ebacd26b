//! Stability under stress: the corners of what may be asked, and identities that must hold there.
//! The table of everything that was tried is in `validation/engine.md`.

use gonio::optics::AmplitudeMatrix;
use gonio::phase_table::Slab;
use gonio::plan::{Engine, LARGEST_K_OVER_N, Plan, PlanError, last_order};
use gonio::scene::{Scene, SceneFile};
use gonio::series::lorenz_mie::Sphere;
use gonio::shape::{RaindropModel, Shape};
use gonio::simulate;
use gonio::trace::Tracer;
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const WATER: Complex64 = Complex64::new(1.333, 0.0);

/// All orders that matter, and forward diffraction.
fn plan(shape: Shape, index: f64, tolerance: f64) -> Plan {
    let orders = (0..=last_order(index, tolerance)).collect();
    Plan::direct(shape, 1.0, Engine::Meridians, orders, true, tolerance, None)
}

/// Named orders without diffraction.
fn plan_of(shape: Shape, orders: &[u32]) -> Plan {
    Plan::direct(shape, 1.0, Engine::Meridians, orders.to_vec(), false, 0.01, None)
}

fn drop(radius_mm: f64, sun_deg: f64) -> Shape {
    Shape::raindrop(radius_mm * 1e-3, RaindropModel::BeardChuang1987, sun_deg.to_radians()).unwrap()
}

/// Directions on one azimuth, both ends of the axis in.
fn line(count: usize, azimuth: f64) -> Vec<(f64, f64)> {
    (0..=count).map(|i| (PI * i as f64 / count as f64, azimuth)).collect()
}

fn finite(amplitudes: &[AmplitudeMatrix]) -> bool {
    amplitudes.iter().all(|s| s.s11().is_finite())
}

/// Scattered power over what falls on the shadow twice (the extinction paradox), for a rotationally
/// symmetric pattern.
fn power_ratio(amplitudes: &[AmplitudeMatrix], directions: &[(f64, f64)], x: f64) -> f64 {
    let step = directions[1].0 - directions[0].0;
    let sum: f64 = amplitudes.iter().zip(directions).map(|(s, d)| s.s11() * d.0.sin() * step).sum();
    sum / (x * x)
}

fn scene(toml: &str) -> Scene {
    let text = gonio::scene::SceneText::parse("stress", toml.into()).unwrap();
    Scene::from_text(text, &SceneFile::default()).unwrap()
}

fn slab(scene: &Scene) -> Slab {
    let plan = Plan::new(scene).unwrap();
    let slab = simulate::slab(scene, &plan, scene.wavelengths[0]).unwrap();
    assert!(slab.values.iter().all(|v| v.is_finite()));
    slab
}

fn largest_difference(a: &[AmplitudeMatrix], b: &[AmplitudeMatrix]) -> f64 {
    let size = a.iter().map(AmplitudeMatrix::s11).fold(0.0, f64::max).sqrt();
    let difference =
        |(a, b): (&AmplitudeMatrix, &AmplitudeMatrix)| (*a + *b * (-1.0).into()).s11().sqrt();
    a.iter().zip(b).map(difference).fold(0.0, f64::max) / size
}

/// Size parameters from 20 to a million, three shapes: finite everywhere.
#[test]
fn size_parameters_from_20_to_a_million() {
    for x in [20.0, 1e2, 1e3, 1e4, 1e5, 1e6] {
        for shape in [Shape::sphere(), drop(0.5, 20.0), Shape::spheroid(0.8, 0.5).unwrap()] {
            // Orders from 4 on cost time in proportion to the size parameter, see the table.
            let plan = if x < 3e4 {
                plan(shape.clone(), 1.333, 0.01)
            } else {
                plan_of(shape.clone(), &[0, 1, 2, 3])
            };
            let found = simulate::scatter(&plan, WATER, x, &line(360, 0.7));
            assert!(finite(&found), "x = {x}, {shape:?}");
        }
    }
}

/// Radii from a micrometre to 4.5 mm, the sun low, high, along the axis and below the horizon.
#[test]
fn radii_and_suns() {
    for radius in [0.001, 0.01, 0.1, 0.4, 0.41, 1.0, 2.0, 3.0, 4.5] {
        for sun in [-90.0, -30.0, 0.0, 20.0, 89.999, 90.0] {
            let Ok(shape) = Shape::raindrop(
                radius * 1e-3,
                RaindropModel::BeardChuang1987,
                f64::to_radians(sun),
            ) else {
                // the model's end is an error with the range, no panic
                assert!(radius > 3.0, "{radius} mm refused");
                continue;
            };
            let x = TAU * radius * 1e-3 / 650e-9;
            let plan = plan_of(shape, &[0, 1, 2, 3]);
            let found = simulate::scatter(&plan, WATER, x, &line(90, 1.1));
            assert!(finite(&found), "{radius} mm, sun {sun}°");
        }
    }
}

/// Indices from 1.0001 to 4 and below 1: finite, and on the sphere the power is right.
#[test]
fn indices_from_below_one_to_four() {
    for index in [0.5, 0.75, 0.99, 0.9999, 1.0001, 1.01, 1.2, 1.333, 1.5, 1.9999, 2.0, 2.5, 4.0] {
        let m = Complex64::new(index, 0.0);
        for shape in [Shape::sphere(), Shape::spheroid(0.9, 0.4).unwrap(), drop(1.0, 30.0)] {
            let directions = line(180, 0.3);
            let found =
                simulate::scatter(&plan(shape.clone(), index, 0.01), m, 2000.0, &directions);
            assert!(finite(&found), "n = {index}, {shape:?}");
        }
    }
}

/// Absorption up to where the ray picture ends; beyond, refused with the reason.
#[test]
fn absorption_up_to_its_end() {
    for k in [0.0, 1e-12, 1e-8, 1e-5, 1e-3, 0.999 * LARGEST_K_OVER_N * 1.333] {
        let m = Complex64::new(1.333, k);
        let found =
            simulate::scatter(&plan(drop(0.5, 20.0), 1.333, 0.01), m, 5000.0, &line(90, 0.7));
        assert!(finite(&found), "k = {k}");
    }
    let table = |k: f64| {
        scene(&format!(
            "[particle]\nshape = \"raindrop\"\nradius_mm = 0.5\nmedium = {{ index = [1.333, {k}] }}\n\
             [light]\nwavelengths_nm = [650]\n[table]\ntheta_deg = [137, 138]\nazimuth_deg = [0]\n"
        ))
    };
    assert!(Plan::new(&table(0.99 * LARGEST_K_OVER_N * 1.333)).is_ok());
    let refused = Plan::new(&table(1.01 * LARGEST_K_OVER_N * 1.333)).unwrap_err();
    assert!(matches!(refused, PlanError::TooAbsorbing { .. }), "{refused}");
    assert!(refused.to_string().contains("k/n must stay below"), "{refused}");
}

/// Rays at the rim, at normal incidence, at Brewster's angle and about the critical angle.
#[test]
fn singular_rays() {
    let brewster = 1.333f64.atan().sin();
    for shape in [Shape::sphere(), Shape::spheroid(1.0 / 1.3, 0.6).unwrap(), drop(2.0, 20.0)] {
        let tracer = Tracer::new(&shape, WATER, 5000.0, 7);
        for curved in [false, true] {
            let tracer =
                if curved { tracer.clone().with_curved_interface(5000.0) } else { tracer.clone() };
            for psi in [0.0f64, 0.4, FRAC_PI_2, PI] {
                let rim = shape.silhouette().radius(psi);
                for b in [0.0, 1e-300, 1e-12, brewster, 0.5, 1.0 - 1e-6, 1.0 - 1e-9, 1.0 - 1e-12] {
                    let (u, v) = (rim * b * psi.cos(), rim * b * psi.sin());
                    tracer.trace(u, v, |exit| {
                        let fields = exit.field.iter().flat_map(|e| [e.x, e.y, e.z]);
                        let power: f64 = fields.map(|e| e.norm_sqr()).sum();
                        assert!(power.is_finite() && power < 2.0 + 1e-6, "b = {b}: {power}");
                        assert!(exit.path.is_finite() && exit.scattering_angle().is_finite());
                    });
                }
            }
        }
    }
}

/// At θ = 0 and π the frame turns with the azimuth, the field does not: intensities agree for all
/// azimuths, and with the neighbourhood.
#[test]
fn both_ends_of_the_axis() {
    let plan = plan_of(drop(0.5, 20.0), &[0, 1, 2, 3]);
    for (end, beside) in [(0.0, 1e-9), (PI, PI - 1e-9)] {
        let directions: Vec<(f64, f64)> =
            (0..8).flat_map(|k| [(end, 0.8 * k as f64), (beside, 0.8 * k as f64)]).collect();
        let found = simulate::scatter(&plan, WATER, 3000.0, &directions);
        assert!(finite(&found));
        let all: Vec<f64> = found.iter().map(AmplitudeMatrix::s11).collect();
        let (low, high) = all.iter().fold((f64::MAX, 0.0f64), |(l, h), v| (l.min(*v), h.max(*v)));
        println!("θ = {:.0}°: S11 from {low:.6e} to {high:.6e}", end.to_degrees());
        assert!(high - low < 1e-6 * high, "θ = {end}: {all:?}");
    }
}

/// Sphere by the raindrop path, analytic sphere and spheroid of ratio 1: the same amplitudes.
#[test]
fn three_ways_to_a_sphere() {
    let directions = line(1800, 0.7);
    let of = |shape| simulate::scatter(&plan(shape, 1.333, 0.01), WATER, 3000.0, &directions);
    let sphere = of(Shape::sphere());
    for (name, shape) in [
        ("raindrop of 0.3 mm", drop(0.3, 20.0)),
        ("spheroid of ratio 1", Shape::spheroid(1.0, 20f64.to_radians()).unwrap()),
    ] {
        let difference = largest_difference(&sphere, &of(shape));
        println!("{name}: {difference:.1e} of the largest amplitude");
        assert!(difference < 1e-6, "{name}: {difference}");
    }
}

/// Perturbing size, index or axis ratio by 1e-12 changes the amplitudes by no more than the phase
/// explains: the longest path, in radians, times the perturbation.
#[test]
fn small_perturbations_stay_small() {
    let directions = line(360, 0.7);
    let x = 5000.0;
    for (name, shape) in [("sphere", Shape::sphere()), ("raindrop", drop(0.5, 20.0))] {
        let of = |m: f64, x: f64| {
            let plan = plan_of(shape.clone(), &[0, 1, 2, 3]);
            simulate::scatter(&plan, Complex64::new(m, 0.0), x, &directions)
        };
        let base = of(1.333, x);
        // the longest optical path of p = 3 is 2·3·n radii
        let condition = 6.0 * 1.333 * x;
        for (what, changed) in
            [("index", of(1.333 * (1.0 + 1e-12), x)), ("size", of(1.333, x * (1.0 + 1e-12)))]
        {
            let difference = largest_difference(&base, &changed);
            println!("{name}, {what}: {difference:.1e}, phase explains {:.1e}", 1e-12 * condition);
            assert!(difference < 3.0 * 1e-12 * condition, "{name}, {what}: {difference}");
        }
    }
}

/// The same bits for any number of threads.
#[test]
fn threads_do_not_matter() {
    let text = "[particle]\nshape = \"raindrop\"\nradius_mm = 0.5\nmedium = \"water\"\n[light]\n\
                sun_elevation_deg = 20\nwavelengths_nm = [600]\n[table]\n\
                theta_deg = { from = 0, to = 180, count = 91 }\n\
                azimuth_deg = { from = 0, to = 360, count = 25 }\n";
    let scene = scene(text);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| slab(&scene))
    };
    let one = with(1);
    for threads in [2, 3, 7] {
        let other = with(threads);
        assert_eq!(one.values, other.values, "{threads} threads");
        assert_eq!(
            one.scattering_cross_section.to_bits(),
            other.scattering_cross_section.to_bits()
        );
        assert_eq!(one.energy, other.energy);
    }
}

/// A table does not change when its azimuths start elsewhere or are fewer.
#[test]
fn the_azimuth_grid_does_not_matter() {
    for (orders, bound) in
        [("[0, 1, 2]", 2e-3), ("[0, 1, 2, 3]", 2e-3), ("[0, 1, 2, 3, 4, 5, 6, 7]", 5e-3)]
    {
        let table = |azimuths: &str| {
            slab(&scene(&format!(
                "[particle]\nshape = \"raindrop\"\nradius_mm = 0.5\nmedium = \"water\"\n[light]\n\
                 sun_elevation_deg = 20\nwavelengths_nm = [600]\n[table]\n\
                 theta_deg = {{ from = 100, to = 170, count = 71 }}\nazimuth_deg = {azimuths}\n\
                 forward_peak = \"point\"\n[model]\norders = {orders}\n"
            )))
        };
        let whole = table("{ from = 0, to = 360, count = 121 }");
        let shifted = table("{ from = 3, to = 357, count = 119 }");
        let single = table("[42]");
        // the tables cover different parts of the sphere but share the normalisation
        let at = |slab: &Slab, i: usize, j: usize| {
            f64::from(slab.values[[0, i, j]]) * slab.scattering_cross_section
        };
        let top = (0..71).map(|i| at(&whole, i, 14)).fold(0.0, f64::max);
        let worst = |other: &Slab, j: usize| {
            let difference = |i: usize| (at(&whole, i, 14) - at(other, i, j)).abs() / top;
            (0..71).map(difference).fold(0.0, f64::max)
        };
        let (shift, alone) = (worst(&shifted, 13), worst(&single, 0));
        println!("orders {orders}: start shifted {shift:.1e}, one azimuth alone {alone:.1e}");
        assert!(shift < 1e-6 && alone < bound, "orders {orders}: {shift} {alone}");
    }
}

/// Light along the axis: nothing depends on azimuth, though the shape is no sphere.
#[test]
fn light_along_the_axis() {
    for sun in [FRAC_PI_2, -FRAC_PI_2] {
        let shape = Shape::raindrop(1e-3, RaindropModel::BeardChuang1987, sun).unwrap();
        assert!(shape.rotational_symmetry() && !shape.is_sphere());
        let of = |phi: f64| {
            simulate::scatter(&plan(shape.clone(), 1.333, 0.01), WATER, 3000.0, &line(180, phi))
        };
        let reference = of(0.0);
        for phi in [0.9, 2.0, 3.1, 5.5] {
            let difference = largest_difference(&reference, &of(phi));
            assert!(difference < 1e-6, "sun {sun}, azimuth {phi}: {difference}");
        }
    }
}

/// The smallest tables: one azimuth, two scattering angles (one alone has no solid angle and is
/// refused with the reason), one wavelength.
#[test]
fn smallest_tables() {
    let one = "[particle]\nshape = \"sphere\"\nradius_mm = 0.1\nmedium = \"water\"\n[light]\nwavelengths_nm = [550]\n[table]\ntheta_deg = [90]\nazimuth_deg = [0]\n";
    let text = gonio::scene::SceneText::parse("stress", one.into()).unwrap();
    let refused = Scene::from_text(text, &SceneFile::default()).unwrap_err().to_string();
    assert!(refused.contains("at least two scattering angles"), "{refused}");
    for shape in ["sphere", "raindrop"] {
        for method in ["rays", "auto"] {
            for theta in ["0, 1", "90, 90.001", "179, 180", "0, 180"] {
                let found = slab(&scene(&format!(
                    "[particle]\nshape = \"{shape}\"\nradius_mm = 0.5\nmedium = \"water\"\n[light]\n\
                     sun_elevation_deg = 20\nwavelengths_nm = [550]\n[table]\ntheta_deg = [{theta}]\n\
                     azimuth_deg = [0]\nforward_peak = \"point\"\n[model]\nmethod = \"{method}\"\n"
                )));
                assert_eq!(found.values.len(), 2);
                assert!(found.values.iter().all(|v| *v >= 0.0));
            }
        }
    }
}

/// The power that leaves a sphere, from rays through the corners of index and size.
#[test]
fn power_is_conserved_on_the_sphere() {
    let directions = line(20_000, 0.2);
    for (index, x) in [(1.2, 500.0), (1.333, 500.0), (1.5, 500.0)] {
        let plan = plan(Shape::sphere(), index, 0.01);
        let found = simulate::scatter(&plan, Complex64::new(index, 0.0), x, &directions);
        let ratio = power_ratio(&found, &directions, x);
        let exact = Sphere::new(x, index.into()).unwrap().efficiencies().q_sca / 2.0;
        println!(
            "n = {index}, x = {x}: scattered power {ratio:.4} of twice the shadow, Mie {exact:.4}"
        );
        assert!((ratio / exact - 1.0).abs() < 0.04, "n = {index}: {ratio} {exact}");
    }
}
