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
//! coefficients stay in the first-level cache, and its state is kept between chunks.

use crate::cancel;
use crate::math::fused::multiply_add;
use multiversion::multiversion;
use multiversion::target::target_cfg_f;
use num_complex::Complex64;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

/// Angles carried together.
const LANES: usize = 16;
/// Orders per chunk: 256 records of 64 bytes are 16 KiB.
const CHUNK: usize = 256;
/// Angles closer than this (radians) share one recurrence: the rounding of θ itself near π.
const SAME_ANGLE: f64 = 1e-15;

type Lanes = [f64; LANES];

/// Scattering angles prepared for summation: folded to θ ≤ π/2, equal ones merged.
#[derive(Clone, Debug)]
pub struct AngleSet {
    /// `t = 1 - cos θ` of the folded angles, padded to whole blocks.
    t: Vec<f64>,
    /// For every asked angle: its place among the folded ones, and whether it lies beyond π/2.
    place: Vec<(usize, bool)>,
    sides: Sides,
}

/// Where the asked angles lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sides {
    /// All up to π/2.
    Forward,
    /// All beyond π/2.
    Backward,
    Both,
}

impl AngleSet {
    /// Prepare angles (radians, any order; 0 … π).
    pub fn new(theta: &[f64]) -> Self {
        let folded = |i: usize| if theta[i] > FRAC_PI_2 { PI - theta[i] } else { theta[i] };
        let mut order: Vec<usize> = (0..theta.len()).collect();
        order.sort_by(|&i, &j| folded(i).total_cmp(&folded(j)));
        let mut t: Vec<f64> = Vec::with_capacity(theta.len() + LANES);
        let mut place = vec![(0, false); theta.len()];
        let mut last = f64::NEG_INFINITY;
        for i in order {
            let angle = folded(i);
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

/// What one order contributes, broadcast over the angles.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct OrderRecord<const W: usize> {
    /// (2n+1)(a_n + b_n) and (2n+1)(a_n - b_n) of every series: real and imaginary parts.
    coefficients: [[f64; 4]; W],
    /// (2n+1)/(n(n+1)).
    weight: f64,
    /// n + 1.
    next: f64,
    /// 1/(n+1).
    inverse_next: f64,
    /// 2/(n(n+1)).
    double_inverse: f64,
}

/// Partial-wave coefficients a_n and b_n; index 0 is n = 1.
pub type Waves<'a> = (&'a [Complex64], &'a [Complex64]);

/// The records of the orders `orders` (from 0: n - 1); a series that is over has zeros.
fn fill_records<const W: usize>(
    orders: std::ops::Range<usize>,
    series: &[Waves; W],
    out: &mut Vec<OrderRecord<W>>,
) {
    out.clear();
    out.extend(orders.map(|k| {
        let n = (k + 1) as f64;
        let (odd, product) = (2.0 * n + 1.0, n * (n + 1.0));
        let coefficients = series.map(|(a, b)| match (a.get(k), b.get(k)) {
            (Some(a), Some(b)) => {
                let (sum, difference) = ((a + b) * odd, (a - b) * odd);
                [sum.re, sum.im, difference.re, difference.im]
            }
            _ => [0.0; 4],
        });
        OrderRecord {
            coefficients,
            weight: odd / product,
            next: n + 1.0,
            inverse_next: 1.0 / (n + 1.0),
            double_inverse: 2.0 / product,
        }
    }));
}

/// Recurrence and partial sums of one block of angles.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct Block<const W: usize> {
    d: Lanes,
    pi: Lanes,
    t: Lanes,
    /// Re, Im of S1 + S2 at θ, S1 - S2 at θ, S1 + S2 at π - θ, S1 - S2 at π - θ of every series.
    sums: [[Lanes; 8]; W],
}

impl<const W: usize> Block<W> {
    /// The state before n = 1: d_1 = π_1 = 1.
    fn new(t: &[f64]) -> Self {
        let mut lanes = [0.0; LANES];
        lanes.copy_from_slice(t);
        Self { d: [1.0; LANES], pi: [1.0; LANES], t: lanes, sums: [[[0.0; LANES]; 8]; W] }
    }
}

/// Carry every block over one chunk of orders; the first order of a chunk is odd.
#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
fn advance<const W: usize>(blocks: &mut [Block<W>], records: &[OrderRecord<W>], sides: Sides) {
    if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
        advance_sides::<W, true>(blocks, records, sides);
    } else {
        advance_sides::<W, false>(blocks, records, sides);
    }
}

#[inline(always)]
fn advance_sides<const W: usize, const FMA: bool>(
    blocks: &mut [Block<W>],
    records: &[OrderRecord<W>],
    sides: Sides,
) {
    match sides {
        Sides::Forward => advance_blocks::<W, FMA, true, false>(blocks, records),
        Sides::Backward => advance_blocks::<W, FMA, false, true>(blocks, records),
        Sides::Both => advance_blocks::<W, FMA, true, true>(blocks, records),
    }
}

#[inline(always)]
fn advance_blocks<const W: usize, const FMA: bool, const FORWARD: bool, const BACKWARD: bool>(
    blocks: &mut [Block<W>],
    records: &[OrderRecord<W>],
) {
    for block in blocks {
        let mut state = *block;
        let mut pairs = records.chunks_exact(2);
        for pair in &mut pairs {
            step::<W, FMA, FORWARD, BACKWARD>(&mut state, &pair[0], 1.0);
            step::<W, FMA, FORWARD, BACKWARD>(&mut state, &pair[1], -1.0);
        }
        for record in pairs.remainder() {
            step::<W, FMA, FORWARD, BACKWARD>(&mut state, record, 1.0);
        }
        *block = state;
    }
}

/// Add one order and move the recurrence to the next; `parity` is (-1)^{n+1}.
#[inline(always)]
fn step<const W: usize, const FMA: bool, const FORWARD: bool, const BACKWARD: bool>(
    state: &mut Block<W>,
    order: &OrderRecord<W>,
    parity: f64,
) {
    let fma = multiply_add::<FMA>;
    let (mut u, mut v) = ([0.0; LANES], [0.0; LANES]);
    for l in 0..LANES {
        let (pi, t) = (state.pi[l], state.t[l]);
        let scaled = t * pi;
        u[l] = fma(-scaled, order.inverse_next, state.d[l]);
        v[l] = fma(pi, order.double_inverse, -u[l]);
        let d = fma(-scaled, order.weight, state.d[l]);
        state.d[l] = d;
        state.pi[l] = fma(order.next, d, pi);
    }
    for w in 0..W {
        let direct = order.coefficients[w];
        let mirrored = direct.map(|coefficient| parity * coefficient);
        let sums = &mut state.sums[w];
        for l in 0..LANES {
            if FORWARD {
                sums[0][l] = fma(direct[0], u[l], sums[0][l]);
                sums[1][l] = fma(direct[1], u[l], sums[1][l]);
                sums[2][l] = fma(direct[2], v[l], sums[2][l]);
                sums[3][l] = fma(direct[3], v[l], sums[3][l]);
            }
            if BACKWARD {
                sums[4][l] = fma(mirrored[0], v[l], sums[4][l]);
                sums[5][l] = fma(mirrored[1], v[l], sums[5][l]);
                sums[6][l] = fma(mirrored[2], u[l], sums[6][l]);
                sums[7][l] = fma(mirrored[3], u[l], sums[7][l]);
            }
        }
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
    let share = blocks.len().div_ceil(4 * rayon::current_num_threads()).max(1);
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
            let first = if beyond { 4 } else { 0 };
            let at = |k: usize| block.sums[series][first + k][lane];
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
