//! Sums of the angular functions π_n(θ), τ_n(θ): the part that costs the time of a series.
//!
//! `S1 = Σ w_n (a_n π_n + b_n τ_n)`, `S2 = Σ w_n (a_n τ_n + b_n π_n)`, `w_n = (2n+1)/(n(n+1))`
//! (Bohren & Huffman 1983, eq. 4.74).
//!
//! Every angle is folded to θ ≤ π/2, because with `t = 1 - cos θ = 2 sin²(θ/2)` the recurrence
//! ```text
//! d_{n+1} = d_n - w_n t π_n          d_n = (π_n - π_{n-1})/n
//! π_{n+1} = π_n + (n+1) d_{n+1}
//! ```
//! never subtracts nearly equal numbers at small angles (a recurrence in a rounded cos θ has a
//! phase error of ε n / sin θ). From it follow, with `U_n = (π_n + τ_n)/(n(n+1))` and
//! `V_n = (π_n - τ_n)/(n(n+1))`,
//! ```text
//! U_n = d_n - t π_n/(n+1)            V_n = 2π_n/(n(n+1)) - U_n
//! S1 ± S2 at θ:      Σ (2n+1)(a_n+b_n) U_n        and  Σ (2n+1)(a_n-b_n) V_n
//! S1 ± S2 at π - θ:  Σ (-1)^{n+1} (2n+1)(a_n+b_n) V_n  and  Σ (-1)^{n+1} (2n+1)(a_n-b_n) U_n
//! ```
//! so that one recurrence and four complex sums serve θ and π - θ together. Where all angles lie on
//! one side of π/2, the other side's two sums are left out.
//!
//! Several series that want the same angles may share the recurrence too: it is half the work of one.
//!
//! Angles run in SIMD lanes, a block of lanes is carried over a chunk of orders whose
//! coefficients stay in the first-level cache, and its state is kept between chunks (`kernel`).

mod kernel;

pub use kernel::Waves;

use crate::cancel;
use crate::math::parallel::*;
use kernel::{Block, LANES, Sides, advance, fill_records};
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, PI};

/// Orders per chunk: 256 records of 64 bytes are 16 KiB.
const CHUNK: usize = 256;
/// Angles closer than this (radians) share one recurrence: the rounding of θ itself near π.
const SAME_ANGLE: f64 = 1e-15;

/// Scattering angles prepared for summation: folded to θ ≤ π/2, equal ones merged.
#[derive(Clone, Debug)]
pub struct AngleSet {
    /// `t = 1 - cos θ` of the folded angles, padded to whole blocks.
    t: Vec<f64>,
    /// For every asked angle: its place among the folded ones, and whether it lies beyond π/2.
    place: Vec<(usize, bool)>,
    sides: Sides,
}

impl AngleSet {
    /// Prepare angles (radians, any order; 0 … π).
    pub fn new(theta: &[f64]) -> Self {
        let fold = |&theta: &f64| if theta > FRAC_PI_2 { PI - theta } else { theta };
        // a stable sort: angles in order, folded, are two runs, which it merges
        let mut order: Vec<(f64, usize)> = theta.iter().map(fold).zip(0..).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut t: Vec<f64> = Vec::with_capacity(theta.len() + LANES);
        let mut place = vec![(0, false); theta.len()];
        let mut last = f64::NEG_INFINITY;
        for (angle, i) in order {
            if angle - last > SAME_ANGLE {
                let half_sine = (0.5 * angle).sin();
                t.push(2.0 * half_sine * half_sine);
                last = angle;
            }
            place[i] = (t.len() - 1, theta[i] > FRAC_PI_2);
        }
        t.resize(t.len().next_multiple_of(LANES), 0.0);
        let beyond = place.iter().filter(|(_, beyond)| *beyond).count();
        let sides = match beyond {
            0 => Sides::Forward,
            n if n == place.len() => Sides::Backward,
            _ => Sides::Both,
        };
        Self { t, place, sides }
    }

    /// Number of angles asked for.
    pub fn len(&self) -> usize {
        self.place.len()
    }

    /// Number of recurrences that serve them.
    pub fn recurrences(&self) -> usize {
        self.t.len()
    }

    /// Whether no angle was asked for.
    pub fn is_empty(&self) -> bool {
        self.place.is_empty()
    }
}

/// Run all orders over some blocks.
fn run<const W: usize>(blocks: &mut [Block<W>], series: &[Waves; W], sides: Sides) {
    let longest = series.iter().map(|(a, _)| a.len()).max().unwrap_or(0);
    let mut records = Vec::with_capacity(CHUNK);
    for first in (0..longest).step_by(CHUNK) {
        cancel::checkpoint();
        fill_records(first..(first + CHUNK).min(longest), series, &mut records);
        advance(blocks, &records, sides);
    }
}

/// S1 and S2 at every angle from partial-wave coefficients (`a[0]` is n = 1), on this thread.
pub fn amplitudes(a: &[Complex64], b: &[Complex64], set: &AngleSet) -> Vec<(Complex64, Complex64)> {
    let [out] = amplitudes_together([(a, b)], set);
    out
}

/// As [`amplitudes`], of several series at the same angles; each comes out as it does alone.
pub fn amplitudes_together<const W: usize>(
    series: [Waves; W],
    set: &AngleSet,
) -> [Vec<(Complex64, Complex64)>; W] {
    let mut blocks: Vec<Block<W>> = set.t.chunks_exact(LANES).map(Block::new).collect();
    run(&mut blocks, &series, set.sides);
    std::array::from_fn(|w| collect(&blocks, w, set))
}

/// As [`amplitudes`], the blocks of angles shared among the threads of rayon.
pub fn amplitudes_parallel(
    a: &[Complex64],
    b: &[Complex64],
    set: &AngleSet,
) -> Vec<(Complex64, Complex64)> {
    let mut blocks: Vec<Block<1>> = set.t.chunks_exact(LANES).map(Block::new).collect();
    let share = blocks.len().div_ceil(4 * current_num_threads()).max(1);
    blocks.par_chunks_mut(share).for_each(|part| run(part, &[(a, b)], set.sides));
    collect(&blocks, 0, set)
}

/// Take S1 and S2 of one series apart again and put them in the order asked for.
fn collect<const W: usize>(
    blocks: &[Block<W>],
    series: usize,
    set: &AngleSet,
) -> Vec<(Complex64, Complex64)> {
    set.place
        .iter()
        .map(|&(place, beyond)| {
            let (block, lane) = (&blocks[place / LANES], place % LANES);
            let at = |k: usize| block.sums[series][usize::from(beyond)][k][lane];
            let sum = Complex64::new(at(0), at(1));
            let difference = Complex64::new(at(2), at(3));
            (0.5 * (sum + difference), 0.5 * (sum - difference))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Order by order against π_2 = 3 cos θ, τ_2 = 3 cos 2θ, and n = 1: π = 1, τ = cos θ.
    #[test]
    fn low_orders_in_closed_form() {
        let theta = [0.0, 0.3, 1.2, FRAC_PI_2, 1.9, 3.0, PI];
        let (i, zero) = (Complex64::I, Complex64::ZERO);
        let (a, b) = ([zero, i], [Complex64::ONE, zero]);
        let got = amplitudes(&a, &b, &AngleSet::new(&theta));
        for (theta, (s1, s2)) in theta.iter().zip(got) {
            let (w1, w2) = (1.5, 5.0 / 6.0);
            let s1_expected = Complex64::new(w1 * theta.cos(), w2 * 3.0 * theta.cos());
            let s2_expected = Complex64::new(w1, w2 * 3.0 * (2.0 * theta).cos());
            assert!((s1 - s1_expected).norm() < 1e-15 * 4.0, "{theta}: {s1}");
            assert!((s2 - s2_expected).norm() < 1e-15 * 4.0, "{theta}: {s2}");
        }
    }

    #[test]
    fn symmetric_angles_share_one_recurrence() {
        let theta: Vec<f64> = (0..=1800).map(|k| (f64::from(k) * 0.1).to_radians()).collect();
        assert_eq!(AngleSet::new(&theta).t.len(), 901usize.next_multiple_of(LANES));
    }

    /// Sums over one side alone are those of both sides together, to the last bit.
    #[test]
    fn one_side_alone_is_the_same() {
        let a: Vec<_> = (0..300).map(|n| Complex64::cis(f64::from(n * n) * 0.01)).collect();
        let b: Vec<_> = a.iter().rev().copied().collect();
        for (from, stranger, sides) in [(2, 151, Sides::Forward), (101, 30, Sides::Backward)] {
            let one: Vec<f64> = (from..from + 70).map(|k| f64::from(k).to_radians()).collect();
            let mut both = one.clone();
            both.push(f64::from(stranger).to_radians() + 0.001);
            let (one, both) = (AngleSet::new(&one), AngleSet::new(&both));
            assert_eq!((one.sides, both.sides), (sides, Sides::Both));
            let mut mixed = amplitudes(&a, &b, &both);
            mixed.pop();
            assert_eq!(amplitudes(&a, &b, &one), mixed);
        }
    }

    #[test]
    fn series_together_are_as_alone() {
        let theta: Vec<f64> = (0..77).map(|k| 2.0 + f64::from(k) * 0.01).collect();
        let a: Vec<_> = (0..600).map(|n| Complex64::cis(f64::from(n * n) * 0.01)).collect();
        let b: Vec<_> = a.iter().rev().copied().collect();
        let set = AngleSet::new(&theta);
        let [one, other] = amplitudes_together([(&a, &b), (&b[..500], &a[..500])], &set);
        assert_eq!(one, amplitudes(&a, &b, &set));
        assert_eq!(other, amplitudes(&b[..500], &a[..500], &set));
    }

    #[test]
    fn threads_change_nothing() {
        let theta: Vec<f64> = (0..777).map(|k| f64::from(k) * 0.004).collect();
        let a: Vec<_> = (0..600).map(|n| Complex64::cis(f64::from(n * n) * 0.01)).collect();
        let b: Vec<_> = a.iter().rev().copied().collect();
        let set = AngleSet::new(&theta);
        assert_eq!(amplitudes(&a, &b, &set), amplitudes_parallel(&a, &b, &set));
    }
}
