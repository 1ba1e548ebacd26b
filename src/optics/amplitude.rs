//! The amplitude scattering matrix of one direction, and the Mueller matrix that follows from it.

use num_complex::Complex64;
use std::ops::{Add, AddAssign, Mul, Sub};

/// Amplitude scattering matrix `[[S2, S3], [S4, S1]]` (Bohren & Huffman 1983, eq. 3.12),
/// dimensionless, absolute phase relative to a wave through the particle's centre.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AmplitudeMatrix {
    /// Perpendicular in, perpendicular out.
    pub s1: Complex64,
    /// Parallel in, parallel out.
    pub s2: Complex64,
    /// Perpendicular in, parallel out.
    pub s3: Complex64,
    /// Parallel in, perpendicular out.
    pub s4: Complex64,
}

impl AmplitudeMatrix {
    /// `S11`: scattered power for unpolarised light, `k² dC_sca/dΩ`.
    pub fn s11(&self) -> f64 {
        0.5 * (self.s1.norm_sqr() + self.s2.norm_sqr() + self.s3.norm_sqr() + self.s4.norm_sqr())
    }

    /// The 4 × 4 Mueller matrix, rows by outgoing Stokes vector (Bohren & Huffman 1983, eq. 3.16).
    pub fn mueller(&self) -> [[f64; 4]; 4] {
        let Self { s1, s2, s3, s4 } = *self;
        let (i1, i2, i3, i4) = (s1.norm_sqr(), s2.norm_sqr(), s3.norm_sqr(), s4.norm_sqr());
        let re = |a: Complex64, b: Complex64| (a * b.conj()).re;
        let im = |a: Complex64, b: Complex64| (a * b.conj()).im;
        [
            [
                0.5 * (i1 + i2 + i3 + i4),
                0.5 * (i2 - i1 + i4 - i3),
                re(s2, s3) + re(s1, s4),
                im(s2, s3) - im(s1, s4),
            ],
            [
                0.5 * (i2 - i1 - i4 + i3),
                0.5 * (i2 + i1 - i4 - i3),
                re(s2, s3) - re(s1, s4),
                im(s2, s3) + im(s1, s4),
            ],
            [
                re(s2, s4) + re(s1, s3),
                re(s2, s4) - re(s1, s3),
                re(s1, s2) + re(s3, s4),
                im(s2, s1) + im(s4, s3),
            ],
            [
                im(s4, s2) + im(s1, s3),
                im(s4, s2) - im(s1, s3),
                im(s1, s2) - im(s3, s4),
                re(s1, s2) - re(s3, s4),
            ],
        ]
    }
}

/// Sign of a Mueller element (0 to 15, row by row) in the mirror image: those that couple I, Q with U, V
/// change it.
pub fn mirror_sign(element: usize) -> f64 {
    let (row, column) = (element / 4, element % 4);
    if (row < 2) == (column < 2) { 1.0 } else { -1.0 }
}

impl Add for AmplitudeMatrix {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self { s1: self.s1 + o.s1, s2: self.s2 + o.s2, s3: self.s3 + o.s3, s4: self.s4 + o.s4 }
    }
}

impl Sub for AmplitudeMatrix {
    type Output = Self;

    fn sub(self, o: Self) -> Self {
        Self { s1: self.s1 - o.s1, s2: self.s2 - o.s2, s3: self.s3 - o.s3, s4: self.s4 - o.s4 }
    }
}

impl AddAssign for AmplitudeMatrix {
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl Mul<Complex64> for AmplitudeMatrix {
    type Output = Self;
    fn mul(self, f: Complex64) -> Self {
        Self { s1: self.s1 * f, s2: self.s2 * f, s3: self.s3 * f, s4: self.s4 * f }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix() -> AmplitudeMatrix {
        let c = Complex64::new;
        AmplitudeMatrix { s1: c(1.0, 0.4), s2: c(-0.3, 2.0), s3: c(0.5, -0.7), s4: c(0.2, 1.1) }
    }

    /// Stokes parameters I, Q, U, V after Bohren & Huffman 1983, eq. 2.80.
    fn stokes([parallel, perpendicular]: [Complex64; 2]) -> [f64; 4] {
        let (i, q) = (parallel.norm_sqr(), perpendicular.norm_sqr());
        let cross = parallel * perpendicular.conj();
        [i + q, i - q, 2.0 * cross.re, -2.0 * cross.im]
    }

    /// Every column of the Mueller matrix: the Stokes vector of the scattered field is the matrix times
    /// that of the incident one.
    #[test]
    fn the_mueller_matrix_does_to_stokes_what_amplitudes_do_to_fields() {
        let s = matrix();
        let mueller = s.mueller();
        let c = Complex64::new;
        for field in [
            [c(1.0, 0.0), c(0.0, 0.0)],
            [c(0.0, 0.0), c(1.0, 0.0)],
            [c(1.0, 0.0), c(1.0, 0.0)],
            [c(1.0, 0.0), c(0.0, 1.0)],
            [c(0.3, -0.8), c(1.2, 0.5)],
        ] {
            let [a, b] = field;
            let out = stokes([s.s2 * a + s.s3 * b, s.s4 * a + s.s1 * b]);
            let incident = stokes(field);
            for (row, wanted) in mueller.iter().zip(out) {
                let found: f64 = row.iter().zip(incident).map(|(m, i)| m * i).sum();
                assert!((found - wanted).abs() < 1e-14, "{field:?}: {found} {wanted}");
            }
        }
        assert_eq!(mueller[0][0], s.s11());
    }

    #[test]
    fn arithmetic_is_element_by_element() {
        let (s, i) = (matrix(), Complex64::i());
        let mut sum = s + s * i;
        sum += s;
        let expected = s * Complex64::new(2.0, 1.0);
        assert!((sum - expected).s11() < 1e-30);
        assert!((sum.s3 - s.s3 * Complex64::new(2.0, 1.0)).norm() < 1e-15);
    }
}
