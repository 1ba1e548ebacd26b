//! Where the light of a distribution ends: radii beyond which what spheres scatter counts for nothing.

use super::{SMALL, SizeDistribution};

impl SizeDistribution {
    /// Stretches of radii between which the density is smooth, ascending, that leave out no more
    /// than the share `tail` of the light of spheres at a wavenumber (1/m).
    pub fn stretches(&self, tail: f64, wavenumber: f64) -> Vec<(f64, f64)> {
        let (low, high) = self.limits(tail, wavenumber);
        let inner = self.law.breaks().iter().copied().filter(|&r| r > low && r < high);
        let edges: Vec<f64> = [low].into_iter().chain(inner).chain([high]).collect();
        let filled = |pair: &&[f64]| self.density(0.5 * (pair[0] + pair[1])) > 0.0;
        edges.windows(2).filter(filled).map(|pair| (pair[0], pair[1])).collect()
    }

    /// Radii between which all but the share `tail` lies: at the small end of the shadows (r²), at
    /// the large one of the light straight ahead of spheres at a wavenumber (1/m).
    pub fn limits(&self, tail: f64, wavenumber: f64) -> (f64, f64) {
        if self.single().is_some() {
            return (self.from, self.to);
        }
        let span = (self.span(2.0, 2.0).0, self.span(4.0, SMALL).1);
        // Where large drops absorb, the small ones shine all the more.
        let shadows = self.weighted(span, |r| r * r);
        let total: f64 = shadows.iter().map(|w| w.1).sum();
        let low = past(shadows.iter(), 0.02 * tail * total).unwrap_or(span.0);
        let straight = |r: f64| {
            let x4 = (wavenumber * r).powi(4);
            (r / span.0).powi(4) * x4 / (1.0 + x4)
        };
        let light = self.weighted(span, straight);
        let total: f64 = light.iter().map(|w| w.1).sum();
        let high = past(light.iter().rev(), tail * total).unwrap_or(span.1);
        // The last node inside the neglected share is not the limit itself.
        let low = if low <= shadows[0].0 { span.0 } else { low };
        let high = if high >= light[light.len() - 1].0 { span.1 } else { high };
        if low < high { (low, high) } else { span }
    }
}

/// The radius up to which the weights sum to `share`, the last before they exceed it.
fn past<'a>(weights: impl Iterator<Item = &'a (f64, f64)>, share: f64) -> Option<f64> {
    let mut sum = 0.0;
    for (r, weight) in weights {
        sum += weight;
        if sum > share {
            return Some(*r);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::SizeLaw;
    use super::*;

    fn whole(law: SizeLaw) -> SizeDistribution {
        SizeDistribution::whole(law).unwrap()
    }

    /// Gamma's tail in closed form: with r⁴ it is a gamma law of shape 1/v + 2 = 12.
    #[test]
    fn limits_leave_the_share_asked_for() {
        let gamma = whole(SizeLaw::gamma(1e-5, 0.1));
        for share in [1e-3, 1e-6, 1e-9] {
            let (_, high) = gamma.limits(share, 1e9);
            let t = high / 1e-6;
            // Q(12, t) = exp(-t) Σ_{k<12} t^k/k!
            let (mut term, mut sum) = (1.0, 0.0);
            for k in 0..12 {
                sum += term;
                term *= t / f64::from(k + 1);
            }
            let tail = (-t).exp() * sum / share;
            assert!((0.8..1.1).contains(&tail), "{share:e}: {tail:e}");
        }
    }

    /// The tails of the light of small particles fall as r⁶: at 1e-9 they end far beyond the bell.
    #[test]
    fn limits_of_small_particles_hold_their_light() {
        let s = 0.3;
        let log = whole(SizeLaw::LogNormal { median: 5e-9, spread: s });
        let (_, high) = log.limits(1e-6, std::f64::consts::TAU / 550e-9);
        // With r⁸ the bell stands at 8 s² beyond the median.
        let place = ((high / 5e-9).ln() - 8.0 * s * s) / s;
        let tail = 0.5 * libm::erfc(place / std::f64::consts::SQRT_2);
        assert!((0.5e-6..1.2e-6).contains(&tail), "{tail:e}");
    }
}
