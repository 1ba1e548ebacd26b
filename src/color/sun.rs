//! The sun's disc: its size, and how its brightness falls from centre to limb.

use super::tabulated::Tabulated;
use std::f64::consts::TAU;
use std::sync::LazyLock;

/// Angular radius of the sun's disc: half of 0.533° (mean distance).
pub const SUN_ANGULAR_RADIUS: f64 = 0.2665 * std::f64::consts::PI / 180.0;

static LIMB: LazyLock<Tabulated<6>> = LazyLock::new(|| {
    Tabulated::parse(include_str!("../../data/color/solar_limb_darkening_neckel_labs_1994.csv"))
});

/// Brightness at a wavelength (metres) relative to the disc's mean, at `mu`, the cosine of the
/// heliocentric angle (1 at the centre, 0 at the limb). Neckel & Labs 1994, Solar Phys. 153, 91.
pub fn limb_darkening(wavelength: f64, mu: f64) -> f64 {
    let a = LIMB.at(wavelength);
    let brightness = a.iter().rev().fold(0.0, |sum, &term| sum * mu + term);
    // ∫ Σ A_k μ^k · 2μ dμ
    let mean: f64 = a.iter().enumerate().map(|(k, &term)| 2.0 * term / (k as f64 + 2.0)).sum();
    brightness / mean
}

/// The disc as a set of directions around its centre, in rings of equal area.
#[derive(Clone, Debug, PartialEq)]
pub struct SunDisc {
    /// Angular radius of each ring, radians.
    pub ring: Vec<f64>,
    /// Heliocentric cosine of each ring.
    pub mu: Vec<f64>,
    /// Position angles, radians; every second ring is turned by half a step.
    pub turn: Vec<f64>,
}

impl SunDisc {
    /// `rings` rings of `points` points each; a disc of angular radius `radius`.
    pub fn new(radius: f64, rings: usize, points: usize) -> Self {
        let middle = |i: usize| ((i as f64 + 0.5) / rings as f64).sqrt();
        Self {
            ring: (0..rings).map(|i| radius * middle(i)).collect(),
            mu: (0..rings).map(|i| (1.0 - middle(i).powi(2)).sqrt()).collect(),
            turn: (0..points).map(|j| TAU * j as f64 / points as f64).collect(),
        }
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
                    limb_darkening(w, mu) * 2.0 * mu / count as f64
                })
                .sum();
            assert!((mean - 1.0).abs() < 1e-6, "{nm} nm: {mean}");
            assert!(limb_darkening(w, 0.1) < limb_darkening(w, 1.0));
        }
        let redness = |mu: f64| limb_darkening(650e-9, mu) / limb_darkening(450e-9, mu);
        assert!(redness(0.1) > redness(1.0));
    }

    /// Neckel & Labs 1994: mean over centre intensity, F/I, at 541.76 nm is 0.8002.
    #[test]
    fn disc_mean_over_centre_is_the_published_ratio() {
        assert!((1.0 / limb_darkening(541.760e-9, 1.0) - 0.8002).abs() < 5.1e-5);
    }
}
