//! Sine and cosine of a phase given in turns, without branches, for loops that the compiler can
//! spread over vector lanes.

use super::fused::multiply_add;
use std::f64::consts::TAU;

/// `(sin 2πx, cos 2πx)` for any x; the whole turns are subtracted exactly.
#[inline(always)]
pub fn sin_cos_turns(x: f64) -> (f64, f64) {
    sin_cos_turns_with::<false>(x)
}

/// The same, with fused multiply-add where the caller is compiled for a machine that has it
/// (elsewhere that would be a slow call).
#[inline(always)]
pub fn sin_cos_turns_with<const FMA: bool>(x: f64) -> (f64, f64) {
    // Adding and subtracting 1.5·2⁵² rounds to the nearest integer without a call.
    const ROUND: f64 = 6755399441055744.0;
    let quarters = 4.0 * x;
    let nearest = (quarters + ROUND) - ROUND;
    let y = (quarters - nearest) * (0.25 * TAU);
    let y2 = y * y;
    // Taylor series on |y| ≤ π/4: the first term left out is below 1e-17.
    let s = polynomial::<FMA, 8>(
        y2,
        [
            1.0,
            -1.0 / 6.0,
            1.0 / 120.0,
            -1.0 / 5040.0,
            1.0 / 362880.0,
            -1.0 / 39916800.0,
            1.0 / 6227020800.0,
            -1.0 / 1307674368000.0,
        ],
    ) * y;
    let c = polynomial::<FMA, 8>(
        y2,
        [
            1.0,
            -0.5,
            1.0 / 24.0,
            -1.0 / 720.0,
            1.0 / 40320.0,
            -1.0 / 3628800.0,
            1.0 / 479001600.0,
            -1.0 / 87178291200.0,
        ],
    );
    // Quadrant of the turn, 0 … 3, as floating-point arithmetic.
    let half = ((0.5 * nearest + ROUND) - ROUND) * 2.0;
    let odd = nearest - half; // -1, 0 or 1
    let whole = ((0.25 * nearest + ROUND) - ROUND) * 4.0;
    let quadrant = nearest - whole; // -2 … 2
    let swap = odd != 0.0;
    let sin = if swap { c } else { s };
    let cos = if swap { s } else { c };
    // sin: quadrants 0, 1 plus; ±2, -1 minus. cos: 0, -1 plus; 1, ±2 minus.
    let sin_sign = if quadrant == 0.0 || quadrant == 1.0 { 1.0 } else { -1.0 };
    let cos_sign = if quadrant == 0.0 || quadrant == -1.0 { 1.0 } else { -1.0 };
    (sin * sin_sign, cos * cos_sign)
}

/// `c₀ + x (c₁ + x (c₂ + …))`.
#[inline(always)]
fn polynomial<const FMA: bool, const N: usize>(x: f64, c: [f64; N]) -> f64 {
    let mut value = c[N - 1];
    for k in (0..N - 1).rev() {
        value = multiply_add::<FMA>(value, x, c[k]);
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_standard_library() {
        for i in -4000..4000 {
            let x = i as f64 * 0.00371;
            let (sin, cos) = sin_cos_turns(x);
            let exact = (TAU * (x - x.round())).sin_cos();
            assert!((sin - exact.0).abs() < 4e-15 && (cos - exact.1).abs() < 4e-15, "{x}");
        }
        assert!((sin_cos_turns(1e9 + 0.25).0 - 1.0).abs() < 1e-15);
    }
}
