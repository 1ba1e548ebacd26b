//! Own medium: an index by a formula of one's own, and the efficiencies of a sphere of it.
//!
//! `cargo run --release --example own_medium`

use gonio::medium::{Medium, OwnMedium};
use gonio::series::lorenz_mie::Sphere;
use num_complex::Complex64;
use std::f64::consts::TAU;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A dye with one absorption line at 550 nm (Lorentz oscillator in a host of index 1.5).
    let dye = OwnMedium::new("dye", (400e-9, 700e-9), |wavelength| {
        let (line, width, strength) = (550e-9, 0.03, 0.01);
        let ratio = line / wavelength;
        let susceptibility = strength / Complex64::new(1.0 - ratio * ratio, -width * ratio);
        (Complex64::from(2.25) + susceptibility).sqrt()
    });
    let dye = Medium::Own(dye);
    let radius = 2e-6;
    println!("nm | n | k | Qext | Qabs");
    let mut absorption = vec![];
    for nanometres in [450.0, 550.0, 650.0] {
        let wavelength = nanometres * 1e-9;
        let index = dye.index(wavelength)?;
        let q = Sphere::new(TAU * radius / wavelength, index)?.efficiencies();
        println!(
            "{nanometres} | {:.4} | {:.5} | {:.3} | {:.3}",
            index.re, index.im, q.q_ext, q.q_abs
        );
        absorption.push(q.q_abs);
    }
    assert!(absorption[1] > 3.0 * absorption[0].max(absorption[2]), "the line absorbs most");
    println!("beyond the range: {}", dye.index(900e-9).expect_err("a range is a range"));
    Ok(())
}
