//! One Fourier order, in azimuth, of a phase matrix between directions of a layer.
//!
//! `Z^m(u, u') = Σ_l Π_l(u) S_l Π_l(u')` (Hovenier & van der Mee 1983; de Haan, Bosma & Hovenier 1987, eqs. 67 to 75)
//! with u the cosine of a direction to the layer's normal, positive downwards, S_l the coefficients of degree l, and
//! Π_l of the functions d_m0 and `(d_m2 ± d_m,-2)/2`; factors i^m cancel, signs are those of our Q and azimuth. Light that falls in unpolarised comes out as
//! `Σ (2 - δ_m0) Z^m` times cos mφ for I and Q, sin mφ for U and V.

use super::expansion::Expansion;
use crate::math::wigner::Wigner;
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};

/// Directions: cosine, and Stokes component.
pub(super) type Components<'a> = &'a [(f64, usize)];

/// Z^m of light from `columns` to `rows`; `side` is 1 where it goes on and -1 where it is turned back.
pub(super) fn order(
    expansion: &Expansion,
    m: usize,
    stokes: usize,
    side: f64,
    rows: Components<'_>,
    columns: Components<'_>,
) -> Mat<f64> {
    let from = basis(m, expansion.len(), stokes, 1.0, columns);
    let to = basis(m, expansion.len(), stokes, side, rows);
    let degrees = expansion.len().saturating_sub(m);
    let mut scattered = Mat::<f64>::zeros(rows.len(), degrees * stokes);
    for k in 0..degrees {
        let coupling = expansion.coupling(m + k);
        for i in 0..rows.len() {
            for d in 0..stokes {
                scattered[(i, k * stokes + d)] =
                    (0..stokes).map(|c| to[(i, k * stokes + c)] * coupling[c][d]).sum();
            }
        }
    }
    let mut product = Mat::zeros(rows.len(), columns.len());
    matmul(product.as_mut(), Accum::Replace, &scattered, from.transpose(), 1.0, Par::Seq);
    product
}

/// Rows of Π_l for l = m, m + 1, …, side by side.
fn basis(m: usize, count: usize, stokes: usize, side: f64, list: Components<'_>) -> Mat<f64> {
    let degrees = count.saturating_sub(m);
    let mut rows = Mat::zeros(list.len(), degrees * stokes);
    let mut known: Option<(f64, Vec<[f64; 3]>)> = None;
    for (i, &(cosine, component)) in list.iter().enumerate() {
        let u = side * cosine;
        if known.as_ref().is_none_or(|(at, _)| *at != u) {
            known = Some((u, functions(m, count, u)));
        }
        let Some((_, values)) = &known else { continue };
        for (k, &[zero, plus, minus]) in values.iter().enumerate() {
            let row = match component {
                0 => [zero, 0.0, 0.0, 0.0],
                1 => [0.0, plus, minus, 0.0],
                2 => [0.0, minus, plus, 0.0],
                _ => [0.0, 0.0, 0.0, zero],
            };
            (0..stokes).for_each(|c| rows[(i, k * stokes + c)] = row[c]);
        }
    }
    rows
}

/// `d_m0` and `(d_m2 ± d_m,-2)/2` for l = m, m + 1, … below `count`.
fn functions(m: usize, count: usize, u: f64) -> Vec<[f64; 3]> {
    let order = m as i32;
    let mut zero = Wigner::new(order, 0, u);
    let (mut below, mut above) = (Wigner::new(order, -2, u), Wigner::new(order, 2, u));
    let next = |_| {
        let (a, b) = (below.next(), above.next());
        [zero.next(), 0.5 * (b + a), 0.5 * (b - a)]
    };
    (0..count).map(next).skip(m).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec3::Vec3;

    /// A phase matrix that has all six elements: that of no special particle.
    fn some_expansion() -> Expansion {
        let mut some = Expansion::zero(9);
        for l in 0..9 {
            let fall = 0.5f64.powi(l as i32);
            some.alpha[0][l] = (2 * l + 1) as f64 * fall;
            some.alpha[3][l] = (2 * l + 1) as f64 * fall * 0.7;
            if l >= 2 {
                some.alpha[1][l] = (2 * l + 1) as f64 * fall * 0.9;
                some.alpha[2][l] = (2 * l + 1) as f64 * fall * 0.6;
                some.beta[0][l] = -0.8 * fall * l as f64;
                some.beta[1][l] = 0.4 * fall * (l as f64 - 3.0);
            }
        }
        some
    }

    /// The scattering matrix at a scattering angle.
    fn scattering_matrix(expansion: &Expansion, cosine: f64) -> [[f64; 4]; 4] {
        let [p11, p12, p22, p33, p34, p44] = expansion.elements(cosine);
        [[p11, p12, 0.0, 0.0], [p12, p22, 0.0, 0.0], [0.0, 0.0, p33, p34], [0.0, 0.0, -p34, p44]]
    }

    /// A direction with its parallel and perpendicular unit vectors in the plane through the normal.
    fn frame(u: f64, phi: f64) -> [Vec3<f64>; 3] {
        let s = (1.0 - u * u).sqrt();
        let (sp, cp) = phi.sin_cos();
        let along = Vec3::new(s * cp, s * sp, u);
        let parallel = Vec3::new(u * cp, u * sp, -s);
        [along, parallel, parallel.cross(along)]
    }

    /// Stokes parameters in a frame whose parallel direction is turned by ψ (`E∥' = E∥ cos ψ + E⊥ sin ψ`).
    fn turned(psi: f64) -> [[f64; 4]; 4] {
        let (s, c) = (2.0 * psi).sin_cos();
        [[1.0, 0.0, 0.0, 0.0], [0.0, c, s, 0.0], [0.0, -s, c, 0.0], [0.0, 0.0, 0.0, 1.0]]
    }

    fn times(a: [[f64; 4]; 4], b: [[f64; 4]; 4]) -> [[f64; 4]; 4] {
        std::array::from_fn(|i| std::array::from_fn(|k| (0..4).map(|j| a[i][j] * b[j][k]).sum()))
    }

    /// Scattering by its definition: turn to the plane of scattering, scatter, turn to the plane of the normal.
    fn direct(
        expansion: &Expansion,
        (u, phi): (f64, f64),
        (u0, phi0): (f64, f64),
    ) -> [[f64; 4]; 4] {
        let ([out, e_out, f_out], [light, e_in, f_in]) = (frame(u, phi), frame(u0, phi0));
        let cosine = out.dot(light);
        // ê⊥ × ê∥ = the direction, and ê∥ of the incident light points to the side that is scattered to
        let normal = light.cross(out);
        let perpendicular = normal * (-1.0 / normal.dot(normal).sqrt());
        let angle = |along: Vec3<f64>, e: Vec3<f64>, f: Vec3<f64>| {
            let parallel = along.cross(perpendicular);
            parallel.dot(f).atan2(parallel.dot(e))
        };
        let to = turned(-angle(out, e_out, f_out));
        times(to, times(scattering_matrix(expansion, cosine), turned(angle(light, e_in, f_in))))
    }

    /// The Fourier series is the phase matrix turned from plane to plane, in all elements.
    #[test]
    fn orders_add_up_to_the_turned_matrix() {
        let expansion = some_expansion();
        for (u, u0, phi) in [(0.3, 0.7, 0.4), (-0.6, 0.2, 2.0), (-0.9, 0.95, 4.0), (0.5, 0.1, 5.5)]
        {
            let expected = direct(&expansion, (u, phi), (u0, 0.0));
            let components = |u: f64| (0..4).map(|c| (u, c)).collect::<Vec<_>>();
            let mut sum = [[0.0; 4]; 4];
            for m in 0..expansion.len() {
                let z = order(&expansion, m, 4, 1.0, &components(u), &components(u0));
                let (sine, cosine) = (m as f64 * phi).sin_cos();
                let twice = if m == 0 { 1.0 } else { 2.0 };
                for (i, row) in sum.iter_mut().enumerate() {
                    for (k, value) in row.iter_mut().enumerate() {
                        let factor = match (i < 2, k < 2) {
                            (true, true) | (false, false) => cosine,
                            (false, true) => sine,
                            (true, false) => -sine,
                        };
                        *value += twice * factor * z[(i, k)];
                    }
                }
            }
            for i in 0..4 {
                for k in 0..4 {
                    assert!(
                        (sum[i][k] - expected[i][k]).abs() < 1e-12,
                        "{u} {u0} {phi}, {i}{k}: {sum:?} {expected:?}"
                    );
                }
            }
        }
    }

    /// Turned back and turned on are mirror images: Z(-u, -u') is Z(u, u') with U and V changing their signs.
    #[test]
    fn from_below_as_from_above() {
        let expansion = some_expansion();
        let components = |u: f64| (0..4).map(|c| (u, c)).collect::<Vec<_>>();
        for m in 0..5 {
            let above = order(&expansion, m, 4, 1.0, &components(0.3), &components(0.8));
            let below = order(&expansion, m, 4, 1.0, &components(-0.3), &components(-0.8));
            for i in 0..4 {
                for k in 0..4 {
                    let sign = if (i < 2) == (k < 2) { 1.0 } else { -1.0 };
                    assert!((above[(i, k)] - sign * below[(i, k)]).abs() < 1e-13);
                }
            }
        }
    }
}
