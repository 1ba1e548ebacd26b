//! Guesses of launch points next to a fold, where they are analytic in the root of the angle from it.

use crate::math::interpolate::{lagrange, lagrange_complex};
use num_complex::Complex64;

/// Launch points as a function of `q`, extrapolated from those already found.
pub(super) struct RootPath {
    centre: [f64; 2],
    tangent: [f64; 2],
    known: Vec<(f64, [f64; 2])>,
    imaginary: Vec<(f64, [Complex64; 2])>,
}

/// Points used for extrapolation.
const STENCIL: usize = 4;

impl RootPath {
    pub(super) fn new(centre: [f64; 2], tangent: [f64; 2]) -> Self {
        Self { centre, tangent, known: vec![(0.0, centre)], imaginary: Vec::new() }
    }

    pub(super) fn add(&mut self, q: f64, place: [f64; 2]) {
        self.known.push((q, place));
    }

    pub(super) fn add_imaginary(&mut self, q: f64, place: [Complex64; 2]) {
        self.imaginary.push((q, place));
    }

    /// Guess at real `q`: the expansion at the fold, then the polynomial through the points nearest.
    pub(super) fn guess(&self, q: f64) -> [f64; 2] {
        let mut near: Vec<_> = self.known.clone();
        near.sort_by(|a, b| (a.0 - q).abs().total_cmp(&(b.0 - q).abs()));
        near.truncate(STENCIL);
        if near.len() < 3 {
            return [0, 1].map(|k| self.centre[k] + q * self.tangent[k]);
        }
        [0, 1].map(|k| {
            let points: Vec<(f64, f64)> = near.iter().map(|(x, p)| (*x, p[k])).collect();
            lagrange(&points, q)
        })
    }

    /// Guess at imaginary `q`: even and odd parts of the path, continued from those found.
    pub(super) fn guess_complex(&self, q: Complex64) -> [Complex64; 2] {
        if self.imaginary.len() >= 3 {
            let last = &self.imaginary[self.imaginary.len() - 3..];
            return [0, 1].map(|k| {
                let part = |f: fn(Complex64) -> f64| {
                    let points: Vec<(f64, f64)> = last.iter().map(|(x, p)| (*x, f(p[k]))).collect();
                    lagrange(&points, q.im)
                };
                Complex64::new(part(|z| z.re), part(|z| z.im))
            });
        }
        // A polynomial in q through the real points nearest to the fold, taken at imaginary q.
        let mut near = self.known.clone();
        near.sort_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        near.truncate(5);
        [0, 1].map(|k| {
            let points: Vec<(f64, f64)> = near.iter().map(|(x, p)| (*x, p[k])).collect();
            lagrange_complex(&points, q)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Guesses extrapolate a launch point that is a cubic in `q`, to imaginary `q` as well.
    #[test]
    fn guesses_follow_the_points_found() {
        let place = |q: Complex64| [0.5 + q * (0.3 + q * (0.1 - q * 0.2)), q * (1.0 - q * q)];
        let real = |q: f64| place(q.into()).map(|z| z.re);
        let mut path = RootPath::new(real(0.0), [0.3, 1.0]);
        let [u, v] = path.guess(0.01);
        assert!((u - 0.503).abs() < 1e-15 && (v - 0.01).abs() < 1e-15);
        for q in [0.1, -0.1, 0.2, -0.2] {
            path.add(q, real(q));
        }
        let [u, v] = path.guess(0.26);
        assert!((u - real(0.26)[0]).abs() < 1e-13 && (v - real(0.26)[1]).abs() < 1e-13);
        let q = Complex64::new(0.0, 0.12);
        let guess = path.guess_complex(q);
        assert!((guess[0] - place(q)[0]).norm() + (guess[1] - place(q)[1]).norm() < 1e-13);
        for k in 1..4 {
            let q = Complex64::new(0.0, 0.1 * f64::from(k));
            path.add_imaginary(q.im, place(q));
        }
        let q = Complex64::new(0.0, 0.32);
        let guess = path.guess_complex(q);
        assert!((guess[0] - place(q)[0]).norm() < 1e-3 && (guess[1] - place(q)[1]).norm() < 5e-3);
    }
}
