//! Dispersion formulas, with the numbers and coefficients of the refractiveindex.info database
//! (M. N. Polyanskiy, Sci. Data 11, 94, 2024, "Dispersion formulas"). Wavelengths in micrometres.
//!
//! | number | name | law |
//! |---|---|---|
//! | 1 | Sellmeier | `n² − 1 = C1 + Σ C2 λ²/(λ² − C3²)` |
//! | 2 | Sellmeier | `n² − 1 = C1 + Σ C2 λ²/(λ² − C3)` |
//! | 3 | Polynomial | `n² = C1 + Σ C2 λ^C3` |
//! | 4 | RefractiveIndex.INFO | `n² = C1 + C2 λ^C3/(λ² − C4^C5) + C6 λ^C7/(λ² − C8^C9) + Σ C10 λ^C11` |
//! | 5 | Cauchy | `n = C1 + Σ C2 λ^C3` |
//! | 6 | Gases | `n − 1 = C1 + Σ C2/(C3 − λ⁻²)` |
//! | 7 | Herzberger | `n = C1 + C2 L + C3 L² + C4 λ² + C5 λ⁴ + C6 λ⁶`, `L = 1/(λ² − 0.028)` |
//! | 8 | Retro | `(n² − 1)/(n² + 2) = C1 + C2 λ²/(λ² − C3) + C4 λ²` |
//! | 9 | Exotic | `n² = C1 + C2/(λ² − C3) + C4 (λ − C5)/((λ − C5)² + C6)` |

use crate::medium::error::{MediumError, invalid};

/// A dispersion formula with its coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    kind: Kind,
    coefficients: Vec<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    SellmeierSquared,
    Sellmeier,
    Polynomial,
    Info,
    Cauchy,
    Gases,
    Herzberger,
    Retro,
    Exotic,
}

/// The constant of Herzberger's formula, µm².
const HERZBERGER: f64 = 0.028;

impl Formula {
    /// The formula of a number from 1 to 9; missing coefficients of the fixed forms are zero.
    pub fn new(number: u32, coefficients: Vec<f64>) -> Result<Self, MediumError> {
        let kind = match number {
            1 => Kind::SellmeierSquared,
            2 => Kind::Sellmeier,
            3 => Kind::Polynomial,
            4 => Kind::Info,
            5 => Kind::Cauchy,
            6 => Kind::Gases,
            7 => Kind::Herzberger,
            8 => Kind::Retro,
            9 => Kind::Exotic,
            _ => return Err(invalid("formula", number, "a number from 1 to 9")),
        };
        check_coefficients(kind, &coefficients)?;
        Ok(Self { kind, coefficients })
    }

    /// `n = A + B/λ² + C/λ⁴ + …`, coefficients in µm⁰, µm², µm⁴, ….
    pub fn cauchy(coefficients: &[f64]) -> Result<Self, MediumError> {
        let mut all = Vec::with_capacity(2 * coefficients.len());
        for (i, &c) in coefficients.iter().enumerate() {
            all.push(c);
            if i > 0 {
                all.push(-2.0 * i as f64);
            }
        }
        Self::new(5, all)
    }

    /// `n² = 1 + Σ bᵢ λ²/(λ² − cᵢ)`, `c` in µm².
    pub fn sellmeier(b: &[f64], c: &[f64]) -> Result<Self, MediumError> {
        if b.len() != c.len() || b.is_empty() {
            let value = format!("{} values of b, {} of c_um2", b.len(), c.len());
            return Err(invalid("sellmeier", value, "as many b as c_um2, at least one of each"));
        }
        let pairs = b.iter().zip(c).flat_map(|(&b, &c)| [b, c]);
        Self::new(2, std::iter::once(0.0).chain(pairs).collect())
    }

    /// Real index at a wavelength in micrometres; NaN where the formula has no real value.
    pub fn index(&self, um: f64) -> f64 {
        let c = |i: usize| self.coefficients.get(i).copied().unwrap_or(0.0);
        let l2 = um * um;
        let first = c(0);
        match self.kind {
            Kind::SellmeierSquared => {
                (1.0 + first + self.pairs(1, |b, c| b * l2 / (l2 - c * c))).sqrt()
            }
            Kind::Sellmeier => (1.0 + first + self.pairs(1, |b, c| b * l2 / (l2 - c))).sqrt(),
            Kind::Polynomial => (first + self.pairs(1, |b, p| b * um.powf(p))).sqrt(),
            Kind::Cauchy => first + self.pairs(1, |b, p| b * um.powf(p)),
            Kind::Gases => 1.0 + first + self.pairs(1, |b, c| b / (c - 1.0 / l2)),
            Kind::Info => {
                let term = |i: usize| match c(i) {
                    0.0 => 0.0,
                    strength => strength * um.powf(c(i + 1)) / (l2 - c(i + 2).powf(c(i + 3))),
                };
                (first + term(1) + term(5) + self.pairs(9, |b, p| b * um.powf(p))).sqrt()
            }
            Kind::Herzberger => {
                let l = 1.0 / (l2 - HERZBERGER);
                first + l * (c(1) + l * c(2)) + l2 * (c(3) + l2 * (c(4) + l2 * c(5)))
            }
            Kind::Retro => {
                let q = first + c(1) * l2 / (l2 - c(2)) + c(3) * l2;
                ((1.0 + 2.0 * q) / (1.0 - q)).sqrt()
            }
            Kind::Exotic => {
                let d = um - c(4);
                (first + c(1) / (l2 - c(2)) + c(3) * d / (d * d + c(5))).sqrt()
            }
        }
    }

    /// Wavelengths in micrometres at which a term of the formula is infinite, ascending.
    pub fn poles(&self) -> Vec<f64> {
        let c = |i: usize| self.coefficients.get(i).copied().unwrap_or(0.0);
        let every_second = |from: usize| {
            let pairs = self.coefficients.get(from..).unwrap_or(&[]).chunks_exact(2);
            pairs.filter(|p| p[0] != 0.0).map(|p| p[1])
        };
        let squares: Vec<f64> = match self.kind {
            Kind::SellmeierSquared => every_second(1).map(|c| c * c).collect(),
            Kind::Sellmeier => every_second(1).collect(),
            Kind::Gases => every_second(1).map(|c| 1.0 / c).collect(),
            Kind::Info => [1, 5]
                .into_iter()
                .filter(|&i| c(i) != 0.0)
                .map(|i| c(i + 2).powf(c(i + 3)))
                .collect(),
            Kind::Herzberger if c(1) != 0.0 || c(2) != 0.0 => vec![HERZBERGER],
            Kind::Retro | Kind::Exotic if c(1) != 0.0 => vec![c(2)],
            _ => Vec::new(),
        };
        let mut poles: Vec<f64> = squares.into_iter().filter(|s| *s > 0.0).map(f64::sqrt).collect();
        if self.kind == Kind::Exotic && c(3) != 0.0 && c(5) <= 0.0 {
            poles.extend([c(4) - (-c(5)).sqrt(), c(4) + (-c(5)).sqrt()]);
        }
        poles.sort_by(f64::total_cmp);
        poles
    }

    /// Refuses a range (micrometres) that holds a pole, or in which the index is not real and
    /// positive.
    pub fn check_range(&self, from: f64, to: f64) -> Result<(), MediumError> {
        if let Some(pole) = self.poles().into_iter().find(|p| (from..=to).contains(p)) {
            let accepted = format!("no pole may lie in the valid range {from} to {to} µm");
            return Err(invalid("pole of the formula", format!("{pole} µm"), &accepted));
        }
        // A ratio of 201 steps over the range finds sign changes that the poles do not announce.
        for i in 0..=200 {
            let um = from * (to / from).powf(f64::from(i) / 200.0);
            let n = self.index(um);
            if !(n.is_finite() && n > 0.0) {
                let field = format!("index by the formula at {um:.4} µm");
                return Err(invalid(&field, n, "a positive real number in all of the valid range"));
            }
        }
        Ok(())
    }

    /// The widest interval in micrometres without a pole about `um`.
    pub fn interval_about(&self, um: f64) -> (f64, f64) {
        let poles = self.poles();
        let below = poles.iter().copied().filter(|p| *p < um).fold(0.0, f64::max);
        let above = poles.iter().copied().filter(|p| *p > um).fold(f64::INFINITY, f64::min);
        (below, above)
    }

    fn pairs(&self, from: usize, term: impl Fn(f64, f64) -> f64) -> f64 {
        let pairs = self.coefficients.get(from..).unwrap_or(&[]).chunks_exact(2);
        pairs.filter(|p| p[0] != 0.0).map(|p| term(p[0], p[1])).sum()
    }
}

fn check_coefficients(kind: Kind, coefficients: &[f64]) -> Result<(), MediumError> {
    if let Some(bad) = coefficients.iter().find(|c| !c.is_finite()) {
        return Err(invalid("coefficients", bad, "finite numbers"));
    }
    let count = coefficients.len();
    let (fits, accepted) = match kind {
        Kind::Herzberger => ((1..=6).contains(&count), "1 to 6 coefficients"),
        Kind::Retro => ((1..=4).contains(&count), "1 to 4 coefficients"),
        Kind::Exotic => ((1..=6).contains(&count), "1 to 6 coefficients"),
        Kind::Info => (
            count == 1 || count == 5 || (count >= 9 && count % 2 == 1),
            "1, 5, 9, 11, 13, … of them",
        ),
        _ => (count % 2 == 1, "an odd number: the first one, then pairs"),
    };
    if fits { Ok(()) } else { Err(invalid("number of coefficients", count, accepted)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each number against its law written out by hand at one wavelength.
    #[test]
    fn every_law_gives_what_its_definition_says() {
        let um: f64 = 0.6;
        let l2 = 0.36;
        let herzberger = 1.0 / (l2 - 0.028);
        let cases: [(u32, &[f64], f64); 9] = [
            (1, &[0.1, 1.1, 0.2], (1.1_f64 + 1.1 * l2 / (l2 - 0.04)).sqrt()),
            (2, &[0.1, 1.1, 0.02], (1.1_f64 + 1.1 * l2 / (l2 - 0.02)).sqrt()),
            (3, &[2.2, 0.01, -2.0, -0.01, 2.0], (2.2_f64 + 0.01 / l2 - 0.01 * l2).sqrt()),
            (
                4,
                &[2.0, 0.5, 1.0, 0.2, 2.0, 0.1, 2.0, 9.0, 1.0, 0.03, 4.0],
                (2.0 + 0.5 * um / (l2 - 0.04) + 0.1 * l2 / (l2 - 9.0) + 0.03 * l2 * l2).sqrt(),
            ),
            (5, &[1.5, 0.004, -2.0], 1.5 + 0.004 / l2),
            (6, &[0.0, 0.05, 230.0], 1.0 + 0.05 / (230.0 - 1.0 / l2)),
            (
                7,
                &[1.5, 0.02, 0.001, -1e-3, 1e-4, -1e-5],
                1.5 + 0.02 * herzberger + 0.001 * herzberger * herzberger - 1e-3 * l2
                    + 1e-4 * l2 * l2
                    - 1e-5 * l2.powi(3),
            ),
            (8, &[0.2, 0.05, 0.03, -1e-3], {
                let q: f64 = 0.2 + 0.05 * l2 / (l2 - 0.03) - 1e-3 * l2;
                ((1.0 + 2.0 * q) / (1.0 - q)).sqrt()
            }),
            (9, &[2.0, 0.1, 0.02, 0.01, 0.4, 0.01], {
                (2.0 + 0.1 / (l2 - 0.02) + 0.01 * 0.2 / (0.04 + 0.01)).sqrt()
            }),
        ];
        for (number, coefficients, expected) in cases {
            let formula = Formula::new(number, coefficients.to_vec()).unwrap();
            assert!((formula.index(um) - expected).abs() < 1e-14, "formula {number}");
        }
    }

    #[test]
    fn poles_are_found_where_the_formula_blows_up() {
        let cases: [(u32, &[f64], &[f64]); 6] = [
            (1, &[0.0, 1.0, 0.5, 1.0, 0.1], &[0.1, 0.5]),
            (2, &[0.0, 1.0, 0.25, 0.0, 0.36], &[0.5]),
            (4, &[2.0, 0.5, 1.0, 0.5, 2.0], &[0.5]),
            (6, &[0.0, 0.05, 4.0], &[0.5]),
            (8, &[0.2, 0.05, 0.25], &[0.5]),
            (9, &[2.0, 0.0, 0.0, 0.1, 0.5, -0.01], &[0.4, 0.6]),
        ];
        for (number, coefficients, poles) in cases {
            let formula = Formula::new(number, coefficients.to_vec()).unwrap();
            let found = formula.poles();
            assert_eq!(found.len(), poles.len(), "formula {number}: {found:?}");
            for (a, b) in found.iter().zip(poles) {
                assert!((a - b).abs() < 1e-12, "formula {number}: {found:?}");
            }
            assert!(formula.check_range(0.35, 0.7).is_err());
        }
    }

    #[test]
    fn wrong_numbers_of_coefficients_are_refused() {
        for (number, count) in [(1, 2), (4, 4), (4, 8), (7, 7), (8, 5), (9, 7), (2, 0), (0, 1)] {
            assert!(Formula::new(number, vec![1.0; count]).is_err(), "{number} with {count}");
        }
        assert!(Formula::new(5, vec![f64::NAN]).is_err());
    }
}
