//! A file's k made n, or its n made k, and what the ends of the data are worth at each row.
//!
//! The integrals are those of [`kramers_kronig`](super). Data end somewhere, and what lies
//! beyond is not known: two ways to go on from the ends differ by what they are worth.

use crate::medium::error::MediumError;
use crate::medium::kramers_kronig::{
    Absorption, Between, Tails, extinction_from_index, maclaurin, worth_of_range,
};

/// How k becomes a change of n.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TransformMethod {
    /// A curve through the rows, integrated exactly through the pole.
    Continuous {
        /// Between the rows.
        between: Between,
        /// Beyond the rows.
        tails: Tails,
    },
    /// Every other row, which steps over the pole; beyond the rows there is nothing.
    Maclaurin,
}

/// What a transform gives, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Transformed {
    /// Real part of the index.
    pub n: Vec<f64>,
    /// Imaginary part of the index.
    pub k: Vec<f64>,
    /// How far what lies beyond the ends may change the result; `None` where nothing tells.
    pub worth: Option<Vec<f64>>,
}

/// n from k over a background `base`, at ascending wavelengths (metres).
///
/// # Errors
/// Rows that make no curve, or none that the method can sum.
pub fn index_of_extinction(
    wavelength: &[f64],
    k: &[f64],
    base: &[f64],
    method: TransformMethod,
) -> Result<Transformed, MediumError> {
    let (between, tails) = match method {
        TransformMethod::Continuous { between, tails } => (between, tails),
        TransformMethod::Maclaurin => (Between::Spline, Tails::Taper),
    };
    let other = match tails {
        Tails::Taper => Tails::LorentzBand,
        Tails::LorentzBand => Tails::Taper,
    };
    let change = |tails| -> Result<Vec<f64>, MediumError> {
        let absorption = Absorption::with(wavelength, k, tails, between)?;
        Ok(wavelength.iter().map(|&w| absorption.index_change(w)).collect())
    };
    let this = change(tails);
    // Without a band there is one way only.
    let worth = match (&this, change(other)) {
        (Ok(this), Ok(other)) => {
            Some(this.iter().zip(&other).map(|(a, b)| (a - b).abs()).collect())
        }
        _ => None,
    };
    let change = match method {
        TransformMethod::Maclaurin => maclaurin(wavelength, k)?,
        TransformMethod::Continuous { .. } => this?,
    };
    let n = base.iter().zip(change).map(|(b, c)| b + c).collect();
    Ok(Transformed { n, k: k.to_vec(), worth })
}

/// k from n over a background `base`, at ascending wavelengths (metres).
///
/// # Errors
/// Rows that make no curve.
pub fn extinction_of_index(
    wavelength: &[f64],
    n: &[f64],
    base: &[f64],
    between: Between,
) -> Result<Transformed, MediumError> {
    let change: Vec<f64> = n.iter().zip(base).map(|(n, b)| n - b).collect();
    let k = extinction_from_index(wavelength, &change, between)?;
    let worth = Some(worth_of_range(wavelength, &change)?);
    Ok(Transformed { n: n.to_vec(), k, worth })
}

impl Transformed {
    /// The largest worth of the ends within the middle half of the rows' range, and of all rows.
    pub fn worth_within(&self, wavelength: &[f64]) -> Option<(f64, f64)> {
        let worth = self.worth.as_ref()?;
        let (first, last) = (*wavelength.first()?, *wavelength.last()?);
        let quarter = 0.25 * (last - first);
        let middle = first + quarter..=last - quarter;
        let rows = || wavelength.iter().zip(worth);
        let inner = rows().filter(|(w, _)| middle.contains(w)).map(|(_, worth)| *worth);
        Some((inner.fold(0.0, f64::max), rows().map(|(_, worth)| *worth).fold(0.0, f64::max)))
    }

    /// The row of the lowest k below zero, which no passive material has, and the number of such rows.
    pub fn below_zero(&self) -> Option<(usize, usize)> {
        let below = self.k.iter().filter(|k| **k < 0.0).count();
        let (row, _) = self.k.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1))?;
        (below > 0).then_some((row, below))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A band of k makes the n of its oscillator, and that n the band again, as far as the ends allow.
    #[test]
    fn there_and_back() {
        let wavelength: Vec<f64> = (0..=200).map(|i| (400.0 + 2.0 * f64::from(i)) * 1e-9).collect();
        let band = |w: &f64| 1e-3 * (-((w - 600e-9) / 40e-9).powi(2)).exp();
        let k: Vec<f64> = wavelength.iter().map(band).collect();
        let base = vec![1.33; wavelength.len()];
        let method = TransformMethod::Continuous { between: Between::Spline, tails: Tails::Taper };
        let there = index_of_extinction(&wavelength, &k, &base, method).unwrap();
        // Anomalous dispersion: n rises through the band towards long wavelengths.
        assert!(there.n[110] > 1.33 && there.n[90] < 1.33);
        let back = extinction_of_index(&wavelength, &there.n, &base, Between::Spline).unwrap();
        let (middle, ends) = back.worth_within(&wavelength).unwrap();
        assert!(middle <= ends);
        for (found, k) in back.k.iter().zip(&k).skip(60).take(80) {
            assert!((found - k).abs() < 1e-4, "{found} {k}");
        }
        let below = Transformed { n: vec![], k: vec![1.0, -2.0, -1.0], worth: None };
        assert_eq!(below.below_zero(), Some((1, 2)));
        assert_eq!(there.below_zero(), None);
    }
}
