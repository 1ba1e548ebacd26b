//! Rain by rays: the mean over sizes that a table takes, orders as powers, against the coherent sum over very many
//! drops, all waves of each as amplitudes.

use gonio::plan::Plan;
use gonio::scene::{Scene, SceneFile, SceneText};
use gonio::simulate;
use gonio::size_distribution::{SizeDistribution, SizeLaw};
use gonio::sun_disc::smooth_over_sun;
use rayon::prelude::*;
use std::f64::consts::TAU;

const WAVELENGTH: f64 = 550e-9;
const LIMITS: (f64, f64) = (1e-4, 1.5e-3);

fn scene(particle: &str, more: &str) -> Scene {
    let text = format!(
        "[particle]\nshape = 'raindrop'\n{particle}\n[light]\nwavelengths_nm = [550]\n{more}\n[table]\n\
         theta_deg = {{ from = 20, to = 175, count = 1551 }}\nazimuth_deg = [0]\n[model]\nmethod = 'rays'\n\
         tolerance = 0.02\n"
    );
    Scene::from_text(SceneText::parse("rain", text).unwrap(), &SceneFile::default()).unwrap()
}

/// Mean `dC/dΩ` (m²/sr) of every second of `count` drops of even radii, and of the others.
fn coherent(count: usize, theta: &[f64]) -> [Vec<f64>; 2] {
    let sizes =
        SizeDistribution::between(SizeLaw::marshall_palmer(5.0), LIMITS.0, LIMITS.1).unwrap();
    let step = (LIMITS.1 - LIMITS.0) / count as f64;
    let directions: Vec<(f64, f64)> = theta.iter().map(|&theta| (theta, 0.0)).collect();
    let of_drop = |i: usize| {
        let radius = LIMITS.0 + (i as f64 + 0.5) * step;
        let scene = scene(&format!("radius_mm = {:?}", radius * 1e3), "");
        let mut plan = Plan::new(&scene).unwrap();
        plan.checked = false;
        let index = scene.medium.index(WAVELENGTH).unwrap();
        let found = simulate::scatter(&plan, index, TAU * radius / WAVELENGTH, &directions);
        let area = (WAVELENGTH / TAU).powi(2) * sizes.density(radius) * step;
        found.iter().map(|matrix| area * matrix.s11()).collect::<Vec<f64>>()
    };
    let half = |first: usize| {
        let none = || vec![0.0; theta.len()];
        let add = |mut sum: Vec<f64>, drop: Vec<f64>| {
            sum.iter_mut().zip(drop).for_each(|(sum, value)| *sum += 2.0 * value);
            sum
        };
        let drops = (first..count).step_by(2).collect::<Vec<_>>().into_par_iter().map(of_drop);
        drops.fold(none, add).reduce(none, |mut sum, more| {
            sum.iter_mut().zip(more).for_each(|(sum, value)| *sum += value);
            sum
        })
    };
    [half(0), half(1)]
}

/// Root mean square over bands of 4° of relative errors, each the root of the squared differences over that of the
/// squared values: as a table states it.
fn by_band(theta: &[f64], found: &[f64], known: &[f64]) -> f64 {
    let mut bands = [[0.0; 2]; 46];
    for ((theta, found), known) in theta.iter().zip(found).zip(known) {
        let band = &mut bands[(theta.to_degrees() / 4.0).round() as usize];
        band[0] += (found - known).powi(2);
        band[1] += known * known;
    }
    let filled: Vec<f64> =
        bands.iter().filter(|[_, light]| *light > 0.0).map(|[off, light]| off / light).collect();
    (filled.iter().sum::<f64>() / filled.len() as f64).sqrt()
}

/// Marshall & Palmer's rain of 5 mm/h, one azimuth. `GONIO_DROPS` of them (2000 take hours of a processor).
#[test]
#[ignore = "hours of processor time with 2000 drops"]
fn orders_as_powers_make_the_coherent_mean() {
    let count = std::env::var("GONIO_DROPS").map_or(2000, |count| count.parse().unwrap());
    let rain = "size_distribution = { kind = 'marshall-palmer', rain_rate_mm_h = 5, from_radius_mm = 0.1, \
                to_radius_mm = 1.5 }";
    for (disc, bound) in [(false, 0.02), (true, 0.01)] {
        let light = if disc { "sun_disc = 'limb-darkened'" } else { "" };
        let scene = scene(rain, light);
        let theta = &scene.theta;
        let slab = simulate::table(&scene).unwrap().slabs.remove(0);
        let found: Vec<f64> = slab
            .values
            .index_axis(ndarray::Axis(0), 0)
            .column(0)
            .iter()
            .map(|value| slab.scattering_cross_section * f64::from(*value))
            .collect();
        let seen = |curve: Vec<f64>| match disc {
            false => curve,
            true => {
                smooth_over_sun(theta, &curve, WAVELENGTH, gonio::color::SUN_ANGULAR_RADIUS, theta)
            }
        };
        // once for both
        static HALVES: std::sync::OnceLock<[Vec<f64>; 2]> = std::sync::OnceLock::new();
        let halves = HALVES.get_or_init(|| coherent(count, theta)).clone().map(seen);
        let known: Vec<f64> =
            halves[0].iter().zip(&halves[1]).map(|(a, b)| 0.5 * (a + b)).collect();
        let own = 0.5 * by_band(theta, &halves[0], &halves[1]);
        // the disc reaches beyond the ends
        let inside = 5..theta.len() - 5;
        let error = by_band(&theta[inside.clone()], &found[inside.clone()], &known[inside]);
        let without_own = (error * error - own * own).max(0.0).sqrt();
        println!(
            "disc {disc}: off {:.2} %, of which {:.2} % is the coherent sum's; stated {:.2} %",
            100.0 * error,
            100.0 * own,
            100.0 * slab.error_by_band
        );
        assert!(without_own < bound, "{disc}: {without_own}");
        let stated = slab.error_by_band / without_own;
        assert!((0.5..2.0).contains(&stated), "{disc}: stated over true {stated}");
    }
}
