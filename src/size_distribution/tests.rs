//! Tests of `size_distribution`.

use super::*;
use approx::assert_relative_eq;

fn whole(law: SizeLaw) -> SizeDistribution {
    SizeDistribution::whole(law).unwrap()
}

/// Hansen & Travis: r_eff and v_eff by definition, ⟨r³⟩ = r_eff³ (1-v)(1-2v), for every width.
#[test]
fn gamma_moments_in_closed_form() {
    for v in [1e-6, 1e-3, 0.1, 1.0 / 9.0, 0.3, 0.45] {
        let gamma = whole(SizeLaw::gamma(1e-5, v));
        assert_relative_eq!(gamma.effective_radius(), 1e-5, max_relative = 1e-10);
        assert_relative_eq!(gamma.effective_variance(), v, max_relative = 1e-9);
        let cubed = 1e-15 * (1.0 - v) * (1.0 - 2.0 * v);
        assert_relative_eq!(gamma.moment(3.0), cubed, max_relative = 1e-10);
        assert_relative_eq!(gamma.moment(0.0), 1.0, max_relative = 1e-12);
    }
}

/// ⟨r^p⟩ = median^p exp(p²s²/2), v_eff = exp(s²) - 1.
#[test]
fn log_normal_moments_in_closed_form() {
    for (median, s) in [(1e-9, 1.0), (2e-6, 0.4), (1e-3, 1e-4)] {
        let log = whole(SizeLaw::LogNormal { median, spread: s });
        for p in [0, 2, 3, 6] {
            let p = f64::from(p);
            let expected = median.powf(p) * (0.5 * p * p * s * s).exp();
            assert_relative_eq!(log.moment(p), expected, max_relative = 1e-10);
        }
        assert_relative_eq!(log.effective_variance(), (s * s).exp_m1(), max_relative = 1e-9);
    }
}

/// A normal law from its moments (m³ + 3mσ²)/(m² + σ²), and the number of a bell cut at zero.
#[test]
fn normal_moments_in_closed_form() {
    let normal = whole(SizeLaw::Normal { mean: 1e-5, deviation: 1e-6 });
    let expected = (1e-15 + 3e-5 * 1e-12) / (1e-10 + 1e-12);
    assert_relative_eq!(normal.effective_radius(), expected, max_relative = 1e-10);
    let cut = whole(SizeLaw::Normal { mean: 1e-5, deviation: 5e-6 });
    let number = 1.0 - 0.5 * libm::erfc(2.0 / std::f64::consts::SQRT_2);
    let at_top = 1.0 / (5e-6 * std::f64::consts::TAU.sqrt() * number);
    assert_relative_eq!(cut.density(1e-5), at_top, max_relative = 1e-9);
}

/// Rain at 1 mm/h: half as many drops per size every ln 2/4.1 mm of diameter.
#[test]
fn rain_halves() {
    let rain = SizeDistribution::between(SizeLaw::marshall_palmer(1.0), 1e-4, 3e-3).unwrap();
    let step = 0.5 * std::f64::consts::LN_2 / 4.1e3;
    let ratio = rain.density(1e-3 + step) / rain.density(1e-3);
    assert_relative_eq!(ratio, 0.5, max_relative = 1e-12);
    assert_eq!(rain.density(9e-5), 0.0);
    assert!(rain.has_step((1e-4, 3e-3)));
}

/// OPAC's soot: 0.8922877792586038 of the number lies between 5 nm and 20 µm.
#[test]
fn limits_are_told() {
    let soot = SizeLaw::LogNormal { median: 11.8e-9, spread: 2f64.ln() };
    let soot = SizeDistribution::between(soot, 5e-9, 20e-6).unwrap();
    assert_relative_eq!(soot.share_inside(), 0.892_287_779_258_603_8, max_relative = 1e-10);
    assert_relative_eq!(soot.effective_variance(), 0.611_214_3, max_relative = 1e-7);
    assert_relative_eq!(soot.moment(3.0), 1.599_210_9e-23, max_relative = 1e-7);
}

/// Bins and lines hold what is written in them.
#[test]
fn tables_hold_their_numbers() {
    let edges: std::sync::Arc<[f64]> = [1e-6, 2e-6, 5e-6, 6e-6].into();
    let numbers: std::sync::Arc<[f64]> = [1.0, 0.0, 3.0].into();
    let bins = whole(SizeLaw::Histogram { edges, numbers });
    let expected = 0.25 * 1.5e-6 + 0.75 * 5.5e-6;
    assert_relative_eq!(bins.moment(1.0), expected, max_relative = 1e-12);
    assert_eq!(bins.stretches(1e-6, 1e7).len(), 2);
    let radii: std::sync::Arc<[f64]> = [1e-6, 2e-6, 4e-6].into();
    let densities: std::sync::Arc<[f64]> = [0.0, 2.0, 0.0].into();
    let roof = whole(SizeLaw::Table { radii, densities });
    assert_relative_eq!(roof.moment(1.0), 7.0 / 3.0 * 1e-6, max_relative = 1e-12);
}

#[test]
fn endless_and_empty_laws_are_refused() {
    let power = SizeLaw::PowerExponential { exponent: -4.0, scale: f64::INFINITY, power: 1.0 };
    let refused = |from, to| SizeDistribution::between(power.clone(), from, to).unwrap_err();
    assert_eq!(refused(0.0, 1.0), SizeError::Endless("lower"));
    assert_eq!(refused(1e-6, f64::INFINITY), SizeError::Endless("upper"));
    assert!(matches!(refused(2.0, 1.0), SizeError::Limits { .. }));
    let mean = SizeDistribution::between(power, 1e-6, 2e-6).unwrap().moment(1.0);
    // ∫ r^-3 / ∫ r^-4
    let expected = 0.5 * (1.0 - 0.25) / (1.0 / 3.0 * (1.0 - 0.125)) * 1e-6;
    assert_relative_eq!(mean, expected, max_relative = 1e-12);
}
