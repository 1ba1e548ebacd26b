//! The drops, the sun and the aim that make the bow of a photograph: least squares on cuts across it.
//!
//! Along each cut what is measured is `a + b t + g · bow(θ)` in three channels: the light behind the bow changes
//! linearly, the bow has one strength. Those are linear and drop out; the radius of the drops, the spread of their sizes,
//! the sun's elevation and the camera's azimuth are found by Levenberg & Marquardt from the best of a grid of radii.
//! Their uncertainties are those of the least squares: from what is left and how fast it grows.

use super::cut::{Cell, scattering_angle};
use glam::DQuat;

/// What is sought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bow {
    /// Of the drops, metres.
    pub radius: f64,
    /// Standard deviation of ln(radius).
    pub spread: f64,
    /// Of the sun, radians.
    pub sun_elevation: f64,
    /// Of the camera from the antisolar direction, beyond the one given, radians.
    pub turn: f64,
}

/// What was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted {
    /// The best bow.
    pub bow: Bow,
    /// Standard deviations, in the same order.
    pub deviation: Bow,
    /// Brightness of the bow, in linear light of the photograph per unit of the curves.
    pub strength: f64,
    /// Root mean square of what is left, in linear light.
    pub rms: f64,
}

/// Colours of a bow over even steps of the scattering angle, linear sRGB.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// First and last angle, radians.
    pub theta: [f64; 2],
    /// At even steps.
    pub rgb: Vec<[f64; 3]>,
}

impl Curve {
    fn at(&self, theta: f64) -> [f64; 3] {
        let [from, to] = self.theta;
        let last = self.rgb.len() - 1;
        let place = ((theta - from) / (to - from)).clamp(0.0, 1.0) * last as f64;
        let i = (place as usize).min(last - 1);
        let f = place - i as f64;
        std::array::from_fn(|c| (1.0 - f) * self.rgb[i][c] + f * self.rgb[i + 1][c])
    }
}

/// Parameters, and the steps by which derivatives are taken.
const STEPS: [f64; 4] = [0.01, 0.01, 1e-3, 1e-3];
const ROUNDS: usize = 25;
/// Changes in units of the steps below which the search ends.
const SETTLED: f64 = 0.02;

/// Widest spread of sizes.
const WIDEST: f64 = 0.5;
/// Steps of elevation and turn that are looked at with each curve, one after the other, radians.
const LOOKS: [[f64; 2]; 3] = [[0.010, 0.020], [0.0025, 0.008], [0.0008, 0.003]];

/// Radii that are tried first, metres, and spreads with each.
const FIRST: (f64, f64, usize) = (10e-6, 1e-3, 15);
const SPREADS: [f64; 2] = [0.05, 0.25];

/// Where a fit begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Start {
    /// The aim is nearly known, the drops are not.
    Aim(Bow),
    /// All is nearly known: found in cuts laid out for another aim.
    Near(Bow),
}

/// Fit; `curve` makes the colours of drops of a radius and a spread. Cuts should be laid out for nearly the right aim: an aim that is off
/// by a degree smears the bow within each. So fit, cut anew for what was found, and fit again.
///
/// # Errors
/// Those of `curve`, and in words why nothing fits.
pub fn fit<E>(
    cells: &[Cell],
    start: Start,
    mut curve: impl FnMut(f64, f64) -> Result<Curve, E>,
) -> Result<Result<Fitted, String>, E> {
    if cells.len() < 60 {
        let words = "the cut meets too little of the picture: is the aim right (sun, horizon, azimuth, field of view)?";
        return Ok(Err(words.into()));
    }
    let begun = match start {
        Start::Near(bow) => Some(bow),
        Start::Aim(bow) => searched(cells, bow, &mut curve)?,
    };
    let Some(mut bow) = begun else {
        let words = "no bow is found along the cut: is the antisolar point where the shadow of the camera was?";
        return Ok(Err(words.into()));
    };
    let mut damping = 1e-2;
    let mut colours = curve(bow.radius, bow.spread)?;
    let (mut left, mut strength) = residual(cells, &bow, &colours);
    let mut normal = [[0.0; 4]; 4];
    for _ in 0..ROUNDS {
        let mut slopes: Vec<Vec<f64>> = Vec::with_capacity(4);
        for k in 0..4 {
            // away from the end of the range
            let side = if k == 1 && bow.spread > WIDEST - STEPS[1] { -1.0 } else { 1.0 };
            let beside = moved(&bow, k, side);
            let near = if k < 2 { curve(beside.radius, beside.spread)? } else { colours.clone() };
            let (other, _) = residual(cells, &beside, &near);
            slopes.push(other.iter().zip(&left).map(|(b, a)| side * (b - a)).collect());
        }
        let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        let right: [f64; 4] = std::array::from_fn(|k| -dot(&slopes[k], &left));
        for i in 0..4 {
            (0..4).for_each(|k| normal[i][k] = dot(&slopes[i], &slopes[k]));
        }
        let mut moved_by = [0.0; 4];
        let mut better = false;
        for _ in 0..8 {
            let mut system = normal;
            (0..4).for_each(|k| system[k][k] *= 1.0 + damping);
            let Some(change) = solved(system, right) else { break };
            let tried = (0..4).fold(bow, |bow, k| moved(&bow, k, change[k].clamp(-20.0, 20.0)));
            let near = curve(tried.radius, tried.spread)?;
            let (other, its) = residual(cells, &tried, &near);
            if its > 0.0 && square(&other) < square(&left) {
                (bow, colours, left, strength) = (tried, near, other, its);
                damping = f64::max(0.2 * damping, 1e-6);
                (moved_by, better) = (change, true);
                break;
            }
            damping *= 6.0;
        }
        if !better || moved_by.iter().all(|change| change.abs() < SETTLED) {
            break;
        }
    }
    let free = (left.len() as f64 - 5.0).max(1.0);
    let variance = square(&left) / free;
    let deviation: [f64; 4] = std::array::from_fn(|k| {
        let unit = std::array::from_fn(|i| f64::from(u8::from(i == k)));
        let found = solved(normal, unit).map_or(f64::INFINITY, |column| column[k]);
        (variance * found.max(0.0)).sqrt() * STEPS[k]
    });
    let deviation = Bow {
        radius: bow.radius * deviation[0],
        spread: deviation[1],
        sun_elevation: deviation[2],
        turn: deviation[3],
    };
    let weight: f64 = 3.0 * cells.iter().map(|cell| cell.count).sum::<f64>();
    let rms = (square(&left) / weight).sqrt();
    Ok(Ok(Fitted { bow, deviation, strength, rms }))
}

/// The best of a grid of radii and spreads, each with its best aim.
fn searched<E>(
    cells: &[Cell],
    start: Bow,
    mut curve: impl FnMut(f64, f64) -> Result<Curve, E>,
) -> Result<Option<Bow>, E> {
    let mut best: Option<(f64, Bow)> = None;
    let (from, to, count) = FIRST;
    for k in 0..count {
        let radius = from * (to / from).powf(k as f64 / (count - 1) as f64);
        for spread in SPREADS {
            let colours = curve(radius, spread)?;
            let aimed = aimed(cells, Bow { radius, spread, ..start }, &colours);
            best = aimed.into_iter().chain(best).min_by(|a, b| a.0.total_cmp(&b.0));
        }
    }
    Ok(best.map(|(_, bow)| bow))
}

/// Of the colours of some drops: the sun and the turn near the given ones that fit best, with the squares left; nothing where light
/// would have to be taken away.
fn aimed(cells: &[Cell], start: Bow, curve: &Curve) -> Option<(f64, Bow)> {
    let mut best: Option<(f64, Bow)> = None;
    let mut about = start;
    for [elevation, turn] in LOOKS {
        for i in -4..=4 {
            for k in -2..=2 {
                let bow = Bow {
                    sun_elevation: about.sun_elevation + elevation * f64::from(i),
                    turn: about.turn + turn * f64::from(k),
                    ..start
                };
                let (left, strength) = residual(cells, &bow, curve);
                let sum = square(&left);
                if strength > 0.0 && best.is_none_or(|(least, _)| sum < least) {
                    best = Some((sum, bow));
                }
            }
        }
        about = best?.1;
    }
    best
}

/// A bow with one parameter changed by so many steps.
fn moved(bow: &Bow, k: usize, steps: f64) -> Bow {
    let by = steps * STEPS[k];
    let mut bow = *bow;
    match k {
        0 => bow.radius = (bow.radius * by.exp()).clamp(2e-6, 3e-3),
        1 => bow.spread = (bow.spread + by).clamp(0.0, WIDEST),
        2 => bow.sun_elevation += by,
        _ => bow.turn += by,
    }
    bow
}

fn square(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum()
}

/// What is left of the cells without the best background of each cut and the best strength of the bow, weighted by the
/// roots of the numbers of pixels; and that strength.
fn residual(cells: &[Cell], bow: &Bow, curve: &Curve) -> (Vec<f64>, f64) {
    let turn = DQuat::from_rotation_z(-bow.turn);
    let colours: Vec<[f64; 3]> = cells
        .iter()
        .map(|cell| curve.at(scattering_angle(turn * cell.view, bow.sun_elevation)))
        .collect();
    let mut measured = vec![0.0; 3 * cells.len()];
    let mut modelled = measured.clone();
    let mut first = 0;
    for part in cells.chunk_by(|a, b| a.sector == b.sector) {
        let range = first..first + part.len();
        for c in 0..3 {
            let data: Vec<f64> = part.iter().map(|cell| cell.rgb[c]).collect();
            let model: Vec<f64> = range.clone().map(|i| colours[i][c]).collect();
            for (values, out) in [(data, &mut measured), (model, &mut modelled)] {
                for (k, value) in without_line(part, &values).into_iter().enumerate() {
                    out[3 * (first + k) + c] = value;
                }
            }
        }
        first = range.end;
    }
    let along: f64 = measured.iter().zip(&modelled).map(|(a, b)| a * b).sum();
    let strength = along / square(&modelled).max(f64::MIN_POSITIVE);
    let left = measured.iter().zip(&modelled).map(|(a, b)| a - strength * b).collect();
    (left, strength)
}

/// Values of a cut without their best line, times the roots of the numbers of pixels.
fn without_line(cells: &[Cell], values: &[f64]) -> Vec<f64> {
    let [mut n, mut t, mut tt, mut v, mut tv] = [0.0; 5];
    for (cell, value) in cells.iter().zip(values) {
        let w = cell.count;
        n += w;
        t += w * cell.along;
        tt += w * cell.along * cell.along;
        v += w * value;
        tv += w * cell.along * value;
    }
    let determinant = (n * tt - t * t).max(f64::MIN_POSITIVE);
    let (slope, base) = ((n * tv - t * v) / determinant, (tt * v - t * tv) / determinant);
    let left =
        |(cell, value): (&Cell, &f64)| cell.count.sqrt() * (value - base - slope * cell.along);
    cells.iter().zip(values).map(left).collect()
}

/// Gauss's elimination with pivots; nothing where the equations say nothing.
fn solved<const N: usize>(mut a: [[f64; N]; N], mut b: [f64; N]) -> Option<[f64; N]> {
    for k in 0..N {
        let pivot = (k..N).max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs()))?;
        a.swap(k, pivot);
        b.swap(k, pivot);
        if a[k][k].is_nan() || a[k][k].abs() <= 1e-300 {
            return None;
        }
        for i in k + 1..N {
            let share = a[i][k] / a[k][k];
            let own = a[k];
            a[i].iter_mut().zip(own).skip(k).for_each(|(value, own)| *value -= share * own);
            b[i] -= share * b[k];
        }
    }
    for k in (0..N).rev() {
        let rest: f64 = (k + 1..N).map(|j| a[k][j] * b[j]).sum();
        b[k] = (b[k] - rest) / a[k][k];
    }
    Some(b)
}
