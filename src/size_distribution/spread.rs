//! Drops of nearly one size: a log-normal law of small spread about a radius, by few samples.
//!
//! Pictures and diagrams of colour take it: [`log_normal_classes`] where each class is computed as a whole,
//! [`log_normal_sample`] where every wavelength may see another size.

use crate::math::GOLDEN;

/// Standard deviations that the classes reach to, on both sides.
const REACH: f64 = 2.5;
/// Quantiles nearer to the ends than this are moved inwards.
const RAREST: f64 = 1e-4;

/// Radii evenly spaced in their logarithm over ±2.5 of its standard deviation `spread`, and their shares;
/// one radius without a spread. At least two classes.
///
/// ```
/// use gonio::size_distribution::log_normal_classes;
/// let classes = log_normal_classes(1e-4, 0.1, 11);
/// assert!((classes.iter().map(|(_, share)| share).sum::<f64>() - 1.0).abs() < 1e-12);
/// assert_eq!(classes[5].0, 1e-4);
/// ```
pub fn log_normal_classes(radius: f64, spread: f64, count: usize) -> Vec<(f64, f64)> {
    if spread == 0.0 {
        return vec![(radius, 1.0)];
    }
    let place = |i: usize| 2.0 * REACH * (i as f64 / (count - 1) as f64 - 0.5);
    let norm: f64 = (0..count).map(|i| (-0.5 * place(i).powi(2)).exp()).sum();
    (0..count)
        .map(|i| (radius * (spread * place(i)).exp(), (-0.5 * place(i).powi(2)).exp() / norm))
        .collect()
}

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

    /// Both have the mean and the spread of the law, as far as their numbers go.
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
        let classes: Vec<(f64, f64)> =
            log_normal_classes(2.0, 0.1, 11).iter().map(|(r, share)| (r.ln(), *share)).collect();
        let (mean, deviation) = moments(&classes);
        // what lies beyond 2.5 deviations is cut
        assert!((mean - 2f64.ln()).abs() < 1e-12 && (0.09..0.1).contains(&deviation));
        assert_eq!(log_normal_sample(2.0, 0.0, 7), 2.0);
    }

    /// Abramowitz & Stegun 1964, table 26.5: 97.5 % of the bell lies below 1.959964.
    #[test]
    fn quantiles_as_tabulated() {
        assert!((normal_quantile(0.975) - 1.959_963_985).abs() < 1e-8);
        assert!(normal_quantile(0.5).abs() < 1e-12);
    }
}
