//! The ideal filter that an observer looks through: along the scattering plane, across it, or none.

/// Light that an observer with or without a filter sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Polarisation {
    Total,
    Parallel,
    Perpendicular,
}

impl Polarisation {
    /// What passes of unpolarised light scattered with the Mueller elements 11 and 21: `½(S11 ± S21)` along
    /// and across the scattering plane (Bohren & Huffman 1983, section 3.3; S21 is S12 for spheres alone).
    ///
    /// ```
    /// use gonio::optics::Polarisation;
    /// // At 90° a small sphere sends nothing along the scattering plane: S21 = −S11.
    /// assert_eq!(Polarisation::Parallel.passed(1.0, -1.0), 0.0);
    /// assert_eq!(Polarisation::Perpendicular.passed(1.0, -1.0), 1.0);
    /// ```
    pub fn passed(self, s11: f64, s21: f64) -> f64 {
        match self {
            Polarisation::Total => s11,
            Polarisation::Parallel => 0.5 * (s11 + s21),
            Polarisation::Perpendicular => 0.5 * (s11 - s21),
        }
    }
}
