//! Layers: the field carried from the centre outward, interface by interface.
//!
//! In a layer of index m the field is `αψ(mρ) + βχ(mρ)`. At its inner side z₁ and its outer side z
//! ```text
//! α = u χ'(z₁) - u' χ(z₁)   β = u' ψ(z₁) - u ψ'(z₁)   u = αψ(z) + βχ(z)   u' = αψ'(z) + βχ'(z)
//! ```
//! (the inverse matrix needs no division, for the Wronskian is constant; with `p = u` and `c = m u'`
//! for b_n, `u'/m` for a_n). Nothing is divided by a function that may vanish: the known recursion of
//! logarithmic derivatives (Yang 2003, Appl. Opt. 42, 1710) loses its digits where ψ(z) is nearly
//! zero at one of the interfaces, which happens at isolated indices and sizes.

use super::bessel::{FLAT, LANES, Pair, RealFunctions, Second, complex_functions};
use super::matching::{self, Coefficients, Surface};
use crate::series::{SeriesError, checked_term_count};
use num_complex::Complex64;

/// One layer: the radius of its outer side in units of the outermost, and its index relative to
/// the outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Of the outer side, in units of the outermost.
    pub radius: f64,
    /// Relative to the outside.
    pub index: Complex64,
}

/// Most layers of a sphere.
pub const MAX_LAYERS: usize = 100_000;
/// Relative error of the coefficients: rounding only, up to size parameters of 10⁵.
pub(super) const ERROR: f64 = 1e-10;
/// Factor of a crossing: `(2⁻⁵⁰⁰)²`.
const CROSSED: f64 = 9.332_636_185_032_189e-302;
/// A field is brought back to 1 when it leaves these bounds.
const BOUNDS: (f64, f64) = (1e-60, 1e60);

/// Coefficients of a sphere of layers.
pub(super) fn coefficients(x: f64, layers: &[Layer]) -> Result<Coefficients, SeriesError> {
    check(layers)?;
    let mut orders = 0;
    for layer in layers {
        orders = orders.max(checked_term_count(x, layer.index)?);
    }
    if layers.iter().all(|layer| layer.index.im == 0.0) {
        return Ok(matching::transparent(x, &transparent(x, layers, orders)));
    }
    Ok(matching::absorbing(x, &absorbing(x, layers, orders)))
}

fn check(layers: &[Layer]) -> Result<(), SeriesError> {
    let invalid = |field, value: String, accepted| SeriesError::Invalid { field, value, accepted };
    if layers.is_empty() || layers.len() > MAX_LAYERS {
        let count = layers.len().to_string();
        return Err(invalid("number of layers", count, "1 to 100000"));
    }
    let mut inside = 0.0;
    for layer in layers {
        if !(layer.radius > inside && layer.radius <= 1.0) {
            let value = format!("{} after {inside}", layer.radius);
            return Err(invalid("outer radius of a layer", value, "ascending radii, the last 1"));
        }
        inside = layer.radius;
    }
    if inside != 1.0 {
        let value = inside.to_string();
        return Err(invalid("outer radius of the last layer", value, "1: it reaches the surface"));
    }
    Ok(())
}

/// The inner and the outer argument of a layer.
fn arguments(x: f64, layers: &[Layer], j: usize) -> (Complex64, Complex64) {
    let inner = if j == 0 { 0.0 } else { layers[j - 1].radius };
    (layers[j].index * (inner * x), layers[j].index * (layers[j].radius * x))
}

/// Field at the surface where all layers are transparent: real arithmetic.
fn transparent(x: f64, layers: &[Layer], orders: usize) -> Surface<f64> {
    let mut surface =
        Surface { electric: vec![(0.0, 0.0); orders], magnetic: vec![(0.0, 0.0); orders] };
    let mut functions = RealFunctions::default();
    for (group, chunk) in layers.chunks(LANES / 2).enumerate() {
        let mut z = [1.0; LANES];
        for k in 0..chunk.len() {
            let (inner, outer) = arguments(x, layers, group * LANES / 2 + k);
            // The centre has no inner side; any argument will do.
            (z[2 * k], z[2 * k + 1]) = (if inner.re > 0.0 { inner.re } else { outer.re }, outer.re);
        }
        functions.fill(&z, orders);
        for (k, layer) in chunk.iter().enumerate() {
            let m = layer.index.re;
            let (inner, outer) = (2 * k, 2 * k + 1);
            if group == 0 && k == 0 {
                for n in 0..orders {
                    let f = functions.at(outer, n);
                    surface.electric[n] = (f.regular, f.regular_slope / m);
                    surface.magnetic[n] = (f.regular, f.regular_slope * m);
                }
                continue;
            }
            let crossings = [&functions.crossings[inner], &functions.crossings[outer]];
            for (from, to, factor) in stretches(crossings.map(Vec::as_slice), orders) {
                for n in from..to {
                    let (f, g) = (functions.at(inner, n), functions.at(outer, n));
                    let electric = carry(surface.electric[n], &f, &g, factor, 1.0 / m);
                    let magnetic = carry(surface.magnetic[n], &f, &g, factor, m);
                    (surface.electric[n], surface.magnetic[n]) = (electric, magnetic);
                }
            }
        }
    }
    surface
}

/// Field at the surface with absorption.
fn absorbing(x: f64, layers: &[Layer], orders: usize) -> Surface<Complex64> {
    let zero = Complex64::ZERO;
    let mut surface =
        Surface { electric: vec![(zero, zero); orders], magnetic: vec![(zero, zero); orders] };
    for (j, layer) in layers.iter().enumerate() {
        let m = layer.index;
        let (inner, outer) = arguments(x, layers, j);
        let second = if outer.im > FLAT { Second::Outgoing } else { Second::Chi };
        let (outside, crossed_outside) = complex_functions(outer, second, orders);
        if j == 0 {
            for (n, f) in outside.iter().enumerate() {
                surface.electric[n] = (f.regular, f.regular_slope / m);
                surface.magnetic[n] = (f.regular, f.regular_slope * m);
            }
            continue;
        }
        let (inside, crossed_inside) = complex_functions(inner, second, orders);
        let decay = match second {
            Second::Chi => 1.0,
            Second::Outgoing => (-2.0 * (outer.im - inner.im)).exp(),
        };
        for (from, to, factor) in stretches([&crossed_inside, &crossed_outside], orders) {
            for n in from..to {
                let (f, g) = (&inside[n], &outside[n]);
                let factor = factor * decay;
                surface.electric[n] = carry_complex(surface.electric[n], f, g, factor, m.inv());
                surface.magnetic[n] = carry_complex(surface.magnetic[n], f, g, factor, m);
            }
        }
    }
    surface
}

/// Stretches of rows between crossings, each with the factor by which β counts less than α there.
fn stretches(crossings: [&[usize]; 2], orders: usize) -> Vec<(usize, usize, f64)> {
    let mut ends: Vec<usize> = crossings.into_iter().flatten().map(|order| order - 1).collect();
    ends.push(orders);
    ends.sort_unstable();
    ends.dedup();
    let count = |list: &[usize], row: usize| list.partition_point(|&order| order - 1 <= row);
    let mut out = Vec::new();
    let mut from = 0;
    for to in ends {
        let (inner, outer) = (count(crossings[0], from), count(crossings[1], from));
        // The inner argument is the smaller one: its χ has crossed at least as often, but for a
        // hair's breadth in absorbing layers.
        let factor = CROSSED.powi(inner as i32 - outer as i32);
        if to > from && to <= orders {
            out.push((from, to, factor));
            from = to;
        }
    }
    out
}

/// Carry (p, c) from the inner to the outer side; `weight` is c over the slope.
#[inline(always)]
fn carry(
    (p, c): (f64, f64),
    inner: &Pair<f64>,
    outer: &Pair<f64>,
    factor: f64,
    weight: f64,
) -> (f64, f64) {
    let slope = c / weight;
    let alpha = p * inner.second_slope - slope * inner.second;
    let beta = (slope * inner.regular - p * inner.regular_slope) * factor;
    let u = alpha * outer.regular + beta * outer.second;
    let u_slope = (alpha * outer.regular_slope + beta * outer.second_slope) * weight;
    let size = u.abs() + u_slope.abs();
    if size > BOUNDS.0 && size < BOUNDS.1 {
        return (u, u_slope);
    }
    (u / size, u_slope / size)
}

/// The same with absorption.
fn carry_complex(
    (p, c): (Complex64, Complex64),
    inner: &Pair<Complex64>,
    outer: &Pair<Complex64>,
    factor: f64,
    weight: Complex64,
) -> (Complex64, Complex64) {
    let slope = c / weight;
    let alpha = p * inner.second_slope - slope * inner.second;
    let beta = (slope * inner.regular - p * inner.regular_slope) * factor;
    let u = alpha * outer.regular + beta * outer.second;
    let u_slope = (alpha * outer.regular_slope + beta * outer.second_slope) * weight;
    let size = u.l1_norm() + u_slope.l1_norm();
    if size > BOUNDS.0 && size < BOUNDS.1 {
        return (u, u_slope);
    }
    (u / size, u_slope / size)
}
