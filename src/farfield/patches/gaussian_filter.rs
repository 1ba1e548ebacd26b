//! The paper's stand-in for diffraction: a Gaussian blur of the intensity near a bow.
//!
//! Sadeghi et al. 2012, Table II: standard deviation by drop radius, found by comparison with
//! Lorenz–Mie for spheres, doubled for the secondary bow. "Sharp transitions" are taken where the
//! number of rays of an order changes from one sample to the next: there a bow begins.

/// Radius (mm) and standard deviation (degrees), as printed.
pub(crate) const TABLE: [(f64, f64); 10] = [
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deviations_are_those_of_the_table() {
        for (mm, degrees) in [(0.1, 0.70), (0.35, 0.275), (1.0, 0.15), (0.05, 0.70), (3.0, 0.15)] {
            let found = standard_deviation(mm * 1e-3).to_degrees();
            assert!((found - degrees).abs() < 1e-12, "{mm}: {found}");
        }
    }

    fn grid() -> Vec<f64> {
        (0..=4000).map(|k| 2.0 + 1e-4 * f64::from(k)).collect()
    }

    /// A step becomes an error function about its bow, twice as wide for the secondary bow.
    #[test]
    fn a_step_at_a_bow_becomes_an_error_function() {
        let (theta, sigma) = (grid(), 0.005);
        let values: Vec<f64> = theta.iter().map(|&t| if t < 2.2 { 1.0 } else { 3.0 }).collect();
        for (order, width) in [(2, sigma), (3, 2.0 * sigma)] {
            let bow = Bow { theta: 2.2, order };
            let found = apply(&theta, &values, &[bow], sigma);
            for (k, &t) in theta.iter().enumerate() {
                let away = (t - 2.2) / width;
                let exact = 2.0 + libm::erf(away / 2f64.sqrt());
                if away.abs() < 3.9 {
                    assert!((found[k] - exact).abs() < 0.01, "{order} {t}: {} {exact}", found[k]);
                } else if away.abs() > 4.1 {
                    assert_eq!(found[k], values[k]);
                }
            }
        }
    }

    /// What is even stays, on uneven samples too.
    #[test]
    fn a_constant_stays() {
        let theta: Vec<f64> = (0..300).map(|k| 2.0 + 1e-5 * f64::from(k * k)).collect();
        let found = apply(&theta, &[0.7; 300], &[Bow { theta: 2.3, order: 2 }], 0.05);
        assert!(found.iter().all(|v| (v - 0.7).abs() < 1e-13));
    }

    #[test]
    fn bows_are_where_rays_of_an_order_come_or_go() {
        let theta = [1.0, 1.1, 1.2, 1.3];
        let counts = [vec![1, 1, 0], vec![1, 3, 2, 1], vec![1, 1, 2], vec![1, 1, 0, 2]];
        let found: Vec<(f64, u32)> =
            bows(&theta, &counts).into_iter().map(|bow| (bow.theta, bow.order)).collect();
        // orders 0 and 1 have none; one ray more is no bow
        assert_eq!(found.len(), 3);
        assert!((found[0].0 - 1.05).abs() < 1e-15 && found[0].1 == 2);
        assert!((found[1].0 - 1.25).abs() < 1e-15 && found[1].1 == 2 && found[2].1 == 3);
    }
}
