//! One amplitude: the matrix of a spheroid in one direction, and the primary bow of a sphere against the
//! exact Debye term.
//!
//! `cargo run --release --example amplitude`

use gonio::plan::{Engine, Plan};
use gonio::series::debye::{DebyeSeries, Term};
use gonio::shape::Shape;
use gonio::simulate;
use std::f64::consts::TAU;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (radius, wavelength, index) = (0.4e-3, 500e-9, 1.333.into());
    let size_parameter = TAU * radius / wavelength;
    // scattering angle and azimuth: the lit side of the primary bow, in the vertical plane
    let direction = (140f64.to_radians(), 0.0);
    let plan = |shape: Shape, orders: Vec<u32>| {
        Plan::direct(shape, radius, Engine::Meridians, orders, false, 0.01, None)
    };

    let spheroid = plan(Shape::spheroid(0.95, 20f64.to_radians())?, vec![0, 1, 2]);
    let amplitude = simulate::scatter(&spheroid, index, size_parameter, &[direction])[0];
    println!("spheroid, orders 0 to 2: S1 = {:.2}, S2 = {:.2}", amplitude.s1, amplitude.s2);
    println!("  dC/dΩ = {:.3e} m²/sr", amplitude.s11() * (wavelength / TAU).powi(2));

    let sphere = plan(Shape::sphere(), vec![2]);
    let rays = simulate::scatter(&sphere, index, size_parameter, &[direction])[0];
    let debye = DebyeSeries::new(size_parameter, index)?;
    let (s1, s2) = debye.amplitudes(Term::Order(2), &[direction.0])[0];
    let error = ((rays.s1 - s1).norm_sqr() + (rays.s2 - s2).norm_sqr()).sqrt();
    let error = error / (s1.norm_sqr() + s2.norm_sqr()).sqrt();
    println!("sphere, order 2: rays are {error:.4} from the Debye term");
    assert!(error < 0.01, "rays and the exact term differ by {error}");
    Ok(())
}
