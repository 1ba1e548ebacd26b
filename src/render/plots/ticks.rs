//! Where an axis has its ticks: round numbers, five to a dozen or so of them.

/// Fewest ticks that make an axis readable, and fewest of a logarithmic one.
const FEWEST: usize = 5;
const FEWEST_LOGARITHMIC: usize = 6;
/// Leading digits of the ticks of a decade, from sparse to dense.
const DIGITS: [&[u32]; 4] = [&[1], &[1, 2, 5], &[1, 2, 3, 5, 7], &[1, 2, 3, 4, 5, 6, 7, 8, 9]];

/// Round numbers from `low` to `high` (`0 < low < high`), spread evenly in their logarithm. A range
/// that is too narrow for whole leading digits gets even steps.
pub(in crate::render) fn logarithmic(low: f64, high: f64) -> Vec<f64> {
    let decades = low.log10().floor() as i32..=high.log10().ceil() as i32;
    for digits in DIGITS {
        // Below 1 divided by a whole number, so that 0.3 is the nearest number to 0.3.
        let tick = |digit: u32, decade: i32| match decade {
            0.. => f64::from(digit) * 10f64.powi(decade),
            _ => f64::from(digit) / 10f64.powi(-decade),
        };
        let all =
            decades.clone().flat_map(|decade| digits.iter().map(move |&digit| tick(digit, decade)));
        let ticks: Vec<f64> = all.filter(|&v| within(v, low, high)).collect();
        if ticks.len() >= FEWEST_LOGARITHMIC {
            return ticks;
        }
    }
    linear(low, high)
}

/// Multiples of 1, 2 or 5 times a power of ten from `low` to `high` (`low < high`).
pub(in crate::render) fn linear(low: f64, high: f64) -> Vec<f64> {
    let power = 10f64.powf(((high - low) / FEWEST as f64).log10().floor());
    let fits = |step: &f64| (high - low) / step >= FEWEST as f64;
    let step = [5.0, 2.0, 1.0].map(|digit| digit * power).into_iter().find(fits).unwrap_or(power);
    let (first, last) = ((low / step).floor() as i64, (high / step).ceil() as i64);
    // Divided by a whole number where the step is a fraction, so that 3 steps of 0.1 are 0.3.
    let multiple =
        |k: i64| if step < 1.0 { k as f64 / (1.0 / step).round() } else { k as f64 * step };
    (first..=last).map(multiple).filter(|&v| within(v, low, high)).collect()
}

/// Inside, up to rounding.
fn within(value: f64, low: f64, high: f64) -> bool {
    let slack = 1e-9 * (high - low);
    (low - slack..=high + slack).contains(&value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_decade_is_labelled() {
        assert_eq!(logarithmic(0.01, 1.0), [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0]);
        assert_eq!(logarithmic(0.002, 3.0).len(), 10);
        assert_eq!(logarithmic(0.05, 0.3), [0.05, 0.06, 0.07, 0.08, 0.09, 0.1, 0.2, 0.3]);
        assert_eq!(logarithmic(1e-4, 10.0).len(), 6);
    }

    #[test]
    fn narrow_ranges_step_evenly() {
        assert_eq!(
            logarithmic(0.4, 0.6),
            [0.4, 0.42, 0.44, 0.46, 0.48, 0.5, 0.52, 0.54, 0.56, 0.58, 0.6]
        );
        assert_eq!(linear(120.0, 150.0), [120.0, 125.0, 130.0, 135.0, 140.0, 145.0, 150.0]);
        assert_eq!(linear(0.4, 1.0), [0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]);
    }
}
