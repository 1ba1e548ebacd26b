//! Drops of nearly one size: a log-normal law of small spread about a radius, sample by sample, in closed form.

use crate::math::GOLDEN;

/// Quantiles nearer to the ends than this are moved inwards.
const RAREST: f64 = 1e-4;

/// The i-th sample. Samples are equally likely and spread by the golden ratio over the quantiles, so that
/// neighbouring ones are of different sizes and their mean sees all.
pub fn log_normal_sample(radius: f64, spread: f64, i: usize) -> f64 {
    if spread <= 0.0 {
        return radius;
    }
    let quantile = ((i as f64 + 0.5) * GOLDEN).fract().clamp(RAREST, 1.0 - RAREST);
    radius * (spread * normal_quantile(quantile)).exp()
}

/// Inverse of the normal distribution by bisection of the error function.
fn normal_quantile(quantile: f64) -> f64 {
    let (mut low, mut high) = (-6.0, 6.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let below = 0.5 * libm::erfc(-middle / std::f64::consts::SQRT_2);
        if below < quantile { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Samples have the mean and the spread of the law, as far as their numbers go.
    #[test]
    fn moments_of_the_law() {
        let moments = |logs: &[(f64, f64)]| {
            let mean: f64 = logs.iter().map(|(x, share)| x * share).sum();
            let square: f64 = logs.iter().map(|(x, share)| (x - mean).powi(2) * share).sum();
            (mean, square.sqrt())
        };
        let count = 4000;
        let samples: Vec<(f64, f64)> =
            (0..count).map(|i| (log_normal_sample(2.0, 0.1, i).ln(), 1.0 / count as f64)).collect();
        let (mean, deviation) = moments(&samples);
        assert!((mean - 2f64.ln()).abs() < 1e-3 && (deviation - 0.1).abs() < 1e-3, "{deviation}");
        assert_eq!(log_normal_sample(2.0, 0.0, 7), 2.0);
    }

    /// Abramowitz & Stegun 1964, table 26.5: 97.5 % of the bell lies below 1.959964.
    #[test]
    fn quantiles_as_tabulated() {
        assert!((normal_quantile(0.975) - 1.959_963_985).abs() < 1e-8);
        assert!(normal_quantile(0.5).abs() < 1e-12);
    }
}
