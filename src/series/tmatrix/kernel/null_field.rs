//! The null-field method (Waterman 1971): surface integrals of products of outside and inside waves.
//!
//! For each order m, with tangential components of outside waves `b₁ = z'π`, `b₂ = z'τ + (r'/r) z̃ d`,
//! `b₃ = zπ`, `b₄ = zτ` (`z'`, `z̃` as in [`super::waves`]) and the same `a₁…a₄ = zπ, zτ, z'π, …` of
//! inside waves, all integrals are made of four products,
//! `P = ∫a₃b₃+a₄b₄`, `R = ∫a₁b₁+a₂b₂`, `U = ∫a₁b₄+a₂b₃`, `V = ∫a₄b₁+a₃b₂`:
//! `Q = [[R - mP, -(mU + V)], [U + mV, mR - P]]` (index m), with `y_n` and `j_n` outside, and
//! `T = -RgQ Q⁻¹`, `Q = Q(j) + iQ(y)`. (Equations 5.154–5.200 of Mishchenko, Travis & Lacis 2002, electric waves
//! turned by i so that for a real index every integral is real.) Reciprocity makes T symmetric.
//!
//! Where the body is its own mirror image only magnetic waves of one parity of n couple, and to electric ones
//! of the other: two systems of half the size, from half the nodes.

use super::block::{OrderBlock, systems};
use super::waves::{Angular, NodeWaves, Radial, gamma, power_of_two};
use faer::linalg::matmul::matmul;
use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Accum, Mat, MatRef, Par};
use num_complex::Complex64;
use std::ops::Mul;

/// The four products for one set of outside degrees, each with `j_n` and `y_n` outside.
/// `p`, `r` against the same degrees inside, `u`, `v` against the other.
struct Products {
    p: [Mat<Complex64>; 2],
    r: [Mat<Complex64>; 2],
    u: [Mat<Complex64>; 2],
    v: [Mat<Complex64>; 2],
}

/// T of one order from the surface's waves.
pub(in crate::series::tmatrix) fn order_block(
    waves: &[NodeWaves],
    index: Complex64,
    m: usize,
    top: usize,
    mirror: bool,
) -> OrderBlock {
    let angular: Vec<Angular> =
        waves.iter().map(|w| Angular::new(m, top, w.node.cos, w.node.sin)).collect();
    let real = index.im == 0.0;
    let mut block = OrderBlock::zero(m, top);
    let systems = systems(m, top, mirror);
    let products: Vec<Products> =
        systems.iter().map(|s| products(waves, &angular, &s.magnetic, &s.electric, real)).collect();
    for (at, system) in systems.iter().enumerate() {
        // Outside electric waves of this system are the outside magnetic ones of the other.
        let electric = &products[products.len() - 1 - at];
        let q = |z: usize| q_matrix(&products[at], electric, index, z);
        let t = solve(&q(0), &q(1));
        block.put(system, t.as_ref());
    }
    block
}

/// `Q` with `j_n` (0) or `y_n` (1) outside.
fn q_matrix(
    magnetic: &Products,
    electric: &Products,
    index: Complex64,
    z: usize,
) -> Mat<Complex64> {
    let (rows, columns) = (magnetic.p[z].nrows(), magnetic.p[z].ncols());
    let size = rows + electric.p[z].nrows();
    Mat::from_fn(size, size, |i, k| match (i < rows, k < columns) {
        (true, true) => magnetic.r[z][(i, k)] - index * magnetic.p[z][(i, k)],
        (true, false) => {
            let k = k - columns;
            -(index * magnetic.u[z][(i, k)] + magnetic.v[z][(i, k)])
        }
        (false, true) => {
            let i = i - rows;
            electric.u[z][(i, k)] + index * electric.v[z][(i, k)]
        }
        (false, false) => {
            let (i, k) = (i - rows, k - columns);
            index * electric.r[z][(i, k)] - electric.p[z][(i, k)]
        }
    })
}

/// `T = -Q(j) [Q(j) + iQ(y)]⁻¹`, by the transposed system with rows of Q scaled to about 1.
fn solve(regular: &Mat<Complex64>, irregular: &Mat<Complex64>) -> Mat<Complex64> {
    let size = regular.nrows();
    let outgoing = |i: usize, k: usize| regular[(i, k)] + Complex64::I * irregular[(i, k)];
    let scales: Vec<f64> = (0..size)
        .map(|i| power_of_two((0..size).fold(0.0f64, |most, k| most.max(outgoing(i, k).norm()))))
        .collect();
    let transposed = Mat::from_fn(size, size, |k, i| outgoing(i, k) * scales[i]);
    let mut solution = Mat::from_fn(size, size, |k, i| -regular[(i, k)]);
    PartialPivLu::new(transposed.as_ref()).solve_in_place(solution.as_mut());
    Mat::from_fn(size, size, |i, k| solution[(k, i)] * scales[k])
}

/// Degrees of one parity, or all, in one matrix of values by (wave, node).
fn products(
    waves: &[NodeWaves],
    angular: &[Angular],
    same: &[usize],
    other: &[usize],
    real: bool,
) -> Products {
    let (rows, count) = (same.len(), waves.len());
    let parts = if real { 1 } else { 2 };
    let (mut near, mut far) = (Mat::zeros(2 * rows, 2 * count), Mat::zeros(2 * rows, 2 * count));
    let columns = parts * (rows + other.len());
    let (mut first, mut second) =
        (Mat::<f64>::zeros(columns, 2 * count), Mat::<f64>::zeros(columns, 2 * count));
    for (g, (wave, angle)) in waves.iter().zip(angular).enumerate() {
        let weight = wave.node.weight * wave.node.radius * wave.node.radius;
        for (half, outside) in [&wave.regular, &wave.irregular].into_iter().enumerate() {
            for (i, &n) in same.iter().enumerate() {
                let b = components(outside, angle, wave.node.slope, n, weight);
                let row = half * rows + i;
                (far[(row, g)], far[(row, count + g)]) = (b[0], b[1]);
                (near[(row, g)], near[(row, count + g)]) = (b[2], b[3]);
            }
        }
        let mut put = |at: usize, n: usize, crossed: bool| {
            // z'π, z'τ + …, zπ, zτ of the inside wave: a₃, a₄, a₁, a₂
            let a = components(&wave.inside, angle, wave.node.slope, n, 1.0);
            let (with_near, with_far) =
                if crossed { ([a[3], a[2]], [a[1], a[0]]) } else { ([a[0], a[1]], [a[2], a[3]]) };
            for half in 0..2 {
                let column = half * count + g;
                first[(parts * at, column)] = with_near[half].re;
                second[(parts * at, column)] = with_far[half].re;
                if parts == 2 {
                    first[(parts * at + 1, column)] = with_near[half].im;
                    second[(parts * at + 1, column)] = with_far[half].im;
                }
            }
        };
        same.iter().enumerate().for_each(|(at, &n)| put(at, n, false));
        other.iter().enumerate().for_each(|(at, &n)| put(rows + at, n, true));
    }
    let multiply = |outside: &Mat<f64>, inside: &Mat<f64>| {
        let mut product = Mat::<f64>::zeros(2 * rows, columns);
        matmul(product.as_mut(), Accum::Replace, outside, inside.transpose(), 1.0, Par::Seq);
        product
    };
    let (with_near, with_far) = (multiply(&near, &first), multiply(&far, &second));
    let take = |product: &Mat<f64>, from: usize, width: usize| {
        [0, 1].map(|z| {
            let part = product.as_ref().submatrix(z * rows, parts * from, rows, parts * width);
            complex(part, parts)
        })
    };
    Products {
        p: take(&with_near, 0, rows),
        u: take(&with_near, rows, other.len()),
        r: take(&with_far, 0, rows),
        v: take(&with_far, rows, other.len()),
    }
}

/// Complex numbers from columns of real parts, or of real and imaginary ones in turn.
fn complex(part: MatRef<'_, f64>, parts: usize) -> Mat<Complex64> {
    Mat::from_fn(part.nrows(), part.ncols() / parts, |i, k| {
        let im = if parts == 2 { part[(i, 2 * k + 1)] } else { 0.0 };
        Complex64::new(part[(i, parts * k)], im)
    })
}

/// `z'π`, `z'τ + (r'/r) z̃ d`, `zπ`, `zτ` of one wave, times `γ_n` and a weight.
pub(in crate::series::tmatrix) fn components<T>(
    radial: &Radial<T>,
    angle: &Angular,
    slope: f64,
    n: usize,
    weight: f64,
) -> [T; 4]
where
    T: Copy + Mul<f64, Output = T> + std::ops::Add<Output = T>,
{
    let scale = gamma(n) * weight;
    let (pi, tau) = (angle.pi[n] * scale, angle.tau[n] * scale);
    let (z, derivative) = (radial.value[n], radial.derivative[n]);
    let along = derivative * tau + radial.across[n] * (slope * angle.d[n] * scale);
    [derivative * pi, along, z * pi, z * tau]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::series::lorenz_mie::Sphere;
    use crate::series::tmatrix::kernel::surface::Surface;
    use crate::series::tmatrix::kernel::waves::on_surface;
    use crate::shape::Shape;

    /// Waves of a sphere do not couple, and its coefficients are those of Lorenz and Mie, whatever the order.
    #[test]
    fn a_sphere_has_the_coefficients_of_lorenz_and_mie() {
        let (shape, x, top) = (Shape::sphere(), 4.0, 10);
        for index in [Complex64::new(1.333, 0.0), Complex64::new(1.5, 0.3)] {
            let series = Sphere::new(x, index).unwrap();
            let mut surface = Surface::new(&shape).unwrap();
            for (m, mirror) in [(0, true), (1, true), (1, false), (3, false)] {
                surface.mirror = mirror;
                let waves = on_surface(&surface.nodes(40).unwrap(), x, index, top);
                let block = order_block(&waves, index, m, top, mirror);
                let degrees = block.degrees();
                for i in 0..2 * degrees {
                    for k in 0..2 * degrees {
                        let n = block.first() + i % degrees;
                        let list = if i < degrees { series.b() } else { series.a() };
                        let known = if i == k { -list[n - 1] } else { Complex64::ZERO };
                        let error = (block.t[(i, k)] - known).norm();
                        assert!(error < 1e-10, "{index} {m} {i} {k}: {} {known}", block.t[(i, k)]);
                    }
                }
            }
        }
    }
}
