//! Pairs of Riccati–Bessel functions with slopes, for carrying a field through a layer.
//!
//! Real arguments have ψ and χ. Arguments in an absorbing layer have ψ and χ too as long as
//! `Im z ≤ 1` (a small Im keeps its own digits), else ψ and the outgoing `ξ = ψ - iχ`, scaled by
//! `exp(∓Im z)`. ψ is carried upward to its turning point and by its downward ratio beyond; where
//! `Im z > 1` it has no zeros near and the ratio serves throughout. χ and ξ are carried upward.
//!
//! Deep beyond the turning point ψ underflows and χ overflows: there ψ carries a factor 2⁵⁰⁰ and χ its
//! inverse, once per crossing listed in `crossings`. All four numbers then stay within 2^±250.

use crate::math::riccati_bessel::ratios;
use multiversion::multiversion;
use num_complex::Complex64;

/// Arguments carried together, one in each SIMD lane.
pub(super) const LANES: usize = 8;
type Lanes = [f64; LANES];

const BIG: f64 = 1.809_251_394_333_065_6e75; // 2^250
const UP: f64 = 3.273_390_607_896_142e150; // 2^500
const DOWN: f64 = 1.0 / UP;

/// ψ, ψ', second function and its slope of one argument, for one order.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<T> {
    pub regular: T,
    pub regular_slope: T,
    pub second: T,
    pub second_slope: T,
}

/// The functions of eight real arguments for n = 1 …; index 0 is n = 1.
#[derive(Debug, Default)]
pub(super) struct RealFunctions {
    rows: Vec<[Lanes; 4]>,
    /// By lane: orders from which on one more factor is taken out.
    pub crossings: [Vec<usize>; LANES],
    ratio: Vec<Lanes>,
}

impl RealFunctions {
    /// Compute the functions of `z > 0` up to an order.
    pub fn fill(&mut self, z: &Lanes, orders: usize) {
        let largest = z.iter().copied().fold(0.0, f64::max);
        self.ratio.clear();
        self.ratio.resize(orders + 2, [0.0; LANES]);
        self.rows.clear();
        self.rows.resize(orders, [[0.0; LANES]; 4]);
        self.crossings.iter_mut().for_each(Vec::clear);
        let inverse = z.map(|z| 1.0 / z);
        // The start is forgotten to a rounding error at the turning point, see `riccati_bessel`.
        let start =
            orders.max(largest.ceil() as usize) + (10.0 * largest.cbrt()).ceil() as usize + 50;
        downward(&inverse, start, &mut self.ratio);
        let mut state = Upward::new(z);
        let mut first = 0;
        while first < orders {
            first = upward(&mut state, &inverse, &self.ratio, &mut self.rows, first);
            state.rescale(first, &mut self.crossings);
        }
    }

    pub fn at(&self, lane: usize, row: usize) -> Pair<f64> {
        let row = &self.rows[row];
        Pair {
            regular: row[0][lane],
            regular_slope: row[1][lane],
            second: row[2][lane],
            second_slope: row[3][lane],
        }
    }
}

#[derive(Clone, Copy, Debug)]
struct Upward {
    turning: Lanes,
    /// Orders n - 1 and n.
    psi: [Lanes; 2],
    chi: [Lanes; 2],
}

impl Upward {
    fn new(z: &Lanes) -> Self {
        let (sin, cos) = (z.map(f64::sin), z.map(f64::cos));
        // ψ_{-1} = cos, χ_{-1} = -sin
        Self { turning: z.map(f64::floor), psi: [cos, sin], chi: [sin.map(|s| -s), cos] }
    }

    /// Take a factor out of the lanes that have grown.
    fn rescale(&mut self, order: usize, crossings: &mut [Vec<usize>; LANES]) {
        for l in 0..LANES {
            if self.chi[1][l].abs() > BIG {
                crossings[l].push(order + 1);
                self.psi.iter_mut().for_each(|psi| psi[l] *= UP);
                self.chi.iter_mut().for_each(|chi| chi[l] *= DOWN);
            }
        }
    }
}

/// `u_n = 1/((2n + 1)/z - u_{n+1})`: an infinite u at a zero of ψ passes by the rules of IEEE.
#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
fn downward(inverse: &Lanes, start: usize, out: &mut [Lanes]) {
    let mut u = [0.0; LANES];
    for n in (1..=start).rev() {
        let odd = (2 * n + 1) as f64;
        for l in 0..LANES {
            u[l] = 1.0 / (odd * inverse[l] - u[l]);
        }
        if n < out.len() {
            out[n] = u;
        }
    }
}

/// Rows from `first` on, until a lane has grown too large; the number of rows that are done.
#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx2+fma",
    "x86_64+avx2+fma",
    "aarch64+neon"
))]
fn upward(
    state: &mut Upward,
    inverse: &Lanes,
    ratio: &[Lanes],
    rows: &mut [[Lanes; 4]],
    first: usize,
) -> usize {
    let mut own = *state;
    let mut done = first;
    for row in rows.iter_mut().skip(first) {
        let n = (done + 1) as f64;
        let odd = 2.0 * n - 1.0;
        let u = &ratio[done + 1];
        let mut largest = 0.0f64;
        for l in 0..LANES {
            let factor = odd * inverse[l];
            let before = own.psi[1][l];
            let up = factor * before - own.psi[0][l];
            let psi = if n <= own.turning[l] { up } else { before * u[l] };
            let chi_before = own.chi[1][l];
            let chi = factor * chi_before - own.chi[0][l];
            (own.psi[0][l], own.psi[1][l]) = (before, psi);
            (own.chi[0][l], own.chi[1][l]) = (chi_before, chi);
            let down = n * inverse[l];
            row[0][l] = psi;
            row[1][l] = before - down * psi;
            row[2][l] = chi;
            row[3][l] = chi_before - down * chi;
            largest = largest.max(chi.abs());
        }
        done += 1;
        if largest > BIG {
            break;
        }
    }
    *state = own;
    done
}

/// The second function beside ψ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Second {
    Chi,
    /// `ξ exp(Im z)`, with `ψ exp(-Im z)`.
    Outgoing,
}

/// From this imaginary part on ξ takes the place of χ.
pub(super) const FLAT: f64 = 1.0;

/// The functions of one complex argument for n = 1 …, with the orders of its crossings.
pub(super) fn complex_functions(
    z: Complex64,
    second: Second,
    orders: usize,
) -> (Vec<Pair<Complex64>>, Vec<usize>) {
    let i = Complex64::I;
    let ratio = ratios(z, orders + 1);
    let (phase, decay) = (Complex64::from_polar(1.0, z.re), (-2.0 * z.im).exp());
    // Orders -1 and 0.
    let (mut psi, mut chi) = match second {
        Second::Chi => ([z.cos(), z.sin()], [-z.sin(), z.cos()]),
        Second::Outgoing => {
            let (there, back) = (phase * decay, phase.conj());
            ([0.5 * (there + back), (there - back) / (2.0 * i)], [phase, -i * phase])
        }
    };
    let turning = if z.im <= FLAT { z.norm().floor() } else { 0.0 };
    let inverse = 1.0 / z;
    let (mut rows, mut crossings) = (Vec::with_capacity(orders), Vec::new());
    for (n, u) in ratio.iter().enumerate().take(orders + 1).skip(1) {
        let factor = inverse * (2 * n - 1) as f64;
        let next = if n as f64 <= turning { factor * psi[1] - psi[0] } else { psi[1] * u };
        let next_chi = factor * chi[1] - chi[0];
        (psi, chi) = ([psi[1], next], [chi[1], next_chi]);
        let down = inverse * n as f64;
        rows.push(Pair {
            regular: next,
            regular_slope: psi[0] - down * next,
            second: next_chi,
            second_slope: chi[0] - down * next_chi,
        });
        if next_chi.norm_sqr() > BIG * BIG {
            crossings.push(n + 1);
            psi.iter_mut().for_each(|psi| *psi *= UP);
            chi.iter_mut().for_each(|chi| *chi *= DOWN);
        }
    }
    (rows, crossings)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `ψ χ' - ψ' χ = -1` from the oscillating region to where χ has overflowed several times.
    #[test]
    fn wronskian_of_real_and_complex_functions() {
        let z = [0.02, 0.9, 7.3, 60.0, 131.0, 500.25, 3000.0, 20.0];
        let mut functions = RealFunctions::default();
        functions.fill(&z, 3100);
        for (lane, z) in z.iter().enumerate() {
            for n in 0..3100 {
                let f = functions.at(lane, n);
                let w = f.regular * f.second_slope - f.regular_slope * f.second;
                assert!((w + 1.0).abs() < 1e-10, "{z} {n}: {w}");
            }
        }
        assert!(functions.crossings[0].len() > 20 && functions.crossings[6].is_empty());
        for (z, second) in [
            (Complex64::new(131.0, 0.3), Second::Chi),
            (Complex64::new(131.0, 1.7), Second::Outgoing),
            (Complex64::new(40.0, 300.0), Second::Outgoing),
            (Complex64::new(131.0, 0.3), Second::Outgoing),
        ] {
            let (rows, _) = complex_functions(z, second, 600);
            for f in rows {
                let w = f.regular * f.second_slope - f.regular_slope * f.second;
                // ψ ξ' - ψ' ξ = i
                let right = if second == Second::Chi { -Complex64::ONE } else { Complex64::I };
                assert!((w - right).norm() < 1e-10, "{z}: {w}");
            }
        }
    }
}
