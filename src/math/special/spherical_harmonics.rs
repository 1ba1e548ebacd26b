//! Associated Legendre functions, normalised by Schmidt, for sums over spherical harmonics.

/// `√((l-m)!/(l+m)!) P_l^m(cos θ)` without the sign `(-1)^m`, and the same of its derivative by θ, for
/// one `m` and `l = m ..= last`, handed to `visit` as `(l, value, slope)`. `θ` must not be 0 or π.
pub fn legendre(m: usize, last: usize, theta: f64, mut visit: impl FnMut(usize, f64, f64)) {
    let (sin, cos) = theta.sin_cos();
    let mut value = (1..=m).fold(1.0, |v, k| {
        let k = k as f64;
        v * sin * ((2.0 * k - 1.0) / (2.0 * k)).sqrt()
    });
    let (mut before, mut root_before) = (0.0, 0.0);
    let square = (m * m) as f64;
    for l in m..=last {
        let degree = l as f64;
        let root = (degree * degree - square).sqrt();
        if l > m {
            let next = ((2.0 * degree - 1.0) * cos * value - root_before * before) / root;
            (before, value) = (value, next);
        }
        visit(l, value, (degree * cos * value - root * before) / sin);
        root_before = root;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn low_degrees_are_met_with_their_slopes() {
        let theta: f64 = 0.7;
        let (sin, cos) = theta.sin_cos();
        let found = |m: usize, degree: usize| {
            let mut at = (0.0, 0.0);
            legendre(m, degree, theta, |l, v, s| {
                if l == degree {
                    at = (v, s);
                }
            });
            at
        };
        let close = |a: (f64, f64), v: f64, s: f64| {
            assert!((a.0 - v).abs() < 1e-14 && (a.1 - s).abs() < 1e-13, "{a:?} {v} {s}");
        };
        close(found(0, 0), 1.0, 0.0);
        close(found(0, 2), 1.5 * cos * cos - 0.5, -3.0 * cos * sin);
        // P₂¹ = 3 sin cos, √(1!/3!) = 1/√6
        close(found(1, 2), 1.5f64.sqrt() * sin * cos, 1.5f64.sqrt() * (cos * cos - sin * sin));
        // P₃² = 15 sin² cos, √(1!/5!) = 1/√120
        let norm = 15.0 / 120f64.sqrt();
        close(
            found(2, 3),
            norm * sin * sin * cos,
            norm * (2.0 * sin * cos * cos - sin * sin * sin),
        );
    }

    /// The addition theorem at one point: `P_l⁰² + 2 Σ P_l^m² = 1` in this normalisation.
    #[test]
    fn high_degrees_add_up() {
        let (degree, theta) = (300, 1.1);
        let mut sum = 0.0;
        for m in 0..=degree {
            let weight = if m == 0 { 1.0 } else { 2.0 };
            legendre(m, degree, theta, |l, value, _| {
                if l == degree {
                    sum += weight * value * value;
                }
            });
        }
        assert!((sum - 1.0).abs() < 1e-11, "{sum}");
    }
}
