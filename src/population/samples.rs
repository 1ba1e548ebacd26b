//! Sizes one by one, where every wavelength may see another: colours average over wavelengths anyway.

use crate::math::GOLDEN;
use crate::size_distribution::SizeDistribution;

/// Radii of a distribution, equally likely, in an order in which neighbours differ.
///
/// ```
/// use gonio::population::SampledSizes;
/// use gonio::size_distribution::{SizeDistribution, SizeLaw};
/// let sizes = SizeDistribution::whole(SizeLaw::gamma(1e-5, 0.1))?;
/// let samples = SampledSizes::new(&sizes);
/// let mean = (0..1000).map(|i| samples.radius(i)).sum::<f64>() / 1000.0;
/// assert!((mean / sizes.moment(1.0) - 1.0).abs() < 2e-3);
/// # Ok::<(), gonio::size_distribution::SizeError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SampledSizes {
    below: Vec<(f64, f64)>,
}

impl SampledSizes {
    /// Of a distribution.
    pub fn new(sizes: &SizeDistribution) -> Self {
        Self { below: sizes.shares_below() }
    }

    /// The i-th radius, metres: the golden ratio spreads samples evenly over the quantiles.
    pub fn radius(&self, i: usize) -> f64 {
        let quantile = ((i as f64 + 0.5) * GOLDEN).fract();
        let above = self.below.partition_point(|(_, share)| *share < quantile);
        let above = above.clamp(1, self.below.len() - 1);
        let ((low, from), (high, to)) = (self.below[above - 1], self.below[above]);
        if to > from { low + (high - low) * (quantile - from) / (to - from) } else { low }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::size_distribution::SizeLaw;

    /// Means over samples are those of the law, from narrow bells to histograms with a hole.
    #[test]
    fn samples_have_the_moments_of_their_law() {
        let edges: std::sync::Arc<[f64]> = [1e-6, 2e-6, 5e-6, 6e-6].into();
        let numbers: std::sync::Arc<[f64]> = [1.0, 0.0, 3.0].into();
        for law in [
            SizeLaw::LogNormal { median: 1e-4, spread: 0.05 },
            SizeLaw::gamma(1e-5, 0.1),
            SizeLaw::Histogram { edges, numbers },
        ] {
            let sizes = SizeDistribution::whole(law.clone()).unwrap();
            let samples = SampledSizes::new(&sizes);
            for power in [1, 2] {
                let mean = (0..8000).map(|i| samples.radius(i).powi(power)).sum::<f64>() / 8000.0;
                let known = sizes.moment(f64::from(power));
                assert!((mean / known - 1.0).abs() < 1e-3, "{law:?} {power}: {mean} {known}");
            }
        }
        assert_eq!(SampledSizes::new(&SizeDistribution::delta(2e-6)).radius(3), 2e-6);
    }
}
