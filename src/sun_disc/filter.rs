//! The average over the sun's disc, together with a low-pass filter, as one kernel on an even grid.
//!
//! A sum of samples weighted by the disc alone would fold every beat above the sampling rate back
//! into the colours. The kernel is therefore the disc's profile (its brightness along chords)
//! convolved with a sinc under a Kaiser window (Kaiser & Schafer 1980, IEEE Trans. ASSP 28, 105):
//! slow beats are damped exactly as the disc damps them, fast ones vanish.

use crate::color::{LimbDarkening, SUN_ANGULAR_RADIUS};
use std::f64::consts::PI;

/// Attenuation in the stop band, decibels: 0.3 % of what the disc lets pass.
const ATTENUATION: f64 = 50.0;
/// Points of the tables, and nodes across the disc.
const FINE: usize = 1000;
const POINTS: usize = 300;
const NODES: usize = 40;

/// A low-pass filter in angle.
#[derive(Clone, Debug)]
pub struct SunFilter {
    /// Half width of the windowed sinc, radians.
    half: f64,
    /// Frequency from which on nothing passes, radians⁻¹.
    highest: f64,
    sinc: Table,
}

/// An even function by linear interpolation, 0 beyond its table.
#[derive(Clone, Debug)]
struct Table {
    step: f64,
    values: Vec<f64>,
}

/// The filtered profile of the disc at one wavelength.
#[derive(Clone, Debug)]
pub struct Kernel(Table);

impl SunFilter {
    /// Pass frequencies (radians⁻¹) up to `cutoff`, stop those from `cutoff + transition`.
    pub fn new(cutoff: f64, transition: f64) -> Self {
        let half = (ATTENUATION - 8.0) / 2.285 / transition;
        let shape = 0.1102 * (ATTENUATION - 8.7);
        let middle = cutoff + 0.5 * transition;
        let sinc = Table::new(half, FINE, |u| {
            let window = bessel_i0(shape * (1.0 - (u / half).powi(2)).max(0.0).sqrt());
            let sinc = if u == 0.0 { middle / PI } else { (middle * u).sin() / (PI * u) };
            sinc * window / bessel_i0(shape)
        });
        Self { half, highest: cutoff + transition, sinc }
    }

    /// How far from an angle the average reaches, radians.
    pub fn reach(&self) -> f64 {
        self.half + SUN_ANGULAR_RADIUS
    }

    /// How far the low-pass filter alone reaches, radians.
    pub(crate) fn half_width(&self) -> f64 {
        self.half
    }

    /// The fastest beat that passes, radians⁻¹.
    pub(crate) fn highest(&self) -> f64 {
        self.highest
    }

    /// The low-pass filter alone, at an angle from its middle.
    pub(crate) fn low_pass(&self, angle: f64) -> f64 {
        self.sinc.at(angle)
    }

    /// The kernel of a disc with this limb darkening.
    pub fn kernel(&self, limb: &LimbDarkening) -> Kernel {
        // Nodes at the sines of even steps: the profile is a square root at the limb.
        let nodes: Vec<(f64, f64)> = (0..NODES)
            .map(|i| {
                let turn = PI * ((i as f64 + 0.5) / NODES as f64 - 0.5);
                (turn.sin(), limb.chord(turn.sin()) * turn.cos())
            })
            .collect();
        let norm: f64 = nodes.iter().map(|n| n.1).sum();
        Kernel(Table::new(self.reach(), POINTS, |u| {
            let at = |(place, weight): &(f64, f64)| {
                weight / norm * self.sinc.at(u - place * SUN_ANGULAR_RADIUS)
            };
            nodes.iter().map(at).sum()
        }))
    }
}

impl Kernel {
    /// Average of `values` on the even grid `theta` (of that step) about each angle of `centres`.
    pub fn average<const N: usize>(
        &self,
        theta: &[f64],
        step: f64,
        values: &[[f64; N]],
        centres: &[f64],
    ) -> Vec<[f64; N]> {
        let reach = self.0.step * (self.0.values.len() - 2) as f64;
        centres
            .iter()
            .map(|&centre| {
                let from = theta.partition_point(|&t| t <= centre - reach);
                let to = theta.partition_point(|&t| t < centre + reach);
                let mut sum = [0.0; N];
                for (t, value) in theta[from..to].iter().zip(&values[from..to]) {
                    let weight = step * self.0.at(t - centre);
                    for (s, v) in sum.iter_mut().zip(value) {
                        *s += weight * v;
                    }
                }
                sum
            })
            .collect()
    }
}

impl Table {
    fn new(reach: f64, points: usize, f: impl Fn(f64) -> f64) -> Self {
        let step = reach / points as f64;
        // One more point than the reach, for the interpolation at its end.
        let mut values: Vec<f64> = (0..=points).map(|i| f(i as f64 * step)).collect();
        values.push(0.0);
        Self { step, values }
    }

    fn at(&self, u: f64) -> f64 {
        let place = u.abs() / self.step;
        let low = place as usize;
        if low + 1 >= self.values.len() {
            return 0.0;
        }
        let share = place - low as f64;
        self.values[low] + share * (self.values[low + 1] - self.values[low])
    }
}

/// Modified Bessel function I₀ by its power series.
fn bessel_i0(x: f64) -> f64 {
    let quarter = 0.25 * x * x;
    let (mut term, mut sum) = (1.0, 1.0);
    for k in 1..60 {
        term *= quarter / f64::from(k * k);
        sum += term;
        if term < 1e-16 * sum {
            break;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sun_disc::DiscPoints;

    /// A slow beat comes out as a sum over the disc's directions gives it, a fast one not at all.
    #[test]
    fn slow_beats_as_the_disc_fast_beats_never() {
        let (cutoff, transition, highest) = (500.0, 1000.0, 4000.0);
        let filter = SunFilter::new(cutoff, transition);
        let limb = LimbDarkening::at(550e-9);
        let kernel = filter.kernel(&limb);
        let step = std::f64::consts::TAU / (highest + cutoff + transition);
        let theta: Vec<f64> = (0..2000).map(|i| 2.0 + (f64::from(i) - 1000.0) * step).collect();
        let disc = DiscPoints::new(SUN_ANGULAR_RADIUS, 60, 240);
        for frequency in [0.0, 100.0, 300.0, 499.0, 1600.0, 2500.0, 3999.0] {
            let beat = |t: f64| (frequency * (t - 2.0) + 0.7).cos();
            let values: Vec<[f64; 1]> = theta.iter().map(|&t| [beat(t)]).collect();
            let (mut sum, mut norm) = (0.0, 0.0);
            for (&ring, &mu) in disc.ring.iter().zip(&disc.mu) {
                for turn in &disc.turn {
                    let weight = limb.brightness(mu);
                    sum += weight * beat(2.01 + ring * turn.cos());
                    norm += weight;
                }
            }
            let expected = if frequency < cutoff + 0.5 * transition { sum / norm } else { 0.0 };
            let [got] = kernel.average(&theta, step, &values, &[2.01])[0];
            assert!((got - expected).abs() < 4e-3, "{frequency}: {got} {expected}");
        }
    }

    /// Abramowitz & Stegun 1964, table 9.8: I₀(1) and I₀(5) e⁻⁵.
    #[test]
    fn bessel_function_as_tabulated() {
        approx::assert_relative_eq!(bessel_i0(1.0), 1.266_065_878, max_relative = 1e-9);
        let scaled = bessel_i0(5.0) * (-5.0f64).exp();
        approx::assert_relative_eq!(scaled, 0.183_540_812_6, max_relative = 1e-9);
    }
}
