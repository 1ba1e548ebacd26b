//! The analytic functions of the two rays of a fold at one place, and as channels of a series.

use num_complex::Complex64;

/// What is analytic in the two rays of a fold: mean path, ζ̂, `g₀` and `g₁` of S1 … S4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairValues {
    /// Mean path of the two rays.
    pub path: f64,
    /// `ζ̂`, the argument of the Airy functions but for the power of the size parameter.
    pub zeta: f64,
    /// `g₀` of S1 … S4.
    pub sums: [Complex64; 4],
    /// `g₁` of S1 … S4.
    pub differences: [Complex64; 4],
}

/// The same as numbers of a series: path, ζ̂, then `g₀` and `g₁` (re, im by element).
pub const PAIR_CHANNELS: usize = 18;

impl From<[f64; PAIR_CHANNELS]> for PairValues {
    fn from(channels: [f64; PAIR_CHANNELS]) -> Self {
        let [path, zeta, elements @ ..] = channels;
        let at = |k: usize| Complex64::new(elements[2 * k], elements[2 * k + 1]);
        let (sums, differences) = ([0, 1, 2, 3].map(at), [4, 5, 6, 7].map(at));
        Self { path, zeta, sums, differences }
    }
}

impl From<PairValues> for [f64; PAIR_CHANNELS] {
    fn from(values: PairValues) -> Self {
        let mut channels = [values.path, values.zeta]
            .into_iter()
            .chain(values.sums.into_iter().chain(values.differences).flat_map(|g| [g.re, g.im]));
        std::array::from_fn(|_| channels.next().unwrap_or_default())
    }
}

impl PairValues {
    /// `|g|²` of all elements.
    pub(super) fn size(&self) -> f64 {
        self.sums.iter().chain(&self.differences).map(Complex64::norm_sqr).sum()
    }

    /// Whether the roots of both are on the same sheet.
    pub(super) fn agrees_with(&self, other: &Self) -> bool {
        let product = |(a, b): (&Complex64, &Complex64)| a.re * b.re + a.im * b.im;
        let (sums, differences) =
            (self.sums.iter().zip(&other.sums), self.differences.iter().zip(&other.differences));
        sums.chain(differences).map(product).sum::<f64>() >= 0.0
    }

    /// On the other sheet of the roots.
    pub(super) fn negated(self) -> Self {
        let negated = |g: [Complex64; 4]| g.map(|g| -g);
        Self { sums: negated(self.sums), differences: negated(self.differences), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_sheets_of_the_roots_are_told_apart() {
        let values = PairValues::from(std::array::from_fn(|c| c as f64 - 6.5));
        assert_eq!(<[f64; PAIR_CHANNELS]>::from(values), std::array::from_fn(|c| c as f64 - 6.5));
        assert_eq!((values.path, values.zeta, values.sums[0].im), (-6.5, -5.5, -3.5));
        let other = values.negated();
        assert!(values.agrees_with(&values) && !values.agrees_with(&other));
        // paths and ζ̂ are the same on both sheets
        assert_eq!(
            (other.path, other.zeta, other.size()),
            (values.path, values.zeta, values.size())
        );
        assert_eq!(other.negated(), values);
    }
}
