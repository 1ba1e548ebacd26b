//! Number of drops by diameter, per volume of air.
//!
//! Exponential (Marshall & Palmer, J. Meteorol. 5, 165, 1948) and normalised gamma spectra (Willis 1984; Testud
//! et al., J. Appl. Meteorol. 40, 1118, 2001; Illingworth & Blackman 2002): `N(D) = N_w f(μ) (D/D₀)^μ exp(-(3.67 + μ) D/D₀)`, `f(μ) =
//! 6/3.67⁴ (3.67 + μ)^(μ+4)/Γ(μ+4)`, so that `N_w` is the intercept of the exponential spectrum with the same
//! water and median volume diameter.

use crate::math::gauss_legendre;

/// Drops per m³ and metre of diameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DropSpectrum {
    /// `intercept exp(-slope D)`.
    Exponential {
        /// m⁻⁴.
        intercept: f64,
        /// m⁻¹.
        slope: f64,
    },
    /// A normalised gamma spectrum.
    NormalisedGamma {
        /// `N_w`, m⁻⁴.
        intercept: f64,
        /// `D₀`, metres.
        median_volume_diameter: f64,
        /// `μ`.
        shape: f64,
    },
}

/// Widest panel of the rule in diameter, metres, and its nodes.
const PANEL: f64 = 0.5e-3;
/// The same.
const NODES: usize = 5;

impl DropSpectrum {
    /// Marshall & Palmer's: `N₀ = 8000 m⁻³ mm⁻¹`, `Λ = 4.1 R^(-0.21) mm⁻¹` at the rain rate R in mm/h.
    pub fn marshall_palmer(rain_rate_mm_h: f64) -> Self {
        Self::Exponential { intercept: 8e6, slope: 4.1e3 * rain_rate_mm_h.powf(-0.21) }
    }

    /// Number per m³ and metre of diameter (metres).
    pub fn density(&self, diameter: f64) -> f64 {
        match *self {
            Self::Exponential { intercept, slope } => intercept * (-slope * diameter).exp(),
            Self::NormalisedGamma { intercept, median_volume_diameter, shape } => {
                let (d, sum) = (diameter / median_volume_diameter, 3.67 + shape);
                let scale = 6.0 / 3.67f64.powi(4) * sum.powf(shape + 4.0);
                intercept * scale / libm::tgamma(shape + 4.0) * d.powf(shape) * (-sum * d).exp()
            }
        }
    }

    /// Diameters (metres) and numbers per m³ that stand for the drops between two diameters, in panels that
    /// none of the `kinks` lies within.
    ///
    /// ```
    /// use gonio::radar::DropSpectrum;
    /// let spectrum = DropSpectrum::marshall_palmer(5.0);
    /// let drops: f64 = spectrum.nodes((0.0, 8e-3), &[]).iter().map(|(_, number)| number).sum();
    /// let known = 8000.0 / (4.1 * 5f64.powf(-0.21));
    /// assert!((drops / known - 1.0).abs() < 1e-6);
    /// ```
    pub fn nodes(&self, (from, to): (f64, f64), kinks: &[f64]) -> Vec<(f64, f64)> {
        let mut edges: Vec<f64> = kinks.iter().copied().filter(|k| *k > from && *k < to).collect();
        edges.extend([from, to]);
        edges.sort_by(f64::total_cmp);
        edges.dedup();
        let rule = gauss_legendre::nodes(NODES);
        let mut nodes = Vec::new();
        for pair in edges.windows(2) {
            let panels = ((pair[1] - pair[0]) / PANEL - 1e-9).ceil().max(1.0);
            let half = 0.5 * (pair[1] - pair[0]) / panels;
            for panel in 0..panels as usize {
                let middle = pair[0] + half * (2 * panel + 1) as f64;
                nodes.extend(rule.iter().map(|(x, weight)| {
                    let diameter = middle + half * x;
                    (diameter, half * weight * self.density(diameter))
                }));
            }
        }
        nodes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half of the water is in drops below the median volume diameter, and N_w is the intercept of the
    /// exponential spectrum with as much water: `W = π N_w D₀⁴/3.67⁴` per unit density.
    #[test]
    fn a_normalised_gamma_holds_what_it_says() {
        for shape in [0.0, 1.5, 4.0] {
            let spectrum = DropSpectrum::NormalisedGamma {
                intercept: 1e6,
                median_volume_diameter: 2e-3,
                shape,
            };
            let volume = |range: (f64, f64)| -> f64 {
                let nodes = spectrum.nodes(range, &[]);
                nodes.iter().map(|(d, n)| n * std::f64::consts::PI / 6.0 * d.powi(3)).sum()
            };
            let (half, whole) = (volume((0.0, 2e-3)), volume((0.0, 30e-3)));
            assert!((half / whole - 0.5).abs() < 1e-3, "{shape}: {half} {whole}");
            let known = std::f64::consts::PI * 1e6 * (2e-3f64 / 3.67).powi(4);
            assert!((whole / known - 1.0).abs() < 1e-6, "{shape}: {whole} {known}");
        }
    }
}
