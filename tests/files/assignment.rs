//! One table of thresholds decides what computes each order: the plan's words, the table's attribute and
//! the computed field follow it together; and the errors that it expects are those that are measured.

use gonio::farfield::assignment::{Assignment, Thresholds};
use gonio::farfield::{FarField, FarFieldSettings};
use gonio::hdf5::{self, TableReader, WriteOptions};
use gonio::phase_table::{MethodPart, PhaseTable};
use gonio::plan::Plan;
use gonio::scene::{Scene, SceneFile, SceneText};
use gonio::series::debye::{DebyeSeries, Term};
use gonio::shape::Shape;
use gonio::simulate;
use gonio::trace::Tracer;
use num_complex::Complex64;

fn scene(particle: &str, azimuths: &str, wavelengths: &str) -> Scene {
    let text = format!(
        "[particle]\n{particle}\nmedium = \"water\"\n[light]\nsun_elevation_deg = 20\n\
         wavelengths_nm = [{wavelengths}]\n[table]\ntheta_deg = {{ from = 0, to = 180, count = 91 }}\n\
         azimuth_deg = {azimuths}\n[model]\nmethod = \"rays\"\n"
    );
    let text = SceneText::parse("assignment", text).unwrap();
    Scene::from_text(text, &SceneFile::default()).unwrap()
}

/// The words of the plan, the attribute of the stored table, and the values in it.
fn three_views(scene: &Scene, by: Thresholds) -> (String, String, Vec<f32>) {
    let plan = Plan::by(scene, by).unwrap();
    let mut methods = plan.methods(scene).unwrap();
    let slabs = scene.wavelengths.iter().map(|&w| simulate::slab(scene, &plan, w).unwrap());
    let slabs: Vec<_> = slabs.collect();
    for planned in &mut methods {
        let first = planned.range.first;
        planned.tried(scene.wavelengths[first], scene.phi.len(), &slabs[first].methods);
    }
    let words = methods.iter().map(ToString::to_string).collect();
    let values = slabs.iter().flat_map(|slab| slab.values.iter().copied()).collect();

    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.h5");
    let header = simulate::header(scene, String::new()).unwrap();
    let table = PhaseTable { header, slabs };
    hdf5::write(&path, &table, WriteOptions::default()).unwrap();
    let reader = TableReader::open(&path).unwrap();
    assert_eq!(reader.slab(0).unwrap().methods.len(), table.slabs[0].methods.len());
    (words, reader.attribute("methods").unwrap().unwrap(), values)
}

/// Which of words, attribute and values differ.
fn changed(a: &(String, String, Vec<f32>), b: &(String, String, Vec<f32>)) -> [bool; 3] {
    [a.0 != b.0, a.1 != b.1, a.2 != b.2]
}

#[test]
fn words_attribute_and_field_change_together() {
    let measured = Thresholds::MEASURED;
    let small = "shape = \"spheroid\"\naxis_ratio = 0.9\nradius_mm = 0.02";
    let cases = [
        // partial waves → planes, by size
        (
            small,
            "[40]",
            Thresholds { partial_waves_below: 1.0, ..measured },
            "partial waves from rays",
        ),
        // two rays of a bow → an integral near the rim, by order
        (
            "shape = \"sphere\"\nradius_mm = 0.1",
            "[0]",
            Thresholds { first_near_grazing_order: 4, ..measured },
            "Airy functions",
        ),
        // planes → a sum on a complex wavefront, by deformation
        (
            "shape = \"raindrop\"\nradius_mm = 0.45",
            "[40]",
            Thresholds { wavefront: [[1e-4, 2e-4]; 4], ..measured },
            "sum on a complex wavefront",
        ),
        // such a sum → patches, by size
        (
            "shape = \"raindrop\"\nradius_mm = 0.8",
            "[40]",
            Thresholds { wavefront_from: 1e6, ..measured },
            "patches of rays",
        ),
    ];
    for (particle, azimuths, moved, word) in cases {
        let scene = scene(particle, azimuths, "550");
        let [before, again] = [measured, measured].map(|by| three_views(&scene, by));
        assert_eq!(changed(&before, &again), [false; 3], "the same numbers, the same table");
        let after = three_views(&scene, moved);
        assert_eq!(changed(&before, &after), [true; 3], "{particle}, {}", after.0);
        assert!(before.0.contains(word) != after.0.contains(word), "{}\n{}", before.0, after.0);
    }
}

/// What is only planned has the methods of what is found, where all is well.
#[test]
fn a_round_drop_is_computed_as_planned() {
    let scene = scene("shape = \"raindrop\"\nradius_mm = 0.3", "[0, 40]", "500, 550");
    let plan = Plan::new(&scene).unwrap();
    let planned = plan.methods(&scene).unwrap();
    let found = simulate::slab(&scene, &plan, scene.wavelengths[0]).unwrap().methods;
    let methods = |parts: &[MethodPart]| -> Vec<(Option<u32>, String)> {
        parts.iter().map(|part| (part.order, part.method.clone())).collect()
    };
    assert_eq!(methods(&planned[0].range.parts), methods(&found));
    let light: f64 = found.iter().map(|part| part.share_of_light.unwrap()).sum();
    assert!((0.995..=1.0).contains(&light), "{light}");
}

/// Relative root mean square of an order's wave on a sphere, 10° to 170°, and what is expected.
fn error_of(order: u32, x: f64, index: f64) -> (f64, f64) {
    let (shape, index) = (Shape::sphere(), Complex64::new(index, 0.0));
    let tracer = Tracer::new(&shape, index, x, order).with_curved_interface(x);
    let theta: Vec<f64> = (0..1600).map(|k| (10.0 + 0.1 * f64::from(k)).to_radians()).collect();
    let joined = order == 0;
    let settings = FarFieldSettings {
        size_parameter: x,
        orders: &[order],
        tolerance: 0.01,
        diffraction: joined,
    };
    let assignment = Assignment::new(&tracer, &[order], x, 0.01, &Thresholds::MEASURED);
    let far_field = FarField::assigned(&tracer, &settings, assignment);
    let directions: Vec<(f64, f64)> = theta.iter().map(|&t| (t, 0.0)).collect();
    let found = far_field.scatter(&directions, joined);
    let terms: Vec<Term> =
        [Term::Order(order)].into_iter().chain(joined.then_some(Term::Diffraction)).collect();
    let exact = DebyeSeries::new(x, index).unwrap().sum_parallel(&terms, &theta);
    let (mut off, mut all) = (0.0, 0.0);
    for (found, (s1, s2)) in found.iter().zip(exact) {
        off += (found.s1 - s1).norm_sqr() + (found.s2 - s2).norm_sqr();
        all += s1.norm_sqr() + s2.norm_sqr();
    }
    ((off / all).sqrt(), far_field.assignment().unwrap().error_of(order))
}

#[test]
fn expected_errors_are_those_measured() {
    for index in [1.333, 1.5] {
        for x in [300.0, 1000.0, 3000.0, 10_000.0] {
            for order in 0..7 {
                let (measured, expected) = error_of(order, x, index);
                println!("{index} x = {x}, order {order}: {measured:.4}, expected {expected:.4}");
                let ratio = measured / expected;
                assert!((0.1..1.2).contains(&ratio), "{index}, {x}, order {order}: {ratio}");
            }
        }
    }
}
