//! A shape, a medium and an export that gonio does not have, in three short files: what "A shape, a
//! medium and an export" in `docs/tutorials.md` explains. It fails where the result is not right.
//!
//! `cargo run --release --example newcomer [FILE]` writes the columns of the superellipsoid.

mod columns;
mod resin;
mod superellipsoid;

use gonio::phase_table::PhaseTable;
use gonio::scene::{Particle, Scene, SceneFile};
use gonio::shape::OwnBody;
use gonio::simulate;
use std::error::Error;
use std::path::Path;
use superellipsoid::Superellipsoid;

/// Everything that is not the newcomer's own, as in any scene file.
const SCENE: &str = "
[light]
wavelengths_nm = [600]
sun_elevation_deg = 20
[table]
theta_deg = { from = 0, to = 180, count = 361 }
azimuth_deg = { from = 0, to = 360, count = 13 }
";
const AXIS_RATIO: f64 = 0.95;
const RADIUS: f64 = 0.015e-3;

fn main() -> Result<(), Box<dyn Error>> {
    // With the exponent 2 it is a spheroid, which gonio has: that is the independent truth.
    let ellipsoid = table_of(2.0)?;
    let spheroid = Particle::Spheroid { radius: RADIUS, axis_ratio: AXIS_RATIO };
    let truth = simulate::table(&Scene { particle: spheroid, ..scene()? })?;
    let difference = relative_difference(&ellipsoid, &truth);
    println!("exponent 2 against the spheroid: {difference:.1e} in L2");
    assert!(difference < 1e-5, "a superellipsoid of exponent 2 is a spheroid");

    // A little squarer. The energy must add up within the error that the table states of itself.
    let squarer = table_of(2.2)?;
    let slab = &squarer.slabs[0];
    let sum = slab.sum_before_peak;
    let error = slab.error_estimate;
    println!("exponent 2.2: sum of P over the sphere {sum:.4}, stated error {error:.3}");
    assert!((sum - 1.0).abs() < error, "the sum is {sum}, the stated error {error}");
    let change = relative_difference(&squarer, &truth);
    println!("exponent 2.2 against the spheroid: {change:.2} in L2");
    assert!(change > 0.01, "another shape scatters otherwise");

    let columns = columns::text(&squarer);
    assert_eq!(columns.lines().count(), 362, "a heading, and one line per angle");
    if let Some(path) = std::env::args().nth(1) {
        columns::write(&squarer, Path::new(&path))?;
    }
    Ok(())
}

fn scene() -> Result<Scene, Box<dyn Error>> {
    let keys: SceneFile = toml::from_str(SCENE)?;
    Ok(Scene::built_in(&keys)?.with_own_medium(resin::resin(), None))
}

fn table_of(exponent: f64) -> Result<PhaseTable, Box<dyn Error>> {
    let shape = Superellipsoid { horizontal: 1.0, vertical: AXIS_RATIO, exponent };
    let body = OwnBody::new("superellipsoid", shape)?;
    Ok(simulate::table(&scene()?.with_own_body(body, RADIUS))?)
}

/// ‖a - b‖ / ‖b‖ over all samples outside the forward peak.
fn relative_difference(a: &PhaseTable, b: &PhaseTable) -> f64 {
    let outside = |i: usize| b.header.axes.theta[i].to_degrees() > 10.0;
    let (mut difference, mut norm) = (0.0, 0.0);
    for ((place, &a), &b) in a.slabs[0].values.indexed_iter().zip(&b.slabs[0].values) {
        if outside(place.1) {
            difference += f64::from(a - b).powi(2);
            norm += f64::from(b).powi(2);
        }
    }
    f64::sqrt(difference / norm)
}
