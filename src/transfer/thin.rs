//! A slab so thin that light changes linearly across it.
//!
//! The equation of transfer with its right side taken at the mean of the values at top and bottom (the "diamond"
//! start of Wiscombe 1976a): second order in the thickness over the cosine, and it keeps the energy to rounding. With
//! `a` half the thickness, `g = 1 + a/μ`, kernels F of scattering on and B of scattering back:
//! `X = I(top) + I(bottom)` of the light that goes down obeys `(g − a/μ K) X = 2 I(top)` with
//! `K = F + B* (g − a/μ F*)⁻¹ a/μ B`, stars for light from below.

use super::expansion::Expansion;
use super::phase_matrix;
use super::quadrature::Directions;
use super::slab::{Slab, Straight, mirrored, product, resolved};
use faer::Mat;

/// The slab of optical depth `depth` in one Fourier order.
pub(super) fn slab(
    expansion: &Expansion,
    albedo: f64,
    depth: f64,
    m: usize,
    directions: &Directions,
) -> Slab {
    let (rows, columns) = (directions.of_rows(), directions.of_columns());
    let kernel = |side: f64| {
        let z = phase_matrix::order(expansion, m, directions.stokes, side, &rows, &columns);
        Mat::from_fn(z.nrows(), z.ncols(), |i, k| 0.5 * albedo * z[(i, k)])
    };
    let (on, back) = (kernel(1.0), kernel(-1.0));
    let (on_below, back_below) = (mirrored(&on, directions), mirrored(&back, directions));
    let weights = directions.weights();
    let inner = directions.inner();
    let crossed = |i: usize| 0.5 * depth / rows[i].0;
    let gain = |i: usize| 1.0 + crossed(i);

    let scattered =
        |kernel: &Mat<f64>| Mat::from_fn(inner, kernel.ncols(), |i, k| crossed(i) * kernel[(i, k)]);
    let up = resolved(gain, crossed, &on_below, &weights, scattered(&back));
    let both = &on + product(back_below.as_ref(), &weights, up.as_ref());
    // what falls in counts twice over its gain: at the top, and straight on at the bottom
    let fallen: Vec<f64> =
        columns.iter().map(|(cosine, _)| 2.0 / (1.0 + 0.5 * depth / cosine)).collect();
    let times_fallen = |kernel: &Mat<f64>| {
        Mat::from_fn(kernel.nrows(), kernel.ncols(), |i, k| kernel[(i, k)] * fallen[k])
    };
    let down = times_fallen(&resolved(gain, crossed, &both, &weights, scattered(&both)));
    let rising =
        times_fallen(&up) + product(up.as_ref().subcols(0, inner), &weights, down.as_ref());

    let at_rows = |sum: Mat<f64>| {
        Mat::from_fn(sum.nrows(), sum.ncols(), |i, k| crossed(i) / gain(i) * sum[(i, k)])
    };
    let transmission =
        at_rows(times_fallen(&both) + product(both.as_ref(), &weights, down.as_ref()));
    let reflection = at_rows(
        times_fallen(&back)
            + product(back.as_ref(), &weights, down.as_ref())
            + product(on_below.as_ref(), &weights, rising.as_ref()),
    );
    let straight = Straight {
        rows: (0..rows.len()).map(|i| 2.0 / gain(i) - 1.0).collect(),
        columns: fallen.iter().map(|twice| twice - 1.0).collect(),
    };
    Slab::homogeneous(reflection, transmission, straight, directions)
}
