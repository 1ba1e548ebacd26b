//! Light scattered once in a layer: the closed form.

/// Which side of the layer is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The side that the sun shines on: reflected light.
    Lit,
    /// The other: transmitted light.
    Far,
}

/// Radiance of light scattered once, over the irradiance across the sun's rays, the albedo of single scattering and the phase
/// function (sr⁻¹): `1/μ ∫ exp(−t/μ₀) exp(−way out/μ) dt` over the optical depth, μ and μ₀ cosines to the normal.
///
/// ```
/// use gonio::transfer::{Side, once};
///
/// // a thin layer, however it is looked at: the optical depth along the line of sight
/// assert!((once(Side::Lit, 1e-6, 0.5, 0.3) / 2e-6 - 1.0).abs() < 1e-5);
/// assert!((once(Side::Far, 1e-6, 0.5, 0.3) / 2e-6 - 1.0).abs() < 1e-5);
/// ```
pub fn once(side: Side, depth: f64, view: f64, sun: f64) -> f64 {
    match side {
        Side::Lit => sun / (sun + view) * -(-depth * (1.0 / sun + 1.0 / view)).exp_m1(),
        Side::Far => {
            // (exp(−τ/μ₀) − exp(−τ/μ)) μ₀/(μ₀−μ), which stays finite where both cosines are one
            let apart = depth * (1.0 / view - 1.0 / sun);
            let mean =
                if apart.abs() < 1e-8 { 1.0 - 0.5 * apart } else { -(-apart).exp_m1() / apart };
            depth / view * (-depth / sun).exp() * mean
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The integral done by steps, on both sides of μ = μ₀ and there.
    #[test]
    fn the_closed_form_is_the_integral() {
        for (depth, view, sun) in
            [(2.0, 0.3, 0.8), (0.7, 0.8, 0.3), (1.5, 0.5, 0.5), (40.0, 0.1, 0.9)]
        {
            let steps = 400_000;
            let mut sums = [0.0; 2];
            for i in 0..steps {
                let t = depth * (f64::from(i) + 0.5) / f64::from(steps);
                let lit = (-t / sun).exp() * depth / f64::from(steps) / view;
                sums[0] += lit * (-t / view).exp();
                sums[1] += lit * (-(depth - t) / view).exp();
            }
            for (side, sum) in [Side::Lit, Side::Far].into_iter().zip(sums) {
                let found = once(side, depth, view, sun);
                assert!((found - sum).abs() < 1e-7 * sum.max(1e-6), "{side:?} {found} {sum}");
            }
        }
    }
}
