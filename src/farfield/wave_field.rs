//! What all methods have in common: they add the waves of their orders to directions.

use crate::optics::AmplitudeMatrix;

/// The waves of some orders, ready to be asked for directions.
pub trait WaveField: Send + Sync {
    /// Add the waves in some directions of one azimuth, scattering angles ascending (radians).
    fn add(&self, theta: &[f64], phi: f64, sums: &mut [AmplitudeMatrix]);

    /// Add them at several azimuths; a method may share work between those.
    fn add_columns(&self, theta: &[f64], azimuths: &[f64], columns: &mut [Vec<AmplitudeMatrix>]) {
        for (column, &phi) in columns.iter_mut().zip(azimuths) {
            self.add(theta, phi, column);
        }
    }
}

/// The waves alone, at one azimuth.
///
/// ```
/// use gonio::farfield::{WaveField, waves};
/// use gonio::optics::AmplitudeMatrix;
/// struct Even(f64);
/// impl WaveField for Even {
///     fn add(&self, _: &[f64], _: f64, sums: &mut [AmplitudeMatrix]) {
///         sums.iter_mut().for_each(|sum| sum.s1 += self.0);
///     }
/// }
/// assert_eq!(waves(&Even(2.0), &[0.1, 0.2], 0.0)[1].s1.re, 2.0);
/// ```
pub fn waves(field: &dyn WaveField, theta: &[f64], phi: f64) -> Vec<AmplitudeMatrix> {
    let mut sums = vec![AmplitudeMatrix::default(); theta.len()];
    field.add(theta, phi, &mut sums);
    sums
}
