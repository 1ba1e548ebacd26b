//! Own shape: a body of revolution by one formula, its rainbow angle and its energy.
//!
//! `cargo run --release --example own_shape`

use gonio::math::jet::Jet;
use gonio::math::scalar::Scalar;
use gonio::shape::{Outline, OwnBody, Shape};
use gonio::trace::{Tracer, Wavefront, energy_by_fate};

/// A pear, `r = 1 + ε (4μ³ - 3μ)` with `μ = ζ/r`: pointed below for `ε > 0`.
#[derive(Debug)]
struct Pear(f64);

impl Outline for Pear {
    fn level<T: Scalar>(&self, q: Jet<T>, depth: Jet<T>) -> Jet<T> {
        let r = q.root();
        let mu = depth / r;
        r - (mu.power(3.0) * 4.0 - mu * 3.0) * self.0 - 1.0
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pear = Shape::own(OwnBody::new("pear", Pear(0.01))?, 20f64.to_radians());
    let tracer = Tracer::new(&pear, 1.333.into(), 5000.0, 2);
    // rays of order 2 through the upper half of the vertical plane turn back at the primary bow
    let deviations = (1..1000).filter_map(|i| {
        let ray = tracer.trace_order(f64::from(i) / 1000.0, 0.0, 2)?;
        Some(ray.scattering_angle().to_degrees())
    });
    let bow = deviations.fold(180.0, f64::min);
    println!("primary bow of the pear, upper rays: {bow:.3}° (sphere: 137.922°)");
    assert!((bow - 137.92).abs() > 0.1, "a pear is no sphere");

    let fates = energy_by_fate(&tracer, &Wavefront::midpoints(&pear, 100, 200));
    let sum = fates.left_by_order.iter().sum::<f64>() + fates.totally_reflected + fates.truncated;
    println!("power that left, was reflected on and was cut off: {sum:.9}");
    assert!((sum - 1.0).abs() < 1e-9, "no light is lost");
    Ok(())
}
