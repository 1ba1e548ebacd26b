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
//! Angles run in SIMD lanes, a block of lanes is carried over a chunk of orders whose
//! coefficients stay in the first-level cache, and its state is kept between chunks.

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
struct OrderRecord {
    /// (2n+1)(a_n + b_n).
    sum: [f64; 2],
    /// (2n+1)(a_n - b_n).
    difference: [f64; 2],
    /// (2n+1)/(n(n+1)).
    weight: f64,
    /// n + 1.
    next: f64,
    /// 1/(n+1).
    inverse_next: f64,
    /// 2/(n(n+1)).
    double_inverse: f64,
}

/// The records of orders `first + 1 …` (index 0 of `a`, `b` is n = 1).
fn fill_records(first: usize, a: &[Complex64], b: &[Complex64], out: &mut Vec<OrderRecord>) {
    out.clear();
    out.extend(a.iter().zip(b).enumerate().map(|(k, (a, b))| {
        let n = (first + k + 1) as f64;
        let (odd, product) = (2.0 * n + 1.0, n * (n + 1.0));
        let (sum, difference) = ((a + b) * odd, (a - b) * odd);
        OrderRecord {
            sum: [sum.re, sum.im],
            difference: [difference.re, difference.im],
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
struct Block {
    d: Lanes,
    pi: Lanes,
    t: Lanes,
    /// Re, Im of S1 + S2 at θ, S1 - S2 at θ, S1 + S2 at π - θ, S1 - S2 at π - θ.
    sums: [Lanes; 8],
}

impl Block {
    /// The state before n = 1: d_1 = π_1 = 1.
    fn new(t: &[f64]) -> Self {
        let mut lanes = [0.0; LANES];
        lanes.copy_from_slice(t);
        Self { d: [1.0; LANES], pi: [1.0; LANES], t: lanes, sums: [[0.0; LANES]; 8] }
    }
}

/// Carry every block over one chunk of orders; the first order of a chunk is odd.
#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
fn advance(blocks: &mut [Block], records: &[OrderRecord], sides: Sides) {
    if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
        advance_sides::<true>(blocks, records, sides);
    } else {
        advance_sides::<false>(blocks, records, sides);
    }
}

#[inline(always)]
fn advance_sides<const FMA: bool>(blocks: &mut [Block], records: &[OrderRecord], sides: Sides) {
    match sides {
        Sides::Forward => advance_blocks::<FMA, true, false>(blocks, records),
        Sides::Backward => advance_blocks::<FMA, false, true>(blocks, records),
        Sides::Both => advance_blocks::<FMA, true, true>(blocks, records),
    }
}

#[inline(always)]
fn advance_blocks<const FMA: bool, const FORWARD: bool, const BACKWARD: bool>(
    blocks: &mut [Block],
    records: &[OrderRecord],
) {
    for block in blocks {
        let mut state = *block;
        let mut pairs = records.chunks_exact(2);
        for pair in &mut pairs {
            step::<FMA, FORWARD, BACKWARD>(&mut state, &pair[0], 1.0);
            step::<FMA, FORWARD, BACKWARD>(&mut state, &pair[1], -1.0);
        }
        for record in pairs.remainder() {
            step::<FMA, FORWARD, BACKWARD>(&mut state, record, 1.0);
        }
        *block = state;
    }
}

/// `a b + c`, in one rounding where the machine has it (and never by a library call).
#[inline(always)]
fn multiply_add<const FMA: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FMA { a.mul_add(b, c) } else { a * b + c }
}

/// Add one order and move the recurrence to the next; `parity` is (-1)^{n+1}.
#[inline(always)]
fn step<const FMA: bool, const FORWARD: bool, const BACKWARD: bool>(
    state: &mut Block,
    order: &OrderRecord,
    parity: f64,
) {
    let mirrored = [order.sum[0], order.sum[1], order.difference[0], order.difference[1]]
        .map(|coefficient| parity * coefficient);
    for l in 0..LANES {
        let fma = multiply_add::<FMA>;
        let (pi, t) = (state.pi[l], state.t[l]);
        let scaled = t * pi;
        let u = fma(-scaled, order.inverse_next, state.d[l]);
        let v = fma(pi, order.double_inverse, -u);
        if FORWARD {
            state.sums[0][l] = fma(order.sum[0], u, state.sums[0][l]);
            state.sums[1][l] = fma(order.sum[1], u, state.sums[1][l]);
            state.sums[2][l] = fma(order.difference[0], v, state.sums[2][l]);
            state.sums[3][l] = fma(order.difference[1], v, state.sums[3][l]);
        }
        if BACKWARD {
            state.sums[4][l] = fma(mirrored[0], v, state.sums[4][l]);
            state.sums[5][l] = fma(mirrored[1], v, state.sums[5][l]);
            state.sums[6][l] = fma(mirrored[2], u, state.sums[6][l]);
            state.sums[7][l] = fma(mirrored[3], u, state.sums[7][l]);
        }
        let d = fma(-scaled, order.weight, state.d[l]);
        state.d[l] = d;
        state.pi[l] = fma(order.next, d, pi);
    }
}

/// Run all orders over some blocks.
fn run(blocks: &mut [Block], a: &[Complex64], b: &[Complex64], sides: Sides) {
    let mut records = Vec::with_capacity(CHUNK);
    for (chunk, (a, b)) in a.chunks(CHUNK).zip(b.chunks(CHUNK)).enumerate() {
        fill_records(chunk * CHUNK, a, b, &mut records);
        advance(blocks, &records, sides);
    }
}

/// S1 and S2 at every angle from partial-wave coefficients (`a[0]` is n = 1), on this thread.
pub fn amplitudes(a: &[Complex64], b: &[Complex64], set: &AngleSet) -> Vec<(Complex64, Complex64)> {
    let mut blocks: Vec<Block> = set.t.chunks_exact(LANES).map(Block::new).collect();
    run(&mut blocks, a, b, set.sides);
    collect(&blocks, set)
}

/// As [`amplitudes`], the blocks of angles shared among the threads of rayon.
pub fn amplitudes_parallel(
    a: &[Complex64],
    b: &[Complex64],
    set: &AngleSet,
) -> Vec<(Complex64, Complex64)> {
    let mut blocks: Vec<Block> = set.t.chunks_exact(LANES).map(Block::new).collect();
    let share = blocks.len().div_ceil(4 * rayon::current_num_threads()).max(1);
    blocks.par_chunks_mut(share).for_each(|part| run(part, a, b, set.sides));
    collect(&blocks, set)
}

/// Take S1 and S2 apart again and put them in the order asked for.
fn collect(blocks: &[Block], set: &AngleSet) -> Vec<(Complex64, Complex64)> {
    set.place
        .iter()
        .map(|&(place, beyond)| {
            let (block, lane) = (&blocks[place / LANES], place % LANES);
            let first = if beyond { 4 } else { 0 };
            let at = |k: usize| block.sums[first + k][lane];
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
    fn threads_change_nothing() {
        let theta: Vec<f64> = (0..777).map(|k| f64::from(k) * 0.004).collect();
        let a: Vec<_> = (0..600).map(|n| Complex64::cis(f64::from(n * n) * 0.01)).collect();
        let b: Vec<_> = a.iter().rev().copied().collect();
        let set = AngleSet::new(&theta);
        assert_eq!(amplitudes(&a, &b, &set), amplitudes_parallel(&a, &b, &set));
    }
}
