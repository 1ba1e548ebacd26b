//! What one slab does to light of one Fourier order: kernels of reflection and diffuse transmission.
//!
//! A kernel K turns radiances by `I(μ) = ∫ K(μ, μ') I(μ') dμ'`; products of kernels sum over the nodes with their
//! weights. Rows are nodes and views, columns nodes and the sun. What passes straight through is kept apart.

use super::quadrature::Directions;
use faer::linalg::matmul::matmul;
use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Accum, Mat, MatRef, Par};

/// A slab, lit from above and from below.
#[derive(Clone, Debug)]
pub(super) struct Slab {
    /// Lit from above.
    pub reflection: Mat<f64>,
    pub transmission: Mat<f64>,
    /// Lit from below, from the nodes alone.
    pub reflection_below: Mat<f64>,
    pub transmission_below: Mat<f64>,
    /// Share that passes straight through, by row and by column.
    pub straight: Straight,
}

/// Share of light that passes a slab without being scattered.
#[derive(Clone, Debug)]
pub(super) struct Straight {
    pub rows: Vec<f64>,
    pub columns: Vec<f64>,
}

impl Slab {
    /// A slab that is the same from below as from above.
    pub fn homogeneous(
        reflection: Mat<f64>,
        transmission: Mat<f64>,
        straight: Straight,
        directions: &Directions,
    ) -> Self {
        let reflection_below = mirrored(&reflection, directions);
        let transmission_below = mirrored(&transmission, directions);
        Self { reflection, transmission, reflection_below, transmission_below, straight }
    }
}

/// A kernel for light from below out of that from above: U and V change their signs.
pub(super) fn mirrored(kernel: &Mat<f64>, directions: &Directions) -> Mat<f64> {
    let linear = |i: usize| i % directions.stokes < 2;
    Mat::from_fn(kernel.nrows(), directions.inner(), |i, k| {
        if linear(i) == linear(k) { kernel[(i, k)] } else { -kernel[(i, k)] }
    })
}

/// A product of kernels: light that goes through the second, then through the first.
pub(super) fn product(
    first: MatRef<'_, f64>,
    weights: &[f64],
    second: MatRef<'_, f64>,
) -> Mat<f64> {
    let inner = weights.len();
    let scaled = Mat::from_fn(first.nrows(), inner, |i, k| first[(i, k)] * weights[k]);
    let mut product = Mat::zeros(first.nrows(), second.ncols());
    let nodes = second.subrows(0, inner);
    matmul(product.as_mut(), Accum::Replace, &scaled, nodes, 1.0, Par::Seq);
    product
}

/// `(diagonal − factor · kernel · weights)⁻¹ · right` among the nodes.
pub(super) fn resolved(
    diagonal: impl Fn(usize) -> f64,
    factor: impl Fn(usize) -> f64,
    kernel: &Mat<f64>,
    weights: &[f64],
    right: Mat<f64>,
) -> Mat<f64> {
    let inner = weights.len();
    let system = Mat::from_fn(inner, inner, |i, k| {
        let own = if i == k { diagonal(i) } else { 0.0 };
        own - factor(i) * kernel[(i, k)] * weights[k]
    });
    let mut right = right;
    PartialPivLu::new(system.as_ref()).solve_in_place(right.as_mut());
    right
}
