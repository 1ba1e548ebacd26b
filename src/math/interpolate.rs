//! Interpolation by polynomials through a few points.
//!
//! ```
//! use gonio::math::interpolate::lagrange;
//!
//! // a parabola through three of its points
//! assert!((lagrange(&[(0.0, 1.0), (1.0, 2.0), (3.0, 10.0)], 2.0) - 5.0).abs() < 1e-14);
//! ```

use num_complex::Complex64;

/// The polynomial through `(x, y)` points, at `x`.
pub fn lagrange(points: &[(f64, f64)], x: f64) -> f64 {
    lagrange_complex(points, Complex64::new(x, 0.0)).re
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
