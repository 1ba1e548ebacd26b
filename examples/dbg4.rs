use gonio::farfield::FarField;
use gonio::farfield::fan::FanSettings;
use gonio::plan::last_order;
use gonio::shape::Shape;
use gonio::trace::Tracer;
use num_complex::Complex64;
fn main() {
    let index = Complex64::new(1.333, 0.0);
    println!("last order {}", last_order(1.333, 0.01));
    for (q, sun, phi) in [
        (1.1f64, 0.0f64, 90.0f64),
        (1.1, 0.0, 0.0),
        (1.1, 30.0, 90.0),
        (1.1, 30.0, 0.0),
        (1.05, 0.0, 90.0),
        (1.02, 0.0, 90.0),
    ] {
        let x = 100.0;
        let shape = Shape::spheroid(1.0 / q, sun.to_radians()).unwrap();
        let tracer = Tracer::new(&shape, index, x, 12).with_curved_interface(x);
        let azimuths = [phi.to_radians()];
        for p in 0..=9u32 {
            let s = FanSettings {
                size_parameter: x,
                orders: &[p],
                tolerance: 0.01,
                azimuths: &azimuths,
            };
            let f = FarField::meridians(&tracer, &s);
            let theta: Vec<f64> = (0..=180).map(|i| (i as f64)).collect();
            let d: Vec<(f64, f64)> = theta.iter().map(|t| (t.to_radians(), azimuths[0])).collect();
            let a = f.scatter(&d, false);
            // sphere same
            let ball = Shape::sphere();
            let tr = Tracer::new(&ball, index, x, 12).with_curved_interface(x);
            let fb = FarField::meridians(&tr, &s);
            let b = fb.scatter(&d, false);
            let top = |v: &Vec<gonio::optics::AmplitudeMatrix>| {
                let mut m: Vec<(f64, usize)> =
                    v.iter().enumerate().map(|(i, s)| (s.s11(), i)).collect();
                m.sort_by(|a, b| b.0.total_cmp(&a.0));
                format!(
                    "{:?}",
                    m[..4].iter().map(|(v, i)| format!("{:.0}@{}", v, i)).collect::<Vec<_>>()
                )
            };
            println!(
                "q {q} sun {sun} phi {phi} p {p} irregular {:?} top {} sphere {}",
                f.irregular(),
                top(&a),
                top(&b)
            );
        }
    }
}
