//! Wigner's functions `d^n_{mm'}(β)`: spherical waves about one axis as sums of those about another.
//!
//! `d^n_{0m}` are the angular functions of [`super::waves`]; for negative m those waves lack the sign
//! `(-1)^m` of Wigner's, which [`sign`] supplies. Upward recurrence in n (Mishchenko, Travis & Lacis
//! 2002, eqs. B.22–B.24), stable in this direction.

/// All `d^n_{m m'}(β)` for fixed m and m', n from `max(|m|, |m'|)` to `top`, by n.
pub(in crate::series::tmatrix) fn wigner(
    m: i64,
    primed: i64,
    top: usize,
    cos: f64,
    out: &mut [f64],
) {
    out.iter_mut().for_each(|value| *value = 0.0);
    let first = m.abs().max(primed.abs());
    if first as usize > top {
        return;
    }
    let (product, m2, p2) = ((m * primed) as f64, (m * m) as f64, (primed * primed) as f64);
    let (mut before, mut now) = (0.0, start(m, primed, cos));
    let mut root = 0.0;
    for (n, to) in out.iter_mut().enumerate().take(top + 1).skip(first as usize) {
        *to = now;
        let (k, next) = (n as f64, (n + 1) as f64);
        let next_root = ((next * next - m2) * (next * next - p2)).sqrt();
        let after = if n == 0 {
            cos * now
        } else {
            ((2.0 * k + 1.0) * (k * next * cos - product) * now - next * root * before)
                / (k * next_root)
        };
        (before, now, root) = (now, after, next_root);
    }
}

/// The first function, `ξ 2^{-n} √((2n)!/(|m-m'|! |m+m'|!)) (1-cos)^{|m-m'|/2} (1+cos)^{|m+m'|/2}`.
fn start(m: i64, primed: i64, cos: f64) -> f64 {
    let (minus, plus) = ((m - primed).unsigned_abs(), (m + primed).unsigned_abs());
    let sign = if primed >= m || (m - primed) % 2 == 0 { 1.0 } else { -1.0 };
    let (low, high) = (0.5 * (1.0 - cos), 0.5 * (1.0 + cos));
    // (minus + plus)!/(minus! plus!) = Π (plus + i)/i, taken together with the powers
    let (few, many) = (minus.min(plus), minus.max(plus));
    let (few_base, many_base) = if minus < plus { (low, high) } else { (high, low) };
    let mut square = 1.0f64;
    for i in 1..=many {
        square *= many_base;
        if i <= few {
            square *= few_base * (many + i) as f64 / i as f64;
        }
    }
    sign * square.sqrt()
}

/// What turns a wave of order m here into Wigner's.
pub(in crate::series::tmatrix) fn sign(m: i64) -> f64 {
    if m < 0 && m % 2 != 0 { -1.0 } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `d²` in closed form (Varshalovich, Moskalev & Khersonskii 1988, table 4.4).
    #[test]
    fn second_degree_in_closed_form() {
        let (sin, cos) = 0.9f64.sin_cos();
        let known = [
            (0, 0, 1.5 * cos * cos - 0.5),
            (1, 0, -(1.5f64.sqrt()) * sin * cos),
            (0, 1, 1.5f64.sqrt() * sin * cos),
            (1, 1, 0.5 * (2.0 * cos * cos + cos - 1.0)),
            (1, -1, 0.5 * (-2.0 * cos * cos + cos + 1.0)),
            (2, 2, 0.25 * (1.0 + cos).powi(2)),
            (2, 1, -0.5 * sin * (1.0 + cos)),
            (-2, 2, 0.25 * (1.0 - cos).powi(2)),
        ];
        for (m, primed, value) in known {
            let mut d = vec![0.0; 3];
            wigner(m, primed, 2, cos, &mut d);
            assert!((d[2] - value).abs() < 1e-15, "{m} {primed}: {} {value}", d[2]);
        }
    }

    /// Rows of a rotation are orthonormal at any degree.
    #[test]
    fn rows_are_unit_vectors() {
        let n = 60;
        for m in [0i64, 7, -31, 60] {
            let square: f64 = (-(n as i64)..=n as i64)
                .map(|primed| {
                    let mut d = vec![0.0; n + 1];
                    wigner(m, primed, n, 0.3, &mut d);
                    d[n] * d[n]
                })
                .sum();
            assert!((square - 1.0).abs() < 1e-12, "{m}: {square}");
        }
    }
}
