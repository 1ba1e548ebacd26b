//! Maxima of the bows and how far they shift from one table to the other.
//!
//! Both curves are first freed of their fine ripple. A maximum of the reference and one of the test
//! are a pair only within half the distance to the reference's next maximum: what lies further off
//! is another maximum, and is listed as one without a partner.

use super::curve::{Curve, nearest};
use crate::phase_table::PhaseTable;
use serde::Serialize;
use std::f64::consts::{PI, TAU};

/// A maximum of the reference and its partner.
#[derive(Clone, Debug, Serialize)]
pub struct Maximum {
    /// `primary`, `supernumerary 2 of the secondary`, …; empty between the bows and where ray optics
    /// knows none.
    pub name: String,
    /// Where the reference has it, degrees.
    pub reference_deg: f64,
    /// How much further the other table has it, degrees.
    pub shift_deg: f64,
}

/// All maxima of a comparison.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Maxima {
    #[serde(rename = "maxima")]
    /// Maxima that both have.
    pub pairs: Vec<Maximum>,
    /// Of the reference, without a partner in the test; degrees.
    #[serde(rename = "maxima_missing_deg")]
    pub missing_deg: Vec<f64>,
    /// Of the test, without a partner in the reference; degrees.
    #[serde(rename = "maxima_extra_deg")]
    pub extra_deg: Vec<f64>,
}

/// Angles between which maxima are looked for, and their step; degrees.
const RANGE: (f64, f64) = (120.0, 150.0);
const STEP: f64 = 0.02;
/// Distance of neighbours that a lone maximum is taken to have, degrees.
const LONE: f64 = 2.0;
/// A maximum rises by this factor above the lowest point within a degree …
const RISE: f64 = 1.1;
/// … and reaches this share of the highest.
const LEAST: f64 = 0.02;

/// Pair the maxima of two curves of drops with this size parameter (the smaller one) and index.
pub(super) fn maxima(test: &Curve, reference: &Curve, size_parameter: f64, index: f64) -> Maxima {
    let ripple = Ripple { size_parameter, dark_band: dark_band(index) };
    let truth = peaks(reference, &ripple);
    let names = names(&truth, index);
    let angles = |peaks: Vec<(f64, f64)>| peaks.into_iter().map(|peak| peak.0).collect();
    let (truth, found): (Vec<f64>, Vec<f64>) = (angles(truth), angles(peaks(test, &ripple)));
    let mut taken = vec![false; found.len()];
    let mut out = Maxima::default();
    for (i, &reference_deg) in truth.iter().enumerate() {
        let reach = 0.5 * spacing(&truth, i);
        let distance = |j: &usize| (found[*j] - reference_deg).abs();
        let nearest = (0..found.len())
            .filter(|&j| !taken[j])
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .filter(|j| distance(j) < reach);
        match nearest {
            Some(j) => {
                taken[j] = true;
                let shift_deg = found[j] - reference_deg;
                out.pairs.push(Maximum { name: names[i].clone(), reference_deg, shift_deg });
            }
            None => out.missing_deg.push(reference_deg),
        }
    }
    out.extra_deg = found.iter().zip(taken).filter(|(_, taken)| !taken).map(|(t, _)| *t).collect();
    out
}

/// Distance to the nearer neighbour.
fn spacing(peaks: &[f64], i: usize) -> f64 {
    let below = i.checked_sub(1).map(|j| peaks[i] - peaks[j]);
    let above = peaks.get(i + 1).map(|next| next - peaks[i]);
    below.into_iter().chain(above).fold(LONE, f64::min)
}

/// Size parameter at a wavelength of whichever drop is smaller: its ripple is the coarser one.
pub(super) fn size_parameter(test: &PhaseTable, reference: &PhaseTable, wavelength: f64) -> f64 {
    let of = |table: &PhaseTable| {
        nearest(table, wavelength).map_or(f64::NAN, |slab| slab.size_parameter(table.header.radius))
    };
    of(test).min(of(reference))
}

/// The fine ripple on the bows: external reflection beats with the bow's rays.
struct Ripple {
    size_parameter: f64,
    dark_band: Option<f64>,
}

impl Ripple {
    /// Its period at an angle, degrees: crests of rays that met the drop `d` radii apart are
    /// `360° / (d x)` apart. The rays of the primary come from the other side of the drop than the
    /// externally reflected ones (impacts 0.86 and -0.35), those of the secondary from the same
    /// (0.95 and 0.44).
    fn period(&self, theta: f64) -> f64 {
        let below = self.dark_band.is_some_and(|middle| theta < middle);
        360.0 / (if below { 0.5 } else { 1.2 } * self.size_parameter)
    }
}

/// Maxima of the smoothed curve that rise above their surroundings: angles (degrees, refined by a
/// parabola) and heights.
fn peaks(curve: &Curve, ripple: &Ripple) -> Vec<(f64, f64)> {
    let Some((_, values)) = curve.intensity.first() else { return Vec::new() };
    let count = ((RANGE.1 - RANGE.0) / STEP).round() as usize;
    let theta: Vec<f64> = (0..=count).map(|i| RANGE.0 + STEP * i as f64).collect();
    // A Gaussian of 0.6 periods leaves exp(-½ (2π 0.6)²) = 1e-3 of the ripple.
    let width = |t: f64| 0.6 * ripple.period(t);
    let smooth: Vec<f64> = theta.iter().map(|&t| smoothed(curve, values, t, width(t))).collect();
    let highest = smooth.iter().copied().fold(0.0, f64::max);
    let mut out = Vec::new();
    for i in 1..smooth.len() - 1 {
        let (a, b, c) = (smooth[i - 1], smooth[i], smooth[i + 1]);
        if !(b > a && b >= c && b > LEAST * highest) {
            continue;
        }
        let window = i.saturating_sub(50)..(i + 51).min(smooth.len());
        let lowest = smooth[window].iter().copied().fold(f64::INFINITY, f64::min);
        if b > RISE * lowest {
            out.push((theta[i] + STEP * 0.5 * (a - c) / (a - 2.0 * b + c), b));
        }
    }
    out
}

/// Mean of a curve about an angle, weighted by a Gaussian (degrees).
fn smoothed(curve: &Curve, values: &[f64], centre: f64, width: f64) -> f64 {
    let from = curve.theta.partition_point(|&t| t < centre - 3.0 * width);
    let to = curve.theta.partition_point(|&t| t <= centre + 3.0 * width);
    let (mut sum, mut norm) = (0.0, 0.0);
    for (t, v) in curve.theta[from..to].iter().zip(&values[from..to]) {
        let weight = (-0.5 * ((t - centre) / width).powi(2)).exp();
        sum += weight * v;
        norm += weight;
    }
    if norm > 0.0 { sum / norm } else { 0.0 }
}

/// Names after the bows of a sphere of that index: the highest maximum on either side of the dark
/// band is the bow, those away from the band its supernumeraries.
fn names(peaks: &[(f64, f64)], index: f64) -> Vec<String> {
    let mut names = vec![String::new(); peaks.len()];
    let Some(middle) = dark_band(index) else { return names };
    let above = peaks.partition_point(|peak| peak.0 < middle);
    let name = |bow: &str, k: usize| match k {
        0 => bow.to_string(),
        _ => format!("supernumerary {k} of the {bow}"),
    };
    let highest =
        |places: std::ops::Range<usize>| places.max_by(|&i, &j| peaks[i].1.total_cmp(&peaks[j].1));
    if let Some(bow) = highest(above..peaks.len()) {
        (bow..peaks.len()).for_each(|i| names[i] = name("primary", i - bow));
    }
    if let Some(bow) = highest(0..above) {
        (0..=bow).for_each(|i| names[i] = name("secondary", bow - i));
    }
    names
}

/// The middle of Alexander's dark band, degrees, where the secondary bow lies below the primary:
/// water and its like.
fn dark_band(index: f64) -> Option<f64> {
    let (primary, secondary) = (rainbow(index, 2.0)?, rainbow(index, 3.0)?);
    (secondary < primary).then_some(0.5 * (primary + secondary))
}

/// Rainbow angle of a sphere, degrees (Bohren & Huffman 1983, section 7.2).
fn rainbow(index: f64, order: f64) -> Option<f64> {
    let squared = (index * index - 1.0) / (order * order - 1.0);
    if !(0.0..1.0).contains(&squared) {
        return None;
    }
    let incident = squared.sqrt().acos();
    let refracted = (incident.sin() / index).asin();
    let turned = ((order - 1.0) * PI + 2.0 * incident - 2.0 * order * refracted).rem_euclid(TAU);
    Some(turned.min(TAU - turned).to_degrees())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A curve with bumps at these angles, of these heights.
    fn bumps(at: &[(f64, f64)]) -> Curve {
        let theta: Vec<f64> = (0..=3000).map(|i| 120.0 + 0.01 * f64::from(i)).collect();
        let value = |t: f64| {
            0.1 + at.iter().map(|(a, h)| h * (-0.5 * ((t - a) / 0.3).powi(2)).exp()).sum::<f64>()
        };
        let values = theta.iter().map(|&t| value(t)).collect();
        Curve { theta, intensity: vec![("unpolarised", values)] }
    }

    #[test]
    fn only_neighbours_are_paired() {
        // Bumps ever lower, as bow and supernumeraries are.
        let truth = bumps(&[(138.0, 1.0), (140.0, 0.6), (142.0, 0.5)]);
        let found = maxima(&bumps(&[(138.1, 1.0), (146.0, 0.5)]), &truth, 5000.0, 1.333);
        assert_eq!(found.pairs.len(), 1);
        assert_eq!(found.pairs[0].name, "primary");
        assert!((found.pairs[0].shift_deg - 0.1).abs() < 1e-3, "{found:?}");
        assert_eq!(found.missing_deg.len(), 2, "{found:?}");
        assert!((found.extra_deg[0] - 146.0).abs() < 1e-3 && found.extra_deg.len() == 1);
    }

    #[test]
    fn bows_of_water() {
        // rainbow_constants: n = 1.333 gives 137.9219° and 129.1092°.
        assert!((rainbow(1.333, 2.0).unwrap() - 137.9219).abs() < 1e-3);
        assert!((rainbow(1.333, 3.0).unwrap() - 129.1092).abs() < 1e-3);
    }
}
