//! Wavelengths of a table share scans of rays, over the index: against each traced by itself.
//!
//! Waves are allowed a tenth of the tolerance, of the largest nearby, at bows and beside them. Guides decide on nothing but
//! where rays are looked for, and rays that are not smooth over the index are traced: what differs is far less.

use gonio::farfield::assignment::{Assigned, Assignment, Thresholds};
use gonio::farfield::{FarField, FarFieldSettings, Guides};
use gonio::medium::MediumSpec;
use gonio::optics::AmplitudeMatrix;
use gonio::scene::{Scene, SceneFile, SceneText};
use gonio::shape::{RaindropModel, Shape};
use gonio::simulate;
use gonio::trace::Tracer;
use num_complex::Complex64;
use std::path::Path;

const TOLERANCE: f64 = 0.01;

/// Differences of two series relative to the largest of the other nearby, at worst.
fn worst(found: &[f64], other: &[f64], size: impl Fn(usize) -> f64) -> f64 {
    const NEAR: usize = 8;
    let largest = |i: usize| {
        let near = i.saturating_sub(NEAR)..(i + NEAR).min(other.len());
        near.map(&size).fold(0.0, f64::max)
    };
    (0..found.len()).map(|i| (found[i] - other[i]).abs() / largest(i)).fold(0.0, f64::max)
}

/// The same method by the same reasons for each order, and the same formulas at the same angles: where a bow or a last
/// ray stands is known to rounding of its search.
fn methods_agree(guided: &Assignment, traced: &Assignment) {
    const SAME_ANGLE: f64 = 1e-4;
    assert_eq!(guided.entries().len(), traced.entries().len());
    for (a, b) in guided.entries().iter().zip(traced.entries()) {
        let formulas =
            |of: &Assigned| of.formulas.iter().map(|range| range.formula).collect::<Vec<_>>();
        assert_eq!((a.order, a.method, formulas(a)), (b.order, b.method, formulas(b)));
        assert_eq!(a.reasons, b.reasons, "{}", a.order);
        for (a, b) in a.formulas.iter().zip(&b.formulas) {
            let off = (0..2).map(|k| (a.theta[k] - b.theta[k]).abs()).fold(0.0, f64::max);
            assert!(off < SAME_ANGLE, "{a:?} {b:?}");
        }
    }
}

/// How far amplitudes by guides over a range of indices are from those without.
fn guided_against_traced(
    shape: &Shape,
    x: f64,
    orders: &[u32],
    range: [f64; 2],
    index: Complex64,
) -> f64 {
    let by = Thresholds::MEASURED;
    let guides = Guides::new(shape, orders, TOLERANCE, range, &by);
    let last = orders.iter().copied().max().unwrap();
    let tracer = Tracer::new(shape, index, x, last).with_curved_interface(x);
    let settings =
        FarFieldSettings { size_parameter: x, orders, tolerance: TOLERANCE, diffraction: true };
    let assignment = Assignment::new(&tracer, orders, x, TOLERANCE, &by);
    let field = |guides| FarField::guided(&tracer, &settings, assignment.clone(), guides);
    let (guided, traced) = (field(Some(&guides)), field(None));
    methods_agree(guided.assignment().unwrap(), traced.assignment().unwrap());
    let theta: Vec<f64> = (0..2000).map(|i| (0.3 + 0.0897 * f64::from(i)).to_radians()).collect();
    let azimuths = [0.0, 0.8, 2.6];
    let columns = |field: &FarField| field.columns(&theta, &azimuths, false);
    let differs = |(a, b): (&Vec<AmplitudeMatrix>, &Vec<AmplitudeMatrix>)| {
        let part = |s: &AmplitudeMatrix, c: usize| {
            [s.s1.re, s.s1.im, s.s2.re, s.s2.im, s.s3.re, s.s3.im, s.s4.re, s.s4.im][c]
        };
        let of = |c: usize| {
            let channel =
                |all: &[AmplitudeMatrix]| all.iter().map(|s| part(s, c)).collect::<Vec<f64>>();
            worst(&channel(a), &channel(b), |i| b[i].s11().sqrt())
        };
        (0..8).map(of).fold(0.0, f64::max)
    };
    let (guided, traced) = (columns(&guided), columns(&traced));
    let pairs = guided.iter().zip(&traced).map(|(a, b)| (&a.amplitude, &b.amplitude));
    pairs.map(differs).fold(0.0, f64::max)
}

fn drop() -> Shape {
    Shape::raindrop(0.5e-3, RaindropModel::BeardChuang1987, 0.349).unwrap()
}

#[test]
fn water_over_the_visible() {
    let orders = [0, 1, 2, 3, 4, 5];
    for (x, index) in [(7500.0, 1.3425), (4700.0, 1.3312)] {
        let off = guided_against_traced(&drop(), x, &orders, [1.330, 1.343], index.into());
        println!("water, n = {index}, x = {x}: {off:.1e}");
        assert!(off < 0.1 * TOLERANCE, "{index}: {off}");
    }
}

/// The index of a strongly dyed drop goes down, up and down again, and absorbs where it is steepest.
#[test]
fn a_dye_whose_index_turns_back() {
    let text = "{ solute = \"fuchsine\", fraction = 0.02, host = \"water\" }";
    let medium = MediumSpec::parse(text).unwrap().resolve(Path::new("")).unwrap();
    let wavelengths: Vec<f64> = (0..14).map(|k| 420e-9 + 20e-9 * f64::from(k)).collect();
    let index = |w: f64| medium.index(w).unwrap();
    let all: Vec<f64> = wavelengths.iter().map(|&w| index(w).re).collect();
    let turns = all.windows(3).filter(|w| (w[1] - w[0]) * (w[2] - w[1]) < 0.0).count();
    assert!(turns > 0, "{all:?}");
    let range =
        [all.iter().fold(f64::MAX, |a, b| a.min(*b)), all.iter().fold(0.0, |a, b| b.max(a))];
    for w in [460e-9, 600e-9] {
        let x = std::f64::consts::TAU * 0.3e-3 / w;
        let off = guided_against_traced(&drop(), x, &[0, 1, 2, 3, 4], range, index(w));
        println!("dyed, {:.0} nm, n = {:.4}: {off:.1e}", w * 1e9, index(w));
        assert!(off < 0.1 * TOLERANCE, "{w}: {off}");
    }
}

/// Over a jump of the index no polynomial holds for all rays: those are traced.
#[test]
fn a_jump_of_the_index() {
    let shape = Shape::spheroid(0.97, 0.4).unwrap();
    for index in [1.28, 1.62] {
        let off =
            guided_against_traced(&shape, 3000.0, &[0, 1, 2, 3, 4], [1.28, 1.62], index.into());
        println!("jump, n = {index}: {off:.1e}");
        assert!(off < 0.1 * TOLERANCE, "{index}: {off}");
    }
}

/// A table of many wavelengths holds what each holds by itself.
#[test]
fn a_table_of_many_wavelengths_is_that_of_each() {
    let text = r#"
        [particle]
        shape = "raindrop"
        radius_mm = 0.45
        [light]
        sun_elevation_deg = 15
        wavelengths_nm = { from = 400, to = 700, count = 9 }
        [table]
        theta_deg = { from = 100, to = 170, count = 701 }
        azimuth_deg = [0, 50]
        [model]
        method = "rays"
        orders = [0, 2, 3, 4]
    "#;
    let text = SceneText::parse("shared rays", text.into()).unwrap();
    let scene = Scene::from_text(text, &SceneFile::default()).unwrap();
    let plan = gonio::plan::Plan::new(&scene).unwrap();
    let table = simulate::table(&scene).unwrap();
    for i in [0, 5] {
        let alone = simulate::slab(&scene, &plan, scene.wavelengths[i]).unwrap();
        let rows = |values: &ndarray::Array3<f32>, phi: usize| -> Vec<f64> {
            values.slice(ndarray::s![0, .., phi]).iter().map(|v| f64::from(*v)).collect()
        };
        for phi in 0..2 {
            let (found, other) = (rows(&table.slabs[i].values, phi), rows(&alone.values, phi));
            let off = worst(&found, &other, |i| other[i]);
            println!("table, wavelength {i}: {off:.1e}");
            assert!(off < 0.1 * TOLERANCE, "{i} {phi}: {off}");
        }
    }
}
