//! The integrand of a rim wave at its samples, and its sums against the waves of a direction.

use crate::math::fused::multiply_add;
use crate::math::lane_fourier::Row;
use crate::math::phase::sin_cos_turns_with;
use crate::math::uneven_fourier;
use multiversion::multiversion;
use multiversion::target::target_cfg_f;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Sums of the four elements against the reference path, and of the same times the impact.
pub(crate) type Sums = [[Complex64; 4]; 2];

/// Samples of the integrand: impacts, paths in units of the radius, four complex elements.
pub(crate) struct Integrand {
    impact: Vec<f64>,
    path: Vec<f64>,
    parts: [Vec<f64>; 8],
}

impl Integrand {
    pub(crate) fn with_capacity(count: usize) -> Self {
        let column = || Vec::with_capacity(count);
        Self { impact: column(), path: column(), parts: std::array::from_fn(|_| column()) }
    }

    pub(crate) fn push(&mut self, impact: f64, path: f64, elements: [Complex64; 4]) {
        self.impact.push(impact);
        self.path.push(path);
        for (k, e) in elements.into_iter().enumerate() {
            self.parts[2 * k].push(e.re);
            self.parts[2 * k + 1].push(e.im);
        }
    }

    /// Impact, path, and the elements S1 and S2 of all samples.
    pub(crate) fn samples(&self) -> impl Iterator<Item = (f64, f64, [Complex64; 2])> {
        let element =
            |e: usize, k: usize| Complex64::new(self.parts[2 * e][k], self.parts[2 * e + 1][k]);
        (0..self.impact.len())
            .map(move |k| (self.impact[k], self.path[k], [element(0, k), element(1, k)]))
    }

    /// Samples of no weight, up to a whole number of lanes.
    pub(crate) fn fill_lanes(&mut self) {
        while !self.impact.len().is_multiple_of(LANES) {
            self.push(0.0, 0.0, [Complex64::default(); 4]);
        }
    }

    /// [`Self::sum`] at many angles, each with the reference path `W` there: all at once where that is faster, then
    /// within 1e-8 of the sum of sizes.
    pub(crate) fn sums(&self, angles: &[[f64; 2]], x: f64) -> Vec<Sums> {
        if !uneven_fourier::pays(self.impact.len(), angles.len()) {
            return angles.iter().map(|&[angle, path]| self.sum(angle, path, x)).collect();
        }
        let [from, path] = angles[angles.len() / 2];
        let per_turn = x / TAU;
        let term = |k: usize| {
            let turns = per_turn * (self.path[k] - self.impact[k] * from - path);
            let (sin, cos) = sin_cos_turns_with::<false>(turns);
            let mut row = Row::ZERO;
            for e in 0..4 {
                let (re, im) = (self.parts[2 * e][k], self.parts[2 * e + 1][k]);
                (row.re[e], row.im[e]) = (re * cos - im * sin, re * sin + im * cos);
                (row.re[4 + e], row.im[4 + e]) =
                    (row.re[e] * self.impact[k], row.im[e] * self.impact[k]);
            }
            row
        };
        // samples that fill lanes weigh nothing and lie at no impact
        let weighs = |k: &usize| self.parts.iter().any(|part| part[*k] != 0.0);
        let samples: Vec<usize> = (0..self.impact.len()).filter(weighs).collect();
        let terms: Vec<Row> = samples.iter().map(|&k| term(k)).collect();
        let frequencies: Vec<f64> = samples.iter().map(|&k| x * self.impact[k]).collect();
        let offsets: Vec<f64> = angles.iter().map(|[angle, _]| angle - from).collect();
        let found = uneven_fourier::sums(&frequencies, &terms, &offsets);
        let turned = |(row, [_, reference]): (&Row, &[f64; 2])| {
            let (sin, cos) = sin_cos_turns_with::<false>(per_turn * (path - reference));
            let wave = Complex64::new(cos, sin);
            let at = |l: usize| wave * Complex64::new(row.re[l], row.im[l]);
            [std::array::from_fn(at), std::array::from_fn(|e| at(4 + e))]
        };
        found.iter().zip(angles).map(turned).collect()
    }

    /// `Σ F exp(ix(L - βϑ - W))`, and the same times β.
    pub(crate) fn sum(&self, angle: f64, reference: f64, x: f64) -> Sums {
        let found = sum(self, angle, reference, x);
        let at = |k: usize| Complex64::new(found[k], found[k + 1]);
        [std::array::from_fn(|e| at(2 * e)), std::array::from_fn(|e| at(8 + 2 * e))]
    }
}

/// Samples handled side by side.
const LANES: usize = 8;

#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
fn sum(integrand: &Integrand, angle: f64, reference: f64, x: f64) -> [f64; 16] {
    if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
        sum_with::<true>(integrand, angle, reference, x)
    } else {
        sum_with::<false>(integrand, angle, reference, x)
    }
}

#[inline(always)]
fn sum_with<const FMA: bool>(
    integrand: &Integrand,
    angle: f64,
    reference: f64,
    x: f64,
) -> [f64; 16] {
    let per_turn = x / TAU;
    let mut sums = [[0.0; LANES]; 16];
    let impacts: &[[f64; LANES]] = integrand.impact.as_chunks().0;
    let paths: &[[f64; LANES]] = integrand.path.as_chunks().0;
    let parts: [&[[f64; LANES]]; 8] = std::array::from_fn(|c| integrand.parts[c].as_chunks().0);
    for (block, (impact, path)) in impacts.iter().zip(paths).enumerate() {
        let (mut sin, mut cos) = ([0.0; LANES], [0.0; LANES]);
        for k in 0..LANES {
            let turns = per_turn * (path[k] - impact[k] * angle - reference);
            (sin[k], cos[k]) = sin_cos_turns_with::<FMA>(turns);
        }
        for element in 0..4 {
            let (re, im) = (&parts[2 * element][block], &parts[2 * element + 1][block]);
            for k in 0..LANES {
                let a = multiply_add::<FMA>(re[k], cos[k], -im[k] * sin[k]);
                let b = multiply_add::<FMA>(re[k], sin[k], im[k] * cos[k]);
                sums[2 * element][k] += a;
                sums[2 * element + 1][k] += b;
                let sum = &mut sums[8 + 2 * element][k];
                *sum = multiply_add::<FMA>(a, impact[k], *sum);
                let sum = &mut sums[9 + 2 * element][k];
                *sum = multiply_add::<FMA>(b, impact[k], *sum);
            }
        }
    }
    sums.map(|lanes| lanes.iter().sum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// All angles at once make the sums of each.
    #[test]
    fn many_angles_at_once() {
        let x = 3000.0;
        let mut integrand = Integrand::with_capacity(400);
        for k in 0..400 {
            let t = f64::from(k) / 400.0;
            let (impact, path) = (0.8 + 0.21 * t - 0.01 * t * t, 1.3 - 0.2 * t + 0.3 * t * t);
            let element = |e: usize| Complex64::new((t * PI).sin() * e as f64, 1.0 - t * e as f64);
            integrand.push(impact, path, std::array::from_fn(element));
        }
        integrand.fill_lanes();
        let angles: Vec<[f64; 2]> =
            (0..500).map(|k| f64::from(k) / 500.0).map(|t| [2.0 + t, 4.0 - 0.9 * t]).collect();
        assert!(uneven_fourier::pays(400, 500));
        for (found, &[angle, path]) in integrand.sums(&angles, x).iter().zip(&angles) {
            let known = integrand.sum(angle, path, x);
            for (f, k) in found.iter().flatten().zip(known.iter().flatten()) {
                assert!((f - k).norm() < 1e-6, "{angle}: {f} {k}");
            }
        }
    }

    /// Eight lanes and a rest, against the plain sum.
    #[test]
    fn lanes_add_up_what_a_plain_sum_does() {
        let (angle, reference, x) = (0.7, 0.2, 900.0);
        let mut integrand = Integrand::with_capacity(19);
        let mut expected = [[Complex64::default(); 4]; 2];
        for k in 0..19 {
            let t = f64::from(k);
            let (impact, path) = (0.9 + 0.01 * t, 1.3 - 0.02 * t + 0.003 * t * t);
            let elements: [Complex64; 4] =
                std::array::from_fn(|e| Complex64::new(t + e as f64, 1.0 - 0.3 * t * e as f64));
            integrand.push(impact, path, elements);
            let wave = Complex64::cis(x * (path - impact * angle - reference));
            for e in 0..4 {
                expected[0][e] += elements[e] * wave;
                expected[1][e] += elements[e] * wave * impact;
            }
        }
        integrand.fill_lanes();
        assert_eq!(integrand.samples().count(), 24);
        let found = integrand.sum(angle, reference, x);
        for (f, e) in found.iter().flatten().zip(expected.iter().flatten()) {
            assert!((f - e).norm() < 1e-10, "{f} {e}");
        }
        let (impact, path, [s1, s2]) = integrand.samples().nth(3).unwrap();
        assert!((impact - 0.93).abs() + (path - 1.267).abs() < 1e-15);
        assert_eq!((s1.re, s2.re), (3.0, 4.0));
    }
}
