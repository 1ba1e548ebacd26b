//! Tests of `diffraction`.

use super::*;
use crate::math::gauss_legendre;

/// The disc: `x² J₁(z)/z`, half the square of the size parameter straight ahead.
#[test]
fn a_disc_is_airy_s_pattern() {
    let shadow = ForwardDiffraction::new(&Shape::sphere());
    assert!((shadow.area() - PI).abs() < 1e-12 && shadow.deformation() < 1e-12);
    for x in [20.0f64, 3000.0] {
        let ahead = shadow.amplitude(x, &Direction::new(0.0, 0.0));
        assert!((ahead - 0.5 * x * x).norm() < 1e-10 * x * x);
        for theta in [0.3 / x, 3.0 / x, 0.1, 0.7] {
            let z = x * theta.sin();
            let exact = x * x * libm::j1(z) / z * 0.5 * (1.0 + theta.cos());
            let found = shadow.amplitude(x, &Direction::new(theta, 1.0));
            assert!((found - exact).norm() < 1e-8 * x * x / z.max(1.0).powf(1.5), "{x} {theta}");
        }
    }
    // the first zero of J₁
    let dark = Direction::new((3.831_705_970_207_512_f64 / 3000.0).asin(), 0.0);
    assert!(shadow.amplitude(3000.0, &dark).norm() < 1e-9 * 3000.0 * 3000.0);
}

/// The ellipse: `J₁(Z)/Z` with `Z² = q_u² a² + q_v² b²`, along the outline and by its two points, which
/// are as exact as the outline's curvature is known.
#[test]
fn an_ellipse_is_a_stretched_disc() {
    let (ratio, elevation): (f64, f64) = (0.8, 0.3);
    let (h, v) = (ratio.powf(-1.0 / 3.0), ratio.powf(2.0 / 3.0));
    let upward = (v * elevation.cos()).hypot(h * elevation.sin());
    let shadow = ForwardDiffraction::new(&Shape::spheroid(ratio, elevation).unwrap());
    assert!((shadow.area() - PI * h * upward).abs() < 1e-11);
    assert!((shadow.deformation() - (h - upward)).abs() < 1e-12);
    let x = 800.0;
    for (q, bound) in [(0.5, 1e-10), (10.0, 1e-10), (60.0, 1e-10), (70.0, 5e-5), (300.0, 5e-5)] {
        for phi in [0.0f64, 0.6, 1.7] {
            let theta: f64 = f64::asin(q / x);
            let z = q * (upward * phi.cos()).hypot(h * phi.sin());
            let exact = x * x * h * upward * libm::j1(z) / z * 0.5 * (1.0 + theta.cos());
            let found = shadow.amplitude(x, &Direction::new(theta, phi));
            let size = x * x / z.max(1.0).powf(1.5);
            assert!((found - exact).norm() < bound * size, "{q} {phi}: {found} {exact}");
        }
    }
    for phi in [0.3f64, 2.2] {
        let [height, slope, radius] = shadow.support_at(phi);
        let exact = (upward * phi.cos()).hypot(h * phi.sin());
        assert!((height - exact).abs() < 1e-8, "{height} {exact}");
        let turn = (h * h - upward * upward) * phi.sin() * phi.cos() / exact;
        assert!((slope - turn).abs() < 1e-6, "{slope} {turn}");
        assert!((radius - (h * upward).powi(2) / exact.powi(3)).abs() < 2e-4, "{radius}");
    }
}

#[test]
fn tails_fade_and_end() {
    let shadow = ForwardDiffraction::new(&Shape::spheroid(0.9, 0.2).unwrap());
    let (x, phi) = (500.0, 0.7);
    let theta = [0.01, 0.1, 0.2, 0.6, 1.5];
    for (tail, theta) in shadow.tails(x, &theta, phi).into_iter().zip(theta) {
        let direction = Direction::new(theta, phi);
        let one = shadow.tail(x, &direction);
        assert!((tail - one).norm() < 1e-9 * one.norm(), "{theta}");
        let share = one.norm() / shadow.amplitude(x, &direction).norm();
        assert!((share.sqrt().recip() - (1.0 + (0.5 * theta * x.cbrt()).powi(2))).abs() < 1e-9);
    }
    let ends = [100.0, 1e3, 1e4, 1e5].map(|x| shadow.farthest(x));
    assert!(ends.windows(2).all(|w| w[0] > w[1]), "{ends:?}");
}

/// `∫₀¹ t exp(-i t φ) dt` by quadrature, on both sides of where its series ends.
#[test]
fn the_ramp_is_its_integral() {
    let nodes = gauss_legendre::nodes(40);
    for phase in [0.0, 0.0099, 0.0101, -0.5, 3.0, -17.0] {
        let exact: Complex64 = nodes
            .iter()
            .map(|(node, weight)| {
                let t = 0.5 * (1.0 + node);
                Complex64::cis(-t * phase) * (0.5 * weight * t)
            })
            .sum();
        assert!((ramp(phase) - exact).norm() < 2e-11, "{phase}: {} {exact}", ramp(phase));
    }
}

#[test]
fn hankel_s_function_is_one_function() {
    for z in [29.99, 30.0, 31.0, 80.0] {
        let exact = Complex64::new(libm::j1(z), libm::y1(z));
        assert!((hankel1(z) - exact).norm() < 1.3e-8 * exact.norm(), "{z}");
    }
    assert!(circle(0.0) == 1.0 && (circle(1.01e-4) - (1.0 - 1.01e-8 * 1.01 / 8.0)).abs() < 1e-14);
    let ratio = hankel_over_leading_term(200.0);
    assert!((ratio - Complex64::new(1.0, -0.375 / 200.0)).norm() < 1e-5, "{ratio}");
    assert_eq!(hankel_over_leading_term(-7.0), hankel_over_leading_term(7.0).conj());
}

#[test]
fn periodic_functions_are_differentiated_to_high_order() {
    let values: Vec<f64> = (0..128).map(|k| (TAU * f64::from(k) / 128.0).cos().exp()).collect();
    for (k, slope) in periodic_derivative(&values).into_iter().enumerate() {
        let (sin, cos) = (TAU * k as f64 / 128.0).sin_cos();
        assert!((slope + sin * cos.exp()).abs() < 1e-9, "{k}");
    }
}
