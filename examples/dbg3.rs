use gonio::farfield::Direction;
use gonio::farfield::huygens_fresnel::HuygensFresnel;
use gonio::series::debye::{DebyeSeries, Term};
use gonio::shape::Shape;
use gonio::trace::Tracer;
use num_complex::Complex64;
fn main() {
    let x = 5000.0;
    let index = Complex64::new(1.333, 0.0);
    let shape = Shape::sphere();
    let tracer = Tracer::new(&shape, index, x, 3);
    let theta: Vec<f64> = (0..17).map(|i| (123.0 + 0.5 * i as f64).to_radians()).collect();
    let exact = DebyeSeries::new(x, index).unwrap().amplitudes(Term::Order(3), &theta);
    let d: Vec<_> = theta.iter().map(|&t| Direction::new(t, 0.7)).collect();
    for w in [6.5f64, 5.0, 4.0, 3.0] {
        let mut h = HuygensFresnel::new(x, 3);
        h.window = w.to_radians();

        let s = h.amplitudes(&tracer, &d);
        println!("{w:?}");
        for i in 0..d.len() {
            println!(
                "{:.1} τ {:.2} S1 ratio {:.4} S2 ratio {:.4} |S1| {:.1} rays {}",
                theta[i].to_degrees(),
                s[i].surface,
                s[i].amplitude.s1 / exact[i].0,
                s[i].amplitude.s2 / exact[i].1,
                exact[i].0.norm(),
                s[i].rays
            );
        }
    }
}
