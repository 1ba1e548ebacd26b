//! Tests of `sizes`.

use super::*;
use crate::size_distribution::SizeDistribution;
use approx::assert_relative_eq;
use std::path::Path;

fn sizes(text: &str) -> SizeDistribution {
    checked(text).unwrap()
}

fn checked(text: &str) -> Result<SizeDistribution, String> {
    text.parse::<SizeKeys>()?.checked(Path::new(""))
}

/// A length is the same by whatever name.
#[test]
fn radius_or_diameter_in_any_unit() {
    let known = sizes("kind = 'gamma', effective_radius_um = 10, effective_variance = 0.1");
    for same in
        ["effective_radius_mm = 0.01", "effective_diameter_um = 20", "effective_radius_nm = 1e4"]
    {
        let found = sizes(&format!("kind = 'gamma', {same}, effective_variance = 0.1"));
        assert_relative_eq!(
            found.effective_radius(),
            known.effective_radius(),
            max_relative = 1e-14
        );
    }
    let twice = "kind = 'gamma', effective_radius_um = 10, effective_diameter_um = 20, effective_variance = 0.1";
    assert!(checked(twice).unwrap_err().contains("keep one"));
}

/// `⟨D^p⟩ = Γ(p + 1)/Λ^p`, Λ = 4.1 R^(-0.21)/mm.
#[test]
fn exponential_moments_in_closed_form() {
    let slope = 4.1e3 * 5f64.powf(-0.21);
    for law in [
        "kind = 'marshall-palmer', rain_rate_mm_h = 5".to_string(),
        format!("kind = 'exponential', slope_per_mm = {:e}", slope * 1e-3),
        format!("kind = 'exponential', mean_diameter_mm = {:e}", 1e3 / slope),
    ] {
        let sizes = sizes(&law);
        for p in [1, 2, 3, 4, 6] {
            let known = libm::tgamma(f64::from(p) + 1.0) * (0.5 / slope).powi(p);
            assert_relative_eq!(sizes.moment(f64::from(p)), known, max_relative = 1e-10);
        }
    }
}

/// `D_m = ⟨D⁴⟩/⟨D³⟩`; with that, `⟨D^p⟩ = Γ(μ + p + 1)/Γ(μ + 1) (D_m/(4 + μ))^p`.
#[test]
fn normalised_gamma_moments_in_closed_form() {
    for mu in [0.0, 3.0, 8.5] {
        let law = format!("kind = 'normalised-gamma', mass_weighted_diameter_mm = 1.5, mu = {mu}");
        let sizes = sizes(&law);
        assert_relative_eq!(
            2.0 * sizes.moment(4.0) / sizes.moment(3.0),
            1.5e-3,
            max_relative = 1e-10
        );
        let known =
            libm::tgamma(mu + 4.0) / libm::tgamma(mu + 1.0) * (0.75e-3 / (4.0 + mu)).powi(3);
        assert_relative_eq!(sizes.moment(3.0), known, max_relative = 1e-10);
    }
    // half of the water below D₀, by the 3.67 of radar meteorology (Γ(4, 3.67) = Γ(4)/2 to 2e-4)
    let law = "kind = 'normalised-gamma', median_volume_diameter_mm = 1.4, mu = 0";
    let below = sizes(&format!("{law}, to_diameter_mm = 1.4"));
    let share = below.moment(3.0) * below.share_inside() / sizes(law).moment(3.0);
    assert!((share - 0.5).abs() < 5e-4, "{share}");
}

/// Modified gamma: `⟨r^p⟩ = Γ((α+1+p)/γ)/Γ((α+1)/γ) b^(-p/γ)`; by its mode the same.
#[test]
fn modified_gamma_moments_in_closed_form() {
    let (alpha, gamma, b) = (4.0, 1.77, 0.0562f64);
    let mode = (alpha / (gamma * b)).powf(1.0 / gamma);
    for way in [format!("b = {b}"), format!("mode_radius_um = {mode:?}")] {
        let sizes =
            sizes(&format!("kind = 'modified-gamma', alpha = {alpha}, gamma = {gamma}, {way}"));
        for p in [1.0, 2.0, 3.0, 6.0] {
            let known =
                libm::tgamma((alpha + 1.0 + p) / gamma) / libm::tgamma((alpha + 1.0) / gamma);
            let known = known * b.powf(-p / gamma) * 1e-6f64.powf(p);
            assert_relative_eq!(sizes.moment(p), known, max_relative = 1e-10);
        }
    }
}

/// Rosin & Rammler: `1 - exp(-(D/X)^q)` of the volume lies below D.
#[test]
fn rosin_rammler_by_volume() {
    let law = "kind = 'rosin-rammler', diameter_um = 60, exponent = 3.5, from_diameter_um = 1";
    let whole = sizes(law);
    let below = sizes(&format!("{law}, to_diameter_um = 60"));
    let number = below.density(2e-5) / whole.density(2e-5);
    let share = below.moment(3.0) / number / whole.moment(3.0);
    let lowest = 1.0 - (-(1f64 / 60.0).powf(3.5)).exp();
    let known = (1.0 - (-1f64).exp() - lowest) / (1.0 - lowest);
    assert_relative_eq!(share, known, max_relative = 1e-10);
    let endless = checked("kind = 'rosin-rammler', diameter_um = 60, exponent = 2").unwrap_err();
    assert!(endless.contains("without a lower limit"), "{endless}");
}

/// The median of the volume is that of the number times `exp(3 s²)`.
#[test]
fn log_normal_by_number_area_and_volume() {
    let s = 1.6f64.ln();
    for (by, p) in [("number", 0.0), ("area", 2.0), ("volume", 3.0)] {
        let law = format!(
            "kind = 'log-normal', median_radius_um = 5, geometric_standard_deviation = 1.6, by = '{by}'"
        );
        let sizes = sizes(&law);
        let median = 5e-6 * (-p * s * s).exp();
        assert_relative_eq!(sizes.moment(1.0), median * (0.5 * s * s).exp(), max_relative = 1e-10);
    }
    let both =
        "kind = 'log-normal', median_radius_um = 5, spread = 0.1, geometric_standard_deviation = 2";
    assert!(checked(both).unwrap_err().contains("keep one"));
}

/// `n ∝ r^-4` between two limits, in closed form.
#[test]
fn power_law_and_limits() {
    let law = sizes("kind = 'power-law', exponent = -4, from_radius_um = 0.1, to_radius_um = 10");
    let known = 1.5 * (1e14 - 1e10) / (1e21 - 1e15);
    assert_relative_eq!(law.moment(1.0), known, max_relative = 1e-10);
    let wrong = |text: &str, words: &str| {
        let error = checked(text).unwrap_err();
        assert!(error.contains(words), "{text}: {error}");
    };
    let power = "kind = 'power-law', exponent = -4";
    wrong(power, "without a lower limit");
    wrong(&format!("{power}, from_radius_um = 0.1"), "infinite");
    wrong(&format!("{power}, from_radius_um = 10, to_radius_um = 1"), "from_radius_um = 10");
    wrong(&format!("{power}, from_radius_um = 1, to_diameter_mm = 1e-3"), "to_diameter_mm = 0.001");
    wrong(&format!("{power}, form_radius_um = 1"), "unknown field `form_radius_um`");
    wrong("kind = 'delta', radius_um = 1, to_radius_um = 2", "unknown field `to_radius_um`");
    wrong("kind = 'gama'", "unknown variant `gama`");
    wrong("median_radius_um = 1", "missing field `kind`");
}

#[test]
fn histograms() {
    let bins = sizes("kind = 'histogram', edges_diameter_mm = [0.2, 0.5, 1], number = [3, 1]");
    assert_relative_eq!(bins.moment(1.0), 0.75 * 0.175e-3 + 0.25 * 0.375e-3, max_relative = 1e-12);
    let wrong = |text: &str, words: &str| {
        let error = checked(&format!("kind = 'histogram', {text}")).unwrap_err();
        assert!(error.contains(words), "{text}: {error}");
    };
    wrong("edges_radius_um = [1, 2], number = [1, 2]", "2 numbers for 2 edges");
    wrong("edges_radius_um = [1, 3, 2], number = [1, 2]", "must ascend");
    wrong("edges_radius_um = [1, 2, 3], number = [1, -2]", "number = -2");
    wrong("edges_radius_um = [1, 2, 3], number = [0, 0]", "no particles");
    wrong("edges_radius_um = [1, 2, 3]", "missing field `number`");
    wrong("number = [1]", "missing field `edges_radius_um`");
    wrong("edges_radius_um = [1, 2], number = [1], from_radius_um = 5", "no particles");
}
