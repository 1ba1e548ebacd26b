//! Tests of `lorenz_mie`.

use super::*;
use crate::series::debye::{DebyeSeries, Term};

fn sphere(x: f64, n: f64, k: f64) -> Sphere {
    Sphere::new(x, Complex64::new(n, k)).unwrap()
}

/// Rayleigh: `a₁ = -i 2x³/3 (m² - 1)/(m² + 2)`, all else smaller by `x²`.
#[test]
fn small_spheres_are_dipoles() {
    for k in [0.0, 0.3] {
        let (x, m) = (1e-3f64, Complex64::new(1.5, k));
        let s = sphere(x, 1.5, k);
        let dipole = -Complex64::i() * (2.0 * x.powi(3) / 3.0) * (m * m - 1.0) / (m * m + 2.0);
        assert!((s.a()[0] - dipole).norm() < 1e-5 * dipole.norm(), "{} {dipole}", s.a()[0]);
        assert!(s.b()[0].norm() < x * x * dipole.norm());
        assert!(s.efficiencies().asymmetry.abs() < 1e-5);
    }
}

/// A clear sphere takes nothing: `|1 - 2a_n| = 1`; an absorbing one never gives.
#[test]
fn partial_waves_are_unitary_or_absorbed() {
    let both = |s: &Sphere| s.a().iter().chain(s.b()).copied().collect::<Vec<_>>();
    for wave in both(&sphere(80.0, 1.333, 0.0)) {
        assert!(((1.0 - 2.0 * wave).norm() - 1.0).abs() < 1e-13);
    }
    for wave in both(&sphere(80.0, 1.333, 0.01)) {
        assert!((1.0 - 2.0 * wave).norm() <= 1.0 + 1e-13);
    }
    assert_eq!(sphere(80.0, 1.333, 0.0).efficiencies().q_abs, 0.0);
}

/// The optical theorem, `Q_ext = 4/x² Re S(0)`, and what is taken is scattered or absorbed.
#[test]
fn extinction_is_what_the_wave_straight_ahead_lacks() {
    for (x, n, k) in [(0.3, 1.5, 0.1), (20.0, 1.333, 0.0), (300.0, 1.333, 1e-3), (40.0, 0.75, 0.0)]
    {
        let s = sphere(x, n, k);
        let [(ahead, same), (behind, opposite)] = s.amplitudes(&[0.0, std::f64::consts::PI])[..]
        else {
            panic!()
        };
        let e = s.efficiencies();
        assert!((4.0 / (x * x) * ahead.re - e.q_ext).abs() < 1e-12 * e.q_ext);
        assert!((e.q_sca + e.q_abs - e.q_ext).abs() < 1e-12 * e.q_ext);
        assert!((ahead - same).norm() < 1e-10 * ahead.norm());
        assert!((behind + opposite).norm() < 1e-10 * (1.0 + behind.norm()));
    }
    // geometrical limit: twice the shadow
    let large = sphere(5000.0, 1.333, 0.01).efficiencies();
    assert!((large.q_ext - 2.0).abs() < 0.02, "{large:?}");
}

/// No contrast, no wave; a little absorption is next to none.
#[test]
fn limits_of_the_index_are_met() {
    assert!(sphere(10.0, 1.0, 0.0).a().iter().all(|a| a.norm() < 1e-13));
    let (clear, dyed) = (sphere(30.0, 1.4, 0.0), sphere(30.0, 1.4, 1e-12));
    for (a, b) in clear.a().iter().zip(dyed.a()) {
        assert!((a - b).norm() < 1e-9);
    }
}

/// One by one, together, on many threads, and by the Debye series: the same amplitudes.
#[test]
fn all_ways_to_the_amplitudes_agree() {
    let theta: Vec<f64> = (0..=100).map(|k| 0.0314 * f64::from(k)).collect();
    let spheres = [sphere(50.0, 1.333, 0.0), sphere(53.0, 1.333, 0.0)];
    let set = AngleSet::new(&theta);
    let together = Sphere::amplitudes_together([&spheres[0], &spheres[1]], &set);
    for (sphere, together) in spheres.iter().zip(together) {
        let alone = sphere.amplitudes(&theta);
        let size = alone.iter().map(|s| s.0.norm()).fold(0.0, f64::max);
        let debye = DebyeSeries::new(sphere.size_parameter(), sphere.relative_index()).unwrap();
        let sum = debye.amplitudes(Term::All, &theta);
        for ((a, b), (c, d)) in
            alone.iter().zip(&together).zip(sphere.amplitudes_parallel(&theta).iter().zip(&sum))
        {
            for other in [b, c, d] {
                assert!((a.0 - other.0).norm() + (a.1 - other.1).norm() < 1e-11 * size);
            }
        }
    }
}
