//! The method's own error estimate against the true error: spheres by rays against Lorenz–Mie.

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
