//! A number of a paper, beside ours.

use crate::math::digits::to_digits;
use serde::Serialize;

/// A quantity that a figure shows, as the paper gives it and as it comes out here.
///
/// ```
/// use gonio::figures::Number;
/// let bow = Number::beside("primary bow", "°", 137.7, 137.68);
/// assert!((bow.difference().unwrap() + 0.02).abs() < 1e-12);
/// assert_eq!(bow.cells(), ["primary bow", "137.7 °", "137.68 °", "-0.02 °"]);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Number {
    /// What it is.
    pub quantity: String,
    /// Its unit; empty for none.
    pub unit: &'static str,
    /// The paper's.
    pub paper: Option<f64>,
    /// This program's.
    pub ours: f64,
}

/// Digits that are printed.
const DIGITS: usize = 5;
/// Below this numbers have a power of ten.
const SMALL: f64 = 1e-3;

impl Number {
    /// A number that the paper gives.
    pub fn beside(quantity: impl Into<String>, unit: &'static str, paper: f64, ours: f64) -> Self {
        Self { quantity: quantity.into(), unit, paper: Some(paper), ours: ours + 0.0 }
    }

    /// A number that the paper does not give.
    pub fn alone(quantity: impl Into<String>, unit: &'static str, ours: f64) -> Self {
        Self { quantity: quantity.into(), unit, paper: None, ours }
    }

    /// Ours less the paper's.
    pub fn difference(&self) -> Option<f64> {
        self.paper.map(|paper| self.ours - paper)
    }

    /// Quantity, the paper's, ours and the difference, in words.
    pub fn cells(&self) -> [String; 4] {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        let words = |value: f64, digits| {
            // 0 has no sign, and what is small its power of ten
            let value = to_digits(value, digits) + 0.0;
            match value.abs() < SMALL && value != 0.0 {
                true => format!("{value:e}{unit}"),
                false => format!("{value}{unit}"),
            }
        };
        let or_none = |value: Option<f64>, digits| value.map_or("-".into(), |v| words(v, digits));
        [
            self.quantity.clone(),
            or_none(self.paper, DIGITS),
            words(self.ours, DIGITS),
            or_none(self.difference(), 2),
        ]
    }
}
