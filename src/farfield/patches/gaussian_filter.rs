//! The paper's stand-in for diffraction: a Gaussian blur of the intensity near a bow.
//!
//! Sadeghi et al. 2012, Table II: standard deviation by drop radius, found by comparison with
//! Lorenz–Mie for spheres, doubled for the secondary bow. "Sharp transitions" are taken where the
//! number of rays of an order changes from one sample to the next: there a bow begins.

/// Radius (mm) and standard deviation (degrees).
const TABLE: [(f64, f64); 10] = [
    (0.1, 0.70),
    (0.2, 0.45),
    (0.3, 0.30),
    (0.4, 0.25),
    (0.5, 0.22),
    (0.6, 0.20),
    (0.7, 0.18),
    (0.8, 0.17),
    (0.9, 0.16),
    (1.0, 0.15),
];

/// How far from a bow, in standard deviations, the filter acts and reaches.
const REACH: f64 = 4.0;

/// Standard deviation in radians for a drop radius in metres; constant beyond the table's ends.
pub fn standard_deviation(radius: f64) -> f64 {
    let mm = radius * 1e3;
    let above = TABLE.iter().position(|row| row.0 >= mm).unwrap_or(TABLE.len());
    let degrees = if above == 0 {
        TABLE[0].1
    } else if above == TABLE.len() {
        TABLE[above - 1].1
    } else {
        let ((r0, s0), (r1, s1)) = (TABLE[above - 1], TABLE[above]);
        s0 + (s1 - s0) * (mm - r0) / (r1 - r0)
    };
    degrees.to_radians()
}

/// A bow on a line of constant azimuth.
#[derive(Clone, Copy, Debug)]
pub struct Bow {
    /// Its scattering angle, radians.
    pub theta: f64,
    /// Number of chords.
    pub order: u32,
}

/// Bows on a line: where the ray count of an order ≥ 2 changes by two between neighbours.
pub fn bows(theta: &[f64], counts: &[Vec<u16>]) -> Vec<Bow> {
    let count = |i: usize, p: usize| counts[i].get(p).copied().unwrap_or(0);
    let orders = counts.iter().map(Vec::len).max().unwrap_or(0);
    let mut found = Vec::new();
    for i in 1..theta.len() {
        for p in 2..orders {
            if count(i, p).abs_diff(count(i - 1, p)) >= 2 {
                let order = p as u32;
                found.push(Bow { theta: 0.5 * (theta[i] + theta[i - 1]), order });
            }
        }
    }
    found
}

/// Blur a line of values (any Mueller element) at samples `theta` (radians, ascending) near bows.
pub fn apply(theta: &[f64], values: &[f64], bows: &[Bow], sigma: f64) -> Vec<f64> {
    let width = |bow: &Bow| if bow.order == 3 { 2.0 * sigma } else { sigma };
    let nearest = |t: f64| {
        bows.iter()
            .map(|bow| ((t - bow.theta).abs() / width(bow), width(bow)))
            .filter(|(distance, _)| *distance < REACH)
            .min_by(|a, b| a.0.total_cmp(&b.0))
    };
    theta
        .iter()
        .zip(values)
        .map(|(&t, &value)| nearest(t).map_or(value, |(_, s)| blurred(theta, values, t, s)))
        .collect()
}

/// Gaussian mean about `t`, with the samples' own spacing as weight.
fn blurred(theta: &[f64], values: &[f64], t: f64, sigma: f64) -> f64 {
    let from = theta.partition_point(|&x| x < t - REACH * sigma);
    let to = theta.partition_point(|&x| x <= t + REACH * sigma);
    let (mut sum, mut weights) = (0.0, 0.0);
    for i in from..to {
        let below = if i > 0 { theta[i] - theta[i - 1] } else { 0.0 };
        let above = if i + 1 < theta.len() { theta[i + 1] - theta[i] } else { 0.0 };
        let weight = (below + above) * (-0.5 * ((theta[i] - t) / sigma).powi(2)).exp();
        sum += weight * values[i];
        weights += weight;
    }
    if weights > 0.0 { sum / weights } else { values[from.min(values.len() - 1)] }
}
