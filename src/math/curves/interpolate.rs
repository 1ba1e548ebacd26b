//! Interpolation by polynomials through a few points.

use num_complex::Complex64;

/// The polynomial through `(x, y)` points, at `x`.
pub fn lagrange(points: &[(f64, f64)], x: f64) -> f64 {
    let term = |(i, (xi, yi)): (usize, &(f64, f64))| {
        let others = points.iter().enumerate().filter(|(j, _)| *j != i);
        others.fold(*yi, |product, (_, (xj, _))| product * (x - xj) / (xi - xj))
    };
    points.iter().enumerate().map(term).sum()
}

/// The polynomial through real points, at a complex argument.
pub fn lagrange_complex(points: &[(f64, f64)], x: Complex64) -> Complex64 {
    let mut sum = Complex64::default();
    for (i, (xi, yi)) in points.iter().enumerate() {
        let mut weight = Complex64::new(*yi, 0.0);
        for (j, (xj, _)) in points.iter().enumerate() {
            if i != j {
                weight *= (x - xj) / (xi - xj);
            }
        }
        sum += weight;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cubic comes back through four points, at complex arguments too.
    #[test]
    fn polynomials_come_back() {
        let cubic = |x: Complex64| 2.0 - x * (3.0 - x * (0.5 + x * 4.0));
        let points = [-1.0, 0.2, 0.7, 3.0].map(|x| (x, cubic(x.into()).re));
        for x in [-2.0, 0.2, 1.3] {
            assert!((lagrange(&points, x) - cubic(x.into()).re).abs() < 1e-12, "{x}");
        }
        let z = Complex64::new(0.4, -1.7);
        assert!((lagrange_complex(&points, z) - cubic(z)).norm() < 1e-12);
    }
}
