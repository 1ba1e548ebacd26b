//! What a sum of Debye terms from diffraction and order 0 on is worth: measured, against Lorenz–Mie.
//!
//! The share of power in the terms left out tells little where the terms kept cancel: beside the forward
//! peak of soft particles, between resonances, for n < 1. The whole series is at hand, so that the two are
//! compared at angles all over the sphere, by the bands in which tables state errors.

use super::debye::{DebyeSeries, Term};
use super::lorenz_mie::Sphere;
use crate::phase_table::{ERROR_BANDS, error_theta};
use num_complex::Complex64;

/// Angles in each band.
const SAMPLES: usize = 12;
/// Bands from 10° to 170° count in the means.
const COUNTED: std::ops::Range<usize> = 3..43;

/// Relative errors of the intensity, as tables state them.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct BandErrors {
    /// Weighted by intensity, 10° to 170°.
    pub weighted: f64,
    /// Root mean square over the bands from 10° to 170°, each relative to its own intensity.
    pub by_band: f64,
    /// Of each band.
    pub by_direction: [f64; ERROR_BANDS],
}

impl BandErrors {
    /// The same everywhere.
    pub fn even(error: f64) -> Self {
        Self { weighted: error, by_band: error, by_direction: [error; ERROR_BANDS] }
    }

    /// None less than this.
    pub fn at_least(self, least: f64) -> Self {
        let most = |error: f64| if error < least { least } else { error };
        Self {
            weighted: most(self.weighted),
            by_band: most(self.by_band),
            by_direction: self.by_direction.map(most),
        }
    }

    /// Of a sum of Debye terms; NaN for single orders, which stand for themselves.
    pub fn of_terms(series: &DebyeSeries, terms: &[Term], sphere: &Sphere) -> Self {
        let count = terms.len().saturating_sub(1) as u32;
        let whole = (0..count).all(|order| terms.contains(&Term::Order(order)));
        if !(whole && count > 0 && terms.contains(&Term::Diffraction)) {
            return Self::even(f64::NAN);
        }
        let theta: Vec<f64> = (0..ERROR_BANDS).flat_map(band).collect();
        let found = intensities(&series.sum_parallel(terms, &theta));
        Self::of(&found, &intensities(&sphere.amplitudes_parallel(&theta)))
    }

    fn of(found: &[f64], right: &[f64]) -> Self {
        let (mut squares, mut powers) = ([0.0; ERROR_BANDS], [0.0; ERROR_BANDS]);
        for (i, (found, right)) in found.iter().zip(right).enumerate() {
            squares[i / SAMPLES] += (found - right).powi(2);
            powers[i / SAMPLES] += right * right;
        }
        let sum = |of: &[f64]| of[COUNTED].iter().sum::<f64>();
        let relative: Vec<f64> = squares.iter().zip(&powers).map(|(off, all)| off / all).collect();
        let mean = relative[COUNTED].iter().map(|r| r.min(1.0)).sum::<f64>() / COUNTED.len() as f64;
        Self {
            weighted: (sum(&squares) / sum(&powers)).sqrt(),
            by_band: mean.sqrt(),
            by_direction: std::array::from_fn(|b| relative[b].sqrt()),
        }
    }
}

/// Angles in a band, off any even grid, in [0, π].
fn band(band: usize) -> impl Iterator<Item = f64> {
    let width = error_theta(1);
    (0..SAMPLES).map(move |k| {
        let offset = ((k as f64 + 0.5) * 0.618_033_988_749_895).fract() - 0.5;
        let theta = (error_theta(band) + offset * width).abs();
        theta.min(2.0 * std::f64::consts::PI - theta)
    })
}

fn intensities(amplitudes: &[(Complex64, Complex64)]) -> Vec<f64> {
    amplitudes.iter().map(|(s1, s2)| s1.norm_sqr() + s2.norm_sqr()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn errors(x: f64, index: Complex64, last: u32) -> BandErrors {
        let terms: Vec<Term> = (0..=last).map(Term::Order).chain([Term::Diffraction]).collect();
        let series = DebyeSeries::new(x, index).unwrap();
        BandErrors::of_terms(&series, &terms, &Sphere::new(x, index).unwrap())
    }

    /// Each order more makes the sum better, down to rounding where light is absorbed.
    #[test]
    fn more_orders_miss_less() {
        let m = Complex64::new(1.333, 0.01);
        let all: Vec<f64> = [1, 3, 8, 60].map(|last| errors(100.0, m, last).weighted).into();
        assert!(all.windows(2).all(|pair| pair[1] < 0.7 * pair[0]), "{all:?}");
        assert!(all[3] < 1e-6, "{all:?}");
    }

    /// Beside the forward peak of a soft sphere the terms cancel, and what little they leave out is
    /// all there is; the share of power left out would say 8 %.
    #[test]
    fn cancelling_terms_are_told() {
        assert!(errors(68.67, 0.9987.into(), 3).weighted > 0.5);
    }

    #[test]
    fn single_orders_have_no_error() {
        let (x, m) = (50.0, Complex64::new(1.333, 0.0));
        let (series, sphere) = (DebyeSeries::new(x, m).unwrap(), Sphere::new(x, m).unwrap());
        let found = BandErrors::of_terms(&series, &[Term::Order(2)], &sphere);
        assert!(found.weighted.is_nan());
    }
}
