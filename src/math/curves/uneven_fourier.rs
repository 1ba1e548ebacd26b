//! Fourier sums between uneven points: `f(t_m) = Σ_k F_k exp(-i s_k t_m)`, eight sequences at once.
//!
//! Every term is spread over a few points of an even grid of `s` with a kernel `φ` whose transform is known; the
//! even grid is transformed fast; the transform is read between its own even points with the same kernel, and both
//! spreadings are divided out (Greengard & Lee, SIAM Rev. 46, 443 (2004), type 3). With the kernel
//! `φ(z) = exp(β(√(1 - (2z/w)²) - 1))` on `w` points of a grid twice as fine as the sums need, sums err by 1e-8 of
//! `Σ|F_k|` (Barnett, Magland & af Klinteberg, SIAM J. Sci. Comput. 41, C479 (2019)).

use super::chebyshev::{self, Chebyshev};
use super::lane_fourier::{LANES, LaneFourier, Row};
use crate::math::fused::multiply_add;
use crate::math::gauss_legendre;
use multiversion::multiversion;
use multiversion::target::target_cfg_f;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::{LazyLock, OnceLock};

/// Points of a grid over which a term is spread.
const TAPS: usize = 10;
/// `β` of the kernel, for a grid twice as fine as need be.
const NARROWNESS: f64 = 2.3 * TAPS as f64;
/// Degree of the polynomials that stand for the kernel between two points of the grid.
const DEGREE: usize = 14;

/// The kernel at a distance, in steps of the grid.
fn kernel(z: f64) -> f64 {
    let u = 2.0 * z / TAPS as f64;
    if u.abs() >= 1.0 { 0.0 } else { (NARROWNESS * ((1.0 - u * u).sqrt() - 1.0)).exp() }
}

/// What is known of the kernel beforehand.
struct Kernel {
    /// At every tap, by powers of the place between two points of the grid, from -1 to 1; highest power first.
    taps: [[f64; TAPS]; DEGREE + 1],
    /// One over its transform `∫ φ(z) e^{-iξz} dz`, by `ξ²`.
    inverse: Chebyshev<1>,
}

static KERNEL: LazyLock<Kernel> = LazyLock::new(|| {
    let mut taps = [[0.0; TAPS]; DEGREE + 1];
    let points = chebyshev::points(DEGREE + 1, -1.0, 1.0);
    for tap in 0..TAPS {
        let at = |v: &f64| [kernel(tap as f64 - 0.5 * TAPS as f64 + 0.5 * (1.0 + v))];
        let values: Vec<[f64; 1]> = points.iter().map(at).collect();
        for (row, power) in taps.iter_mut().rev().zip(powers(&Chebyshev::fit(&values, -1.0, 1.0))) {
            row[tap] = power;
        }
    }
    let rule = gauss_legendre::nodes(64);
    let half = 0.5 * TAPS as f64;
    let transform = |xi: f64| -> f64 {
        rule.iter().map(|(z, w)| half * w * kernel(half * z) * (xi * half * z).cos()).sum()
    };
    let to = FRAC_PI_2 * FRAC_PI_2;
    let squares = chebyshev::points(20, 0.0, to);
    let values: Vec<[f64; 1]> =
        squares.iter().map(|square| [1.0 / transform(square.sqrt())]).collect();
    Kernel { taps, inverse: Chebyshev::fit(&values, 0.0, to).rounded() }
});

/// Coefficients by powers, lowest first, of a polynomial on -1 to 1.
fn powers(series: &Chebyshev<1>) -> [f64; DEGREE + 1] {
    let mut sum = [0.0; DEGREE + 1];
    // T_n by powers
    let (mut before, mut here) = ([0.0; DEGREE + 1], [0.0; DEGREE + 1]);
    for (n, [coefficient]) in series.coefficients().iter().enumerate() {
        let next: [f64; DEGREE + 1] = std::array::from_fn(|k| match n {
            0 => f64::from(u8::from(k == 0)),
            1 => f64::from(u8::from(k == 1)),
            _ => 2.0 * if k == 0 { 0.0 } else { here[k - 1] } - before[k],
        });
        (before, here) = (here, next);
        sum.iter_mut().zip(here).for_each(|(sum, power)| *sum += coefficient * power);
    }
    sum
}

/// The transform of a length, prepared once.
fn transform(length: usize) -> &'static LaneFourier {
    static ALL: [OnceLock<LaneFourier>; 2 * usize::BITS as usize] =
        [const { OnceLock::new() }; 2 * usize::BITS as usize];
    let place = 2 * length.ilog2() as usize + usize::from(!length.is_power_of_two());
    ALL[place].get_or_init(|| LaneFourier::new(length))
}

/// Multiply-adds of a plain sum below which it is the faster one.
const PLAIN: usize = 20_000;

/// Whether so many sums of so many terms are faster this way than one by one.
pub fn pays(terms: usize, sums: usize) -> bool {
    terms * sums > PLAIN
}

/// `Σ_k F_k exp(-i s_k t_m)` for all `m`.
///
/// ```text
/// s_k = s₀ + hz_k,   Σ_k F_k exp(-i s_k t) = exp(-i s₀ t) / φ̂(ht) Σ_j g_j exp(-ihjt),   g_j = Σ_k F_k φ(j - z_k)
/// ```
pub fn sums(s: &[f64], terms: &[Row], t: &[f64]) -> Vec<Row> {
    let ([low, high], [from, to]) = (range(s), range(t));
    let centre = 0.5 * (from + to);
    let reach = (0.5 * (to - from)).max(f64::MIN_POSITIVE);
    // so fine that all |ht| are at most a quarter turn
    let step = (FRAC_PI_2 / reach).min((high - low).max(1.0));
    let room = 0.5 * TAPS as f64;
    let count = ((high - low) / step).ceil() as usize + TAPS + 2;
    let middle = count / 2;
    let origin = low - room * step;

    let mut grid = vec![Row::ZERO; count];
    let places: Vec<f64> = s.iter().map(|s| (s - origin) / step).collect();
    let turned: Vec<Row> =
        s.iter().zip(terms).map(|(s, term)| times(term, (-s * centre).sin_cos())).collect();
    let kernel = &*KERNEL;
    spread(&kernel.taps, &places, &turned, &mut grid);

    let fourier = transform(LaneFourier::length_from(2 * count));
    let length = fourier.length();
    let inverse = |xi: f64| kernel.inverse.value(xi * xi)[0];
    let mut rows = vec![Row::ZERO; length];
    for (j, row) in grid.iter().enumerate() {
        let off = j as f64 - middle as f64;
        let factor = inverse(TAU * off / length as f64);
        rows[(j + length - middle) % length] = times(row, (0.0, factor));
    }
    fourier.transform(&mut rows, &mut Vec::new());

    // the transform has the other sign: its points run backwards
    let per_step = -(length as f64) * step / TAU;
    let places: Vec<f64> = t.iter().map(|t| (t - centre) * per_step).collect();
    let mut found = vec![Row::ZERO; t.len()];
    gather(&kernel.taps, &places, &rows, &mut found);
    for (row, t) in found.iter_mut().zip(t) {
        let off = t - centre;
        let factor = inverse(off * step);
        let (sin, cos) = (-(origin + middle as f64 * step) * off).sin_cos();
        *row = times(row, (factor * sin, factor * cos));
    }
    found
}

fn range(values: &[f64]) -> [f64; 2] {
    values.iter().fold([f64::MAX, f64::MIN], |[low, high], v| [low.min(*v), high.max(*v)])
}

/// A row times a complex number, given as its imaginary and real part.
#[inline]
fn times(row: &Row, (im, re): (f64, f64)) -> Row {
    let mut found = Row::ZERO;
    for l in 0..LANES {
        found.re[l] = row.re[l] * re - row.im[l] * im;
        found.im[l] = row.re[l] * im + row.im[l] * re;
    }
    found
}

/// The kernel at the taps about a place of a grid, and the first of them.
#[inline(always)]
fn taps_at<const FMA: bool>(taps: &[[f64; TAPS]; DEGREE + 1], place: f64) -> (i64, [f64; TAPS]) {
    let first = (place - 0.5 * TAPS as f64).ceil();
    let v = 2.0 * (first - (place - 0.5 * TAPS as f64)) - 1.0;
    let mut values = taps[0];
    for row in &taps[1..] {
        for (value, power) in values.iter_mut().zip(row) {
            *value = multiply_add::<FMA>(*value, v, *power);
        }
    }
    (first as i64, values)
}

#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
fn spread(taps: &[[f64; TAPS]; DEGREE + 1], places: &[f64], terms: &[Row], grid: &mut [Row]) {
    if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
        spread_with::<true>(taps, places, terms, grid);
    } else {
        spread_with::<false>(taps, places, terms, grid);
    }
}

#[inline(always)]
fn spread_with<const FMA: bool>(
    taps: &[[f64; TAPS]; DEGREE + 1],
    places: &[f64],
    terms: &[Row],
    grid: &mut [Row],
) {
    for (&place, term) in places.iter().zip(terms) {
        let (first, weights) = taps_at::<FMA>(taps, place);
        let Some(near) = grid.get_mut(first as usize..first as usize + TAPS) else { continue };
        for (row, weight) in near.iter_mut().zip(weights) {
            for l in 0..LANES {
                row.re[l] = multiply_add::<FMA>(term.re[l], weight, row.re[l]);
                row.im[l] = multiply_add::<FMA>(term.im[l], weight, row.im[l]);
            }
        }
    }
}

#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
fn gather(taps: &[[f64; TAPS]; DEGREE + 1], places: &[f64], rows: &[Row], found: &mut [Row]) {
    if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
        gather_with::<true>(taps, places, rows, found);
    } else {
        gather_with::<false>(taps, places, rows, found);
    }
}

#[inline(always)]
fn gather_with<const FMA: bool>(
    taps: &[[f64; TAPS]; DEGREE + 1],
    places: &[f64],
    rows: &[Row],
    found: &mut [Row],
) {
    let length = rows.len() as i64;
    for (&place, sum) in places.iter().zip(found) {
        let (first, weights) = taps_at::<FMA>(taps, place);
        for (k, weight) in weights.into_iter().enumerate() {
            let row = &rows[(first + k as i64).rem_euclid(length) as usize];
            for l in 0..LANES {
                sum.re[l] = multiply_add::<FMA>(row.re[l], weight, sum.re[l]);
                sum.im[l] = multiply_add::<FMA>(row.im[l], weight, sum.im[l]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_complex::Complex64;

    fn uneven(count: usize, from: f64, to: f64, seed: f64) -> Vec<f64> {
        let at = |k: usize| (seed + k as f64 * crate::math::GOLDEN).fract();
        (0..count).map(|k| from + (to - from) * at(k)).collect()
    }

    /// Against the sums as they are written: few and many terms, wide and narrow ranges, far from zero, one point.
    #[test]
    fn sums_are_the_plain_ones() {
        let cases = [
            (300, [900.0, 1100.0], 200, [1.0, 2.5]),
            (40, [-50.0, 4000.0], 700, [-0.3, 0.4]),
            (500, [1e4, 1.3e4], 60, [3.0, 3.001]),
            (7, [0.0, 1e-3], 5, [0.0, 1e-3]),
            (30, [5.0, 6.0], 1, [0.7, 0.9]),
            (1, [5.0, 6.0], 30, [0.7, 90.0]),
        ];
        for (terms, [low, high], count, [from, to]) in cases {
            let s = uneven(terms, low, high, 0.1);
            let t = uneven(count, from, to, 0.7);
            let value =
                |k: usize, l: usize| Complex64::cis((k * k + 3 * l) as f64) * (1 + l) as f64;
            let rows: Vec<Row> = (0..terms)
                .map(|k| Row {
                    re: std::array::from_fn(|l| value(k, l).re),
                    im: std::array::from_fn(|l| value(k, l).im),
                })
                .collect();
            for (row, t) in sums(&s, &rows, &t).iter().zip(&t) {
                for l in 0..LANES {
                    let wave = |k: usize| Complex64::cis(-s[k] * t) * value(k, l);
                    let sum: Complex64 = (0..terms).map(wave).sum();
                    let found = Complex64::new(row.re[l], row.im[l]);
                    let size = (terms * (1 + l)) as f64;
                    let off = (found - sum).norm() / size;
                    assert!(off < 1.5e-8, "{terms} of {low} to {high}, {t}, {l}: {off:e}");
                }
            }
        }
    }

    /// The polynomials are the kernel.
    #[test]
    fn taps_are_the_kernel() {
        for place in [7.0, 7.2, 7.5, 7.999, -3.3] {
            let (first, values) = taps_at::<false>(&KERNEL.taps, place);
            for (k, value) in values.into_iter().enumerate() {
                let off = value - kernel((first + k as i64) as f64 - place);
                assert!(off.abs() < 3e-10, "{place} {k}: {off:e}");
            }
        }
    }
}
