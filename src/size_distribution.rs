//! Distributions of particle sizes: how many particles there are per size.
//!
//! Densities are numbers per radius, not normalised: whatever is averaged is divided by its weight.
//! Gamma after Hansen & Travis 1974 (Space Sci. Rev. 16, 527, eq. 2.56), by effective radius and
//! effective variance; rain after Marshall & Palmer 1948 (J. Meteorol. 5, 165).

/// Number of particles by radius (metres).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SizeDistribution {
    /// All of one radius.
    Delta { radius: f64 },
    /// `exp(-(r - mean)²/2σ²)` for r > 0.
    Normal { mean: f64, deviation: f64 },
    /// `exp(-ln²(r/median)/2s²)/r`; `spread` s is the standard deviation of ln r.
    LogNormal { median: f64, spread: f64 },
    /// `r^((1-3v)/v) exp(-r/(v r_eff))`.
    Gamma { effective_radius: f64, effective_variance: f64 },
    /// `exp(-Λ D)` between two radii, Λ = 4.1 R^(-0.21) mm⁻¹ at the rain rate R in mm/h.
    MarshallPalmer { rain_rate: f64, from: f64, to: f64 },
}

use std::f64::consts::{SQRT_2, TAU};

/// Samples of a search for the limits and of the moments, evenly spaced in ln r.
const SAMPLES: usize = 20_000;

impl SizeDistribution {
    /// Number per radius, up to a common factor.
    pub fn density(&self, radius: f64) -> f64 {
        if radius <= 0.0 {
            return 0.0;
        }
        match *self {
            Self::Delta { radius: only } => f64::from(u8::from(radius == only)),
            Self::Normal { mean, deviation } => {
                (-0.5 * ((radius - mean) / deviation).powi(2)).exp()
            }
            Self::LogNormal { median, spread } => {
                (-0.5 * ((radius / median).ln() / spread).powi(2)).exp() * median / radius
            }
            Self::Gamma { effective_radius: a, effective_variance: v } => {
                // Divided by its value at r = a, in logarithms, so that nothing overflows.
                let exponent = (1.0 - 3.0 * v) / v;
                (exponent * (radius / a).ln() - (radius - a) / (a * v)).exp()
            }
            Self::MarshallPalmer { rain_rate, from, to } => {
                let inside = (from..=to).contains(&radius);
                if inside { (-slope(rain_rate) * 2.0 * (radius - from)).exp() } else { 0.0 }
            }
        }
    }

    /// Number of particles: the integral of the density, in closed form.
    pub fn number(&self) -> f64 {
        match *self {
            Self::Delta { .. } => 1.0,
            Self::Normal { mean, deviation } => {
                let below = 0.5 * libm::erfc(mean / (deviation * SQRT_2));
                deviation * TAU.sqrt() * (1.0 - below)
            }
            Self::LogNormal { median, spread } => median * spread * TAU.sqrt(),
            Self::Gamma { effective_radius: a, effective_variance: v } => {
                // ∫ (r/a)^(k-1) exp(-(r-a)/(a v)) dr = a v^k Γ(k) e^(1/v), k = (1-2v)/v
                let k = (1.0 - 2.0 * v) / v;
                a * (k * v.ln() + libm::lgamma(k) + 1.0 / v).exp()
            }
            Self::MarshallPalmer { rain_rate, from, to } => {
                let decay = 2.0 * slope(rain_rate);
                -(-decay * (to - from)).exp_m1() / decay
            }
        }
    }

    /// Whether the density ends in a step, where the rule of equal steps needs help.
    pub fn has_steps(&self) -> bool {
        match *self {
            Self::MarshallPalmer { .. } => true,
            // A bell that is cut off at zero.
            Self::Normal { mean, deviation } => mean < 6.0 * deviation,
            _ => false,
        }
    }

    /// Radii between which all but the share `tail` of both the shadows (r²) and the forward
    /// scattering (r⁴) lies.
    pub fn limits(&self, tail: f64) -> (f64, f64) {
        match *self {
            Self::Delta { radius } => (radius, radius),
            Self::MarshallPalmer { from, to, .. } => (from, to),
            _ => {
                let (low, high) = self.span();
                // Where large drops absorb, the small ones shine all the more.
                let low_cut = self.quantile(low, high, 2, 0.02 * tail);
                let high_cut = self.quantile(low, high, 4, 1.0 - tail);
                (low_cut, high_cut)
            }
        }
    }

    /// Mean of r³ over mean of r²: the radius of the sphere with the same volume per shadow.
    pub fn effective_radius(&self) -> f64 {
        match *self {
            Self::Delta { radius } => radius,
            Self::Gamma { effective_radius, .. } => effective_radius,
            _ => self.moment(3) / self.moment(2),
        }
    }

    /// Variance of the radius about the effective radius, weighted with the shadow, in units of the
    /// effective radius squared.
    pub fn effective_variance(&self) -> f64 {
        match *self {
            Self::Delta { .. } => 0.0,
            _ => self.moment(4) * self.moment(2) / self.moment(3).powi(2) - 1.0,
        }
    }

    /// Mean of a power of the radius over the number of particles, m to that power.
    pub fn mean_power(&self, power: i32) -> f64 {
        match *self {
            Self::Delta { radius } => radius.powi(power),
            _ => self.moment(power) / self.number(),
        }
    }

    /// Radii beyond which nothing counts, even weighted with r⁴.
    fn span(&self) -> (f64, f64) {
        match *self {
            Self::Delta { radius } => (radius, radius),
            Self::Normal { mean, deviation } => {
                ((mean - 10.0 * deviation).max(1e-3 * mean), mean + 12.0 * deviation)
            }
            Self::LogNormal { median, spread } => {
                // Weighted with r⁴ the bell moves up by 4 s² in ln r.
                let reach = 10.0 * spread;
                (median * (-reach).exp(), median * (reach + 4.0 * spread * spread).exp())
            }
            Self::Gamma { effective_radius: a, effective_variance: v } => {
                (1e-4 * a, a * (1.0 + 12.0 * v.sqrt() + 60.0 * v))
            }
            Self::MarshallPalmer { from, to, .. } => (from, to),
        }
    }

    fn moment(&self, power: i32) -> f64 {
        let (low, high) = self.span();
        samples(low, high).map(|(r, width)| self.density(r) * r.powi(power) * width).sum()
    }

    /// Radius below which the share `share` of the moment lies.
    fn quantile(&self, low: f64, high: f64, power: i32, share: f64) -> f64 {
        let total: f64 = self.moment(power);
        let mut sum = 0.0;
        for (r, width) in samples(low, high) {
            sum += self.density(r) * r.powi(power) * width;
            if sum >= share * total {
                return r;
            }
        }
        high
    }
}

/// Midpoints of equal steps in ln r, with their widths in r.
fn samples(low: f64, high: f64) -> impl Iterator<Item = (f64, f64)> {
    let step = (high / low).ln() / SAMPLES as f64;
    (0..SAMPLES).map(move |i| {
        let r = low * ((i as f64 + 0.5) * step).exp();
        (r, r * step)
    })
}

/// Λ of Marshall & Palmer in 1/m, by diameter.
fn slope(rain_rate: f64) -> f64 {
    4.1e3 * rain_rate.powf(-0.21)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Closed forms of r_eff: gamma by definition; log-normal median exp(5s²/2); a normal one from
    /// its moments (m³ + 3mσ²)/(m² + σ²).
    #[test]
    fn effective_radii_in_closed_form() {
        let gamma = SizeDistribution::Gamma { effective_radius: 1e-5, effective_variance: 0.1 };
        let moments = gamma.moment(3) / gamma.moment(2);
        assert_relative_eq!(gamma.effective_radius(), moments, max_relative = 1e-6);
        let log = SizeDistribution::LogNormal { median: 2e-6, spread: 0.4 };
        let expected = 2e-6 * f64::exp(2.5 * 0.16);
        assert_relative_eq!(log.effective_radius(), expected, max_relative = 1e-6);
        let normal = SizeDistribution::Normal { mean: 1e-5, deviation: 1e-6 };
        let expected = (1e-15 + 3e-5 * 1e-12) / (1e-10 + 1e-12);
        assert_relative_eq!(normal.effective_radius(), expected, max_relative = 1e-6);
    }

    /// Closed forms: gamma ⟨r³⟩ = a³ (1 - v)(1 - 2v), ⟨r²⟩ = a² (1 - v)(1 - 2v), variance v; log-normal
    /// ⟨r³⟩ = r_eff³ exp(-3 s²), variance exp(s²) - 1.
    #[test]
    fn volumes_and_variances_in_closed_form() {
        let (a, v) = (1e-5, 0.1);
        let gamma = SizeDistribution::Gamma { effective_radius: a, effective_variance: v };
        let share = (1.0 - v) * (1.0 - 2.0 * v);
        assert_relative_eq!(gamma.mean_power(3), a.powi(3) * share, max_relative = 1e-6);
        assert_relative_eq!(gamma.mean_power(2), a.powi(2) * share, max_relative = 1e-6);
        assert_relative_eq!(gamma.effective_variance(), v, max_relative = 1e-6);
        let log = SizeDistribution::LogNormal { median: 2e-6, spread: 0.4 };
        let volume = (log.effective_radius()).powi(3) * f64::exp(-3.0 * 0.16);
        assert_relative_eq!(log.mean_power(3), volume, max_relative = 1e-6);
        assert_relative_eq!(log.effective_variance(), 0.16f64.exp_m1(), max_relative = 1e-6);
        let one = SizeDistribution::Delta { radius: a };
        assert_eq!((one.mean_power(3), one.effective_variance()), (a.powi(3), 0.0));
    }

    /// Closed forms against sums.
    #[test]
    fn numbers_are_the_integrals_of_the_densities() {
        for sizes in [
            SizeDistribution::Gamma { effective_radius: 1e-5, effective_variance: 0.1 },
            SizeDistribution::Gamma { effective_radius: 1e-5, effective_variance: 1e-3 },
            SizeDistribution::LogNormal { median: 2e-6, spread: 0.4 },
            SizeDistribution::Normal { mean: 1e-5, deviation: 1e-6 },
            SizeDistribution::Normal { mean: 1e-5, deviation: 4e-6 },
            SizeDistribution::MarshallPalmer { rain_rate: 5.0, from: 1e-4, to: 2e-3 },
        ] {
            // The sum begins a little above zero.
            assert_relative_eq!(sizes.number(), sizes.moment(0), max_relative = 3e-4);
        }
    }

    /// Gamma's tail in closed form: with r⁴ it is a gamma law of shape 1/v + 2 = 12.
    #[test]
    fn limits_leave_the_share_asked_for() {
        let gamma = SizeDistribution::Gamma { effective_radius: 1e-5, effective_variance: 0.1 };
        let (_, high) = gamma.limits(1e-6);
        let t = high / 1e-6;
        // Q(12, t) = exp(-t) Σ_{k<12} t^k/k!
        let (mut term, mut sum) = (1.0, 0.0);
        for k in 0..12 {
            sum += term;
            term *= t / f64::from(k + 1);
        }
        let tail = (-t).exp() * sum;
        assert!((0.9e-6..1.1e-6).contains(&tail), "{tail:e}");
    }

    /// Rain at 1 mm/h: half as many drops per size every ln 2/4.1 mm of diameter.
    #[test]
    fn rain_halves() {
        let rain = SizeDistribution::MarshallPalmer { rain_rate: 1.0, from: 1e-4, to: 3e-3 };
        let step = 0.5 * std::f64::consts::LN_2 / 4.1e3;
        let ratio = rain.density(1e-3 + step) / rain.density(1e-3);
        assert_relative_eq!(ratio, 0.5, max_relative = 1e-12);
        assert_eq!(rain.density(9e-5), 0.0);
    }
}
