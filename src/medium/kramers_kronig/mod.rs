//! Kramers–Kronig: the change of n that an absorption brings, and the reverse.
//!
//! With `ω = 1/λ` (any unit of frequency will do) and `n_b` the background without the bands:
//!
//! `n(ω) − n_b(ω) = (2/π) P∫ ω' k(ω')/(ω'² − ω²) dω' = (H(ω) + H(−ω))/π`,
//! `k(ω) = −(2ω/π) P∫ (n − n_b)(ω')/(ω'² − ω²) dω' = −(H(ω) − H(−ω))/π`,
//!
//! `H(s) = P∫ f(x)/(x − s) dx` over the data's range (Lucarini et al. 2005, eqs. 2.45; Weidlich &
//! Wilkie 2009, eqs. 10–12). Two methods:
//! - **analytic**: k is a quintic spline in ω (or straight lines) and is integrated exactly through the
//!   pole. Any spacing of rows, any wavelength, not just those of the rows.
//! - **Maclaurin** (Ohta & Ishida 1988, as in Weidlich & Wilkie 2009, eq. 15): every other row is
//!   summed, so that the pole is never met. Equally spaced rows only, and only at those.
//!
//! Data end somewhere. Beyond either end k falls to zero over one row's spacing, or follows the
//! wing of a Lorentz band ([`Tails`]).

pub mod transform;

use crate::math::monotone::MonotoneCurve;
use crate::math::principal_value::PiecewisePolynomial;
use crate::medium::error::{MediumError, invalid};
use std::f64::consts::PI;

/// What k does beyond the ends of the data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tails {
    /// It falls to zero over one row's spacing.
    Taper,
    /// It goes on as the wing of the Lorentz band that has the position and the width of the
    /// data's highest peak, scaled to meet the last row.
    LorentzBand,
}

/// How k runs between the rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Between {
    /// Straight lines.
    Lines,
    /// Cubic splines.
    Spline,
}

/// An absorption k(λ), ready for the transform at any wavelength.
#[derive(Clone, Debug, PartialEq)]
pub struct Absorption {
    wavelength: Vec<f64>,
    curve: MonotoneCurve,
    transform: PiecewisePolynomial,
}

impl Absorption {
    /// k at ascending wavelengths in metres, splines between the rows.
    pub fn new(wavelength: &[f64], k: &[f64], tails: Tails) -> Result<Self, MediumError> {
        Self::with(wavelength, k, tails, Between::Spline)
    }

    /// As [`Absorption::new`], with a choice of what runs between the rows.
    pub fn with(
        wavelength: &[f64],
        k: &[f64],
        tails: Tails,
        between: Between,
    ) -> Result<Self, MediumError> {
        if let Some(bad) = k.iter().find(|k| **k < 0.0 || !k.is_finite()) {
            return Err(invalid("k", bad, "0 or more"));
        }
        let curve = curve(wavelength, k)?;
        let (mut omega, mut values) = by_frequency(wavelength, k);
        if tails == Tails::LorentzBand {
            extend(&mut omega, &mut values)?;
        }
        let transform = transform(&omega, &values, between);
        Ok(Self { wavelength: wavelength.to_vec(), curve, transform })
    }

    /// k at a wavelength in metres; zero outside the data.
    pub fn extinction(&self, wavelength: f64) -> f64 {
        let (from, to) = self.range();
        if (from..=to).contains(&wavelength) { self.curve.value(wavelength) } else { 0.0 }
    }

    /// `n − n_b` at a wavelength in metres.
    pub fn index_change(&self, wavelength: f64) -> f64 {
        let omega = 1.0 / wavelength;
        (self.transform.principal_value(omega) + self.transform.principal_value(-omega)) / PI
    }

    /// First and last wavelength of the data, metres.
    pub fn range(&self) -> (f64, f64) {
        (self.wavelength[0], self.wavelength[self.wavelength.len() - 1])
    }
}

/// `n − n_b` at every row after Maclaurin's formula. Rows must be equally spaced in wavelength.
pub fn maclaurin(wavelength: &[f64], k: &[f64]) -> Result<Vec<f64>, MediumError> {
    let step = equal_step(wavelength)?;
    let at_row = |i: usize| {
        let here = wavelength[i] * wavelength[i];
        // Rows of the other parity than i: the pole at row i is stepped over.
        let others = ((i + 1) % 2..wavelength.len()).step_by(2);
        let sum: f64 =
            others.map(|j| k[j] / (wavelength[j] * (here - wavelength[j] * wavelength[j]))).sum();
        2.0 * here / PI * 2.0 * step * sum
    };
    Ok((0..wavelength.len()).map(at_row).collect())
}

/// k at every row from `n − n_b` there, by the analytic method; the change of n is taken as zero
/// beyond the data, so they must reach well beyond the bands.
pub fn extinction_from_index(
    wavelength: &[f64],
    index_change: &[f64],
    between: Between,
) -> Result<Vec<f64>, MediumError> {
    curve(wavelength, index_change)?;
    let (omega, values) = by_frequency(wavelength, index_change);
    let transform = transform(&omega, &values, between);
    let at_row = |w: &f64| {
        let omega = 1.0 / w;
        -(transform.principal_value(omega) - transform.principal_value(-omega)) / PI
    };
    Ok(wavelength.iter().map(at_row).collect())
}

/// What the ends of the data are worth at every row: by how much k would change if `n − n_b` did not
/// end with them, but went on as it must somewhere: constant towards long waves, and falling as `λ²`
/// towards short ones (as far above all bands). Without this, a k from a short range of n looks as
/// good as any. At the very ends, where the integral diverges, half a row's distance is taken.
///
/// With `Δ₁` and `Δ₂` the changes of n in the first and the last row in frequency,
/// `δk = |Δ₁/π · ln((ω + ω₁)/(ω − ω₁))| + |2ωω₂²Δ₂/π · (ln((ω₂ + ω)/(ω₂ − ω))/2ω³ − 1/ω²ω₂)|`.
pub fn worth_of_range(wavelength: &[f64], index_change: &[f64]) -> Result<Vec<f64>, MediumError> {
    curve(wavelength, index_change)?;
    let (omega, values) = by_frequency(wavelength, index_change);
    let last = omega.len() - 1;
    let (low, high) = (omega[0], omega[last]);
    let half_row = [0.5 * (omega[1] - low), 0.5 * (high - omega[last - 1])];
    let at_row = |w: &f64| {
        let omega = 1.0 / w;
        let (above, below) = ((omega - low).max(half_row[0]), (high - omega).max(half_row[1]));
        let long = values[0] / PI * ((omega + low) / above).ln();
        let integral =
            ((high + omega) / below).ln() / (2.0 * omega.powi(3)) - 1.0 / (omega * omega * high);
        let short = 2.0 * omega / PI * values[last] * high * high * integral;
        long.abs() + short.abs()
    };
    Ok(wavelength.iter().map(at_row).collect())
}

fn transform(omega: &[f64], values: &[f64], between: Between) -> PiecewisePolynomial {
    let last = omega.len() - 1;
    let below = (omega[1] - omega[0]).min(omega[0]);
    let above = omega[last] - omega[last - 1];
    let pieces = match between {
        Between::Lines => PiecewisePolynomial::linear(omega, values),
        Between::Spline => PiecewisePolynomial::spline(omega, values),
    };
    pieces.tapered(below, above)
}

/// The rows in ascending order of `ω = 1/λ`.
fn by_frequency(wavelength: &[f64], values: &[f64]) -> (Vec<f64>, Vec<f64>) {
    (wavelength.iter().rev().map(|w| 1.0 / w).collect(), values.iter().rev().copied().collect())
}

fn equal_step(wavelength: &[f64]) -> Result<f64, MediumError> {
    let count = wavelength.len();
    let step =
        if count > 1 { (wavelength[count - 1] - wavelength[0]) / (count - 1) as f64 } else { 0.0 };
    // Files print wavelengths to a few digits; a thousandth of a step covers that.
    let equal = wavelength.windows(2).all(|w| (w[1] - w[0] - step).abs() < 1e-3 * step);
    if count >= 3 && step > 0.0 && equal {
        return Ok(step);
    }
    Err(invalid(
        "spacing of the rows",
        "unequal",
        "equal steps of wavelength for the method maclaurin; analytic takes any",
    ))
}

/// Adds the wings of a Lorentz band at both ends.
fn extend(omega: &mut Vec<f64>, values: &mut Vec<f64>) -> Result<(), MediumError> {
    let (centre, width) = strongest_band(omega, values)?;
    let shape = |w: f64| w / ((centre * centre - w * w).powi(2) + (width * w).powi(2));
    let (first, last) = (omega[0], omega[omega.len() - 1]);
    let (low, high) = (values[0] / shape(first), values[values.len() - 1] / shape(last));
    // The wing falls as ω below and as ω⁻³ above: 64 rows down to zero, and up to 30 times the
    // last frequency, where nothing is left.
    const ROWS: usize = 64;
    let below: Vec<f64> = (0..ROWS).map(|i| first * i as f64 / ROWS as f64).collect();
    let ratio = 30.0_f64.powf(1.0 / (2 * ROWS) as f64);
    let above: Vec<f64> = (1..=2 * ROWS).map(|i| last * ratio.powi(i as i32)).collect();
    values.splice(0..0, below.iter().map(|&w| low * shape(w)));
    values.extend(above.iter().map(|&w| high * shape(w)));
    omega.splice(0..0, below);
    omega.extend(above);
    Ok(())
}

/// Position and full width at half height of the highest peak, in frequency.
fn strongest_band(omega: &[f64], values: &[f64]) -> Result<(f64, f64), MediumError> {
    let peak = (0..values.len()).max_by(|&a, &b| values[a].total_cmp(&values[b])).unwrap_or(0);
    let half = 0.5 * values[peak];
    let crossing = |a: usize, b: usize| {
        omega[a] + (omega[b] - omega[a]) * (half - values[a]) / (values[b] - values[a])
    };
    let below = (1..=peak).rev().find(|&i| values[i - 1] < half).map(|i| crossing(i - 1, i));
    let above =
        (peak..values.len() - 1).find(|&i| values[i + 1] < half).map(|i| crossing(i, i + 1));
    let width = match (below, above) {
        (Some(a), Some(b)) => b - a,
        (Some(a), None) => 2.0 * (omega[peak] - a),
        (None, Some(b)) => 2.0 * (b - omega[peak]),
        (None, None) => {
            return Err(invalid(
                "band tails",
                "k without a peak",
                "data that hold a band and at least one of its half heights",
            ));
        }
    };
    Ok((omega[peak], width))
}

/// The curve through the rows of a column.
fn curve(x: &[f64], y: &[f64]) -> Result<MonotoneCurve, MediumError> {
    MonotoneCurve::new(x.to_vec(), y.to_vec()).ok_or_else(|| {
        invalid(
            "table",
            format!("{} wavelengths, {} values", x.len(), y.len()),
            "as many values as wavelengths, ascending, at least two",
        )
    })
}
