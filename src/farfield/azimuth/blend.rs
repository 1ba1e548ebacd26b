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
