//! The method's own error estimate against the true error: spheres by rays against Lorenz–Mie.

use gonio::phase_table::{ERROR_BANDS, Slab};
use gonio::scene::{Scene, SceneFile, SceneText};
use gonio::simulate;

/// Samples per band of 4° from 10° to 170°, where the estimate looks.
const PER_BAND: usize = 160;
const BANDS: usize = 40;

fn table(radius_mm: f64, method: &str, tolerance: f64) -> (Vec<f64>, [f64; 2]) {
    let text = format!(
        "[particle]\nshape = \"sphere\"\nradius_mm = {radius_mm}\nmedium = \"water\"\n\
         [light]\nwavelengths_nm = {{ from = 650, to = 650, count = 1 }}\n\
         [table]\ntheta_deg = {{ from = 10, to = 170, count = {} }}\nazimuth_deg = [180]\n\
         forward_peak = \"point\"\n\
         [model]\nmethod = \"{method}\"\ntolerance = {tolerance}\n",
        PER_BAND * BANDS + 1
    );
    let text = SceneText::parse("estimate", text).unwrap();
    let scene = Scene::from_text(text, &SceneFile::default()).unwrap();
    let slab = simulate::table(&scene).unwrap().slabs.swap_remove(0);
    let values = slab.values.iter().map(|&v| f64::from(v)).collect();
    (values, [slab.error_estimate, slab.error_by_band])
}

/// Weighted by intensity, and root mean square over bands.
fn true_errors(found: &[f64], exact: &[f64]) -> [f64; 2] {
    let (mut wrong, mut all, mut bands) = (0.0, 0.0, 0.0);
    for (found, exact) in found.chunks_exact(PER_BAND).zip(exact.chunks_exact(PER_BAND)) {
        let off: f64 = found.iter().zip(exact).map(|(f, e)| (f - e).powi(2)).sum();
        let square: f64 = exact.iter().map(|e| e * e).sum();
        bands += (off / square).min(1.0);
        wrong += off;
        all += square;
    }
    [(wrong / all).sqrt(), (bands / BANDS as f64).sqrt()]
}

#[test]
fn the_estimate_is_near_the_true_error() {
    for radius_mm in [0.05, 0.25, 1.0] {
        let exact = table(radius_mm, "mie", 1e-4).0;
        for tolerance in [0.03, 0.01, 0.003] {
            let (found, estimate) = table(radius_mm, "rays", tolerance);
            let truth = true_errors(&found, &exact);
            println!(
                "radius {radius_mm} mm, tolerance {tolerance}: weighted {:.4}, estimated {:.4}; \
                 by band {:.4}, estimated {:.4}",
                truth[0], estimate[0], truth[1], estimate[1]
            );
            for (truth, estimate) in truth.into_iter().zip(estimate) {
                let ratio = truth / estimate;
                assert!((0.4..2.5).contains(&ratio), "{radius_mm} mm, {tolerance}: ratio {ratio}");
            }
        }
    }
}

/// What patches stand for, in small flattened particles, has no uniform formulas: the estimate says so.
#[test]
fn tangled_orders_admit_their_error() {
    let estimate = |ratio: f64| {
        let text = format!(
            "[particle]\nshape = \"spheroid\"\naxis_ratio = {ratio}\nradius_mm = 0.08\n\
             medium = \"water\"\n[light]\nsun_elevation_deg = 20\nwavelengths_nm = [650]\n\
             [table]\ntheta_deg = {{ from = 0, to = 180, count = 181 }}\nazimuth_deg = [180]\n\
             [model]\nmethod = \"rays\"\n"
        );
        let text = SceneText::parse("estimate", text).unwrap();
        let scene = Scene::from_text(text, &SceneFile::default()).unwrap();
        simulate::table(&scene).unwrap().slabs.swap_remove(0).error_by_band
    };
    let (round, flat) = (estimate(1.0 - 1e-6), estimate(0.85));
    println!("all but a sphere {round:.4}, flattened {flat:.4}");
    assert!(flat > 1.2 * round, "{flat} {round}");
}

/// One sphere: its slab by a method.
fn sphere(n: f64, x: f64, method: &str, tolerance: f64, model: &str) -> Slab {
    let text = format!(
        "[particle]\nshape = \"sphere\"\nradius_um = {}\nmedium = {{ index = [{n}, 0.0] }}\n\
         [light]\nwavelengths_nm = [650]\n\
         [table]\ntheta_deg = {{ from = 0, to = 180, count = {} }}\nazimuth_deg = [180]\n\
         forward_peak = \"point\"\n\
         [model]\nmethod = \"{method}\"\ntolerance = {tolerance}\n{model}",
        x * 0.65 / std::f64::consts::TAU,
        PER_BAND * (ERROR_BANDS - 1) + 1
    );
    let text = SceneText::parse("estimate", text).unwrap();
    let scene = Scene::from_text(text, &SceneFile::default()).unwrap();
    simulate::table(&scene).unwrap().slabs.swap_remove(0)
}

/// True error over the stated one: weighted, by band, and of each band.
fn ratios(found: &Slab, exact: &Slab) -> ([f64; 2], Vec<f64>) {
    let intensities = |slab: &Slab| -> Vec<f64> {
        slab.values.iter().map(|&v| f64::from(v) * slab.scattering_cross_section).collect()
    };
    let (f, e) = (intensities(found), intensities(exact));
    let (mut wrong, mut all, mut bands, mut each) = (0.0, 0.0, 0.0, Vec::new());
    for band in 0..ERROR_BANDS {
        let from = (PER_BAND * band).saturating_sub(PER_BAND / 2);
        let to = (PER_BAND * band + PER_BAND / 2).min(f.len());
        let off: f64 = f[from..to].iter().zip(&e[from..to]).map(|(f, e)| (f - e).powi(2)).sum();
        let square: f64 = e[from..to].iter().map(|e| e * e).sum();
        each.push((off / square).sqrt().min(1.0) / found.error_by_direction[band].min(1.0));
        // 10° to 170°, as the means have it
        if (3..43).contains(&band) {
            bands += (off / square).min(1.0);
            wrong += off;
            all += square;
        }
    }
    let truth = [(wrong / all).sqrt(), (bands / BANDS as f64).sqrt()];
    ([truth[0] / found.error_estimate, truth[1] / found.error_by_band], each)
}

/// Whatever the index and the size, from soft to hard, bubbles in: both stated errors, and nearly all of
/// those by direction.
#[test]
fn spheres_state_their_error_at_every_index_and_size() {
    let (mut all, mut within) = (0, 0);
    for n in [0.75, 0.87, 1.1, 1.17, 1.333, 1.47, 1.65, 2.0, 2.42] {
        for (x, tolerance) in [(63.0, 0.01), (170.0, 0.003), (1130.0, 0.01), (19_000.0, 0.03)] {
            let exact = sphere(n, x, "mie", 1e-4, "");
            let (means, each) = ratios(&sphere(n, x, "rays", tolerance, ""), &exact);
            println!("n = {n}, x = {x}: weighted {:.2}, by band {:.2}", means[0], means[1]);
            for ratio in means {
                assert!((0.4..2.0).contains(&ratio), "n = {n}, x = {x}: true over stated {ratio}");
            }
            all += each.len();
            within += each.iter().filter(|r| (0.33..3.0).contains(*r)).count();
        }
    }
    println!("{within} of {all} bands within a factor of three");
    assert!(within as f64 > 0.95 * all as f64);
}

/// Soft particles: rays are worth little, and say so.
#[test]
fn soft_spheres_state_what_rays_are_worth() {
    for (n, shift) in [(1.01, 6.0), (1.01, 15.0), (1.05, 9.0), (0.97, 12.0)] {
        let x = shift / (2.0 * f64::abs(n - 1.0));
        let exact = sphere(n, x, "mie", 1e-4, "");
        let found = sphere(n, x, "rays", 0.01, "");
        let (means, _) = ratios(&found, &exact);
        println!(
            "n = {n}, 2x|n - 1| = {shift}: stated {:.2} and {:.2}, true over stated {means:?}",
            found.error_estimate, found.error_by_band
        );
        for ratio in means {
            assert!((0.4..2.0).contains(&ratio), "n = {n}, phase shift {shift}: {ratio}");
        }
    }
}

/// The published method: patches and a filter, with orders 0 to 3 or all.
#[test]
fn patches_state_their_error() {
    for (x, model) in [
        (500.0, "diffraction = \"gaussian\"\n"),
        (1800.0, "diffraction = \"gaussian\"\nrays_across = 200\n"),
        (1800.0, "diffraction = \"none\"\n"),
    ] {
        let exact = sphere(1.333, x, "mie", 1e-4, "");
        let found = sphere(1.333, x, "rays", 0.01, model);
        let (means, _) = ratios(&found, &exact);
        println!(
            "x = {x}, {model:?}: stated {:.2} and {:.2}, true over stated {means:?}",
            found.error_estimate, found.error_by_band
        );
        assert!(found.error_by_band > 0.05);
        for ratio in means {
            assert!((0.4..2.0).contains(&ratio), "x = {x}: {ratio}");
        }
    }
}
