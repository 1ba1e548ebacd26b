//! Weighted sums of knots: the kernel of the interpolation over azimuth.

use crate::farfield::branch::knots::{CHANNELS, Knot};
use crate::math::fused::multiply_add;
use multiversion::multiversion;
use multiversion::target::target_cfg_f;

/// Neighbours in the interpolation over azimuth.
pub(super) const STENCIL: usize = 8;

/// A weight for each number of a knot.
type Weights = [f64; CHANNELS];

/// Weighted sums of knots, number by number.
#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
pub(super) fn blend(
    knots: &mut [Knot],
    sources: &[&[Knot]; STENCIL],
    weights: &[Weights; STENCIL],
) {
    if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
        blend_with::<true>(knots, sources, weights);
    } else {
        blend_with::<false>(knots, sources, weights);
    }
}

#[inline(always)]
fn blend_with<const FMA: bool>(
    knots: &mut [Knot],
    sources: &[&[Knot]; STENCIL],
    weights: &[Weights; STENCIL],
) {
    let count = sources.iter().map(|s| s.len()).fold(knots.len(), usize::min);
    let sources = sources.map(|s| &s[..count]);
    for (i, knot) in knots[..count].iter_mut().enumerate() {
        let mut sum = [0.0; CHANNELS];
        for (source, weights) in sources.iter().zip(weights) {
            for c in 0..CHANNELS {
                sum[c] = multiply_add::<FMA>(weights[c], source[i].channels()[c], sum[c]);
            }
        }
        *knot.channels_mut() = sum;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn knots(of: impl Fn(usize, usize) -> f64) -> Vec<Knot> {
        let knot = |i| {
            let mut knot = Knot::default();
            *knot.channels_mut() = std::array::from_fn(|c| of(i, c));
            knot
        };
        (0..5).map(knot).collect()
    }

    /// Channel by channel with weights of its own; a missing knot of one plane ends all.
    #[test]
    fn sums_are_weighted_channel_by_channel() {
        let planes: Vec<Vec<Knot>> = (0..STENCIL)
            .map(|plane| knots(|i, c| (plane * 100 + i * 10 + c) as f64 / 7.0))
            .collect();
        let weights: [Weights; STENCIL] = std::array::from_fn(|plane| {
            std::array::from_fn(|c| (1.0 + plane as f64) * 0.3 - c as f64 * 0.01)
        });
        let mut sources: [&[Knot]; STENCIL] = std::array::from_fn(|plane| planes[plane].as_slice());
        let mut found = knots(|_, _| -1.0);
        blend(&mut found, &sources, &weights);
        for (i, knot) in found.iter().enumerate() {
            for c in 0..CHANNELS {
                let known: f64 = (planes.iter().zip(&weights))
                    .map(|(plane, weights)| plane[i].channels()[c] * weights[c])
                    .sum();
                assert!((knot.channels()[c] - known).abs() < 1e-12 * known.abs().max(1.0));
            }
        }
        sources[3] = &planes[3][..2];
        let mut short = knots(|_, _| -1.0);
        blend(&mut short, &sources, &weights);
        assert_eq!((short[1], short[2]), (found[1], knots(|_, _| -1.0)[2]));
    }
}
