//! A curve over the scattering angle as the sun's disc smears it.
//!
//! Scattering without azimuth dependence, `f(θ)`, lit by a disc instead of a point, is the mean of
//! `f` over a disc of directions around θ, weighted with the sun's limb darkening. Every sample of
//! the curve that lies in the disc counts, so fine interference ripple averages out as it does in
//! the sky, instead of being sampled.

use crate::color::LimbDarkening;

/// Sub-steps across half the disc at the least; coarser curves are interpolated.
const STEPS: f64 = 24.0;
/// Nodes along a chord of the disc; the integrand is smooth after the sine substitution.
const CHORD_NODES: usize = 12;

/// Mean over the disc of the curve `values` at `theta` (ascending, radians), at the angles `out`.
/// A `radius` of 0 interpolates. Angles outside the curve give its end values.
pub fn smooth_over_sun(
    theta: &[f64],
    values: &[f64],
    wavelength: f64,
    radius: f64,
    out: &[f64],
) -> Vec<f64> {
    if theta.len() < 2 || radius <= 0.0 {
        return out.iter().map(|&t| interpolate(theta, values, t)).collect();
    }
    let limb = LimbDarkening::at(wavelength);
    out.iter()
        .map(|&centre| {
            // Away from the poles of the sphere a chord is straight (to 1e-3 of the disc).
            let flat = centre.sin() > 10.0 * radius;
            let weigh = |angle: f64| {
                if flat {
                    limb.chord((angle - centre) / radius)
                } else {
                    curved_chord(&limb, centre, angle, radius)
                }
            };
            let (mut sum, mut norm) = (0.0, 0.0);
            for_each_node(theta, centre, radius, |angle, width| {
                let weight = width * weigh(angle);
                sum += weight * interpolate(theta, values, angle);
                norm += weight;
            });
            if norm > 0.0 { sum / norm } else { interpolate(theta, values, centre) }
        })
        .collect()
}

/// Visit midpoints that cover the disc around `centre`, every interval of the curve in at least
/// one piece and the disc in at least `2 · STEPS`.
fn for_each_node(theta: &[f64], centre: f64, radius: f64, mut visit: impl FnMut(f64, f64)) {
    let (first, last) = (theta[0], theta[theta.len() - 1]);
    let (low, high) = ((centre - radius).max(first), (centre + radius).min(last));
    if high <= low {
        return;
    }
    let from = theta.partition_point(|&t| t <= low).saturating_sub(1);
    for pair in theta[from..].windows(2) {
        if pair[0] >= high {
            break;
        }
        let (a, b) = (pair[0].max(low), pair[1].min(high));
        let pieces = ((b - a) * STEPS / radius).ceil().max(1.0);
        let width = (b - a) / pieces;
        for i in 0..pieces as usize {
            visit(a + (i as f64 + 0.5) * width, width);
        }
    }
}

/// Brightness of the disc summed along the circle of scattering angle `angle`, exact on the sphere.
fn curved_chord(limb: &LimbDarkening, centre: f64, angle: f64, radius: f64) -> f64 {
    let (sc, cc) = centre.sin_cos();
    let (sa, ca) = angle.sin_cos();
    let product = sc * sa;
    let cosine =
        if product > 0.0 { ((radius.cos() - cc * ca) / product).clamp(-1.0, 1.0) } else { -1.0 };
    let half = cosine.acos();
    let quarter = std::f64::consts::FRAC_PI_2;
    (0..CHORD_NODES)
        .map(|i| {
            let u = quarter * (i as f64 + 0.5) / CHORD_NODES as f64;
            // 1 − cos γ without cancellation
            let hav = |x: f64| (0.5 * x).sin().powi(2);
            let distance = hav(centre - angle) + product * hav(half * u.sin());
            let mu = (1.0 - distance / hav(radius)).max(0.0).sqrt();
            sa * half * u.cos() * limb.brightness(mu)
        })
        .sum()
}

fn interpolate(theta: &[f64], values: &[f64], angle: f64) -> f64 {
    let last = theta.len() - 1;
    let above = theta.partition_point(|&t| t <= angle);
    if above == 0 || above > last {
        return values[above.min(last)];
    }
    let fraction = (angle - theta[above - 1]) / (theta[above] - theta[above - 1]);
    values[above - 1] + fraction * (values[above] - values[above - 1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::SUN_ANGULAR_RADIUS;
    use crate::sun_disc::DiscPoints;

    /// Against directions spread over the disc, at the bow, near the glory and at it.
    #[test]
    fn agrees_with_a_sum_over_the_disc() {
        let curve = |t: f64| 2.0 + (t * 150.0).sin();
        let theta: Vec<f64> = (0..=36000).map(|i| (0.005 * i as f64).to_radians()).collect();
        let values: Vec<f64> = theta.iter().map(|&t| curve(t)).collect();
        let disc = DiscPoints::new(SUN_ANGULAR_RADIUS, 60, 240);
        for degrees in [2.0, 60.0, 138.0, 179.8, 180.0] {
            let centre = f64::to_radians(degrees);
            let (mut sum, mut norm) = (0.0, 0.0);
            for (&ring, &mu) in disc.ring.iter().zip(&disc.mu) {
                for &turn in &disc.turn {
                    let angle =
                        (centre.cos() * ring.cos() + centre.sin() * ring.sin() * turn.cos()).acos();
                    let weight = LimbDarkening::at(550e-9).brightness(mu);
                    sum += weight * curve(angle);
                    norm += weight;
                }
            }
            let got = smooth_over_sun(&theta, &values, 550e-9, SUN_ANGULAR_RADIUS, &[centre])[0];
            assert!((got - sum / norm).abs() < 2e-3, "{degrees}: {got} {}", sum / norm);
        }
    }
}
