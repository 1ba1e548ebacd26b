//! Tables by rays of small bodies against exact ones: the rings about the forward peak, which steps of half a degree
//! resolve and no mean over cells may wash out, and what the tables state of their error.

use gonio::phase_table::{Slab, error_theta};
use gonio::scene::{Scene, SceneFile, SceneText};
use gonio::simulate;

const COUNT: usize = 361;

/// P by scattering angle and azimuth, and the stated error weighted by intensity.
fn table(shape: &str, radius_mm: f64, x: f64, sun: f64, method: &str) -> (Vec<Vec<f64>>, f64) {
    let wavelength = std::f64::consts::TAU * radius_mm * 1e6 / x;
    let tolerance = if method == "rays" { 0.01 } else { 1e-3 };
    let text = format!(
        "[particle]\nshape = \"{shape}\"\nradius_mm = {radius_mm}\nmedium = {{ index = [1.333, 0.0] }}\n\
         [light]\nsun_elevation_deg = {sun}\nwavelengths_nm = [{wavelength}]\n\
         [table]\ntheta_deg = {{ from = 0, to = 180, count = {COUNT} }}\n\
         azimuth_deg = {{ from = 0, to = 360, count = 19 }}\n\
         [model]\nmethod = \"{method}\"\ntolerance = {tolerance}\n"
    );
    let text = SceneText::parse("rings", text).unwrap();
    let scene = Scene::from_text(text, &SceneFile::default()).unwrap();
    let slab = simulate::table(&scene).unwrap().slabs.remove(0);
    let row =
        |i: usize| slab.values.slice(ndarray::s![0, i, ..]).iter().map(|&v| f64::from(v)).collect();
    ((0..COUNT).map(row).collect(), slab.error_estimate)
}

/// Relative L2 difference between these angles (degrees).
fn difference(found: &[Vec<f64>], known: &[Vec<f64>], from: f64, to: f64) -> f64 {
    let (mut wrong, mut all) = (0.0, 0.0);
    for (i, (found, known)) in found.iter().zip(known).enumerate() {
        let theta = 180.0 * i as f64 / (COUNT - 1) as f64;
        if (from..=to).contains(&theta) {
            wrong += found.iter().zip(known).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
            all += known.iter().map(|b| b * b).sum::<f64>();
        }
    }
    (wrong / all).sqrt()
}

#[test]
fn rings_about_the_peak_are_those_of_exact_tables() {
    let mut wrong = Vec::new();
    let mut check = |shape: &str, radius: f64, x: f64, sun: f64, exact: &str, bounds: [f64; 4]| {
        let (found, stated) = table(shape, radius, x, sun, "rays");
        let (known, _) = table(shape, radius, x, sun, exact);
        let bands = [(0.0, 10.0), (10.0, 20.0), (20.0, 60.0)];
        let errors = bands.map(|(from, to)| difference(&found, &known, from, to));
        let ratio = stated / difference(&found, &known, 10.0, 170.0);
        let text = format!(
            "{shape} {radius} x = {x}, sun {sun}: {errors:.3?}, stated {stated:.3}, over true {ratio:.2}"
        );
        println!("{text}");
        if errors.iter().zip(bounds).any(|(error, bound)| *error > bound)
            || !(0.4..bounds[3]).contains(&ratio)
        {
            wrong.push(text);
        }
    };
    // 90 is near a resonance
    for x in [80.0, 84.0, 88.0, 100.0, 150.0] {
        check("sphere", 0.3, x, 0.0, "mie", [0.06, 0.04, 0.05, 2.5]);
    }
    for (radius, x, sun, most) in [
        (0.5, 50.0, 0.0, 2.5),
        (0.5, 100.0, 30.0, 2.5),
        (0.5, 150.0, 0.0, 2.5),
        (1.0, 100.0, 0.0, 8.0),
    ] {
        check("raindrop", radius, x, sun, "tmatrix", [0.025, 0.06, 0.07, most]);
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

fn sphere(x: f64, index: (f64, f64), count: usize, method: &str) -> Slab {
    let (n, k) = index;
    let wavelength = std::f64::consts::TAU * 1e5 / x;
    let text = format!(
        "[particle]\nshape = \"sphere\"\nradius_mm = 0.1\nmedium = {{ index = [{n}, {k}] }}\n\
         [light]\nwavelengths_nm = [{wavelength}]\n\
         [table]\ntheta_deg = {{ from = 0, to = 180, count = {count} }}\nazimuth_deg = [0, 90]\n\
         [model]\nmethod = \"{method}\"\ntolerance = 0.01\n"
    );
    let text = SceneText::parse("sphere", text).unwrap();
    let scene = Scene::from_text(text, &SceneFile::default()).unwrap();
    simulate::table(&scene).unwrap().slabs.remove(0)
}

/// Cells about the peak from far coarser than its lobes to finer, bright and dark spheres: every band of 4° states
/// its error, those of the peak too, which closing the sum changes.
#[test]
fn every_band_states_its_error() {
    let mut wrong = Vec::new();
    for (x, index, count) in [
        (65.6, (1.31, 0.0), 181),
        (125.2, (1.4, 1e-3), 361),
        (134.7, (1.31, 1e-3), 181),
        (151.4, (1.31, 1e-5), 91),
        (320.0, (1.6, 0.0), 1801),
        (423.5, (1.333, 1e-4), 91),
        (515.1, (1.4, 0.0), 181),
        (962.6, (1.333, 1e-3), 721),
        (2987.9, (1.333, 0.0), 1801),
    ] {
        let (found, known) = (sphere(x, index, count, "rays"), sphere(x, index, count, "mie"));
        let column = |slab: &Slab| -> Vec<Vec<f64>> {
            (0..count).map(|i| vec![f64::from(slab.values[(0, i, 0)])]).collect()
        };
        let step = 180.0 / (count - 1) as f64;
        let error = |from: f64, to: f64| {
            let (mut off, mut all) = (0.0, 0.0);
            for (i, (a, b)) in column(&found).iter().zip(column(&known)).enumerate() {
                if (from..=to).contains(&(i as f64 * step)) {
                    off += (a[0] - b[0]).powi(2);
                    all += b[0] * b[0];
                }
            }
            f64::sqrt(off / all)
        };
        let weighted = found.error_estimate / error(10.0, 170.0);
        let worst = (0..46)
            .map(|band| {
                let middle = error_theta(band).to_degrees();
                error(middle - 2.0, middle + 2.0) / found.error_by_direction[band].max(2e-3)
            })
            .fold(0.0, f64::max);
        let text = format!(
            "x = {x}, {index:?}, {count}: stated over true {weighted:.2}, worst band {worst:.2} of it"
        );
        println!("{text}");
        if !(0.6..1.6).contains(&weighted) || worst > 3.5 {
            wrong.push(text);
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
