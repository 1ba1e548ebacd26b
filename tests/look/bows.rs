//! Airy's theory of the rainbow, and how to read a profile: for tests of Lee diagrams.
//!
//! Nothing here uses the program's own physics but the index of water and the observer's curve.

use gonio::color::{Illuminant, Observer};
use gonio::medium::Medium;
use std::f64::consts::PI;

pub const WATER: Medium = Medium::Water { temperature: 293.15 };
/// Wavelength for what does not depend on colour, metres.
pub const GREEN: f64 = 550e-9;
/// Arguments -z of the maxima of Ai² (Abramowitz & Stegun, table 10.13: zeros of Ai').
pub const AIRY_MAXIMA: [f64; 4] = [1.01879297, 3.24819758, 4.82009921, 6.16330736];

/// Rainbow angle of ray optics, degrees.
pub fn descartes(n: f64, p: f64) -> f64 {
    let incident = ((n * n - 1.0) / (p * p - 1.0)).sqrt().acos();
    let refracted = (incident.sin() / n).asin();
    let turned = ((p - 1.0) * PI + 2.0 * incident - 2.0 * p * refracted) % (2.0 * PI);
    turned.min(2.0 * PI - turned).to_degrees()
}

/// van de Hulst's h of a bow (1957, section 13.23).
pub fn curvature(n: f64, p: f64) -> f64 {
    (p * p - 1.0).powi(2) / (p * p) * ((p * p - n * n) / (n * n - 1.0).powi(3)).sqrt()
}

/// Degrees from the angle of ray optics per unit of the Airy function's argument.
pub fn airy_scale(radius: f64, wavelength: f64, n: f64, p: f64) -> f64 {
    let x = 2.0 * PI * radius / wavelength;
    (curvature(n, p).cbrt() / x.powf(2.0 / 3.0)).to_degrees()
}

/// Ai(v): Maclaurin's series up to 5, asymptotic series beyond (Abramowitz & Stegun 10.4.2, 10.4.59).
pub fn ai(v: f64) -> f64 {
    let zeta = 2.0 / 3.0 * v.abs().powf(1.5);
    if v > 5.0 {
        return (-zeta).exp() / (2.0 * PI.sqrt() * v.powf(0.25)) * (1.0 - 5.0 / (72.0 * zeta));
    }
    if v < -5.0 {
        let (s, c) = (zeta + PI / 4.0).sin_cos();
        let even = 1.0 - 385.0 / 10368.0 / (zeta * zeta);
        return (s * even - c * 5.0 / (72.0 * zeta)) / (PI.sqrt() * v.abs().powf(0.25));
    }
    let (mut f, mut g, mut first, mut second) = (1.0, v, 1.0, v);
    for k in 1..40 {
        let k = f64::from(3 * k);
        first *= v * v * v / (k * (k - 1.0));
        second *= v * v * v / (k * (k + 1.0));
        f += first;
        g += second;
    }
    0.355028053887817 * f - 0.258819403792807 * g
}

/// Luminance of a bow of drops in daylight by Airy's theory, under a sun of 0.533°, any scale.
pub fn airy_luminance(radius: f64, p: f64, theta: &[f64]) -> Vec<f64> {
    let away = if p == 2.0 { 1.0 } else { -1.0 };
    let step = theta[1] - theta[0];
    let reach = (SUN_RADIUS / step).ceil() as i64;
    let chord = |k: i64| (SUN_RADIUS.powi(2) - (k as f64 * step).powi(2)).max(0.0).sqrt();
    let count = theta.len() as i64;
    let mut point = vec![0.0; theta.len()];
    for nm in (390..=720).step_by(2) {
        let wavelength = f64::from(nm) * 1e-9;
        let n = WATER.index(wavelength).unwrap().re;
        let weight = Illuminant::D65.power(wavelength) * Observer::Cie1931.matching(wavelength)[1];
        // dC/dΩ over the cross-section goes with x^(1/3) Ai².
        let weight = weight * wavelength.powf(-1.0 / 3.0);
        let (bow, scale) = (descartes(n, p), airy_scale(radius, wavelength, n, p));
        for (sum, t) in point.iter_mut().zip(theta) {
            *sum += weight * ai(-away * (t - bow) / scale).powi(2);
        }
    }
    let at = |i: i64| point[i.clamp(0, count - 1) as usize];
    (0..count).map(|i| (-reach..=reach).map(|k| chord(k) * at(i + k)).sum()).collect()
}

/// Degrees.
const SUN_RADIUS: f64 = 0.2665;

/// A maximum of a profile.
#[derive(Clone, Copy, Debug)]
pub struct Peak {
    pub theta: f64,
    pub height: f64,
    /// Above the higher of the two valleys that part it from higher ground.
    pub prominence: f64,
}

/// Maxima between two angles (degrees), ascending, angles refined by a parabola.
pub fn peaks(theta: &[f64], values: &[f64], from: f64, to: f64) -> Vec<Peak> {
    let inside: Vec<usize> =
        (0..theta.len()).filter(|&i| (from..=to).contains(&theta[i])).collect();
    let (first, last) = (inside[0], inside[inside.len() - 1]);
    let mut out = Vec::new();
    for i in first + 1..last {
        let (a, b, c) = (values[i - 1], values[i], values[i + 1]);
        if !(b > a && b >= c) {
            continue;
        }
        let valley = |side: &mut dyn Iterator<Item = usize>| {
            let mut lowest = b;
            for j in side {
                if values[j] > b {
                    break;
                }
                lowest = lowest.min(values[j]);
            }
            lowest
        };
        let left = valley(&mut (first..i).rev());
        let right = valley(&mut (i + 1..=last));
        let shift = 0.5 * (a - c) / (a - 2.0 * b + c) * (theta[i + 1] - theta[i]);
        out.push(Peak { theta: theta[i] + shift, height: b, prominence: b - left.max(right) });
    }
    out
}

/// The bow and its supernumeraries, away from the dark band: from the highest maximum on.
pub fn bow(theta: &[f64], values: &[f64], p: f64) -> Vec<Peak> {
    let (from, to) = if p == 2.0 { (134.0, theta[theta.len() - 1]) } else { (theta[0], 132.0) };
    let mut found = peaks(theta, values, from, to);
    if p != 2.0 {
        found.reverse();
    }
    let highest = (0..found.len()).max_by(|&i, &j| found[i].height.total_cmp(&found[j].height));
    found.split_off(highest.unwrap())
}

/// Contrast of the first supernumerary: (max - min) / (max + min) of its crest and the valley
/// between it and the bow; 0 where it has no crest.
pub fn first_contrast(theta: &[f64], values: &[f64]) -> f64 {
    let found = bow(theta, values, 2.0);
    let [main, first, ..] = found.as_slice() else { return 0.0 };
    let between = theta.iter().zip(values).filter(|(t, _)| (main.theta..first.theta).contains(*t));
    let valley = between.map(|(_, v)| *v).fold(f64::INFINITY, f64::min);
    (first.height - valley) / (first.height + valley)
}
