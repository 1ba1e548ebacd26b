//! An axis: what it says, from where to where, and its ticks.

use crate::render::plots::heat_map::power_of_ten;
use crate::render::plots::ticks;

/// An axis of a chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The quantity with its unit.
    pub label: String,
    /// Least value.
    pub from: f64,
    /// Greatest value.
    pub to: f64,
    /// Whether even steps are even factors.
    pub logarithmic: bool,
}

impl Default for Axis {
    fn default() -> Self {
        Self::linear("", 0.0, 1.0)
    }
}

/// Decades from which on whole powers of ten alone are named.
const MANY_DECADES: f64 = 3.5;

impl Axis {
    /// Of even steps.
    pub fn linear(label: &str, from: f64, to: f64) -> Self {
        Self { label: label.into(), from, to, logarithmic: false }
    }

    /// Of even factors.
    pub fn logarithmic(label: &str, from: f64, to: f64) -> Self {
        Self { label: label.into(), from, to, logarithmic: true }
    }

    /// Where a value is: 0 at the start, 1 at the end; not finite for what a logarithmic axis cannot show.
    pub(super) fn share(&self, value: f64) -> f64 {
        match self.logarithmic {
            true => (value / self.from).ln() / (self.to / self.from).ln(),
            false => (value - self.from) / (self.to - self.from),
        }
    }

    /// Values with the words at their ticks, no more than fit.
    pub(super) fn ticks(&self, most: usize) -> Vec<(f64, String)> {
        let values = if self.logarithmic {
            ticks::logarithmic(self.from, self.to)
        } else {
            ticks::linear(self.from, self.to)
        };
        let decades = (self.to / self.from).log10();
        let values: Vec<f64> = match self.logarithmic && decades > MANY_DECADES {
            true => (self.from.log10().ceil() as i32..=self.to.log10().floor() as i32)
                .map(|power| 10f64.powi(power))
                .collect(),
            false => values,
        };
        let every = values.len().div_ceil(most.max(2)).max(1);
        // of even steps those that are multiples of the wider step, 0 among them
        let step = match values.as_slice() {
            [first, second, ..] if !self.logarithmic => second - first,
            _ => 0.0,
        };
        let kept = |(i, value): (usize, &f64)| match step > 0.0 {
            true => (value / step).round() as i64 % every as i64 == 0,
            false => i % every == 0,
        };
        let kept: Vec<f64> =
            values.iter().enumerate().filter(|&(i, v)| kept((i, v))).map(|(_, v)| *v).collect();
        kept.into_iter().map(|value| (value, self.words(value))).collect()
    }

    fn words(&self, value: f64) -> String {
        let power = value.abs().log10();
        let whole = (power - power.round()).abs() < 1e-9;
        match self.logarithmic {
            true if whole && !(-3.5..4.5).contains(&power) => power_of_ten(power.round() as i32),
            true if (self.to / self.from).log10() > MANY_DECADES && whole => {
                power_of_ten(power.round() as i32)
            }
            _ => trimmed(value),
        }
    }
}

/// A number without trailing zeros.
fn trimmed(value: f64) -> String {
    if value != 0.0 && value.abs() < 1e-4 {
        return format!("{value:.0e}");
    }
    let text = format!("{value:.5}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.replace('-', "−") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_named_shortly() {
        let words = |axis: Axis, most| -> Vec<String> {
            axis.ticks(most).into_iter().map(|(_, words)| words).collect()
        };
        assert_eq!(
            words(Axis::logarithmic("", 1e-9, 1.0), 20),
            ["10⁻⁹", "10⁻⁸", "10⁻⁷", "10⁻⁶", "10⁻⁵", "10⁻⁴", "10⁻³", "10⁻²", "10⁻¹", "10⁰"]
        );
        assert_eq!(words(Axis::logarithmic("", 0.1, 1.0), 9)[..2], ["0.1", "0.2"]);
        assert_eq!(words(Axis::linear("", -1.0, 1.0), 20)[0], "−1");
        assert_eq!(words(Axis::linear("", -3.0, 3.0), 4), ["−2", "0", "2"]);
    }

    #[test]
    fn shares_run_from_start_to_end() {
        let axis = Axis::logarithmic("", 0.1, 1000.0);
        assert!((axis.share(10.0) - 0.5).abs() < 1e-12 && !axis.share(-1.0).is_finite());
        assert_eq!(Axis::linear("", 2.0, 4.0).share(3.0), 0.5);
    }
}
