//! The sun's disc: its size, and how its brightness falls from centre to limb.

use super::tabulated::Tabulated;
use std::sync::LazyLock;

/// Angular radius of the sun's disc: half of 0.533° (mean distance).
pub const SUN_ANGULAR_RADIUS: f64 = 0.2665 * std::f64::consts::PI / 180.0;

static LIMB: LazyLock<Tabulated<6>> = LazyLock::new(|| {
    Tabulated::parse(include_str!("../../data/color/solar_limb_darkening_neckel_labs_1994.csv"))
});

/// Brightness across the disc at one wavelength, relative to its mean: a polynomial in `mu`, the
/// cosine of the heliocentric angle (1 at the centre, 0 at the limb). Neckel & Labs 1994, Solar
/// Phys. 153, 91, table 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimbDarkening {
    coefficients: [f64; 6],
}

impl LimbDarkening {
    /// At a wavelength in metres.
    pub fn at(wavelength: f64) -> Self {
        let a = LIMB.at(wavelength);
        // ∫ Σ A_k μ^k · 2μ dμ
        let mean: f64 = a.iter().enumerate().map(|(k, &t)| 2.0 * t / (k as f64 + 2.0)).sum();
        Self { coefficients: a.map(|term| term / mean) }
    }

    /// Brightness at `mu`.
    pub fn brightness(&self, mu: f64) -> f64 {
        self.coefficients.iter().rev().fold(0.0, |sum, &term| sum * mu + term)
    }

    /// Brightness summed along a straight chord at `offset` from the centre (in disc radii):
    /// `∫ μᵏ dy = c^(k+1) √π Γ(k/2+1)/Γ(k/2+3/2)` with `c² = 1 − offset²`.
    pub fn chord(&self, offset: f64) -> f64 {
        use std::f64::consts::PI;
        const INTEGRALS: [f64; 6] =
            [2.0, PI / 2.0, 4.0 / 3.0, 3.0 * PI / 8.0, 16.0 / 15.0, 5.0 * PI / 16.0];
        let c = (1.0 - offset * offset).max(0.0).sqrt();
        let terms = self.coefficients.iter().zip(INTEGRALS).rev();
        c * terms.fold(0.0, |sum, (&term, integral)| sum * c + term * integral)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean over the disc is 1 at every wavelength, and the limb is darker and redder.
    #[test]
    fn limb_darkening_averages_to_one() {
        for nm in [380.0, 450.0, 550.0, 650.0, 720.0] {
            let w = nm * 1e-9;
            let count = 20_000;
            let mean: f64 = (0..count)
                .map(|i| {
                    let mu = (i as f64 + 0.5) / count as f64;
                    LimbDarkening::at(w).brightness(mu) * 2.0 * mu / count as f64
                })
                .sum();
            assert!((mean - 1.0).abs() < 1e-6, "{nm} nm: {mean}");
            assert!(LimbDarkening::at(w).brightness(0.1) < LimbDarkening::at(w).brightness(1.0));
        }
        let redness = |mu: f64| {
            LimbDarkening::at(650e-9).brightness(mu) / LimbDarkening::at(450e-9).brightness(mu)
        };
        assert!(redness(0.1) > redness(1.0));
    }

    /// Neckel & Labs 1994: mean over centre intensity, F/I, at 541.76 nm is 0.8002.
    #[test]
    fn disc_mean_over_centre_is_the_published_ratio() {
        assert!((1.0 / LimbDarkening::at(541.760e-9).brightness(1.0) - 0.8002).abs() < 5.1e-5);
    }

    /// The closed form of a chord against a sum along it.
    #[test]
    fn chord_is_the_sum_along_it() {
        let limb = LimbDarkening::at(550e-9);
        for offset in [0.0, 0.3, 0.9, 0.999] {
            let half = f64::sqrt(1.0 - offset * offset);
            let count = 100_000;
            let sum: f64 = (0..count)
                .map(|i| half * (2.0 * (i as f64 + 0.5) / count as f64 - 1.0))
                .map(|y| limb.brightness((half * half - y * y).max(0.0).sqrt()))
                .sum::<f64>();
            let expected = sum * 2.0 * half / count as f64;
            approx::assert_relative_eq!(limb.chord(offset), expected, max_relative = 1e-6);
        }
    }
}
